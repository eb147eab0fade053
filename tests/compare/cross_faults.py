"""Supervisors with one fault each, for the cross-check to find."""

from collections import deque
from dataclasses import replace

from rovercheck.supervisor.board1 import Board1
from rovercheck.supervisor.board1.monitors import BatteryMonitor, UpdateMonitor
from rovercheck.supervisor.board1.motion import TURNED_DEG, MotionSupervision
from rovercheck.supervisor.board1.signals import Board1Inputs, Board1Outputs
from rovercheck.supervisor.board1.states import MotionInputs
from rovercheck.supervisor.board2.board import Board2
from rovercheck.supervisor.board2.signals import Board2Inputs, Board2Outputs
from rovercheck.supervisor.timing import Duration, steps
from rovercheck.supervisor.types import Level, SafetyState


class LateReception(Board1):
    """A boundary: frames are lost from 120 ms on, instead of after it."""

    def reset(self) -> None:
        super().reset()
        self._reception = _FromTheLimitOn()


class _FromTheLimitOn(UpdateMonitor):
    def step(self, stamp_ms: int, now_ms: int) -> Level:
        found = super().step(stamp_ms, now_ms)
        return Level.CRITICAL if now_ms - stamp_ms == 120 else found


class LateRelay(Board1):
    """A timer one step too long."""

    def reset(self) -> None:
        super().reset()
        self._relay._sound = Duration(steps(3) + 1)


class NoLatch(Board1):
    """An emergency stop that ends before the rover stands."""

    def reset(self) -> None:
        super().reset()
        self._motion = _Unlatched()


class _Unlatched(MotionSupervision):
    def _stop(self, inputs: MotionInputs) -> None:
        self.estop_recover_enabled = inputs.rover_status is not SafetyState.SAFETY_CRITICAL
        super()._stop(inputs)


class StalePayload(Board1):
    """The payload of the frame before."""

    def reset(self) -> None:
        super().reset()
        self._payloads = deque([Board1Inputs().payload] * 2, maxlen=2)

    def step(self, inputs: Board1Inputs) -> Board1Outputs:
        if inputs.payload != self._payloads[-1]:
            self._payloads.append(inputs.payload)
            return super().step(replace(inputs, payload=self._payloads[0]))
        return super().step(inputs)


class SwappedWheels(Board1):
    """Front left and rear right are exchanged."""

    def step(self, inputs: Board1Inputs) -> Board1Outputs:
        fl, fr, rl, rr = inputs.has_no_feedback
        return super().step(replace(inputs, has_no_feedback=(rr, fr, rl, fl)))


class HalfTurn(Board1):
    """A half turn that is over at exactly 7.5 degrees too."""

    def reset(self) -> None:
        super().reset()
        self._motion = _TurnedAtTheLimit()


class _TurnedAtTheLimit(MotionSupervision):
    def _rotate(self, inputs: MotionInputs) -> None:
        if abs(self.angle_err) == TURNED_DEG:
            self.angle_err = 0.0
        super()._rotate(inputs)


class Rounded(Board1):
    """References in tenths."""

    def step(self, inputs: Board1Inputs) -> Board1Outputs:
        found = super().step(inputs)
        return replace(found, v_ref=round(found.v_ref, 1))


class EstimateFromHalfASecond(Board1):
    """The battery is assumed to fall from 0.5 s on, instead of from the last interpretation."""

    def reset(self) -> None:
        super().reset()
        self._battery = _Later()


class _Later(BatteryMonitor):
    def step(self, pct: float, last_valid_ms: int, now_ms: int) -> Level:
        age = now_ms - last_valid_ms
        optimistic = 15 <= pct < 15 + 0.00042 * age and pct >= 15 + 0.00042 * (age - 500)
        found = super().step(pct, last_valid_ms, now_ms)
        return Level.DEGRADED if optimistic and found is Level.CRITICAL else found


class StopsLate(Board2):
    """An obstacle at exactly 70 cm is not near."""

    def step(self, inputs: Board2Inputs) -> Board2Outputs:
        left, centre, right = (d + (d == 70) for d in inputs.dist_cm)
        return super().step(replace(inputs, dist_cm=(left, centre, right)))


class KeepsAuthority(Board2):
    """A timer one step too short."""

    def reset(self) -> None:
        super().reset()
        self._failure_check._sound = Duration(steps(3) - 1)


class SwappedSonars(Board2):
    """Left and right are exchanged."""

    def step(self, inputs: Board2Inputs) -> Board2Outputs:
        left, centre, right = inputs.dist_cm
        return super().step(replace(inputs, dist_cm=(right, centre, left)))


class NoReceptionFault(Board2):
    """Slow frames are no fault."""

    def step(self, inputs: Board2Inputs) -> Board2Outputs:
        found = super().step(inputs)
        return replace(found, degraded_mask=found.degraded_mask & ~0b100)


class Crashing(Board2):
    """Raises when the joystick fails."""

    def step(self, inputs: Board2Inputs) -> Board2Outputs:
        found = super().step(inputs)
        if found.statuses.esp_status is Level.CRITICAL:
            raise RuntimeError("nobody steers")
        return found


FAULTS = {
    "board1": (
        LateReception, LateRelay, NoLatch, StalePayload, SwappedWheels, HalfTurn, Rounded,
        EstimateFromHalfASecond,
    ),
    "board2": (StopsLate, KeepsAuthority, SwappedSonars, NoReceptionFault),
}  # fmt: skip
"""The faults that must be found, by board."""
