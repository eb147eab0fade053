"""What a trace is asked for: a property, a state of a chart to be reached, or a transition to be taken."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from shlex import quote
from typing import TYPE_CHECKING

from rovercheck.checker.commands.shared.codes import UsageError
from rovercheck.checker.commands.shared.select import pick
from rovercheck.checker.model.variant import Variant
from rovercheck.checker.results.trace import Trace
from rovercheck.checker.results.verdict import Run
from rovercheck.checker.system.lowering_cache import lowered
from rovercheck.checker.verify.runs.replay import followed
from rovercheck.checker.verify.tasks import Task
from rovercheck.properties.expected import Expected
from rovercheck.properties.forms import Property, reachable
from rovercheck.spec_model.lang.chart import Chart
from rovercheck.spec_model.lang.errors import did_you_mean
from rovercheck.spec_model.lang.system import System

if TYPE_CHECKING:  # with all that tests cover
    from rovercheck.checker.system.instrument.goals import CoverGoal, Watched
    from rovercheck.spec_model.abstraction import Board

COVERS = ("an example was trace_request for",)


@dataclass(frozen=True)
class TraceRequest:
    """A property, the systems that it is decided on, and the expected verdicts.

    An ``example`` is no property that somebody stated, but something of which a user wants to see a run.
    ``plain`` is the system as drawn, where charts had to be changed so that the property could be stated,
    and ``watched`` that change.  ``again`` is the command that asks for it.
    """

    property: Property
    systems: Mapping[str, System]
    expected: Callable[[str], Expected]
    example: bool = False
    plain: System | None = None
    watched: "Watched | None" = None
    again: str = ""
    boards: "Callable[[], Mapping[str, Board]] | None" = None
    """The boards of the charts, where these are changed."""

    def drawn(self, trace: Trace) -> Trace:
        """A trace of the property on the charts as drawn, with the command that shows it."""
        trace = replace(trace, again=self.again)
        if self.plain is None:
            return trace
        system = lowered(self.plain)
        frozen = {v.name: trace.before[v.name] for v in system.frozen}
        run = Run(frozen, tuple(tick.inputs for tick in trace.ticks))
        ticks, _ = followed(system, run, self.property.id)
        before = {**system.init, **frozen}
        of = replace(trace.system, statecharts=_charts(self.plain), components=self.plain.components)
        return replace(trace, system=of, before=before, ticks=ticks)


def trace_request(
    variant: Variant, id: str | None, state: str | None, transition: str | None, system: str | None
) -> TraceRequest:
    """What a user asks for, who must name one thing.  Raises ``UsageError`` and ``ModelError``."""
    named = [thing for thing in (id, state, transition) if thing is not None]
    if len(named) != 1:
        raise UsageError(
            "Name one thing: the ID of a property, --state CHART.STATE or --transition 'CHART: A -> B'."
        )
    systems = variant.systems()
    again = _again(variant, id, state, transition, system)
    of_run = boards_changed(variant)
    if id is not None:
        if system is not None:
            raise UsageError(
                f"--system goes with --state and --transition; {id} names its own system. Leave it out."
            )
        prop = variant.asked(pick("property", id, variant.properties()))
        return TraceRequest(prop, systems, variant.model.expected, again=again, boards=of_run)
    wanted = (
        of_state(named[0], systems, system)
        if transition is None
        else of_transition(transition, systems, system)
    )
    return replace(wanted, again=again, boards=of_run)


def _again(
    variant: Variant, id: str | None, state: str | None, transition: str | None, system: str | None
) -> str:
    """The command that asks for the same."""
    given = [("--state", state), ("--transition", transition), ("--system", system)]
    options = [f"{option} {quote(value)}" for option, value in given if value is not None]
    return " ".join(filter(None, ["rovercheck trace", id, *options, variant.options]))


def _unrecorded(_: str) -> Expected:
    return Expected()


def of_state(wanted: str, systems: Mapping[str, System], system: str | None) -> TraceRequest:
    """That a state, written ``CHART.STATE``, can be active.  Raises ``UsageError`` and ``ModelError``."""
    name, dot, state = wanted.partition(".")
    if not (dot and state):
        raise UsageError(f"{wanted!r} names no state; write CHART.STATE, such as Relay.B2_actuating.")
    on = _system(name, systems, system)
    chart = _charts(on)[name]
    path = chart.path(state)
    id = f"state {'.'.join((name, *path))}"
    found = reachable(
        id, f"The {id} can be reached.", that=chart.active_path(path), covers=COVERS, on=on.name
    )
    return TraceRequest(_unwritten(found), systems, _unrecorded, example=True)


def boards_changed(variant: Variant) -> "Callable[[], Mapping[str, Board]] | None":
    """What makes the rover's boards of a variant, where it changes their charts."""

    def made() -> "Mapping[str, Board]":
        from rovercheck.checker.compare.variants import boards_of

        return boards_of(variant)

    return made if variant.name and variant.own is None else None


