"""The causes of a part that deviates in several ways: changes that each explain some deviations wholly.

A change counts if it makes no row wrong that was right, and if with it every row of some deviation is right.
The one that explains most is taken as given, and the next one is looked for on top of it, until nothing is
left to explain, nothing more is found, or the time is over.

Where two changes make the same rows wrong, none of them explains a deviation alone.  Then the one is taken
that makes most right, and kept if with those found on top of it nothing is wrong that was right.
"""

from collections.abc import Callable, Collection, Mapping, Sequence
from functools import partial
from time import process_time

from rovercheck.checker.conformance.cones import LogCone
from rovercheck.checker.conformance.deviations import Deviation
from rovercheck.checker.conformance.numbers import PARAMETER
from rovercheck.checker.conformance.recording import Raw
from rovercheck.checker.diagnosis.bridges import NEAREST, ahead, bridges
from rovercheck.checker.diagnosis.change import ChangeKind, ChartChange, Nearness
from rovercheck.checker.diagnosis.cover import CoveringChange, PartCover, Sound, Unexplaining, Witness, ranked
from rovercheck.checker.diagnosis.evidence import PartEvidence
from rovercheck.checker.diagnosis.hypotheses import stamp_changes
from rovercheck.checker.diagnosis.influence import ChangeInfluence
from rovercheck.checker.diagnosis.pieces import (
    Pieces,
    Wrong,
    more_wrong,
    nothing_new,
    rows_of,
    with_new,
    wrong_of,
)
from rovercheck.checker.diagnosis.rivals import read_earlier, rivals, with_earlier
from rovercheck.checker.diagnosis.row_judge import RowJudge
from rovercheck.checker.diagnosis.search import Clock, HypothesisSearch
from rovercheck.checker.diagnosis.stamp_search import StampSearch
from rovercheck.checker.diagnosis.trial import NO_VALUE, Parameter
from rovercheck.checker.diagnosis.variant import WrittenChange, found_change
from rovercheck.checker.diagnosis.witnesses import first_cases
from rovercheck.spec_model.abstraction.readings import StampReading
from rovercheck.spec_model.lang.chart import parts
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.system import System

MOST_CAUSES = 8
"""Changes of one part that are put on top of each other."""
MORE_TIME = 1.5
"""Times the time for changes, after which those found are not put on top of each other any more."""
MOST_BRIDGES = 3
"""Changes that explain nothing alone on which others are put, one after the other."""
GAIN = 4
"""Times as much as it makes wrong that such a change makes right."""
ANYWHERE = ("extra", "held", "frozen", "enabled", "dead")
"""Kinds of which some change makes right almost whatever is wrong."""


def covered(
    evidence: PartEvidence,
    deviations: Sequence[Deviation],
    seconds: float,
    clock: Clock = process_time,
    only: Sequence[ChartChange] | None = None,
    without: Collection[ChangeKind] = (),
) -> PartCover:
    """The changes that explain the deviations of one part, which are among ``deviations``.

    ``only``: no others are tried; ``without``: none of these kinds.
    """
    found = PartCover(evidence, deviations)
    start = clock()
    search = _CoverSearch(found, start, seconds, clock)
    search.only, search.without = only, without
    search.run()
    found.seconds = clock() - start
    return found


