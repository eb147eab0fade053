"""What the supervisor of Board 1 reads and writes in one step [spec §2.2, §2.3]."""

from dataclasses import dataclass, field

from rovercheck.supervisor.link.payloads import FromBoard2
from rovercheck.supervisor.types import Level, SafetyState, SupervisorCommand


@dataclass(frozen=True, slots=True)
class Board1Inputs:
    """The snapshots latched at the start of a step; times in ms of the clock of Board 1.

    Without arguments: what Board 1 finds at power-up.  Wheels are front left, front right, rear left, rear
    right.
    """

    now_ms: int = 0
    """Never before a stamp of the same step, except that the clock wraps."""
    last_valid_b2_ms: int = 0
    """When a new heartbeat of Board 2 was last seen."""
    b2_data_last_valid_ms: int = 0
    """When a frame of Board 2 was last accepted."""
    payload: FromBoard2 = field(default_factory=FromBoard2)
    temperature_degc: float = 0.0
    battery_pct: float = 0.0
    temp_last_valid_ms: int = 0
    batt_last_valid_ms: int = 0
    wheel_speed_rpm: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 0.0)
    has_no_feedback: tuple[bool, bool, bool, bool] = (False, False, False, False)
    """True where an encoder reads 0 rpm under a valid speed command [spec Fig 14, S32]."""


@dataclass(frozen=True, slots=True)
class Statuses:
    """How well each component of Board 1 works [spec Table 2]."""

    temp_status: Level = Level.OK
    batt_status: Level = Level.OK
    wheel_status: tuple[Level, Level, Level, Level] = (Level.OK, Level.OK, Level.OK, Level.OK)
    b2_sup_status: Level = Level.OK
    rx_status: Level = Level.OK


@dataclass(frozen=True, slots=True)
class Board1Outputs:
    """The outputs of one step, then what else a log holds; without arguments: before the first step."""

    v_ref: float = 0.0
    """Linear velocity in parts of full scale, [-1;1]."""
    omega_ref: float = 0.0
    """Angular velocity in parts of full scale, [-1;1], positive to the left."""
    critical_mask: int = 0
    degraded_mask: int = 0
    give_b2_actuation: bool = False
    actuate_emergency_stop: bool = False
    current_action: SupervisorCommand = SupervisorCommand.CMD_NORMAL

    statuses: Statuses = Statuses()
    stop_required: bool = False
    degraded_required: bool = False
    rover_safety_state: SafetyState = SafetyState.SAFETY_OK
    backward_enabled: bool = False
    v_user: float = 0.0
    omega_user: float = 0.0
    invert_y: bool = False
    is_rotating180: bool = False
    estop_recover_enabled: bool = False
    rover_is_stopped: bool = False
    target_angle: float = 0.0
    """Heading in degrees at which the half turn in progress, or the last one, ends."""
    angle_err: float = 0.0
    """Degrees left to turn when it was last computed, clockwise positive."""