def of_transition(wanted: str, systems: Mapping[str, System], system: str | None) -> TraceRequest:
    """That a transition, written ``CHART: A -> B``, can be taken.  Raises ``UsageError``."""
    name, colon, transition = (part.strip() for part in wanted.partition(":"))
    if not (colon and transition):
        raise UsageError(f"{wanted!r} names no transition; write 'CHART: A -> B', as traces show it.")
    on = _system(name, systems, system)
    from rovercheck.checker.system.instrument.goals import GoalKind
    from rovercheck.checker.system.instrument.watch import watched

    looked = watched(on, (GoalKind.TRANSITIONS,))
    goal = _transition(name, _plainly(transition), looked.goals)
    id = f"transition {name}: {goal.text}"
    found = reachable(id, f"The {id} can be taken.", that=goal.flag, covers=COVERS, on=on.name)
    there = {**systems, on.name: looked.system}
    return TraceRequest(_unwritten(found), there, _unrecorded, example=True, plain=on, watched=looked)


def _unwritten(made: Property) -> Property:
    """A property that nobody wrote: no line of a file leads to it."""
    return replace(made, place=None)


def _transition(chart: str, wanted: str, goals: Sequence["CoverGoal"]) -> "CoverGoal":
    """The transition that is meant: by its ends, and its number where several have the same."""
    own = {g.text: g for g in goals if g.part == chart}
    found = [
        g for text, g in own.items() if text == wanted or text.startswith((f"{wanted} (", f"{wanted} ["))
    ]
    if len(found) == 1:
        return found[0]
    if found:
        options = "; ".join(f"'{chart}: {g.text.partition(' [')[0]}'" for g in found)
        raise UsageError(f"{chart} has {len(found)} transitions {wanted!r}; write one of {options}.")
    ends = [text.partition(" (")[0] for text in own]
    raise UsageError(f"{chart} has no transition {wanted!r}. {did_you_mean(wanted, ends)}")


def _plainly(transition: str) -> str:
    """With ``->``, single blanks and today's word for its number: older traces show ``(arrow 2)``."""
    return " ".join(transition.replace("→", "->").replace("(arrow ", "(transition ").split())


def _system(chart: str, systems: Mapping[str, System], wanted: str | None) -> System:
    """The system asked for, or the smallest one with the chart that has neither more nor fewer runs."""
    known = {name: None for system in systems.values() for name in _charts(system)}
    pick("chart", chart, known)
    having = {name: system for name, system in systems.items() if chart in _charts(system)}
    if wanted is not None:
        pick("system", wanted, systems)
        if wanted not in having:
            raise UsageError(f"{wanted} does not execute {chart}; these do: {', '.join(sorted(having))}.")
        return having[wanted]
    return min(having.values(), key=lambda s: (s.over or s.under, s.over, Task(s, ()).size, s.name))


def _charts(system: System) -> dict[str, Chart]:
    return {chart.name: chart for chart in system.charts}