class _CoverSearch(HypothesisSearch):
    def __init__(self, found: PartCover, start: float, seconds: float, clock: Clock) -> None:
        super().__init__(found.evidence, start + seconds, clock)
        self._end = start + MORE_TIME * seconds
        self._cover = found
        self._name = found.evidence.name
        self._rows: Mapping[int, Pieces] = rows_of(found.evidence, found.deviations)
        found.rows = self._rows
        self._good: list[CoveringChange] = []
        self._partly: list[Unexplaining] = []
        self._judge = RowJudge(self._rows)
        self._base: list[Wrong] = []
        self._left: frozenset[int] = frozenset()
        self._witnesses: list[Witness] = []
        self._first = self._decided = frozenset[int]()
        self._settled = self._settled_before = frozenset[int]()
        self._passed_by_good, self._at_power_up = 0, False
        self._influence = ChangeInfluence(found.evidence.group.system, found.evidence.cone.outputs)

    def run(self) -> None:
        """Change upon change, while some deviation is left."""
        self._base = [wrong_of(run.wrong.get(self._name, ())) for run in self._bench.runs]
        self._left = frozenset(n for n in self._rows if self._rows[n])
        self._system = self._evidence.group.system
        drawn, ends = list(self._base), [run.undecided.get(self._name, len(run)) for run in self._bench.runs]
        sound = self._now
        others, instead = list[CoveringChange](), list[CoveringChange]()
        while len(self._cover.changes) < MOST_CAUSES:
            more = self._level()
            at_sound = len(self._cover.changes) == len(sound.changes)
            if more and at_sound and not instead and (first := self._ahead()) is not None:
                instead = list(self._good)
                self._begin(first)
                continue
            if more and self._more_explained():
                read_earlier(self._cover.changes, lambda one: self._added(one, self._system, self._left))
                if nothing_new(drawn, self._base, ends):
                    sound, others, instead = self._now, [], []
                continue
            found = bridges(self._partly, self._bridge, lambda: self._clock() > self._end) if more else []
            if at_sound:
                others = found
            elif (
                found and found[0].cases > 0 and len(self._cover.changes) < len(sound.changes) + MOST_BRIDGES
            ):
                self._begin(found[0])
                continue
            if self.late or not (others or instead):
                break
            self._back(sound)
            if instead:
                self._take(instead)
                sound = self._now
            else:
                self._begin(others.pop(0))
        if instead and not nothing_new(drawn, self._base, ends):
            self._back(sound)
            self._take(instead)
            sound = self._now
        self._back(sound)
        told = frozenset[int]().union(*(own for _, own in self._cover.changes))
        self._cover.left, self._cover.base, self._cover.system = self._left - told, self._base, self._system
        self._cover.bench = self._bench
        self._cover.tried, self._cover.of, self._cover.late = self.tried, self.of, self.late

    def _level(self) -> bool:
        """Try every change on top of those taken; whether there is anything left to explain."""
        self._good, self._partly, self._settled, self._passed_by_good = [], [], frozenset(), 0
        cone = self._evidence.group.cone(self._system)
        self._decided = self._judge.decided(self._left, self._bench)
        self._witnesses = first_cases(self._bench, cone, self._base, self._rows, self._left)
        self._first = frozenset(w.place for w in self._witnesses if not w.before)
        self._at_power_up = any(w.last == 0 for w in self._witnesses)
        if not self._left or not self._witnesses:
            return False
        self._influence = ChangeInfluence(self._system, self._evidence.cone.outputs)
        self.level(self._system)
        if self.enough:
            self.of = self.tried
        return True

    def _more_explained(self) -> bool:
        """Take what explains something, and makes nothing wrong."""
        if self._good:
            self._take(ranked(self._good, self._behind))
        return bool(self._good) or self._combined()

    def _behind(self, one: CoveringChange) -> int:
        """How many rows a change explains behind those that are decided, in runs in which it explains one."""
        cone = self._cone(one.system) if self._clock() < self._end else None
        own = [n for n, old in enumerate(self._base) if len(one.wrong[n]) < len(old)]
        return 0 if cone is None else self._bench.with_reading(one.change.reading).rows_behind(cone, own)

    def _begin(self, bridge: CoveringChange) -> None:
        """Take a change that makes something wrong, which belongs to deviations of the same outputs now."""
        before = list(self._base)
        self._accept(bridge)
        rows, deviations = self._rows, self._cover.deviations
        rows, more = with_new(self._bench.runs, before, self._base, rows, self._left, deviations)
        self._left |= more
        self._rows, self._judge = rows, self._judge.of_rows(rows)

    @property
    def _now(self) -> Sound:
        made = self._cover.changes
        return Sound(tuple(made), self._left, list(self._base), self._system, self._bench, self._rows)

    def _back(self, sound: Sound) -> None:
        self._cover.changes[:] = sound.changes
        self._left, self._base = sound.left, list(sound.base)
        self._system, self._bench = sound.system, sound.bench
        self._rows, self._judge = sound.rows, self._judge.of_rows(sound.rows)

    def _take(self, good: Sequence[CoveringChange]) -> None:
        """The best, and on top of it what explains something else, and all that another one may there."""
        self._cover.rivals[good[0].change.key] = rivals(good)
        self._accept(good[0])
        while len(self._cover.changes) < MOST_CAUSES:
            rest: dict[frozenset[int], list[CoveringChange]] = {}
            for one in good:
                own = one.explains & self._left
                if own and not any(own < other.places & self._left for other in self._partly):
                    rest.setdefault(own, []).append(one)
            nearest = [one for own in sorted(rest, key=len, reverse=True) for one in rest[own][:NEAREST]]
            if not any(self._again(one) for one in nearest if self._clock() < self._end):
                return

    def _explained(
        self, system: System, reading: StampReading | None, places: frozenset[int]
    ) -> tuple[frozenset[int], Sequence[Wrong]]:
        """What a part explains of deviations, with a stamp taken otherwise, and what is wrong with it."""
        cone = self._cone(system)
        wrong = None if cone is None else self._right(cone, None, places, reading)
        return (
            (frozenset(), ()) if wrong is None else (self._judge.explained(places, self._bench, wrong), wrong)
        )

    def _combined(self) -> bool:
        """Take several readings of stamps that only together explain something, and make nothing wrong."""
        cone = self._cone(self._system)
        if cone is None or not any(map(self._concerned, stamp_changes(self._board, self._system, self._own))):
            return False
        search = StampSearch(self._bench, cone, self._system, self._base)
        changes, wrong, bench = search.found(lambda: self._clock() > self._end)
        if not all(new.keys() <= old.keys() for old, new in zip(self._base, wrong, strict=True)):
            return False
        explains = self._judge.explained(self._left, self._bench, wrong)
        if not changes or not explains:
            return False
        self._cover.changes += [(change, frozenset[int]()) for change in changes[:-1]]
        self._accept(CoveringChange(changes[-1], explains, 0, wrong, self._system))
        self._bench = bench
        return True

    @property
    def _own(self) -> frozenset[str]:
        return frozenset(part.name for part in parts(self._system.components))

    def _again(self, one: CoveringChange) -> bool:
        """Take a change on top of those taken before, if it still does what it did alone."""
        change = one.change
        try:
            system = found_change(self._board, self._system, WrittenChange(*change.key)).make()
        except ModelError:
            return False
        return self._added(change, system, self._concerned(change))

    def _added(self, change: ChartChange, system: System, concerned: frozenset[int]) -> bool:
        """Take a change on top of those taken before, if it explains something there."""
        explains, wrong = self._explained(system, change.reading, concerned)
        if explains:
            self._accept(CoveringChange(change, explains, 0, wrong, system))
        return bool(explains)

    def _accept(self, one: CoveringChange) -> None:
        """Take a change, and the rows of which nobody could know without it what is right."""
        one = with_earlier(one, lambda reading: self._explained(one.system, reading, one.explains)[0])
        self._base, self._system = list(one.wrong), one.system
        bench = self._bench.with_reading(one.change.reading)
        self._bench, found = bench.going_on(self._evidence.group.cone(self._system))
        for number, wrong in found.items():
            self._base[number] = wrong
        explains = (one.explains & self._left) | self._judge.explained(self._left, self._bench, self._base)
        self._cover.changes.append((one.change, explains))
        self._left -= explains
        self._decided = self._judge.decided(self._left, self._bench)

    def order(self, change: ChartChange) -> Nearness:
        """Initial values first, where something differs in the first step of a run."""
        return (-1.0,) if change.kind == "initial" and self._at_power_up else super().order(change)

    def concerns(self, change: ChartChange) -> bool:
        """Whether a change may explain a deviation that is left."""
        return bool(self._concerned(change))

    def _concerned(self, change: ChartChange) -> frozenset[int]:
        """The deviations left, in rows that count, of outputs that a change may make otherwise."""
        outputs = self._influence.outputs(change)
        left = self._decided - self._settled
        return frozenset(n for n in left if outputs.issuperset(self._cover.deviations[n].scope.outputs))

    @property
    def satisfied(self) -> bool:
        """Whether something is explained by transitions that are drawn."""
        return bool(self._good)

    @property
    def enough(self) -> bool:
        """Whether single changes explain all that comes first in some run, each of what it concerns.

        What comes later is looked at then.  Where several do it together, one that is farther from the charts
        may explain as much.
        """
        return bool(self._first) and self._first <= self._settled

    # --- judging ---

    def passing(self, cone: LogCone, change: ChartChange, values: Sequence[Raw]) -> set[Raw]:
        """The values with which some witness is right that the change may concern."""
        concerned = self._concerned(change)
        found = set[Raw]()
        for one in self._witnesses:
            if one.place in concerned and len(found) < len(values):
                found |= set(self._bench.passing(cone, one.number, one.last, PARAMETER, values, one.masked))
        return found

    def narrowed(self, cone: LogCone, value: Raw, values: Sequence[Raw]) -> Collection[Raw]:
        """The values with which more rows are right behind those that the part as it is decides."""
        better = self._bench.narrowed(cone, PARAMETER, value, values)
        if value not in better:
            self._settled = self._settled_before
        return better

    def judge(
        self,
        cone: LogCone,
        change: Callable[[], ChartChange],
        system: System | None,
        parameter: Parameter | None = None,
    ) -> bool:
        """Note a change if it contradicts nothing and explains some deviation; whether it does."""
        made = change()
        concerned = self._concerned(made)
        witnesses = [one for one in self._witnesses if one.place in concerned]
        passes = partial(self._bench.passes, cone)
        places = [w.place for w in witnesses if passes(w.number, w.last, parameter, w.masked)]
        passed = len(places)
        if not passed:
            return False
        wrong = self._right(cone, parameter, concerned)
        if wrong is not None and parameter is not None:
            # the number was an input, for which there may be no room
            system, real = self._made(made)
            wrong = None if real is None else self._right(real, None, concerned)
        explains = frozenset[int]() if wrong is None else self._judge.explained(concerned, self._bench, wrong)
        if wrong is None or not explains:
            if made.kind not in ANYWHERE:
                self._partly.append(Unexplaining(made, self._bench, passed, frozenset(places)))
            return False
        if made.kind == "extra" and explains != self._left:  # of these one always explains some case
            return False
        cases = sum(len(old) - len(new) for old, new in zip(self._base, wrong, strict=True))
        first, self._settled_before = self._first & concerned, self._settled
        if first and first <= explains and made.kind != "single-precision":
            self._settled |= concerned  # single precision has rivals, which are told beside it
        self._passed_by_good = max(self._passed_by_good, passed)
        self._good.append(CoveringChange(made, explains, cases, wrong, system or made.make()))
        return True

    def _right(
        self, cone: LogCone, parameter: Parameter | None, concerned: frozenset[int],
        reading: StampReading | None = None,
    ) -> list[Wrong] | None:  # fmt: skip
        bench = self._bench.with_reading(reading)
        try:
            return self._judge.all_right(bench, self._base, cone, parameter, concerned)
        except NO_VALUE:
            return None

    def _ahead(self) -> CoveringChange | None:
        partly = [one for one in self._partly if self._good and one.passed > self._passed_by_good]
        return ahead(partly, self._good, self._bridge)

    def _bridge(self, one: Unexplaining) -> CoveringChange | None:
        """What a change does, if it makes nothing wrong earlier than now; ``cases`` is what it gains."""
        system, cone = self._made(one.change)
        try:
            wrong = None if cone is None else self._judge.mostly_right(one.bench, self._base, cone)
        except NO_VALUE:
            return None
        if wrong is None or system is None:
            return None
        gain = more_wrong(self._base, wrong) - GAIN * more_wrong(wrong, self._base)
        explains = self._judge.explained(self._concerned(one.change), one.bench, wrong)
        return CoveringChange(one.change, explains, gain, wrong, system)


__all__ = ["covered"]
