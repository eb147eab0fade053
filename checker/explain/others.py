"""Other runs that end alike: each takes another set of arrows than those before.

The charts are made to raise a flag in each of their arrows, the flags are remembered, and the engines are
asked for a run that reaches the goal with another set of flags.  That there is no more such run is proved
like anything else.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from checker.conform.cover.goals import Goal as Arrow
from checker.conform.cover.goals import Kind, Watched
from checker.conform.cover.watch import watched
from checker.decide import Asking
from checker.engine import Limits, Progress, quiet
from checker.isolate import Send, Stopped, messages
from checker.lowered import lowered
from checker.portfolio import Hint, Told
from checker.portfolio.question import light
from checker.result import check_domains
from checker.runs.calm import calmed
from checker.runs.replay import followed, replay
from checker.searches import SLACK
from checker.trace import Trace
from checker.verdict import Answer, Open, Reached, Run, Unreachable
from properties.forms import Property
from properties.reduce import Question, reduce
from spec_model.lang.action import Assign
from spec_model.lang.domain import boolean
from spec_model.lang.expr import Expr, Var, all_of, any_of
from spec_model.lang.system import System, TransitionSystem

Taken = frozenset[str]
"""The arrows that a run takes, by id."""


@dataclass(frozen=True)
class Other:
    """A run that reaches the same end; ``differences`` says of each run before it how it differs."""

    trace: Trace
    differences: tuple[str, ...]


@dataclass(frozen=True)
class NoMore:
    """Why there is no further run: ``proved`` that there is none, or not found, for the reason given."""

    proved: bool
    reason: str


class Others:
    """Runs that break a property, or reach what it wants reached, from one that is known.

    ``looked`` is the system with flags for all its arrows, where the property already speaks of these.
    """

    def __init__(self, first: Trace, prop: Property, system: System, looked: Watched | None = None) -> None:
        self._plain = reduce(lowered(system), [replace(prop, on=system.name)])
        looked = looked or watched(system, (Kind.ARROWS,))
        self.arrows = tuple(arrow for arrow in looked.goals if arrow.part in first.charts)
        question = reduce(lowered(looked.system), [replace(prop, on=system.name)])
        self._question, self._memories = _remembering(question, self.arrows)
        run = _run_of(first, self._plain)
        self._runs = [run]
        self._taken = [self._arrows_of(run)]

    def next(self, engine: str, limits: Limits, progress: Progress = quiet) -> Other | NoMore:
        """A further run, or why there is none."""
        question = self._another()
        answer = _answer(question.system, question.goals[0].var, engine, limits, progress)
        match answer:
            case Reached(run):
                return self._shown(question, run)
            case Unreachable(because):
                return NoMore(True, because.how)
            case Open(reason, depth):
                return NoMore(
                    False,
                    f"none within {depth} ticks; {reason}" if not depth else f"none within {depth} ticks",
                )

    def _another(self) -> Question:
        """The question for a run that takes another set of arrows than each before."""
        [goal] = self._question.goals
        other = Var(
            "another run", boolean, 0, "the end is reached with other arrows than before", hidden=True
        )
        differs = (any_of(*(~m if a.id in taken else m for a, m in self._memories)) for taken in self._taken)
        wanted: Expr = all_of(goal.var, *differs)
        system = replace(
            self._question.system,
            variables=(*self._question.system.variables, other),
            step=(*self._question.system.step, Assign(other, wanted)),
        )
        return Question(system, (replace(goal, var=other),))

    def _shown(self, question: Question, run: Run) -> Other:
        """The run on the charts as drawn, replayed there."""
        calm = calmed(question.system, question.goals[0].var, run)
        taken = self._arrows_of(calm)
        differences = tuple(self._difference(taken, earlier) for earlier in self._taken)
        self._taken.append(taken)
        trace = replay(self._plain.system, self._plain.goals[0], calm)
        return Other(trace, differences)

    def _arrows_of(self, run: Run) -> Taken:
        """The arrows that a run takes in some tick, by their flags."""
        ticks, _ = followed(self._question.system, run, self._question.goals[0].var.name)
        return frozenset(a.id for a in self.arrows if any(tick.after[a.flag.name] for tick in ticks))

    def _difference(self, taken: Taken, earlier: Taken) -> str:
        more = [_named(a) for a in self.arrows if a.id in taken - earlier]
        fewer = [_named(a) for a in self.arrows if a.id in earlier - taken]
        parts = [
            f"takes {', '.join(more)}" if more else "",
            f"does not take {', '.join(fewer)}" if fewer else "",
        ]
        return "; ".join(part for part in parts if part)


def _remembering(question: Question, arrows: Sequence[Arrow]) -> tuple[Question, list[tuple[Arrow, Var]]]:
    """The question with a variable for each arrow that tells whether it was taken so far."""
    memories = [(a, Var(f"taken {a.id}", boolean, 0, f"{a.text} so far", hidden=True)) for a in arrows]
    system = replace(
        question.system,
        variables=(*question.system.variables, *(m for _, m in memories)),
        step=(*question.system.step, *(Assign(m, m | a.flag) for a, m in memories)),
    )
    return replace(question, system=system), memories


def _run_of(trace: Trace, question: Question) -> Run:
    frozen = {v.name: trace.before[v.name] for v in question.system.frozen}
    return Run(frozen, tuple(tick.inputs for tick in trace.ticks))


def _named(arrow: Arrow) -> str:
    return f"{arrow.part}: {arrow.text}"


# --- in a child -------------------------------------------------------------------------------------


def _answer(system: TransitionSystem, goal: Var, engine: str, limits: Limits, progress: Progress) -> Answer:
    """The answer of engines in a process of their own, which can be ended at any moment."""
    try:
        for heard in messages(_search, system, goal, engine, limits, memory=limits.memory + SLACK):
            if isinstance(heard, str):
                progress(heard)
            elif heard is not None:
                found: Answer = heard
                return found
    except Stopped as stopped:
        return Open(str(stopped), 0)
    return Open("the search ended without a word on it", 0)


def _search(send: Send, system: TransitionSystem, goal: Var, engine: str, limits: Limits) -> None:
    found = Asking(engine, limits, Told(send))(system, [goal], Hint.SHORT)
    check_domains(system, found)
    send(light(found[goal.name][0]))
