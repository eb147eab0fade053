"""Other runs that end alike: each takes another set of transitions than those before.

The charts are made to raise a flag in each of their transitions, the flags are remembered, and the engines
are asked for a run that reaches the goal with another set of flags.  That there is no more such run is proved
like anything else.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from rovercheck.checker.engines import Limits, Progress, quiet
from rovercheck.checker.process.isolate import ChildStopped, Send, messages
from rovercheck.checker.results.trace import Trace, counted_ticks
from rovercheck.checker.results.verdict import Answer, Open, Reached, Run, Unreachable
from rovercheck.checker.system.instrument.goals import CoverGoal, GoalKind, Watched
from rovercheck.checker.system.instrument.watch import watched
from rovercheck.checker.system.lowering_cache import lowered
from rovercheck.checker.verify.decide import EngineCall
from rovercheck.checker.verify.portfolio import Callbacks, Prior
from rovercheck.checker.verify.portfolio.question import light
from rovercheck.checker.verify.result import check_domains
from rovercheck.checker.verify.runs.minimise import minimise_inputs
from rovercheck.checker.verify.runs.replay import followed, replay
from rovercheck.checker.verify.searches import SLACK
from rovercheck.properties.forms import Property
from rovercheck.properties.reduce import Question, reduce
from rovercheck.spec_model.lang.action import Assign
from rovercheck.spec_model.lang.domain import boolean
from rovercheck.spec_model.lang.expr import Expr, Var, all_of, any_of
from rovercheck.spec_model.lang.system import System, TransitionSystem

MOST = 4
"""Transitions that are named to tell two runs apart."""

Taken = frozenset[str]
"""The transitions that a run takes, by id."""


@dataclass(frozen=True)
class OtherRun:
    """A run that reaches the same end; ``differences`` says of each run before it how it differs."""

    trace: Trace
    differences: tuple[str, ...]


@dataclass(frozen=True)
class NoOtherRun:
    """Why there is no further run: ``proved`` that there is none, or not found, for the reason given."""

    proved: bool
    reason: str

    @staticmethod
    def open(left: Open) -> "NoOtherRun":
        """What a search that found none leaves open."""
        none = f"none within {counted_ticks(left.depth)}"
        return NoOtherRun(False, none if left.depth else f"{none}; {left.reason}")


class OtherRuns:
    """Runs that break a property, or reach what it wants reached, from one that is known.

    ``looked`` is the system with flags for all its transitions, where the property already speaks of these.
    """

    def __init__(self, first: Trace, prop: Property, system: System, looked: Watched | None = None) -> None:
        self._plain = reduce(lowered(system), [replace(prop, on=system.name)])
        looked = looked or watched(system, (GoalKind.TRANSITIONS,))
        self.transitions = tuple(
            transition for transition in looked.goals if transition.part in first.property.charts
        )
        question = reduce(lowered(looked.system), [replace(prop, on=system.name)])
        self._question, self._memories = _remembering(question, self.transitions)
        run = _run_of(first, self._plain)
        self._taken = [self._transitions_of(run)]
        self._told = [_transitions_shown(first)]

    def next(self, engine: str, limits: Limits, progress: Progress = quiet) -> OtherRun | NoOtherRun:
        """A further run, or why there is none."""
        question = self._another()
        answer = answered(question.system, question.goals[0].var, engine, limits, progress)
        match answer:
            case Reached(run):
                return self._shown(question, run)
            case Unreachable(because):
                return NoOtherRun(True, because.how)
            case Open() as left:
                return NoOtherRun.open(left)

    def _another(self) -> Question:
        """The question for a run that takes another set of transitions than each before."""
        [goal] = self._question.goals
        other = Var(
            "another run", boolean, 0, "the end is reached with other transitions than before", hidden=True
        )
        differs = (any_of(*(~m if a.id in taken else m for a, m in self._memories)) for taken in self._taken)
        wanted: Expr = all_of(goal.var, *differs)
        system = replace(
            self._question.system,
            variables=(*self._question.system.variables, other),
            step=(*self._question.system.step, Assign(other, wanted)),
        )
        return Question(system, (replace(goal, var=other),))

    def _shown(self, question: Question, run: Run) -> OtherRun:
        """The run on the charts as drawn, replayed there."""
        calm = minimise_inputs(question.system, question.goals[0].var, run)
        taken = self._transitions_of(calm)
        trace = replay(self._plain.system, self._plain.goals[0], calm)
        told = _transitions_shown(trace)
        before = zip(self._taken, self._told, strict=True)
        differences = tuple(_difference(told, own) or self._parts(taken, flags) for flags, own in before)
        self._taken.append(taken)
        self._told.append(told)
        return OtherRun(trace, differences)

    def _transitions_of(self, run: Run) -> Taken:
        """The transitions that a run takes in some tick, by their flags."""
        ticks, _ = followed(self._question.system, run, self._question.goals[0].var.name)
        return frozenset(a.id for a in self.transitions if any(tick.after[a.flag.name] for tick in ticks))

    def _parts(self, taken: Taken, earlier: Taken) -> str:
        """The difference in segments, from junction to junction, where no whole transition makes it."""
        names = {a.id: _named(a) for a in self.transitions}
        return _difference([n for i, n in names.items() if i in taken], [names[i] for i in earlier])


def _transitions_shown(trace: Trace) -> list[str]:
    """The transitions that fired, as a trace shows them, in order of their first time."""
    return list(
        dict.fromkeys(str(a) for t in trace.ticks for a in t.transitions if a.chart in trace.property.charts)
    )


def _difference(taken: Sequence[str], earlier: Sequence[str]) -> str:
    """Which transitions a run takes that another does not, and the other way round; empty if none."""
    more = [transition for transition in taken if transition not in earlier]
    fewer = [transition for transition in earlier if transition not in taken]
    parts = [f"takes {_some(more)}" if more else "", f"does not take {_some(fewer)}" if fewer else ""]
    return "; ".join(part for part in parts if part)


def _some(transitions: Sequence[str]) -> str:
    more = len(transitions) - MOST
    return ", ".join(transitions[:MOST]) + (f" and {more} more" if more > 0 else "")


def _remembering(
    question: Question, transitions: Sequence[CoverGoal]
) -> tuple[Question, list[tuple[CoverGoal, Var]]]:
    """The question with a variable for each transition that tells whether it was taken so far."""
    memories = [(a, Var(f"taken {a.id}", boolean, 0, f"{a.text} so far", hidden=True)) for a in transitions]
    system = replace(
        question.system,
        variables=(*question.system.variables, *(m for _, m in memories)),
        step=(*question.system.step, *(Assign(m, m | a.flag) for a, m in memories)),
    )
    return replace(question, system=system), memories


def _run_of(trace: Trace, question: Question) -> Run:
    frozen = {v.name: trace.before[v.name] for v in question.system.frozen}
    return Run(frozen, tuple(tick.inputs for tick in trace.ticks))


def _named(transition: CoverGoal) -> str:
    return f"{transition.part}: {transition.text}"


# --- in a child -------------------------------------------------------------------------------------


def answered(system: TransitionSystem, goal: Var, engine: str, limits: Limits, progress: Progress) -> Answer:
    """The answer of engines in a process of their own, which can be ended at any moment."""
    try:
        for heard in messages(_search, system, goal, engine, limits, memory=limits.memory + SLACK):
            if isinstance(heard, str):
                progress(heard)
            elif heard is not None:
                found: Answer = heard
                return found
    except ChildStopped as stopped:
        return Open(str(stopped), 0)
    return Open("the search ended without a word on it", 0)


def _search(send: Send, system: TransitionSystem, goal: Var, engine: str, limits: Limits) -> None:
    found = EngineCall(engine, limits, Callbacks(send))(system, [goal], Prior.SHORT)
    check_domains(system, found)
    send(light(found[goal.name][0]))
