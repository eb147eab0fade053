"""The references of Board 1: what becomes of the user's wish under the command and the safety state.

[spec §2.7, Figs 19 and 20]
"""

from dataclasses import dataclass, field
from math import isfinite

from rovercheck.supervisor.board1.laws import avoid, turn
from rovercheck.supervisor.board1.limits import LIMITS, Limits
from rovercheck.supervisor.board1.states import (
    ACTIONS,
    MANOEUVRES,
    PROCEDURA_EMERGENCY_STOP,
    Motion,
    MotionInputs,
)
from rovercheck.supervisor.motion import UserReferences, angle180, angle_error, check_stop
from rovercheck.supervisor.timing import Duration, steps
from rovercheck.supervisor.types import SafetyState, SupervisorCommand

TURNED_DEG = 7.5
"""A half turn ends within this angle of its target."""


@dataclass
class MotionSupervision:
    """CH-MOVE1.  A heading that is infinite or no number starts no half turn, and pauses one."""

    state: Motion | None = None
    v_ref: float = 0.0
    omega_ref: float = 0.0
    emergency_stop: bool = False
    current_action: SupervisorCommand = SupervisorCommand.CMD_NORMAL
    user: UserReferences = field(default_factory=UserReferences)
    is_rotating180: bool = False
    estop_recover_enabled: bool = False
    rover_is_stopped: bool = False
    target_angle: float = 0.0
    angle_err: float = 0.0
    _limits: Limits = LIMITS[SafetyState.SAFETY_OK]
    _standstill: Duration = field(default_factory=lambda: Duration(steps(1)))

    def step(self, inputs: MotionInputs) -> None:
        """One execution."""
        if self.state is None:
            self._enter_running(inputs)
        elif self.state in PROCEDURA_EMERGENCY_STOP:
            self._stop(inputs)
        else:
            self._run(self.state, inputs)
        braking = self.state is Motion.IN_FRENATA_DI_EMERGENZA
        self._standstill.end_step(braking, self.rover_is_stopped)

    # --- Stato_marcia_rover ---------------------------------------------------------------------

    def _enter_running(self, inputs: MotionInputs) -> None:
        self._update_user(inputs)
        self._enter(Motion.NORMALE_MARCIA)

    def _run(self, state: Motion, inputs: MotionInputs) -> None:
        collision = inputs.cmd == SupervisorCommand.CMD_ESTOP and self.user.v_user > 0
        if (collision and not self.is_rotating180) or inputs.rover_status is SafetyState.SAFETY_CRITICAL:
            self._enter_emergency_stop()
            return
        self._update_user(inputs)
        if state is Motion.NORMALE_MARCIA:
            self._drive_normally(inputs)
        elif state is Motion.RETROMARCIA_180:
            self._rotate(inputs)
        elif inputs.cmd == SupervisorCommand.CMD_NORMAL:
            self._enter(Motion.NORMALE_MARCIA)
        else:
            self.v_ref, self.omega_ref = avoid(state, self.user, self._limits)

    def _update_user(self, inputs: MotionInputs) -> None:
        self._limits = LIMITS[inputs.rover_status]
        self.user.update(inputs.x_norm, inputs.y_norm, self._limits.v_max, self._limits.omega_max)

    def _drive_normally(self, inputs: MotionInputs) -> None:
        if self.user.v_user > 0 and inputs.cmd in MANOEUVRES:
            self._enter(MANOEUVRES[inputs.cmd])
        elif inputs.y_norm < -0.5 and not inputs.backward_enabled and isfinite(inputs.yaw):
            self._enter_rotation(inputs.yaw)
        else:
            may_drive = inputs.backward_enabled or inputs.y_norm > 0
            self.v_ref = self.user.v_user if may_drive else 0.0
            self.omega_ref = self.user.omega_user

    # --- Retromarcia_180 ------------------------------------------------------------------------

    def _enter_rotation(self, yaw: float) -> None:
        self._enter(Motion.RETROMARCIA_180)
        self.is_rotating180 = True
        self.target_angle = angle180(yaw)
        self.angle_err = angle_error(yaw, self.target_angle)

    def _rotate(self, inputs: MotionInputs) -> None:
        if abs(self.angle_err) < TURNED_DEG:
            if self.user.v_user < 0:
                self.user.invert_y = True
            self.is_rotating180 = False
            self._enter(Motion.NORMALE_MARCIA)
        elif isfinite(inputs.yaw):
            self.angle_err = angle_error(inputs.yaw, self.target_angle)
            omega = turn(self.angle_err, self._limits.omega_max, inputs.rover_status)
            self.omega_ref = self.omega_ref if omega is None else omega
        else:
            self.v_ref, self.omega_ref = 0.0, 0.0

    # --- Procedura_emergency_stop ---------------------------------------------------------------

    def _enter_emergency_stop(self) -> None:
        self.estop_recover_enabled = False
        self.is_rotating180 = False
        self.user.invert_y = False
        self._enter(Motion.IN_FRENATA_DI_EMERGENZA)
        self.v_ref, self.omega_ref = 0.0, 0.0
        self.emergency_stop = True
        self._standstill.enter()

    def _stop(self, inputs: MotionInputs) -> None:
        if inputs.rover_status is not SafetyState.SAFETY_CRITICAL and self.estop_recover_enabled:
            self.emergency_stop = False
            self._enter_running(inputs)
        elif self.state is Motion.IN_FRENATA_DI_EMERGENZA:
            if self._standstill.test(self.rover_is_stopped):
                self._enter(Motion.MOTORI_FERMI)
                self.estop_recover_enabled = True
            else:
                self.rover_is_stopped = check_stop(inputs.wheel_speed_rpm)

    def _enter(self, state: Motion) -> None:
        self.state = state
        self.current_action = ACTIONS[state]
