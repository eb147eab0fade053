"""The state graphs of a review page: what its systems do, seen through the active states of their charts."""

from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import asdict
from functools import partial

from rovercheck.checker.cache.entries import MEANINGLESS
from rovercheck.checker.commands.shared.output import counted, err
from rovercheck.checker.commands.shared.progress import Watch
from rovercheck.checker.engines import Limits, Progress
from rovercheck.checker.explore.graphs.construction import seen
from rovercheck.checker.explore.graphs.projection import projection
from rovercheck.checker.explore.graphs.reachable_ticks import ReachableTicks
from rovercheck.checker.explore.graphs.search import Exploration, explore
from rovercheck.checker.render.review.graphs import graph_view, kept_view
from rovercheck.checker.render.review.model import StateGraphView
from rovercheck.checker.results.graph import StateGraph, with_trace
from rovercheck.checker.results.trace import Trace
from rovercheck.checker.results.verdict import Violated
from rovercheck.checker.store.parts import UNKEPT, PartStore
from rovercheck.checker.verify.checked import CheckedProperty
from rovercheck.checker.verify.runs.known_runs import run_in
from rovercheck.properties.forms import Property, Reachable, Unbounded
from rovercheck.properties.reduce import reduce
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.lower import lower
from rovercheck.spec_model.lang.system import System

LIMITS = Limits(seconds=60.0, memory=128 << 20)
"""Memory is counted, so that the page is the same everywhere; time ends what nobody would wait for."""
CHARTS = 4
"""Charts whose states can be read side by side."""
NODES, LINES = 24, 30
"""Nodes, and lines between them, that are taken in at a glance."""

LEFT_OUT = "left out by --at-once"
Undrawn = tuple[str, str]
"""A system without a graph, and why."""


def state_graphs(
    found: Sequence[CheckedProperty],
    systems: Sequence[System],
    options: str,
    kept: PartStore = UNKEPT,
    kept_only: bool = False,
) -> tuple[tuple[StateGraphView, ...], tuple[Undrawn, ...]]:
    """A graph of each system with few charts and of its own findings, else one for all of the same charts.

    Systems with the real runs come before those with more or fewer, and marked graphs before others.  Also
    why some charts have no graph; ``options`` is what a command needs besides.  One that is ``kept`` is not
    made again, and with ``kept_only`` no other is made.
    """
    wanted = sorted((s for s in systems if s.charts), key=lambda s: s.over or s.under)
    graphs: dict[str, StateGraphView] = {}
    undrawn: dict[str, str] = {}
    drawn: set[frozenset[str]] = set()
    with Watch(err, len(wanted), of="graphs") as watch:
        for system in wanted:
            asked = [c.result.property for c in found if _marked(c, system)]
            if asked or _charts(system) not in drawn:
                say = None if kept_only else partial(watch.say, system.name)
                one = _kept_graph(system, asked, found, options, kept, say)
                if isinstance(one, StateGraphView):
                    graphs[system.name] = one
                    drawn.add(_charts(system))
                else:
                    undrawn[system.name] = one
            watch.finished(system.name)
    shown = sorted((graphs[s.name] for s in systems if s.name in graphs), key=lambda g: not g.asked)
    left = ((s.name, undrawn[s.name]) for s in systems if s.name in undrawn and _charts(s) not in drawn)
    return tuple(shown), tuple(left)


def _charts(system: System) -> frozenset[str]:
    return frozenset(c.name for c in system.charts)


def _kept_graph(
    system: System,
    asked: Sequence[Property],
    found: Sequence[CheckedProperty],
    options: str,
    kept: PartStore,
    progress: Progress | None,
) -> StateGraphView | str:
    """The graph, or why there is none: as it is kept, or made and kept unless time has ended it.

    Without ``progress`` none is made.
    """
    runs = [(c.result.property, c.result.system, run_in(run)) for c, run in _broken(found, system)]
    name = kept.name("graph", system, [*asked], runs, LIMITS, options)
    before = kept.read(name)
    if isinstance(before, str):
        return before
    if before is not None:
        with suppress(*MEANINGLESS):
            return kept_view(before)
    if progress is None:
        return LEFT_OUT
    late, one = _state_graph(system, asked, found, options, progress)
    if not late:
        kept.write(name, one if isinstance(one, str) else asdict(one))
    return one


