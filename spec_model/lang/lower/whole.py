"""A whole system as a transition system: components in order, enabled subsystems, domain checks."""

from collections.abc import Sequence
from functools import lru_cache
from typing import Generic, TypeVar

from rovercheck.spec_model.lang.action import Assign, If, each_action
from rovercheck.spec_model.lang.chart import Block, Chart, Component, Enabled
from rovercheck.spec_model.lang.expr import FALSE, Var
from rovercheck.spec_model.lang.lower.flow import ChartFlow
from rovercheck.spec_model.lang.lower.ranges import check_of, guarded
from rovercheck.spec_model.lang.programmed import ProgrammedChart
from rovercheck.spec_model.lang.system import Program, Statement, System, TransitionSystem
from rovercheck.spec_model.lang.wellformed import check_system

T = TypeVar("T")
LoweredChart = tuple[Program, tuple[Var, ...], tuple[Var, ...]]
_KEPT = 256
"""Charts, and blocks, of which the lowered form is remembered."""


def lower(system: System) -> TransitionSystem:
    """The transition system of a system.  Raises ``ModelError`` for an ill-formed one."""
    check_system(system)
    made = _Made(system.step_ms, system.elapsed)
    body = made.run(system.components)
    data = {n: v for n, v in system.written.items() if n not in {f.name for f in system.frozen}}
    checks = _checks(body)
    return TransitionSystem(
        name=system.name,
        inputs=tuple(system.inputs.values()),
        frozen=system.frozen,
        variables=(*made.locations, *data.values(), *made.timers, *checks),
        temps=tuple(made.flags),
        step=(*(Assign(check, FALSE) for check in checks), *body),
        assume=system.assumed,
        checks=tuple((check, check.doc) for check in checks),
        tick_ms=system.tick_ms,
        notes=system.notes,
        elapsed=system.elapsed,
        source=system,
    )


class _Made:
    """What lowering the components creates besides their statements."""

    def __init__(self, tick_ms: int, elapsed: Var | None) -> None:
        self.tick_ms, self.elapsed = tick_ms, elapsed
        self.locations: list[Var] = []
        self.timers: list[Var] = []
        self.flags: list[Var] = []

    def run(self, components: Sequence[Component]) -> tuple[Statement, ...]:
        out: list[Statement] = []
        for component in components:
            match component:
                case Chart():
                    out += self._chart(component)
                case Block():
                    out += _lowered_block(ByIdentity(component))
                    self.flags += component.temporaries
                case Enabled():
                    out.append(If(component.by, self.run(component.components)))
        return tuple(out)

    def _chart(self, chart: Chart) -> Program:
        if isinstance(chart, ProgrammedChart):
            self.locations += [chart.entered, *chart.locations]
            self.flags += chart.program.temporaries
            return tuple(_block(chart.program.unmarked))
        step, timers, flags = _lowered_chart(ByIdentity(chart), self.tick_ms, ByIdentity(self.elapsed))
        self.locations += [*([chart.entered] if chart.root.parallel else []), *chart.locations]
        self.timers += timers
        self.flags += flags
        return step


# --- charts and blocks that several systems share are lowered once ---------------------------------


class ByIdentity(Generic[T]):
    """A system, or a part of one, as a key of what is remembered: equal to itself alone.

    Formulas cannot be compared.
    """

    def __init__(self, part: T) -> None:
        self.part = part

    def __hash__(self) -> int:
        return id(self.part)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, ByIdentity) and other.part is self.part


@lru_cache(maxsize=_KEPT)
def _lowered_chart(chart: ByIdentity[Chart], tick_ms: int, elapsed: ByIdentity[Var | None]) -> LoweredChart:
    """Its step, timers and flags."""
    flow = ChartFlow(chart.part, tick_ms, elapsed.part)
    step = tuple(flow.step())
    return step, tuple(flow.timers.variables), tuple(flow.flags)


@lru_cache(maxsize=_KEPT)
def _lowered_block(block: ByIdentity[Block]) -> Program:
    return tuple(_block(block.part.do))


def _block(actions: Sequence[object]) -> list[Statement]:
    out: list[Statement] = []
    for action in actions:
        if isinstance(action, Assign):
            out.append(guarded(action))
        elif isinstance(action, If):
            out.append(If(action.condition, tuple(_block(action.then)), tuple(_block(action.otherwise))))
    return out


def _checks(program: Program) -> list[Var]:
    """The check variables that the program may raise, once each."""
    guarding = (a for a in each_action(program) if isinstance(a, If))
    found = {check.name: check for check in map(check_of, guarding) if check is not None}
    return list(found.values())
