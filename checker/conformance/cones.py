"""A board taken apart at the signals that are logged: each part is checked on its own, against its outputs.

A component that reads a logged output of another one reads it in the log.  What no row tells (states, timers,
signals that are not logged) keeps the components that share it together.  A log is a run of the charts iff
it is one of every part; and a fault shows in the part where it arises, not in all that follow.
"""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

from rovercheck.checker.conformance.alike import ValueLikes, computed_with
from rovercheck.checker.conformance.numbers import is_number, value_of
from rovercheck.checker.conformance.program import (
    BeliefOutcome,
    Known,
    ProgramOutput,
    Step,
    TakenStep,
    compiled,
)
from rovercheck.checker.system.partition import expressions, partition
from rovercheck.checker.system.slice import sliced
from rovercheck.spec_model.abstraction import Board, Output
from rovercheck.spec_model.lang.chart import Block, Chart, Component, Enabled
from rovercheck.spec_model.lang.domain import Num
from rovercheck.spec_model.lang.expr import Const, Expr, Var
from rovercheck.spec_model.lang.lower import lower
from rovercheck.spec_model.lang.lower.ranges import unguarded
from rovercheck.spec_model.lang.system import System, TransitionSystem
from rovercheck.spec_model.lang.walk import variables

MOST_VALUES = 300
"""Values of one variable that are tried where it is not known."""

MOST_CUT = 200_000
SOME = 24


@dataclass(frozen=True)
class LogPart:
    """A component of the board with the conditions under which it executes."""

    component: Chart | Block
    enabled: tuple[Expr, ...]

    @property
    def reads(self) -> frozenset[str]:
        return frozenset(self.component.read) | frozenset(variables(*self.enabled))

    @property
    def writes(self) -> frozenset[str]:
        return written_by(self.component)

    @property
    def whole(self) -> Component:
        made: Component = self.component
        for condition in reversed(self.enabled):
            made = Enabled(condition, made)
        return made


@dataclass(frozen=True)
class LogCone:
    """A part of a board that is checked on its own.

    ``before``: inputs that are the logged outputs of the tick before.  ``between``: inputs that are not
    logged and of which values between the representative ones may matter.  ``left_out``: logged outputs that
    are computed from such inputs, which any value might explain.  ``components``: its charts and blocks, in
    the order of execution.
    """

    system: TransitionSystem
    outputs: tuple[Output, ...]
    charts: tuple[Chart, ...]
    before: frozenset[str]
    between: frozenset[str]
    left_out: tuple[str, ...]
    components: tuple[Chart | Block, ...] = ()

    @property
    def name(self) -> str:
        return self.system.name

    @cached_property
    def step(self) -> Step:
        return compiled(self.system, [ProgramOutput(o.var, o.unless) for o in self.outputs])

    @cached_property
    def quick_step(self) -> Step:
        """The same step, of states and inputs that are known."""
        return compiled(self.system, [ProgramOutput(o.var, o.unless) for o in self.outputs], known=True)

    @cached_property
    def ahead(self) -> dict[tuple[Known, Known], TakenStep]:
        """Steps taken ahead, by state and inputs."""
        return {}

    @cached_property
    def likes(self) -> tuple[ValueLikes | None, ...]:
        """Of each input the values that are alike; ``None`` where the step does more than to compare it."""
        used: set[str] = set()
        for root in self._roots:
            computed_with(root, used)
        return tuple(None if v.name in used else ValueLikes(v, self._roots) for v in self.system.inputs)

    @cached_property
    def remembered(self) -> dict[tuple[Known, Known], BeliefOutcome]:
        """Steps taken with everything known, by state and inputs."""
        return {}

    @cached_property
    def _roots(self) -> list[Expr]:
        return [*expressions(self.system.step), *(o.unless for o in self.outputs)]

    @cached_property
    def _cells(self) -> dict[str, tuple[tuple[int, ...], bool]]:
        return {}

    def values(self, name: str) -> tuple[int, ...]:
        """Values of a variable that stand for all of them, or, if not ``complete``, some of them."""
        return self._tried(name)[0]

    def complete(self, name: str) -> bool:
        """Whether the values tried stand for all that the variable may have."""
        return name not in self.between and self._tried(name)[1]

    def _tried(self, name: str) -> tuple[tuple[int, ...], bool]:
        if name not in self._cells:
            self._cells[name] = _representatives(self.system.var(name), self._roots)
        return self._cells[name]


