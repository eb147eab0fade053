"""One run followed with many values of one input at once: a limit, of which many are tried."""

from collections.abc import Mapping, Sequence

from rovercheck.checker.conformance.cones import LogCone
from rovercheck.checker.conformance.estimator import StateEstimator
from rovercheck.checker.conformance.program import Known, Step
from rovercheck.checker.conformance.recording import Raw
from rovercheck.checker.diagnosis.evidence import DecodedRun

NO_VALUE = (TypeError, ValueError, ZeroDivisionError)
"""What a step raises with numbers that have no meaning: bits of a fraction or of -1, a division by 0."""

MOST_STATES = 64
"""States that are followed side by side before the tracker takes over."""

Rows = Sequence[tuple[tuple[Known, ...], Known]]
"""Of each row every combination of inputs that the part may have seen, and its outputs."""


_Together = tuple[tuple[Known, ...], Sequence[Raw]]
"""The states that a part may be in with each of some values of an input."""


class ValuesTogether:
    """Follows a run with many values of one input, which is at ``place``."""

    def __init__(self, cone: LogCone, run: DecodedRun, place: int) -> None:
        estimator = StateEstimator(cone, run.run.tolerance)
        self._step, self._place = cone.step, place
        self._agrees, self._power_up = estimator.agrees, estimator.power_up()

    def passing(self, rows: Rows, masked: Mapping[int, Known], values: Sequence[Raw]) -> list[Raw]:
        """Those that explain all rows."""
        groups: list[_Together] = [(self._power_up, values)] if values else []
        for at, (options, logged) in enumerate(rows):
            wanted = masked.get(at, logged)
            groups = [after for group in groups for after in self._after(group, options, wanted)]
        return [value for _, some in groups for value in some]

    def _after(self, group: _Together, options: Sequence[Known], logged: Known) -> list[_Together]:
        before, values = group
        first = self._one(before, options, logged, values[0])
        if len(values) == 1 or self._one(before, options, logged, values[-1]) == first:
            return [(first, values)] if first else []
        middle = len(values) // 2
        halves = (before, values[:middle]), (before, values[middle:])
        return [after for half in halves for after in self._after(half, options, logged)]

    def _one(
        self, before: Sequence[Known], options: Sequence[Known], logged: Known, value: Raw
    ) -> tuple[Known, ...]:
        """The states after a row with one value; none if the value explains no outputs of the row."""
        place = self._place
        try:
            found = [
                self._step(state, (*given[:place], value, *given[place + 1 :]))
                for given in options
                for state in before
            ]
        except NO_VALUE:
            return ()
        states = tuple(dict.fromkeys(s for s, out in found if self._agrees(out, logged)))
        if len(states) > MOST_STATES:
            raise TooManyStates
        return states


class TooManyStates(Exception):
    """More states than are followed side by side."""


def with_parameter(cone: LogCone, name: str, value: Raw) -> Step:
    """The step of a part in which an input always has one value, whatever it is given."""
    place, step = place_of(cone, name), cone.step
    if place is None:
        return step
    return lambda state, given: step(state, (*given[:place], value, *given[place + 1 :]))


def place_of(cone: LogCone, name: str) -> int | None:
    return next((i for i, v in enumerate(cone.system.inputs) if v.name == name), None)


__all__ = ["MOST_STATES", "NO_VALUE", "Rows", "TooManyStates", "ValuesTogether", "place_of", "with_parameter"]