def _state_graph(
    system: System,
    asked: Sequence[Property],
    found: Sequence[CheckedProperty],
    options: str,
    progress: Progress,
) -> tuple[bool, StateGraphView | str]:
    """The graph, or why there is none; first whether the limit of time has something to do with it."""
    if len(system.charts) > CHARTS:
        return False, f"{len(system.charts)} charts"
    try:
        late, exploration, wanted = _explored(system, asked, progress)
    except ModelError as problem:
        return False, str(problem)
    if stopped := exploration.explored.stopped:
        many = f"more than {counted(len(exploration.explored), 'state', 'states')}"
        return late, many if "memory" in stopped else stopped
    onto = _onto(system, exploration.explored)
    if onto is None:
        return late, "no combination of its charts with few nodes, and more than one"
    ids = tuple(p.id for p in asked)
    marked, unmarked = (ids, ()) if wanted else ((), ids)
    says = f"{', '.join(marked)} {'is' if len(marked) == 1 else 'are'} broken" if marked else ""
    graph = seen(exploration, onto, wanted, says).with_ways()
    runs = dict(_paths(graph, found, system))
    again = f"rovercheck graph {system.name}{options}"
    return late, graph_view(system.name, graph, runs, marked, again, unmarked)


def _marked(compared: CheckedProperty, system: System) -> bool:
    """Whether it is broken by single states of the system."""
    prop, word = compared.result.property, compared.verdict.word
    return prop.on == system.name and word == "violated" and not isinstance(prop.form, Reachable | Unbounded)


def _explored(
    system: System, asked: Sequence[Property], progress: Progress
) -> tuple[bool, Exploration, tuple[str, ...]]:
    """With the monitors of the properties, and the variables that mark; without where that is too much.

    First whether time was too short for something.
    """
    lowered = lower(system)
    places = _places(system)
    late = False
    if asked:
        question = reduce(lowered, asked)
        goals = tuple(goal.var.name for goal in question.goals)
        exploration = explore(question.system, [*places, *goals], LIMITS, progress)
        if not exploration.explored.stopped:
            return False, exploration, goals
        late = "memory" not in exploration.explored.stopped
    exploration = explore(lowered, places, LIMITS, progress)
    stopped = exploration.explored.stopped
    return late or bool(stopped and "memory" not in stopped), exploration, ()


def _places(system: System) -> list[str]:
    """The locations of its charts that are variables of the system."""
    return [v.name for c in system.charts for v in c.locations]


def _onto(system: System, explored: ReachableTicks) -> tuple[str, ...] | None:
    """As many locations as give a picture with few nodes and lines, without those that tell no more.

    All of them if that is possible, else the outermost of all charts, those of the last chart, which executes
    when the others have, and of one more, those of one chart.
    """
    moving = [n for n in _places(system) if len(set(explored.column(n).tolist())) > 1]
    own = [tuple(v.name for v in c.locations if v.name in moving) for c in system.charts]
    outermost = tuple(names[0] for names in own if names)
    pairs = [(name, outermost[-1]) for name in outermost[:-1]]
    for group in ([tuple(moving)], [outermost], pairs, own, [(name,) for name in moving]):
        fitting = [names for names in group if names and _fits(explored, names)]
        if fitting:
            return _without_idle(explored, max(fitting, key=partial(_nodes, explored)))
    return None


def _fits(explored: ReachableTicks, names: Sequence[str]) -> bool:
    found = projection(explored, [explored.column(name) for name in names])
    lines = int((found.ends[0] != found.ends[1]).sum())
    return 1 < len(found.first) <= NODES and lines <= LINES


def _nodes(explored: ReachableTicks, names: Sequence[str]) -> int:
    return len(projection(explored, [explored.column(name) for name in names]).first)


def _without_idle(explored: ReachableTicks, names: tuple[str, ...]) -> tuple[str, ...]:
    """The names without those whose values follow from the others."""
    count = _nodes(explored, names)
    for name in reversed(names):
        rest = tuple(n for n in names if n != name)
        if rest and _nodes(explored, rest) == count:
            names = rest
    return names


def _paths(
    graph: StateGraph, found: Sequence[CheckedProperty], system: System
) -> Iterator[tuple[str, tuple[int, ...]]]:
    """The counterexamples about the system that can be followed in the graph.

    One of a system with real runs may lack a variable.
    """
    for compared, trace in _broken(found, system):
        with suppress(ModelError):
            yield compared.result.property.id, with_trace(graph, trace).path


def _broken(found: Sequence[CheckedProperty], system: System) -> Iterator[tuple[CheckedProperty, Trace]]:
    """The findings about the system with their runs."""
    for compared in found:
        verdict, result = compared.verdict, compared.result
        about = system.name in (result.system, result.property.on)
        if about and isinstance(verdict, Violated) and isinstance(verdict.because, Trace):
            yield compared, verdict.because
