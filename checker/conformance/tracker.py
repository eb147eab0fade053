"""Follows one part of a board through a log: explains each tick, or says what differs, and goes on."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from math import prod

from rovercheck.checker.conformance.cones import LogCone, measured
from rovercheck.checker.conformance.estimator import (
    FIRST_RUNS,
    MORE_RUNS,
    MOST_REMEMBERED,
    StateEstimator,
    TooMany,
)
from rovercheck.checker.conformance.mismatch import Differences, LogMismatch, shown
from rovercheck.checker.conformance.program import BeliefOutcome, Known
from rovercheck.checker.conformance.recording import Raw

MOST_LOST = 20
"""How often the states may become too many before the part is given up."""

MOST_MISSING, FEW_RUNS, GUESSED_RUNS = 5, 1000, 500
"""Steps missing in a row through which states are followed, and how many may be tried for it.

Fewer where not all values can be tried: then any state says more, as what it does not explain is decided.
"""

MOST_OPTIONS = 16


@dataclass(frozen=True)
class TrackedRow:
    """What one row tells one part: inputs, each with every value it may have had, and logged outputs."""

    tick: int
    line: int
    missing: int
    inputs: tuple[tuple[Raw | None, ...], ...]
    logged: Known


@dataclass(frozen=True)
class UndecidedRow:
    """From this tick on a part is not decided, and why."""

    tick: int
    part: str
    because: str


class Tracker:
    """The states that explain the log so far.

    After a tick that none explains, the charts go on from where they are; if they do not explain the next
    one either, from any state that has the logged outputs.

    ``tells_inputs``: whether a mismatch says what was read.  ``always``: an input and its value in all steps,
    also in those that were not logged.
    """

    def __init__(
        self,
        cone: LogCone,
        tolerance: Mapping[str, float],
        from_power_up: bool,
        tells_inputs: bool = True,
        always: tuple[str, Raw] | None = None,
    ) -> None:
        self.cone = cone
        self._tells_inputs = tells_inputs
        name, value = always or ("", None)
        self._not_logged: Known = tuple(value if v.name == name else None for v in cone.system.inputs)
        self.undecided: UndecidedRow | None = None
        self.given_up = False
        self._follow = StateEstimator(cone, tolerance)
        self.differences = Differences(cone)
        self.exact: BeliefOutcome | None = None
        """The step that the charts took from a state and inputs that are known, if they were."""
        self._now = self._follow.power_up() if from_power_up else self._follow.anything({})
        self._own: tuple[Known, ...] | None = self._now if from_power_up else None
        self._lost = False
        self._times_lost = 0
        self._last: dict[str, Raw | None] = {}
        self._told = [o.var.name for o in cone.outputs]
        self._numbers = [measured(o) for o in cone.outputs]
        self.required: tuple[Raw | None, ...] = (
            tuple(o.var.init for o in cone.outputs) if from_power_up else ()
        )
        """The outputs of the charts' own run in the tick before, where they leave no choice."""

    def astray(self, logged: Known) -> list[int]:
        """Positions of the outputs that are not those of the charts' own run in the tick of the last row."""
        return self._follow.others(self.required, logged) if self.required else []

    def step(self, row: TrackedRow) -> LogMismatch | None:
        """Take one row; what differs, if no behaviour explains it."""
        if self.given_up:
            return None
        self._follow.runs_left = min(self._follow.runs_left, FIRST_RUNS) + MORE_RUNS
        self.exact = None
        if self._exactly(row):
            self._last = dict(zip(self._told, row.logged, strict=True))
            return None
        try:
            return self._step(row)
        except TooMany as reason:
            self._lose(row, str(reason))
            return None
        finally:
            logged = zip(self._told, row.logged, strict=True)
            self._last = {name: value for name, value in logged if value is not None}

    # --- steps that were taken ahead ---

    @property
    def certain(self) -> bool:
        """Whether the state is known, so that steps can be taken ahead."""
        if len(self._now) != 1 or self._lost or self.given_up:
            return False
        return self.owned or (self._own is None and self._follow.runs_left >= FIRST_RUNS)

    @property
    def owned(self) -> bool:
        """Whether the charts' own run explains the log so far."""
        return self._own is self._now

    @property
    def state(self) -> Known:
        """The state, which is certain."""
        return self._now[0]

    def agrees(self, required: Known, logged: Known) -> bool:
        """Whether no output is another than the one required."""
        return self._follow.agrees(required, logged)

    @property
    def apart(self) -> Sequence[float | None]:
        """How far each output may lie from the one required."""
        return self._follow.apart

    def settle(self, outcome: BeliefOutcome, logged: Known, rows: int) -> None:
        """Go on behind so many rows that steps from the certain state explain; the last of them."""
        left = self._follow.runs_left + MORE_RUNS * rows
        self._follow.runs_left = min(left, FIRST_RUNS + MORE_RUNS)
        owned, self._now = self.owned, (outcome.after,)
        self._last = dict(zip(self._told, logged, strict=True))
        self.exact = outcome if owned else None
        if owned:
            self._own, self.required = self._now, outcome.outputs

    # --- rows, one by one ---

    def _exactly(self, row: TrackedRow) -> bool:
        """Take the step by itself where state and inputs are known, and it explains the row."""
        if len(self._now) != 1 or self._own is not self._now or self._lost or row.missing:
            return False
        if any(len(options) != 1 for options in row.inputs):
            return False
        key = self._now[0], tuple([options[0] for options in row.inputs])
        outcome = self.cone.remembered.get(key)
        if outcome is None:
            if None in key[0] or None in key[1]:
                return False
            if len(self.cone.remembered) >= MOST_REMEMBERED:
                self.cone.remembered.clear()
            outcome = self.cone.remembered[key] = BeliefOutcome(key[0], *self.cone.step(*key))
        if not self._follow.explains(outcome, row.logged):
            return False
        self._now = self._own = (outcome.after,)
        self.required, self.exact = outcome.outputs, outcome
        return True

    def _step(self, row: TrackedRow) -> LogMismatch | None:
        if row.missing:
            self._skip(row.missing)
        found, fits = self._fitting(self._now, row)
        fits = fits or self._from_own(row)
        if not fits and self._lost and not self._only_numbers(row):
            _, fits = self._fitting(self._follow.anything(self._last), row)
        if not fits:
            return self._differs(row, self._fitting(self._now, row)[0] if self._lost else found)
        self._goes_on(row, fits)
        return None

    def _only_numbers(self, row: TrackedRow) -> bool:
        """Whether the charts' own run differs in numbers alone: its state is then not in question."""
        if self._own is None or all(self._numbers):
            return False
        found, _ = self._fitting(self._own, row)
        at = self._nearest(found, row.logged)[1]
        if not all(self._numbers[i] for i in at):
            return False
        self._now = self._own
        return True

    def _fitting(
        self, valuations: Sequence[Known], row: TrackedRow
    ) -> tuple[list[BeliefOutcome], list[BeliefOutcome]]:
        """All outcomes, and those that explain the row."""
        found = [o for given in _combined(row.inputs) for o in self._follow.outcomes(valuations, given)]
        return found, [o for o in found if self._follow.explains(o, row.logged)]

    def _goes_on(self, row: TrackedRow, fits: Sequence[BeliefOutcome]) -> None:
        same = self._own is self._now
        self._now = self._follow.kept(fits)
        self._lost = False
        if same:
            self._own = self._now
            self.required = _agreed(fits)
        else:
            self._own_goes_on(row)

    def _from_own(self, row: TrackedRow) -> list[BeliefOutcome]:
        """Outcomes of the charts' own run that explain the row."""
        if self._own is None or self._own is self._now:
            return []
        return self._fitting(self._own, row)[1]

    def _own_goes_on(self, row: TrackedRow) -> None:
        if self._own is None:
            self.required = ()
            return
        found, fits = self._fitting(self._own, row)
        after = tuple(dict.fromkeys(o.after for o in fits or found))
        self.required = _agreed(fits or found)
        self._own = after if len(after) <= MOST_OPTIONS else None
        if self._own == self._now:
            self._own = self._now

    def _differs(self, row: TrackedRow, found: Sequence[BeliefOutcome]) -> LogMismatch | None:
        if self._follow.incomplete:
            names = ", ".join(sorted(self._follow.incomplete))
            self._undecided(row, f"{names} not logged, and not all values of it can be tried")
            self._follow.incomplete.clear()
            self._now, self._own = self._follow.anything(self._outputs(row)), None
            return None
        best, at = self._nearest(found, row.logged)
        last = tuple(self._last.get(name) for name in self._told)
        wrong = self.differences.told(best, row.logged, at, self.required, last)
        self._stay(row, best)
        inputs = self.inputs(row) if self._tells_inputs else {}
        return LogMismatch(row.tick, row.line, self.cone.name, wrong, inputs)

    def _nearest(
        self, found: Sequence[BeliefOutcome], logged: Known
    ) -> tuple[list[BeliefOutcome], list[int]]:
        """The outcomes with the fewest outputs that differ, and the places of these."""
        places = [self._follow.differing(outcome, logged) for outcome in found]
        fewest = min(map(len, places))
        best = [(o, at) for o, at in zip(found, places, strict=True) if len(at) == fewest]
        return [o for o, _ in best], sorted({i for _, at in best for i in at})

    def _stay(self, row: TrackedRow, best: Sequence[BeliefOutcome]) -> None:
        """The charts go on from where they are, whatever the log says."""
        same = self._own is self._now
        self._now, self._lost = self._follow.kept(best), True
        if same:
            self._own = self._now if len(self._now) <= MOST_OPTIONS else None
            self.required = _agreed(best)
        else:
            self._own_goes_on(row)

    def inputs(self, row: TrackedRow) -> dict[str, str]:
        """What the part read, as a person writes it."""
        rows = zip(self.cone.system.inputs, row.inputs, strict=True)
        return {v.name: "not logged" if given[0] is None else shown(v.domain, given[0]) for v, given in rows}

    def _outputs(self, row: TrackedRow) -> dict[str, Raw]:
        rows = zip(self._told, row.logged, strict=True)
        return {name: value for name, value in rows if value is not None}

    # --- what is not known ---

    def _skip(self, missing: int) -> None:
        """Steps that were not logged: anything may have been read in them."""
        self._own, self._lost, self.required, self._last = None, False, (), {}
        if missing > MOST_MISSING or not self.cone.system.variables:
            self._now = self._follow.anything({})
            return
        left, self._follow.runs_left = self._follow.runs_left, FEW_RUNS
        before = set(self._follow.incomplete)
        try:
            for _ in range(missing):
                self._now = self._follow.kept(self._follow.outcomes(self._now, self._not_logged))
        except TooMany:
            self._now = self._follow.anything({})
        if self._follow.incomplete > before and FEW_RUNS - self._follow.runs_left > GUESSED_RUNS:
            self._now, self._follow.incomplete = self._follow.anything({}), before
        self._follow.runs_left = left

    def _lose(self, row: TrackedRow, what: str) -> None:
        """What explains the row is not known: the charts go on by themselves if they can."""
        because = f"too many states; what multiplies them: {what}"
        if self._own is not None and len(self._own) == 1 and all(len(given) == 1 for given in row.inputs):
            self._follow.runs_left = max(self._follow.runs_left, MOST_OPTIONS)
            try:
                self._own_goes_on(row)
            except TooMany:
                self._own = None
            if self._own is not None:
                self._now, self._lost = self._own, True
                self._note_undecided(row, because)
                return
        self._undecided(row, because)
        self._now, self._own, self._lost, self.required = (
            self._follow.anything(self._outputs(row)),
            None,
            False,
            (),
        )

    def _undecided(self, row: TrackedRow, because: str) -> None:
        self._times_lost += 1
        self.given_up = self._times_lost >= MOST_LOST
        self._note_undecided(row, because)

    def _note_undecided(self, row: TrackedRow, because: str) -> None:
        if self.undecided is None:
            self.undecided = UndecidedRow(row.tick, self.cone.name, because)


def _agreed(outcomes: Sequence[BeliefOutcome]) -> tuple[Raw | None, ...]:
    """The outputs on which all outcomes agree, ``None`` elsewhere."""
    columns = zip(*(o.outputs for o in outcomes), strict=True)
    return tuple(c[0] if all(v == c[0] for v in c) else None for c in columns)


def _combined(inputs: Sequence[tuple[Raw | None, ...]]) -> Iterator[Known]:
    """Every combination of the values that inputs may have had; where these are many, any value."""
    if all(len(options) == 1 for options in inputs):
        yield tuple(options[0] for options in inputs)
    elif prod(len(options) for options in inputs) <= MOST_OPTIONS:
        yield from product(*inputs)
    else:
        yield tuple(options[0] if len(options) == 1 else None for options in inputs)
