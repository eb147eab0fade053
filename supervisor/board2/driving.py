"""What Board 2 executes in authorised steps only: safety state, obstacle command, backward mode and motion.

Without authorisation all of it stands still, timers, edges and outputs included.
"""

from dataclasses import dataclass, field

from rovercheck.supervisor.backward import BackwardToggle
from rovercheck.supervisor.board2.decision import COMMANDS
from rovercheck.supervisor.board2.faults import Faults
from rovercheck.supervisor.board2.motion import Motion, MotionInputs
from rovercheck.supervisor.board2.obstacles_degraded import DegradedObstacles
from rovercheck.supervisor.board2.safety import Safety
from rovercheck.supervisor.board2.signals import Board2Inputs
from rovercheck.supervisor.types import SupervisorCommand


@dataclass
class Driving:
    """The blocks of an authorised step in their order; the first one only enters their initial states."""

    safety: Safety = field(default_factory=Safety)
    backward: BackwardToggle = field(default_factory=BackwardToggle)
    motion: Motion = field(default_factory=Motion)
    cmd: SupervisorCommand = SupervisorCommand.CMD_NORMAL
    """What the obstacles allow; a chart of its own decides it, not the one that informs Board 1."""
    _obstacles: DegradedObstacles = field(default_factory=DegradedObstacles)

    def step(self, inputs: Board2Inputs, faults: Faults) -> None:
        """One authorised step."""
        safety_state = self.safety.step(faults.classification.emergency)
        self.cmd = COMMANDS[self._obstacles.step(inputs.dist_cm)]
        backward_enabled = self.backward.step(inputs.x_norm, inputs.y_norm, inputs.btn1, inputs.btn2)
        self.motion.step(
            MotionInputs(
                cmd=self.cmd,
                yaw=inputs.yaw,
                wheel_speed_rpm=inputs.payload.wheel_speed_rpm,
                x_norm=inputs.x_norm,
                y_norm=inputs.y_norm,
                safety_state=safety_state,
                rx_status=faults.statuses.rx_status,
                backward_enabled=backward_enabled,
            )
        )
