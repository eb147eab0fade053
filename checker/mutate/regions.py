"""Two regions of a chart in one memory: active state, times and data.

So is firmware in which two instances of one structure are one: each region is executed in its turn, and goes
on from where the other has left off.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import combinations

from rovercheck.checker.mutate.alike_regions import actions_of, written_alike
from rovercheck.checker.mutate.memory import FEWEST_CELLS, with_memory
from rovercheck.checker.mutate.rewrites import mapped
from rovercheck.checker.mutate.wiring import kept
from rovercheck.spec_model.lang.action import Action, Assign, If, Send, each_action
from rovercheck.spec_model.lang.chart import Block, Chart, Component, Enabled, State, parts
from rovercheck.spec_model.lang.domain import Domain, Enum, Num, integer
from rovercheck.spec_model.lang.edit import in_actions
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import TRUE, Apply, Const, Expr, Var
from rovercheck.spec_model.lang.lower.flow import ChartFlow
from rovercheck.spec_model.lang.lower.ranges import unguarded
from rovercheck.spec_model.lang.operators import COMPARISONS, Op
from rovercheck.spec_model.lang.system import Statement, System
from rovercheck.spec_model.lang.walk import nodes, variables

BITS = 32
"""Bits of the numbers in which firmware counts milliseconds."""


@dataclass(frozen=True)
class RegionsInOneMemory:
    """Two regions of a chart that are alike but for numbers and for the data that they read and write.

    ``data``: what they write, in pairs.  ``since``: of these pairs the numbers to which a block adds and that
    a region sets to 0: what has gone by since then, of one clock for each region.  In one memory that is the
    same moment for both, so that what has gone by may be negative; ``bits``: in how many bits it is kept
    then, 0: in all that it needs.
    """

    chart: Chart
    first: State
    second: State
    data: Mapping[str, tuple[Var, Var]]
    since: Mapping[str, tuple[Var, Var]]
    bits: int = 0

    def system(self, system: System) -> System:
        """The system with both regions in one block, in place of the regions.

        Raises ``ModelError`` where the counters of a region are of no use to the other.
        """
        root = self.chart.root
        others = [s for s in root.states if s not in (self.first, self.second)]
        rest = [self.chart.with_root(replace(root, states=tuple(others)))] if others else []
        block = self._block(system)
        counted = {var.name: _either_sign(var) for pair in self.since.values() for var in pair}

        def walk(component: Component) -> tuple[Component, ...]:
            if isinstance(component, Enabled):
                inside = [new for old in component.components for new in walk(old)]
                return (Enabled(component.by, *inside, name=component.name, place=component.place),)
            alone: tuple[Chart | Block, ...] = (*rest, block) if component is self.chart else (component,)
            return tuple(
                with_memory(one, counted) if counted.keys() & (one.read.keys() | one.written.keys()) else one
                for one in alone
            )

        return kept(system, replace(system, components=tuple(n for c in system.components for n in walk(c))))

    def _block(self, system: System) -> Block:
        name = f"{self.chart.name}.{self.first.name}"
        memory = {
            one.name: Var(f"{name}.{one.name}", one.domain, one.init, f"{one.doc}, of two regions", True)
            for one, _ in self.data.values()
        }
        flows = [self._flow(state, name, memory, system) for state in (self.first, self.second)]
        _count_alike(*flows)
        do: list[Statement] = []
        for flow, own in zip(flows, zip(*self.data.values(), strict=True), strict=True):
            do += unguarded(tuple(flow.step()))
            do += [
                Assign(var, memory[one.name]) for var, (one, _) in zip(own, self.data.values(), strict=True)
            ]
        text = f"Regions {self.first.name} and {self.second.name} in one memory."
        return _with_own_places(Block(name, do, text=text, place=self.chart.place), flows[0].chart)

    def _flow(self, state: State, name: str, memory: Mapping[str, Var], system: System) -> ChartFlow:
        """One region as a chart of its own, on what both remember."""
        chart = Chart(name, state.states, default=state.default, junctions=state.junctions)
        for one, two in self.since.values():
            own, other = (one, two) if state is self.first else (two, one)
            chart = self._since(chart, own, other)
        instead = {var.name: memory[one.name] for one, two in self.data.values() for var in (one, two)}
        changed = with_memory(chart, instead)
        assert isinstance(changed, Chart)
        return ChartFlow(changed, system.step_ms, system.elapsed)

    def _since(self, chart: Chart, own: Var, other: Var) -> Chart:
        """What has gone by since a moment that the other region sets, too."""
        again = If(TRUE, (Assign(other, other - own), Assign(own, Const(0, own.sort))))
        wrap = partial(_wrapped, bits=self.bits, sort=own.sort)

        def condition(node: Expr) -> Expr:
            match node:
                case Apply(Op.GT, (Var(own.name), Const(0))):
                    return own != 0
            if self.bits and isinstance(node, Apply) and node.op in COMPARISONS and _is_sum(node.args[0]):
                return replace(node, args=(wrap(node.args[0]), *node.args[1:]))
            return node

        def act(action: Action) -> Action:
            match action:
                case Assign(Var(own.name)):
                    return again
                case Assign(var, Var(own.name)) if self.bits:
                    return Assign(var, wrap(own))
                case If(test, then, otherwise):
                    return If(test, tuple(map(act, then)), tuple(map(act, otherwise)))
            return action

        compared = mapped(chart, condition)
        assert isinstance(compared, Chart)
        return in_actions(compared, act)


def regions_in_one_memory(system: System) -> Iterator[RegionsInOneMemory]:
    """Every two regions of a chart that may be in one memory, and each of the ways to keep it."""
    every = list(parts(system.components))
    for chart in every:
        if isinstance(chart, Chart) and chart.root.parallel and not chart.local_to and not _sends(chart):
            blocks = [
                part
                for part in every
                if part is not chart and not part.written.keys().isdisjoint(chart.written)
            ]
            for first, second in combinations(chart.root.states, 2):
                found = _in_one_memory(chart, first, second, blocks)
                if found is not None:
                    yield found
                    if found.since:
                        yield replace(found, bits=BITS)


def _in_one_memory(
    chart: Chart, first: State, second: State, others: Sequence[Chart | Block]
) -> RegionsInOneMemory | None:
    pairs = written_alike(first, second)
    since = {n: pair for n, pair in pairs.items() if any(v.name in o.written for v in pair for o in others)}
    regions = (first, second)
    counted = (zip(pair, regions, strict=True) for pair in since.values())
    if not pairs or not all(_gone_by(var, region, others) for both in counted for var, region in both):
        return None
    data = {name: pair for name, pair in pairs.items() if name not in since}
    return RegionsInOneMemory(chart, first, second, data, since)


def _either_sign(var: Var) -> Var:
    """The variable with as large numbers below 0 as above it."""
    return replace(var, domain=Domain(var.sort, range(-var.domain.high, var.domain.high + 1)))


def _sends(chart: Chart) -> bool:
    return any(isinstance(a, Send) for _, s in chart.root.walk() for a in each_action(list(actions_of(s))))


def _gone_by(var: Var, region: State, others: Sequence[Chart | Block]) -> bool:
    """Whether blocks only add to a number, and the region only sets it to 0."""
    inside = [a for _, s in region.walk() for a in each_action(list(actions_of(s)))]
    outside = [a for part in others if isinstance(part, Block) for a in each_action(list(part.do))]
    charts = any(var.name in part.written for part in others if isinstance(part, Chart))
    own = [a for a in inside if isinstance(a, Assign) and a.var.name == var.name]
    added = [a for a in outside if isinstance(a, Assign) and a.var.name == var.name]
    zero = all(isinstance(a.value, Const) and a.value.value == 0 for a in own)
    return not charts and zero and all(_adds(a) for a in added)


def _adds(action: Assign) -> bool:
    match action.value:
        case Apply(Op.ADD, (Var(name), added)):
            return name == action.var.name and name not in variables(added)
    return False


def _is_sum(formula: Expr) -> bool:
    """Whether a formula adds up the cells of an array."""
    cells = [node for node in nodes(formula) if isinstance(node, Var)]
    return len(cells) >= FEWEST_CELLS and all(
        isinstance(node, Var) or (isinstance(node, Apply) and node.op is Op.ADD) for node in nodes(formula)
    )


def _wrapped(formula: Expr, bits: int, sort: object) -> Expr:
    assert isinstance(sort, Num)
    most = (1 << bits) / sort.resolution
    if not bits or most.denominator != 1:
        return formula
    return Apply(Op.MOD, (formula, Const(int(most), sort)), sort)


def _with_own_places(block: Block, chart: Chart) -> Block:
    """The block with data in place of the active states of a chart, which is not there any more."""
    places = {place.name: _datum(place) for place in chart.locations}
    sorts = {place.sort: places[place.name].sort for place in chart.locations}

    def constant(node: Expr) -> Expr:
        return (
            replace(node, sort=sorts[node.sort]) if isinstance(node, Const) and node.sort in sorts else node
        )

    changed = mapped(with_memory(block, places), constant)
    assert isinstance(changed, Block)
    return changed


def _datum(place: Var) -> Var:
    assert isinstance(place.sort, Enum)
    sort = Enum(f"places in {place.name}", place.sort.members)
    return Var(place.name, Domain(sort, place.domain.values), place.init, place.doc)


def _count_alike(one: ChartFlow, two: ChartFlow) -> None:
    """Give the counters of both the range of the longer one."""
    for path in one.timers.after.keys() & two.timers.after.keys():
        longer = _longer(one.timers.after[path], two.timers.after[path])
        one.timers.after[path] = two.timers.after[path] = longer
    for path in one.timers.durations.keys() & two.timers.durations.keys():
        here, there = one.timers.durations[path], two.timers.durations[path]
        if len(here) != len(there):
            raise ModelError(f"{'.'.join(path)} counts other times in one region than in the other.")
        for mine, other in zip(list(here), list(there), strict=True):
            longer = _longer(here[mine][1], there[other][1])
            here[mine], there[other] = (here[mine][0], longer), (there[other][0], longer)


def _longer(one: Var, two: Var) -> Var:
    high = max(one.domain.high, two.domain.high)
    return Var(one.name, integer(0, high), 0, one.doc)


__all__ = ["RegionsInOneMemory", "regions_in_one_memory"]
