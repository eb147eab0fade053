"""Every change of a part, tried from near to far; single ones that explain every case of it."""

from abc import ABC, abstractmethod
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import partial
from time import process_time

from rovercheck.checker.conformance.cones import LogCone
from rovercheck.checker.conformance.numbers import PARAMETER
from rovercheck.checker.conformance.recording import Raw
from rovercheck.checker.diagnosis.change import TIERS, ChangeKind, ChartChange, Nearness
from rovercheck.checker.diagnosis.durations import durations
from rovercheck.checker.diagnosis.evidence import PartEvidence
from rovercheck.checker.diagnosis.hypotheses import (
    age_changes,
    beginning_changes,
    delay_changes,
    during_changes,
    extra_changes,
    mutant_changes,
    other_ages,
    region_changes,
    rewrite_changes,
    signals_of,
    stamp_changes,
    timer_changes,
    written_changes,
)
from rovercheck.checker.diagnosis.limits import NumberSlot, number_slots, values_of
from rovercheck.checker.diagnosis.met_values import MetValues
from rovercheck.checker.diagnosis.trial import NO_VALUE, Parameter, Trial, TrialBench
from rovercheck.checker.diagnosis.variant import WrittenChange, found_change
from rovercheck.spec_model.abstraction import Board
from rovercheck.spec_model.abstraction.board import with_readings
from rovercheck.spec_model.abstraction.signals import whole
from rovercheck.spec_model.lang.chart import parts
from rovercheck.spec_model.lang.domain import Num
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.system import System

SECONDS = 300.0
"""How long the causes of one part are looked for, in seconds of the processor."""

STAMPS = TIERS["always"]
"""When stamps that are taken otherwise are tried: before the many changes that are farther than this."""

Clock = Callable[[], float]


@dataclass(frozen=True)
class ExplainingCause:
    """One or more changes of a part that together explain ``trial``."""

    changes: tuple[ChartChange, ...]
    trial: Trial

    @property
    def nearness(self) -> tuple[float, ...]:
        """Fewer changes come first, then the nearer ones."""
        return (len(self.changes), *(x for c in self.changes for x in c.nearness))


@dataclass
class SingleCauses:
    """Changes of one part that each explain every case, the nearest first.

    ``tried`` changes ``of`` all; fewer only if the time was over.
    """

    causes: list[ExplainingCause] = field(default_factory=list)
    tried: int = 0
    of: int = 0
    seconds: float = 0.0


def single_causes(
    evidence: PartEvidence, seconds: float = SECONDS, clock: Clock = process_time
) -> SingleCauses:
    """The single changes that explain all that one part does otherwise than the charts."""
    found = SingleCauses()
    start = clock()
    _SingleChanges(evidence, found, start + seconds, clock).run()
    found.seconds = clock() - start
    return found


