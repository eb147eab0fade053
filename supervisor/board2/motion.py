"""The motion of the rover while Board 2 drives it: normal running, half turn and emergency stop.

Executed in authorised steps only; in between everything keeps its value.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field
from enum import Enum, auto

from rovercheck.supervisor.motion import UserReferences, angle180, angle_error, check_stop, sign
from rovercheck.supervisor.timing import After, Duration, steps
from rovercheck.supervisor.types import Level, SafetyState, SupervisorCommand

SPEED_LIMIT = 0.5
"""V_MAX and OMEGA_MAX of a degraded rover; both are 0 in the critical state [spec Fig 20]."""
TURNED_DEG = 7.5
"""A half turn is over when less than this is left."""
COASTING_DEG = 45
"""Up to this error the half turn keeps the last angular reference."""


class State(Enum):
    """The states without children; the first two are of the running rover, the others of the stop."""

    NORMALE_MARCIA = auto()
    RETROMARCIA_180 = auto()
    IN_FRENATA_DI_EMERGENZA = auto()
    MOTORI_FERMI = auto()


RUNNING = (State.NORMALE_MARCIA, State.RETROMARCIA_180)


@dataclass(frozen=True, slots=True)
class MotionInputs:
    """What the motion of one step depends on; all values are finite but for the wheel speeds."""

    cmd: SupervisorCommand
    yaw: float
    wheel_speed_rpm: Sequence[float]
    x_norm: float
    y_norm: float
    safety_state: SafetyState
    rx_status: Level
    backward_enabled: bool

    @property
    def critical(self) -> bool:
        return self.safety_state is SafetyState.SAFETY_CRITICAL


@dataclass
class Motion:
    """``Motion_Supervision`` of Board 2."""

    v_ref: float = 0.0
    omega_ref: float = 0.0
    emergency_stop: bool = False
    current_action: SupervisorCommand = SupervisorCommand.CMD_NORMAL
    state: State | None = None
    user: UserReferences = field(default_factory=UserReferences)
    is_rotating180: bool = False
    estop_recover_enabled: bool = False
    rover_is_stopped: bool = False
    _target_deg: float = 0.0
    _angle_err: float = 0.0
    _omega_max: float = 0.0
    _link_lost: After = field(default_factory=lambda: After(steps(2)))
    _standstill: Duration = field(default_factory=lambda: Duration(steps(1)))

    def step(self, inputs: MotionInputs) -> None:
        """One execution; the first one only enters normal running."""
        self._link_lost.tick()
        if self.state is None:
            self._enter_running(inputs)
        elif self.state in RUNNING:
            self._run(inputs)
        else:
            self._stop(inputs)
        self._standstill.end_step(self.state is State.IN_FRENATA_DI_EMERGENZA, self.rover_is_stopped)

    def _run(self, inputs: MotionInputs) -> None:
        """Stato_marcia_rover: its transition looks at the speed that the user asked for in the last step."""
        obstacle_ahead = inputs.cmd is SupervisorCommand.CMD_ESTOP and self.user.v_user > 0
        if (obstacle_ahead and not self.is_rotating180) or inputs.critical:
            self._leave_running()
            self._enter_braking()
            return
        self._update_user(inputs)
        if self.state is State.NORMALE_MARCIA:
            self._normale_marcia(inputs)
        else:
            self._retromarcia_180(inputs)

    def _normale_marcia(self, inputs: MotionInputs) -> None:
        if inputs.y_norm < -0.5 and not inputs.backward_enabled:
            self._enter_half_turn(inputs)
            return
        self.v_ref = self.user.v_user if inputs.backward_enabled or inputs.y_norm > 0 else 0.0
        self.omega_ref = self.user.omega_user

    def _retromarcia_180(self, inputs: MotionInputs) -> None:
        if abs(self._angle_err) < TURNED_DEG:
            self.user.invert_y = self.user.invert_y or self.user.v_user < 0
            self.is_rotating180 = False
            self._enter_normale_marcia()
            return
        self._angle_err = angle_error(inputs.yaw, self._target_deg)
        if abs(self._angle_err) > COASTING_DEG:
            self.omega_ref = sign(-self._angle_err) * self._omega_max

    def _stop(self, inputs: MotionInputs) -> None:
        """Procedura_emergency_stop."""
        if not inputs.critical and self.estop_recover_enabled:
            self.emergency_stop = False
            self._enter_running(inputs)
        elif self.state is State.IN_FRENATA_DI_EMERGENZA:
            self._brake(inputs)

    def _brake(self, inputs: MotionInputs) -> None:
        """Without Board 1 nobody measures the wheels: two seconds are taken for a standstill."""
        link_lost = inputs.rx_status is Level.CRITICAL and self._link_lost.over
        if link_lost or self._standstill.test(self.rover_is_stopped):
            self.state = State.MOTORI_FERMI
            self.current_action = SupervisorCommand.CMD_STOP
            self.estop_recover_enabled = True
        else:
            self.rover_is_stopped = check_stop(inputs.wheel_speed_rpm)

    def _enter_running(self, inputs: MotionInputs) -> None:
        self._update_user(inputs)
        self._enter_normale_marcia()

    def _leave_running(self) -> None:
        self.is_rotating180 = False
        self.user.invert_y = False

    def _enter_normale_marcia(self) -> None:
        self.state = State.NORMALE_MARCIA
        self.current_action = SupervisorCommand.CMD_NORMAL

    def _enter_half_turn(self, inputs: MotionInputs) -> None:
        self.state = State.RETROMARCIA_180
        self.current_action = SupervisorCommand.CMD_ROTATE_180
        self.is_rotating180 = True
        self._target_deg = angle180(inputs.yaw)
        self._angle_err = angle_error(inputs.yaw, self._target_deg)

    def _enter_braking(self) -> None:
        """What the wheels did before is kept: standstill of the last stop counts until measured anew."""
        self.state = State.IN_FRENATA_DI_EMERGENZA
        self.estop_recover_enabled = False
        self.current_action = SupervisorCommand.CMD_ESTOP
        self.v_ref = self.omega_ref = 0.0
        self.emergency_stop = True
        self._link_lost.enter()
        self._standstill.enter()

    def _update_user(self, inputs: MotionInputs) -> None:
        self._omega_max = 0.0 if inputs.critical else SPEED_LIMIT
        self.user.update(inputs.x_norm, inputs.y_norm, self._omega_max, self._omega_max)
