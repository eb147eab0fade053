"""A changed part tried on the recordings: whether it explains them all, and what it still gets wrong."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from itertools import product

from rovercheck.checker.conformance.cones import LogCone
from rovercheck.checker.conformance.estimator import StateEstimator
from rovercheck.checker.conformance.mismatch import LogMismatch
from rovercheck.checker.conformance.program import BeliefOutcome, Known, NeededInputs, Step
from rovercheck.checker.conformance.recording import Raw
from rovercheck.checker.conformance.tracker import TrackedRow, Tracker
from rovercheck.checker.diagnosis.evidence import (
    DecodedRun,
    PartEvidence,
    inputs_of,
    logged_of,
    taken_otherwise,
)
from rovercheck.checker.diagnosis.pieces import Pieces, Wrong, differing
from rovercheck.checker.diagnosis.values_together import (
    MOST_STATES,
    NO_VALUE,
    Rows,
    TooManyStates,
    ValuesTogether,
    place_of,
    with_parameter,
)
from rovercheck.spec_model.abstraction.readings import StampReading

FEW_VARIABLES = 8
"""Up to as many a part is in few states, and its steps are remembered while a run is followed."""

Parameter = tuple[str, Raw]
"""An input that always has one value: a limit that is tried."""

NOTHING: Mapping[int, Known] = {}
ALL: Mapping[int, int] = {}


@dataclass(frozen=True)
class Trial:
    """How a change does: cases explained of all, and rows that become wrong by it."""

    explained: int
    cases: int
    wrong: int
    left: tuple[tuple[int, int], ...] = ()
    """The run and the row of the first cases that are not explained."""

    @property
    def full(self) -> bool:
        return self.explained == self.cases and not self.wrong


class TrialBench:
    """Tries changes of one part; the rows are prepared once for all that read the same.

    ``readings``: stamps that are taken otherwise than the board does.  ``ends``: how many rows of a run
    count, by its number, where that is not as many as the charts as drawn decide.
    """

    def __init__(
        self,
        evidence: PartEvidence,
        readings: Sequence[StampReading] = (),
        ends: Mapping[int, int] = ALL,
    ) -> None:
        self.evidence, self.readings, self.ends = evidence, tuple(readings), dict(ends)
        firsts = {id(run): run.cases(evidence.name)[0].first for run in evidence.deviating}
        self.runs = sorted(evidence.runs, key=lambda run: firsts.get(id(run), 10**9 + len(run)))
        """Those with the earliest deviations first."""
        self.numbers = {id(run): number for number, run in enumerate(self.runs)}
        self._order = list(range(len(self.runs)))
        self._rows: dict[tuple[object, ...], list[Rows | None]] = {}
        self._last: tuple[LogCone | None, list[Rows | None]] = (None, [])

    def with_reading(self, reading: StampReading | None) -> "TrialBench":
        """The same with one more stamp taken otherwise."""
        if reading is None:
            return self
        return TrialBench(self.evidence, (*self.readings, reading), self.ends)

    def going_on(
        self, cone: LogCone, parameter: Parameter | None = None
    ) -> tuple["TrialBench", dict[int, Wrong]]:
        """The same with all rows that a changed part decides of runs that the drawn one does not decide.

        And, by their numbers, what it gets wrong in these runs; a run in which a number has no meaning to it
        stays as it is.
        """
        ends, found = dict(self.ends), dict[int, Wrong]()
        for number in (n for n in range(len(self.runs)) if not self.decided(n)):
            end, wrong = len(self.runs[number]), dict[int, frozenset[tuple[str, int]]]()
            try:
                for row, mismatch in self._whole.mismatches(cone, number, parameter):
                    if mismatch is None:
                        end = row
                        break
                    wrong[row] = differing(mismatch)
            except NO_VALUE:
                continue
            if end > self.end(number):
                ends[number], found[number] = end, wrong
        return (TrialBench(self.evidence, self.readings, ends) if found else self), found

    @cached_property
    def _whole(self) -> "TrialBench":
        """The same with all rows of all runs."""
        return TrialBench(self.evidence, self.readings, {n: len(run) for n, run in enumerate(self.runs)})

    def rows_behind(self, cone: LogCone, among: Collection[int]) -> int:
        """How many more rows a changed part explains in some runs that the drawn one does not decide."""
        return sum(row - self.end(n) for n, row, _ in self._behind(cone, None) if n in among)

    def narrowed(self, cone: LogCone, name: str, value: Raw, values: Sequence[Raw]) -> Sequence[Raw]:
        """Those of some values of an input with which rows are right that one value gets wrong there.

        All of them, if no value does better.
        """
        for number, row, wrong in self._behind(cone, (name, value)):
            if wrong:
                values = self._whole.passing(cone, number, row, name, values) or values
        return values

    def _behind(self, cone: LogCone, parameter: Parameter | None) -> Iterator[tuple[int, int, bool]]:
        """Of runs that the drawn part does not decide the row behind up to which a changed one explains them.

        And whether the row is wrong, and not just undecided, too.
        """
        for number, run in enumerate(self.runs):
            if self.decided(number):
                continue
            end = self.end(number)
            try:
                rows = self._whole.mismatches(cone, number, parameter)
                row, mismatch = next(((r, m) for r, m in rows if r >= end or m is None), (len(run), None))
            except NO_VALUE:
                continue
            if row >= end:
                yield number, row, mismatch is not None

    def decided(self, number: int) -> bool:
        """Whether the part, with what was taken so far, decides a run to its end."""
        return self.end(number) == len(self.runs[number])

    def decides(self, rows: Pieces) -> bool:
        """Whether some of the rows of a deviation count: of others nothing can be said yet."""
        return any(row < self.end(self.numbers[run]) for run, row in rows)

    def end(self, number: int) -> int:
        """How many rows of a run count: those that the part, with what was taken so far, decides."""
        run = self.runs[number]
        return self.ends.get(number, run.undecided.get(self.evidence.name, len(run)))

    def rejected(self, cone: LogCone, parameter: Parameter | None = None) -> tuple[int, int] | None:
        """The run and the row of a first contradiction; ``None``: every row of every run is explained.

        The run that rejected the last change is tried first.
        """
        step = cone.step if parameter is None else with_parameter(cone, *parameter)
        rows = self._prepared(cone)
        for place, number in enumerate(self._order):
            found = self._first_wrong(cone, step, number, rows, parameter)
            if found is not None:
                self._order.insert(0, self._order.pop(place))
                return number, found
        return None

    def trial(self, cone: LogCone, parameter: Parameter | None = None) -> Trial:
        """All that a change explains, and all that it gets wrong."""
        explained = cases = wrong = 0
        left: list[tuple[int, int]] = []
        for number, run in enumerate(self.runs):
            bad = set(self._tracked(cone, number, parameter))
            within = set[int]()
            for case in run.cases(self.evidence.name):
                rows = range(case.first, case.last + 1)
                within.update(rows)
                cases += 1
                if bad.isdisjoint(rows):
                    explained += 1
                else:
                    left.append((number, case.first))
            wrong += len(bad - within)
        return Trial(explained, cases, wrong, tuple(left))

    def wrong_rows(self, cone: LogCone, run: DecodedRun) -> Iterator[int]:
        """Every row of a run that a changed part gets wrong."""
        return self._tracked(cone, self.numbers[id(run)], None)

    def passes(
        self,
        cone: LogCone,
        number: int,
        last: int | None,
        parameter: Parameter | None = None,
        masked: Mapping[int, Known] = NOTHING,
    ) -> bool:
        """Whether a changed part explains a run from its start to a row, or to its end.

        ``masked``: outputs in place of those recorded in some rows; what is ``None`` is not compared.
        """
        step = cone.step if parameter is None else with_parameter(cone, *parameter)
        try:
            wrong = self._first_wrong(cone, step, number, self._prepared(cone), parameter, last, masked)
        except NO_VALUE:
            return False
        return wrong is None or (last is not None and wrong > last)

    def holds(self, cone: LogCone, number: int, parameter: Parameter | None = None) -> bool | None:
        """Whether a changed part explains a whole run; ``None``: not decided, and nothing before is wrong."""
        step = cone.step if parameter is None else with_parameter(cone, *parameter)
        run = self.runs[number]
        try:
            if run.run.from_power_up and not any(run.missing):
                try:
                    rows = self._prepared(cone)
                    return self._followed(cone, step, number, rows, None, NOTHING) is None
                except (NeededInputs, TooManyStates):
                    pass
            found = next(self.mismatches(cone, number, parameter), None)
        except NO_VALUE:
            return False
        return True if found is None else None if found[1] is None else False

    def passing(
        self,
        cone: LogCone,
        number: int,
        last: int,
        name: str,
        values: Sequence[Raw],
        masked: Mapping[int, Known] = NOTHING,
    ) -> list[Raw]:
        """The values of an input with which a changed part explains a run from its start to a row.

        Neighbours that lead to the same states are followed together, and so are all values between them.
        """
        run, place = self.runs[number], place_of(cone, name)
        if place is None or not run.run.from_power_up or any(run.missing):
            return [v for v in values if self.passes(cone, number, last, (name, v), masked)]
        rows = self._of(cone, number, self._prepared(cone))[: last + 1]
        try:
            return ValuesTogether(cone, run, place).passing(rows, masked, sorted(values))
        except (NeededInputs, TooManyStates):
            return [v for v in values if self.passes(cone, number, last, (name, v), masked)]

    # --- rows ---

    def _prepared(self, cone: LogCone) -> list[Rows | None]:
        last, rows = self._last
        if last is not cone:
            rows = self._found_rows(cone)
            self._last = cone, rows
        return rows

    def _found_rows(self, cone: LogCone) -> list[Rows | None]:
        names = tuple((v.name, v.name in cone.before) for v in cone.system.inputs)
        key = (names, tuple(o.name for o in cone.outputs))
        if key not in self._rows:
            self._rows[key] = [None] * len(self.runs)
        return self._rows[key]

    def _of(self, cone: LogCone, number: int, rows: list[Rows | None]) -> Rows:
        found = rows[number]
        if found is None:
            run = self.runs[number]
            plain = inputs_of(cone, run, taken_otherwise(self.evidence.group.board, run, self.readings))
            logged = logged_of(cone, run)
            given: list[tuple[Known, ...]] = [(one,) for one in plain]
            options = run.options.get(self.evidence.name, {})
            for place, var in enumerate(cone.system.inputs):
                for at, values in options.get(var.name, {}).items():
                    given[at] = tuple(
                        (*one[:place], value, *one[place + 1 :]) for one, value in product(given[at], values)
                    )
            found = rows[number] = list(zip(given, logged, strict=True))[: self.end(number)]
        return found

    # --- following ---

    def _first_wrong(
        self,
        cone: LogCone,
        step: Step,
        number: int,
        rows: list[Rows | None],
        parameter: Parameter | None,
        last: int | None = None,
        masked: Mapping[int, Known] = NOTHING,
    ) -> int | None:
        run = self.runs[number]
        if run.run.from_power_up and not any(run.missing):
            try:
                return self._followed(cone, step, number, rows, last, masked)
            except (NeededInputs, TooManyStates):
                pass
        return next(self._tracked(cone, number, parameter), None)

    def _followed(
        self,
        cone: LogCone,
        step: Step,
        number: int,
        rows: list[Rows | None],
        last: int | None,
        masked: Mapping[int, Known],
    ) -> int | None:
        """The first row that is wrong up to ``last``, where everything that the part reads is known."""
        estimator = StateEstimator(cone, self.runs[number].run.tolerance)
        agrees, states = estimator.agrees, list(estimator.power_up())
        if len(cone.system.variables) <= FEW_VARIABLES:
            step = cache(step)
        for at, (options, logged) in enumerate(self._of(cone, number, rows)):
            if last is not None and at > last:
                return None
            if at in masked:
                logged = masked[at]
            if len(options) == 1 and len(states) == 1:
                states[0], outputs = step(states[0], options[0])
                if not agrees(outputs, logged):
                    return at
                continue
            found = [step(before, given) for given in options for before in states]
            states = list(dict.fromkeys(s for s, out in found if agrees(out, logged)))
            if not states:
                return at
            if len(states) > MOST_STATES:
                raise TooManyStates
        return None

    def _tracked(self, cone: LogCone, number: int, parameter: Parameter | None) -> Iterator[int]:
        """Every row that is wrong or not decided, by a tracker, which infers what is not recorded."""
        return (row for row, _ in self.mismatches(cone, number, parameter))

    def mismatches(
        self,
        cone: LogCone,
        number: int,
        parameter: Parameter | None = None,
        unknown: tuple[str, Collection[int]] = ("", ()),
    ) -> Iterator[tuple[int, LogMismatch | None]]:
        """Every row of a run that a changed part gets wrong, and what differs; ``None``: not decided.

        Where there are too many states to follow, no later row is decided either.
        ``unknown``: an input that may have had any value, and the rows in which.
        """
        run = self.runs[number]
        tracker = Tracker(cone, run.run.tolerance, run.run.from_power_up, False, parameter)
        place = None if parameter is None else place_of(cone, parameter[0])
        free = place_of(cone, unknown[0])
        rows = self._of(cone, number, self._prepared(cone))
        begin = 0 if free is not None else _explained(tracker, run, rows, place, parameter)
        for at in range(begin, len(rows)):
            options, logged = rows[at]
            if len(options) == 1:
                columns = [(value,) for value in options[0]]
            else:
                columns = [tuple(dict.fromkeys(c)) for c in zip(*options, strict=True)]
            if place is not None and parameter is not None:
                columns[place] = (parameter[1],)
            if free is not None and at in unknown[1]:
                columns[free] = (None,)
            row = TrackedRow(run.ticks[at], run.lines[at], run.missing[at], tuple(columns), logged)
            mismatch = tracker.step(row)
            if mismatch is not None or tracker.undecided is not None:
                yield at, mismatch
            if tracker.undecided is not None:
                yield from ((later, None) for later in range(at + 1, len(rows)))
                return


def _explained(
    tracker: Tracker, run: DecodedRun, rows: Rows, place: int | None, parameter: Parameter | None
) -> int:
    """Take the rows at the start of a run that are explained, as long as all is known; how many."""
    if not run.run.from_power_up or any(run.missing):
        return 0
    step, agrees, state = tracker.cone.step, tracker.agrees, tracker.state
    outcome, taken = None, 0
    for options, logged in rows:
        given = options[0]
        if place is not None and parameter is not None:
            given = (*given[:place], parameter[1], *given[place + 1 :])
        if len(options) > 1 or None in given:
            break
        after, outputs = step(state, given)
        if not agrees(outputs, logged):
            break
        outcome, state = BeliefOutcome(state, after, outputs), after
        taken += 1
    if outcome is not None:
        tracker.settle(outcome, rows[taken - 1][1], taken)
    return taken


__all__ = ["NO_VALUE", "Parameter", "Trial", "TrialBench", "with_parameter"]