class HypothesisSearch(ABC):
    """Tries all changes of a part until the time is over; ``judge`` says what becomes of one.

    ``tried`` changes ``of`` those that there are.
    """

    def __init__(self, evidence: PartEvidence, until: float, clock: Clock) -> None:
        self._evidence, self._until, self._clock = evidence, until, clock
        self._bench = TrialBench(evidence)
        self._met = MetValues(evidence)
        self._outputs = len(evidence.cone.outputs)
        self._known = {PARAMETER, *(v.name for v in evidence.cone.system.inputs), *self._signals()}
        self._known |= {v.name for v in other_ages(evidence.group.board)}
        self.only: Sequence[ChartChange] | None = None
        """Changes instead of all those that there are; each is made anew where it is tried."""
        self.without: Collection[ChangeKind] = ()
        """Kinds of changes that are left out."""
        self.tried = self.of = 0
        self.late = False
        """Whether the time was over before all was tried."""

    @abstractmethod
    def judge(
        self,
        cone: LogCone,
        change: Callable[[], ChartChange],
        system: System | None,
        parameter: Parameter | None = None,
    ) -> bool:
        """Note a change of the part, which is ``cone`` with it; whether it explains what it must."""

    def concerns(self, change: ChartChange) -> bool:
        """Whether a change may explain anything; one that may not is not tried."""
        return True

    @property
    def satisfied(self) -> bool:
        """Whether no transitions that are not drawn need to be tried."""
        return False

    @property
    def enough(self) -> bool:
        """Whether nothing more needs to be tried, though there is time."""
        return False

    def level(self, system: System) -> None:
        """Every change of a system, from near to far, or those alone that are asked for."""
        if self.only is not None:
            self._each_again(system, self.only)
            return
        only = frozenset(part.name for part in parts(system.components))
        changes = sorted(self._changes(system, only), key=self.order)
        self.of += len(changes)
        near = sum(self.order(change) < (TIERS["limit"],) for change in changes)
        self._each(changes[:near])
        slots = [] if self.ended else list(number_slots(system, only))
        self._limits([one for one in slots if not one.of_equality])
        self._each(changes[near:])
        if not self.ended:
            self._limits([one for one in slots if one.of_equality])
        if not self.satisfied:
            extra = list(extra_changes(system, only))
            self.of += len(extra)
            self._each(extra)

    def order(self, change: ChartChange) -> Nearness:
        """What is tried first; ways to take a stamp are few, and soon tried."""
        of_stamp = change.reading is not None and change.kind != "single-precision"
        return (STAMPS, change.distance) if of_stamp else change.nearness

    @property
    def ended(self) -> bool:
        """Whether no further change is to be tried: all is found, or the time is over."""
        return self.enough or self._over

    @property
    def _over(self) -> bool:
        self.late = self.late or self._clock() > self._until
        return self.late

    def _each(self, changes: Sequence[ChartChange]) -> None:
        for change in changes:
            if self.ended:
                return
            self.tried += 1
            if change.kind not in self.without and self.concerns(change):
                self._try(change)

    def _each_again(self, system: System, changes: Iterable[ChartChange]) -> None:
        for change in changes:
            with suppress(ModelError):  # of something that is no longer there
                made = found_change(self._board, system, WrittenChange(*change.key))
                self.of += 1
                self._each([replace(made, tier=change.tier)])

    def _changes(self, system: System, only: frozenset[str]) -> list[ChartChange]:
        found: list[ChartChange] = []
        found += written_changes(self._evidence.group.board, system)
        found += timer_changes(system, durations(self._evidence), only)
        found += mutant_changes(system)
        found += beginning_changes(system, only)
        found += during_changes(system, only)
        found += rewrite_changes(system, self._signals(), only)
        found += region_changes(system, only)
        outputs = frozenset(o.var.name for o in self._evidence.cone.outputs)
        found += delay_changes(system, only, outputs)
        found += stamp_changes(self._board, system, only)
        found += age_changes(self._board, system, only)
        return found

    @property
    def _board(self) -> Board:
        """The board with the stamps as they are taken so far."""
        return with_readings(self._evidence.group.board, self._bench.readings)

    def _signals(self) -> dict[str, Var]:
        """What the part might read by mistake, as far as it is recorded in all runs."""
        known = set.intersection(*(set(run.columns) for run in self._evidence.runs))
        return {n: v for n, v in signals_of(self._evidence.group.board).items() if n in known}

    def _cone(self, system: System) -> LogCone | None:
        """The changed part, or None where it has no meaning or no longer gives what is compared.

        Nor where it may do one or the other: firmware does one of them.
        """
        try:
            cone = self._evidence.group.cone(system)
        except (ModelError, StopIteration, RecursionError, AssertionError):
            return None
        told = self._known.issuperset(v.name for v in cone.system.inputs)
        return cone if told and len(cone.outputs) == self._outputs else None

    def _made(self, change: ChartChange) -> tuple[System | None, LogCone | None]:
        """The charts with a change, and the part of them."""
        try:
            system = change.make()
        except (ModelError, AssertionError, ValueError):
            return None, None
        return system, self._cone(system)

    def _try(self, change: ChartChange) -> None:
        system, cone = self._made(change)
        if cone is not None:
            bench = self._bench
            self._bench = bench.with_reading(change.reading)
            self.judge(cone, lambda: change, system)
            self._bench = bench

    # --- limits ---

    def _limits(self, slots: Sequence[NumberSlot]) -> None:
        factors = self._factors()
        for slot in sorted(slots, key=lambda s: not s.at.startswith("everywhere")):
            if not self.concerns(slot.change(slot.op, slot.drawn)):
                continue
            values = values_of(slot, self._met, factors)
            self.of += len(values)
            cones = {op: self._opened(slot, op) for op in dict.fromkeys(op for op, _ in values)}
            possible = self._possible(slot, values, cones)
            explained = tried = 0
            for op, raw in sorted(values, key=lambda v: slot.change(*v).nearness):
                made = partial(slot.change, op, raw, values[op, raw])
                if self._over:
                    return
                self.tried, tried = self.tried + 1, tried + 1
                cone, value = cones[op], whole(raw)
                if cone is None or (op, raw) not in possible:
                    continue
                if self.judge(cone, made, None, (PARAMETER, value)):
                    others = [whole(other) for same, other in possible if same is op]
                    better = self.narrowed(cone, value, others)
                    possible -= {one for one in possible if one[0] is op and whole(one[1]) not in better}
                    explained += value in better
                if explained >= 2:  # of one limit the two simplest say enough
                    self.of -= len(values) - tried
                    break

    def _possible(
        self,
        slot: NumberSlot,
        values: Collection[tuple[Op | None, Fraction]],
        cones: Mapping[Op | None, LogCone | None],
    ) -> set[tuple[Op | None, Fraction]]:
        """Those of the values of a limit that may explain something, by operator."""
        found = set[tuple[Op | None, Fraction]]()
        for op, cone in cones.items():
            raws = {whole(raw): raw for other, raw in values if other is op}
            if cone is not None:
                some = self.passing(cone, slot.change(slot.op, slot.drawn), list(raws))
                found |= {(op, raws[value]) for value in some}
        return found

    def passing(self, cone: LogCone, change: ChartChange, values: Sequence[Raw]) -> Collection[Raw]:
        """Those of the values of the parameter of a part that need to be judged."""
        return values

    def narrowed(self, cone: LogCone, value: Raw, values: Sequence[Raw]) -> Collection[Raw]:
        """Those of the values of the parameter of a part that may explain more than one does; or all."""
        return values

    def _opened(self, slot: NumberSlot, op: Op | None) -> LogCone | None:
        try:
            return self._cone(slot.opened(op))
        except (ModelError, AssertionError):
            return None

    def _factors(self) -> list[Fraction]:
        """How many times what is required is recorded, of outputs that are measured."""
        found: dict[Fraction, None] = {}
        for run in self._evidence.deviating:
            for _, mismatch in run.wrong[self._evidence.name][:200]:
                for difference in mismatch.differences:
                    if isinstance(difference.output.var.domain.sort, Num):
                        for wanted in difference.expected[:2]:
                            if difference.logged is not None:
                                found.update(_ratio(wanted, difference.logged))
            if len(found) > 40:
                break
        return list(found)[:40]


