"""What the supervisor of Board 2 reads and produces in one step.

The lists follow the interface of Board 1 [spec §2.2, §2.3], for the sources that Board 2 has.
"""

from dataclasses import dataclass, field

from rovercheck.supervisor.board2.actuation import Actuated
from rovercheck.supervisor.board2.decision import Decision
from rovercheck.supervisor.board2.distances import Distances
from rovercheck.supervisor.board2.masks import Statuses
from rovercheck.supervisor.link.payloads import FromBoard1
from rovercheck.supervisor.types import SafetyState, SupervisorCommand

__all__ = ["Board2Inputs", "Board2Outputs", "FromBoard1", "Statuses"]

STOPPED = Actuated(stop_pin=True)
"""Nothing is sent, and the stop pin has its stop level."""


@dataclass(frozen=True, slots=True)
class Board2Inputs:
    """The snapshots at the start of a step; the initial values are those at power-up.

    Every stamp is in ms of the clock of Board 2 and 0 before the first valid update.
    """

    now_ms: int = 0
    last_valid_b1_ms: int = 0
    """When a step last saw the alive counter of Board 1 change [spec Table 2]."""
    b1_data_last_valid_ms: int = 0
    """When the last frame was accepted."""
    payload: FromBoard1 = field(default_factory=FromBoard1)
    dist_cm: Distances = (0.0, 0.0, 0.0)
    """Distances of the left, centre and right sonar, 0..344; 301 is no echo, 0 before the first scan."""
    sonar_last_valid_ms: int = 0
    """When the last scan was published; no block reads it."""
    yaw: float = 0.0
    """Heading in degrees, [0;360[, clockwise positive."""
    gz_dps: float = 0.0
    """Yaw rate in degrees/s, clockwise positive."""
    imu_last_valid_ms: int = 0
    x_norm: float = 0.0
    """Turning command of the joystick, [-1;1], positive to the left."""
    y_norm: float = 0.0
    """Speed command of the joystick, [-1;1], positive forward."""
    btn1: bool = False
    btn2: bool = False
    ble_last_valid_ms: int = 0


@dataclass(frozen=True, slots=True)
class Board2Outputs:
    """What one step produced, and the statuses that a log holds; the initial values are those at power-up."""

    b2_dec: Decision = Decision.READY
    """Obstacle decision: 0..4 of the chart for a healthy rover, 5 and 6 of that for a degraded one."""
    command: SupervisorCommand = SupervisorCommand.CMD_NORMAL
    """The decision in the words of Board 1 [spec Fig 12]."""
    critical_mask: int = 0
    """Bit 0 joystick link, 1 IMU, 2 reception from Board 1, 3 supervisor of Board 1."""
    degraded_mask: int = 0
    is_motion_consistent: bool = False
    """Whether IMU and wheels agree on the rotation."""
    autorized_to_send_command: bool = False
    """Whether Board 2 may send motor commands; the relay of Board 1 decides whether they arrive."""
    v_ref_actuation: float = 0.0
    """Linear reference, [-0.5;0.5]; 1 is 160 rpm."""
    omega_ref_actuation: float = 0.0
    """Angular reference, [-0.5;0.5], positive to the left."""
    actuate_emergency_stop: bool = False
    current_action: SupervisorCommand = SupervisorCommand.CMD_NORMAL
    actuated: Actuated = STOPPED
    """What goes to the motor driver and the stop pin."""

    deg_b1: bool = False
    """Whether the obstacle decision for a degraded rover counts."""
    statuses: Statuses = field(default_factory=Statuses)
    b2_emergency: bool = False
    b1_requests_switch: bool = False
    b1_emergency: bool = False
    rover_safety_state: SafetyState = SafetyState.SAFETY_OK
    cmd: SupervisorCommand = SupervisorCommand.CMD_NORMAL
    """What the obstacles allow while Board 2 actuates (read by the motion chart)."""
    backward_enabled: bool = False
