"""Supervisors with a fault that no chart can express: shared buffers, rounding, stale data."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial

from rovercheck.checker.adapters.firmware import places
from rovercheck.checker.adapters.python_calls import Instance
from rovercheck.spec_model.abstraction import boards
from rovercheck.supervisor.board1 import Board1, Board1Inputs, Board1Outputs
from rovercheck.supervisor.board2.board import Board2
from rovercheck.supervisor.board2.signals import Board2Inputs, Board2Outputs


class OneRecord(Board1):
    """Heartbeats and frames note their intervals in one buffer."""

    def reset(self) -> None:
        super().reset()
        self._reception._slow = self._supervisor._slow


class WholePercent(Board1):
    """The charge is rounded to whole percent."""

    def step(self, inputs: Board1Inputs) -> Board1Outputs:
        return super().step(replace(inputs, battery_pct=round(inputs.battery_pct)))


class LastHeading(Board1):
    """The heading is that of the step before."""

    def reset(self) -> None:
        super().reset()
        self._yaw = 0.0

    def step(self, inputs: Board1Inputs) -> Board1Outputs:
        payload = replace(inputs.payload, yaw=self._yaw)
        self._yaw = inputs.payload.yaw
        return super().step(replace(inputs, payload=payload))


class OneRecord2(Board2):
    """Joystick and IMU note their gaps in one buffer."""

    def reset(self) -> None:
        super().reset()
        monitors = self._fault_finder._monitors
        monitors._esp._slow = monitors._imu._slow


class WholeRpm(Board2):
    """Speeds are cut to whole rpm where they are sent."""

    def step(self, inputs: Board2Inputs) -> Board2Outputs:
        outputs = super().step(inputs)
        motors = outputs.actuated.motors
        if motors is None:
            return outputs
        cut = replace(motors, left_rpm=int(motors.left_rpm), right_rpm=int(motors.right_rpm))
        return replace(outputs, actuated=replace(outputs.actuated, motors=cut))


class LastPayload(Board2):
    """The masks and wheel speeds of Board 1 are those of the step before."""

    def reset(self) -> None:
        super().reset()
        self._payload = Board2Inputs().payload

    def step(self, inputs: Board2Inputs) -> Board2Outputs:
        payload, self._payload = self._payload, inputs.payload
        return super().step(replace(inputs, payload=payload))


About = tuple[str, str, str, str]
"""Kind, board, part and text of a fault."""
IMPLEMENTATIONS: Mapping[About, Callable[[], Instance]] = {
    about: partial(Instance, supervisor, places(boards()[about[1]]))
    for about, supervisor in {
        ("shared buffer", "board1", "UpdateMonitor", "heartbeats and frames note into one record"): OneRecord,
        ("shared buffer", "board2", "Slow2", "joystick and IMU note into one record"): OneRecord2,
        ("rounding", "board1", "BatteryMonitor", "the charge in whole percent"): WholePercent,
        ("rounding", "board2", "Actuation", "speeds cut to whole rpm"): WholeRpm,
        ("stale data", "board1", "MotionSupervision", "the heading of the step before"): LastHeading,
        ("stale data", "board2", "Board2", "the payload of the step before"): LastPayload,
    }.items()
}
