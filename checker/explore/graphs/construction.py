"""From a system to its graph: explored, projected, and with what a reader wants to know beside it."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import islice

from rovercheck.checker.engines import Limits, Progress, quiet
from rovercheck.checker.explore.graphs.projection import project
from rovercheck.checker.explore.graphs.search import Exploration, checks_of, explore
from rovercheck.checker.results.graph import GraphWay, StateGraph
from rovercheck.checker.results.trace import Trace, TracedProperty, TracedSystem
from rovercheck.checker.system.partition import Partition
from rovercheck.checker.system.slice import sliced
from rovercheck.checker.verify.reachable import ticks
from rovercheck.checker.verify.runs.replay import ends, followed
from rovercheck.spec_model.lang.lower.ranges import checked
from rovercheck.spec_model.lang.system import TransitionSystem

# --- the inputs of a tick that are worth telling -------------------------------------------------------

TOGETHER = 64
"""Ways through a tick that are tried to see whether an input matters."""
BUDGET = 20_000
"""Ticks tried for one graph: few enough not to be waited for, and counted so that it is always the same."""

Same = Callable[[Mapping[str, int]], bool]
"""Whether a state is behind the node in question."""


class InputSimplifier:
    """Leaves out inputs of example ticks that do not matter, as long as the budget lasts."""

    def __init__(
        self, system: TransitionSystem, cells: Mapping[str, Partition], budget: int = BUDGET
    ) -> None:
        self.system, self.budget = system, budget
        self.cells = {name: tuple(c.value for c in p.cells) for name, p in cells.items()}

    def told(self, before: Mapping[str, int], inputs: Mapping[str, int], same: Same) -> dict[str, int]:
        """Inputs with which every tick from the state ends behind the same node.

        More than these only where too many ways through the tick would have to be tried.
        """
        left = dict(inputs)
        for name in inputs:
            fewer = {n: raw for n, raw in left.items() if n != name}
            if self._enough(before, fewer, same):
                left = fewer
        return left

    def _enough(self, before: Mapping[str, int], fixed: Mapping[str, int], same: Same) -> bool:
        """Whether all ticks with the fixed inputs end behind the same node."""
        cells = {name: (fixed[name],) if name in fixed else own for name, own in self.cells.items()}
        most = min(TOGETHER, self.budget)
        for number, (after, _) in enumerate(islice(ticks(self.system, before, cells), most + 1), start=1):
            self.budget -= 1
            if number > most or not same(after):
                return False
        return self.budget > 0


LIMITS = Limits(seconds=60.0, memory=2 << 30)


@dataclass(frozen=True, eq=False)
class BuiltGraph:
    """A graph and the exploration it is made of."""

    exploration: Exploration
    graph: StateGraph
    wanted: tuple[str, ...] = ()

    @cached_property
    def first(self) -> Mapping[int, int]:
        """A first state of each node; of a marked node the first that is marked."""
        explored = self.exploration.explored
        rows = zip(*(explored.column(name).tolist() for name in self.graph.variables), strict=True)
        numbers = {node.raw: node.number for node in self.graph.nodes}
        marks = explored.any_of(self.wanted).tolist()
        found: dict[int, int] = {}
        marked: dict[int, int] = {}
        for place, (raw, mark) in enumerate(zip(rows, marks, strict=True)):
            found.setdefault(numbers[raw], place)
            if mark:
                marked.setdefault(numbers[raw], place)
        return found | marked

    def with_ways(self) -> StateGraph:
        """The graph with a way to each node: a shortest run, which the interpreter of the charts replays."""
        ways = {}
        for node in self.graph.nodes:
            self.exploration.progress(f"a run to each of {len(self.graph.nodes)} nodes: {node.number + 1}")
            ways[node.number] = self._way(self.first[node.number])
        return replace(self.graph, ways=ways)

    def _way(self, place: int) -> GraphWay:
        exploration, system = self.exploration, self.exploration.system
        run = exploration.run(place)
        ticks, _ = followed(system, run, self.graph.title)
        of = TracedSystem.of(system)
        part = exploration.task.system
        relevant = {v.name for v in (*part.inputs, *part.frozen, *part.variables, *part.temps)}
        charts = (
            c.name for c in of.statecharts.values() if relevant & {*c.written, *(v.name for v in c.locations)}
        )
        none = TracedProperty(relevant=frozenset(relevant), charts=frozenset(charts))
        trace = Trace(of, {**system.init, **run.frozen}, ticks, none, ends(system, ticks))
        at = exploration.explored.at(place)
        shown = ((n, of.variables[n].domain.show(raw)) for n, raw in at.items() if not of.variables[n].hidden)
        return GraphWay(tuple(shown), trace.focused())


def made(
    system: TransitionSystem,
    onto: Sequence[str],
    limits: Limits = LIMITS,
    progress: Progress = quiet,
    wanted: tuple[str, ...] = (),
    looked_for: str = "",
) -> BuiltGraph:
    """The graph of the system on the variables named ``onto``.

    A state is marked in which one of the variables ``wanted`` is 1; ``looked_for`` says what that means.
    Raises ``ModelError`` for an unknown variable, an input, and a tick that leaves a domain.
    """
    return seen(explore(system, [*onto, *wanted], limits, progress), onto, wanted, looked_for)


def seen(
    exploration: Exploration, onto: Sequence[str], wanted: tuple[str, ...] = (), looked_for: str = ""
) -> BuiltGraph:
    """What was explored, projected on the variables named ``onto``, which it must have."""
    exploration.progress(f"projecting {len(exploration.words):,} states")
    system = exploration.system
    source = system.source
    graph = project(
        f"{system.name} on {', '.join(onto)}",
        exploration.explored,
        onto,
        _Shown(exploration, onto),
        wanted,
    )
    graph = replace(
        graph,
        over=(
            *((f"{system.name} has more runs than the real system",) if source and source.over else ()),
            *_unchecked(exploration),
        ),
        under=(f"{system.name} has fewer runs than the real system",) if source and source.under else (),
        notes=_notes(system, onto, wanted),
        looked_for=looked_for,
    )
    return BuiltGraph(exploration, graph, wanted)


def _unchecked(exploration: Exploration) -> tuple[str, ...]:
    """That runs may end because of what the graph does not depend on."""
    own = {check.name for check in checks_of(exploration.task.system)}
    others = [checked(check) for check, _ in exploration.system.checks if check.name not in own]
    if not others:
        return ()
    return (f"whether {', '.join(others)} may leave the domain, where a run ends, was not looked into",)


def _notes(system: TransitionSystem, onto: Sequence[str], wanted: Sequence[str]) -> tuple[str, ...]:
    """What the counts count, where one may be mistaken about it."""
    if not wanted:
        return ()
    part = {v.name for v in sliced(system, [system.var(name) for name in onto]).variables} | set(onto)
    asked = [system.var(name) for name in wanted]
    more = [v.name for v in sliced(system, asked).variables if v.name not in part]
    also = f" on {', '.join(more[:4])}{' and others' if len(more) > 4 else ''}" if more else ""
    known = wanted[0] if len(wanted) == 1 else "the properties looked for"
    return (f"States count what {known} depends on, too{':' if also else ''}{also}.",)


class _Shown:
    """Shows the inputs of example ticks."""

    def __init__(self, exploration: Exploration, onto: Sequence[str]) -> None:
        self.exploration, self.onto = exploration, onto
        self.inputs = {v.name: v for v in exploration.task.system.inputs}
        self.telling = InputSimplifier(exploration.task.system, exploration.task.cells)

    def __call__(self, source: int, target: int) -> str:
        explored = self.exploration.explored
        after = explored.at(target)
        wanted = [(name, after[name]) for name in self.onto]

        def same(at: Mapping[str, int]) -> bool:
            return all(at[name] == raw for name, raw in wanted)

        told = self.telling.told(explored.at(source), self.exploration.inputs(source, target), same)
        return ", ".join(f"{name} = {self.inputs[name].domain.show(raw)}" for name, raw in told.items())