def _representatives(var: Var, roots: Sequence[Expr]) -> tuple[tuple[int, ...], bool]:
    """One value of each cell; where these are too many, some of them, and whether they are all."""
    if len(var.domain) <= MOST_CUT:
        cells = [cell.value for cell in partition(var, roots, {var.name: var}).cells]
        if len(cells) <= MOST_VALUES:
            return tuple(cells), True
    values = var.domain.values
    some = {*values[:SOME], *values[:: max(1, len(values) // SOME)], values[-1]}
    return tuple(sorted(some)), False


def written_by(component: Chart | Block) -> frozenset[str]:
    """What a component determines: data that it writes, and of a chart which states are active."""
    places = component.locations if isinstance(component, Chart) else ()
    return frozenset(component.written).union(v.name for v in places)


@dataclass(frozen=True)
class ConeGroup:
    """Parts of a board that are checked together: what is not told keeps them together.

    ``outputs``: those of them that are compared, also where any value might be right.  ``cuts``: logged
    outputs that others read in the log.
    """

    board: Board
    parts: tuple[LogPart, ...]
    every: tuple[LogPart, ...]
    outputs: tuple[Output, ...]
    seen: frozenset[str]
    cuts: frozenset[str]

    @property
    def name(self) -> str:
        last = self.outputs[-1].var.name
        return next((p for p in reversed(self.parts) if last in p.writes), self.parts[-1]).component.name

    @property
    def system(self) -> System:
        """The parts as a system of their own."""
        whole = tuple(p.whole for p in self.parts)
        return System(self.name, whole, tick_ms=self.board.system.tick_ms)

    def cone(self, system: System | None = None) -> LogCone:
        """What is followed of the parts, or of a changed ``system`` in their place."""
        parts = self.parts if system is None else tuple(_parts(system.components, ()))
        return _cone(self, self.system if system is None else system, parts)


def cones(board: Board, seen: frozenset[str], logged: frozenset[str]) -> tuple[LogCone, ...]:
    """The parts of a board in the order of execution.

    ``seen``: inputs of the charts that the log tells.  ``logged``: names of the outputs in the log.
    """
    return tuple(group.cone() for group in cone_groups(board, seen, logged))


def cone_groups(board: Board, seen: frozenset[str], logged: frozenset[str]) -> tuple[ConeGroup, ...]:
    """The groups of parts of which the cones are made, in the same order."""
    parts = parts_of(board)
    outputs = tuple(o for o in board.outputs if o.name in logged)
    cuts = {o.var.name for o in outputs if _cut(o, parts)}
    while True:
        groups = _groups(parts, seen, cuts)
        mixed = {v for group in groups for v in _read_twice(group, parts, cuts)}
        if not mixed:
            break
        cuts -= mixed
    found: list[ConeGroup] = []
    for group in groups:
        inside = tuple(parts[i] for i in group)
        written = frozenset(name for part in inside for name in part.writes)
        if own := tuple(o for o in outputs if o.var.name in written):
            found.append(ConeGroup(board, inside, parts, own, seen, frozenset(cuts)))
    return tuple(found)


def parts_of(board: Board) -> tuple[LogPart, ...]:
    """The charts and blocks of a board in the order of execution."""
    return tuple(_parts(board.system.components, ()))


def _parts(components: Sequence[Component], enabled: tuple[Expr, ...]) -> Iterator[LogPart]:
    for component in components:
        if isinstance(component, Enabled):
            yield from _parts(component.components, (*enabled, component.by))
        else:
            yield LogPart(component, enabled)


def _cut(output: Output, parts: Sequence[LogPart]) -> bool:
    """Whether the log tells the value of the variable exactly, in every tick, to whoever reads it."""
    sort = output.var.domain.sort
    always = isinstance(output.unless, Const) and not output.unless.value
    whole = not isinstance(sort, Num) or sort.resolution == 1
    return always and whole and sum(output.var.name in p.writes for p in parts) == 1


def _groups(parts: Sequence[LogPart], seen: frozenset[str], cuts: Iterable[str]) -> list[list[int]]:
    """Indexes of the parts that share what is not told."""
    told = seen | frozenset(cuts)
    groups: list[tuple[set[str], list[int]]] = []
    for index, part in enumerate(parts):
        own = set((part.reads | part.writes) - told) | {f"writes {v}" for v in part.writes & set(cuts)}
        joined = [g for g in groups if g[0] & own]
        groups = [g for g in groups if not g[0] & own]
        groups.append(
            (own.union(*(g[0] for g in joined)), sorted([index, *(i for g in joined for i in g[1])]))
        )
    return sorted((group for _, group in groups), key=max)


def _writer(name: str, parts: Sequence[LogPart]) -> int:
    return next(i for i, p in enumerate(parts) if name in p.writes)


def _read_before(name: str, group: Sequence[LogPart], every: Sequence[LogPart]) -> bool:
    """Whether the group reads the variable before it is renewed."""
    order = {p.component.name: number for number, p in enumerate(every)}
    last = max((order[p.component.name] for p in group if p.component.name in order), default=0)
    writer = _writer(name, every)
    return any(name in p.reads and order.get(p.component.name, last) < writer for p in group)


def _read_twice(group: Sequence[int], parts: Sequence[LogPart], cuts: Iterable[str]) -> Iterator[str]:
    """Cut variables that the group reads both before and after they are renewed."""
    for name in cuts:
        writer = _writer(name, parts)
        readers = [i for i in group if name in parts[i].reads and i != writer]
        if writer not in group and min(readers, default=writer) < writer < max(readers, default=writer):
            yield name


def _cone(group: ConeGroup, system: System, parts: Sequence[LogPart]) -> LogCone:
    whole = lower(system)
    # values between those of a domain are stored like the others
    lowered = replace(whole, checks=(), step=unguarded(whole.step))
    told = group.seen | group.cuts | {v.name for v in whole.inputs if is_number(v.name)}
    told_all = all(v.name in told for v in lowered.inputs)  # then nothing lies between
    numbers = [] if told_all else [o for o in group.outputs if measured(o)]
    free = frozenset(o.name for o in numbers if _between(_least(lowered, [o]), told))
    own = tuple(o for o in group.outputs if o.name not in free)
    least = _least(lowered, own)
    before = frozenset(
        v.name for v in least.inputs if v.name in group.cuts and _read_before(v.name, parts, group.every)
    )
    charts = tuple(p.component for p in parts if isinstance(p.component, Chart))
    components = tuple(p.component for p in parts)
    between = frozenset[str]() if told_all else _between(least, told)
    given = tuple(v for v in least.inputs if value_of(v.name) is None)
    least = replace(least, inputs=given)
    return LogCone(least, own, charts, before, between, tuple(sorted(free)), components)


def _least(system: TransitionSystem, outputs: Sequence[Output]) -> TransitionSystem:
    """What the outputs depend on."""
    goals = {v.name: v for o in outputs for v in (o.var, *variables(o.unless).values())}
    return sliced(system, tuple(goals.values()))


# --- values between the representative ones ---------------------------------------------------


def measured(output: Output) -> bool:
    """Whether firmware computes the output with floats."""
    sort = output.var.domain.sort
    return isinstance(sort, Num) and sort.resolution != 1


def _between(system: TransitionSystem, told: frozenset[str] | set[str]) -> frozenset[str]:
    """Measured inputs that are not told and are computed with, not only compared with limits."""
    found: set[str] = set()
    for root in expressions(system.step):
        computed_with(root, found)
    measured = {v.name for v in system.inputs if isinstance(v.domain.sort, Num) and not v.domain.dense}
    measured |= {
        v.name for v in system.inputs if isinstance(v.domain.sort, Num) and v.domain.sort.resolution != 1
    }
    return frozenset(found & measured - told)


__all__ = ["ConeGroup", "LogCone", "LogPart", "cone_groups", "cones", "measured", "parts_of"]