class _SingleChanges(HypothesisSearch):
    def __init__(self, evidence: PartEvidence, found: SingleCauses, until: float, clock: Clock) -> None:
        super().__init__(evidence, until, clock)
        self._found = found

    def run(self) -> None:
        """All changes, or as many as there is time for."""
        self.level(self._evidence.group.system)
        self._found.causes.sort(key=lambda c: c.nearness)
        self._found.tried, self._found.of = self.tried, self.of

    @property
    def satisfied(self) -> bool:
        """Whether some change explains all."""
        return bool(self._found.causes)

    def judge(
        self,
        cone: LogCone,
        change: Callable[[], ChartChange],
        system: System | None,
        parameter: Parameter | None = None,
    ) -> bool:
        """Note a change if it explains all; whether it does."""
        try:
            if self._bench.rejected(cone, parameter) is not None:
                return False
            trial = self._bench.trial(cone, parameter)
            _, behind = self._bench.going_on(cone, parameter)
        except NO_VALUE:
            return False
        if not trial.full or any(behind.values()):
            return False
        made = change()
        if parameter is not None and self._cone(system if system is not None else made.make()) is None:
            return False  # the number as an input, for which there is no room
        self._found.causes.append(ExplainingCause((made,), trial))
        return True


def _ratio(wanted: Raw, got: Raw) -> Iterator[tuple[Fraction, None]]:
    if wanted:
        yield (Fraction(got) / Fraction(wanted)).limit_denominator(1000), None


__all__ = ["ExplainingCause", "HypothesisSearch", "SingleCauses", "single_causes"]
