"""From properties to verdicts: what the engines answer to the questions of a task."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from time import monotonic

from rovercheck.checker.engines import ALL, AUTO, Engine, Limits, Stage, Timers
from rovercheck.checker.process.faults import Failed, attempted
from rovercheck.checker.results.verdict import Open, Reached, Unknown, Unreachable
from rovercheck.checker.system.formula_json import Tree, readable
from rovercheck.checker.system.initial import require_initial_tick
from rovercheck.checker.system.lowering_cache import lowered
from rovercheck.checker.verify.liveness.verdicts import unbounded
from rovercheck.checker.verify.portfolio import (
    Callbacks,
    Disagreement,
    PortfolioQuestion,
    Prior,
    answers,
    as_found,
)
from rovercheck.checker.verify.portfolio.question import EngineAnswer, Found
from rovercheck.checker.verify.portfolio.shape import shape
from rovercheck.checker.verify.result import Result, check_domains, result
from rovercheck.checker.verify.runs.replay import ReplayError
from rovercheck.checker.verify.runs.reproduce import moved, not_reproducible, reproduced
from rovercheck.checker.verify.tasks import Task, tasks
from rovercheck.properties.forms import Property, Unbounded
from rovercheck.properties.reduce import reduce
from rovercheck.spec_model.lang.expiry import free_timers
from rovercheck.spec_model.lang.expr import Expr, Var
from rovercheck.spec_model.lang.system import System, TransitionSystem

# --- properties decided where timers may expire at any time, as far as that goes (docs/timers.md)

Query = Callable[[TransitionSystem, Sequence[Var]], Found]
"""An answer for each goal, and for each check of the system."""


def decide_with_free_timers(
    system: System, properties: Sequence[Property], query: Query
) -> tuple[list[Result], list[Property]]:
    """Results that hold for ``system``, and the properties that are left for an exact search.

    What is unreachable with free timers is unreachable.  A run with free timers counts if the system
    itself reaches the goal with the same inputs; as no run of it is shorter, that one is a shortest.
    """
    loose = free_timers(system)
    if loose is system:
        return [], list(properties)
    here = reduce(lowered(system), properties)
    if shape(PortfolioQuestion(here.system, tuple(g.var for g in here.goals))).kind == "driven":
        return [], list(properties)  # free timers would be most of what is free
    there = reduce(lowered(loose), [replace(p, on=loose.name) for p in properties])
    found = query(there.system, [g.var for g in there.goals])
    if not all(isinstance(found[check.name][0], Unreachable) for check, _ in there.system.checks):
        return [], list(properties)  # a value may leave its domain only because a timer ends early
    done: list[Result] = []
    left: list[Property] = []
    for goal, same in zip(there.goals, here.goals, strict=True):
        answer, by = found[goal.var.name]
        run = None
        if isinstance(answer, Reached) and not system.over:
            run = moved(there, goal, answer, here, same)
        if isinstance(answer, Unreachable):
            done.append(replace(result(there.system, goal, answer, by), property=same.property))
        elif run is not None:
            done.append(result(here.system, same, run, by))
        else:
            left.append(same.property)
    return done, left


SILENT = Callbacks()
"""Nobody is told anything."""


def decide(
    task: Task,
    systems: Mapping[str, System],
    engine: str | Engine,
    limits: Limits,
    callbacks: Callbacks = SILENT,
    deadline: float | None = None,
) -> Iterator[Result]:
    """A verdict for each property of the task, each as soon as it is known.

    ``engine`` is one, or the name of one, ``auto`` (engines in turn, see ``checker.verify.portfolio.order``)
    or ``all`` (every engine, answers compared).  With free timers in ``limits``, what the system whose timers
    may expire at any time leaves open is then searched exactly.  The time of ``limits`` is for all of it,
    lowering included, from now on or until the ``deadline``; ``searches`` ends what looks at no clock.
    Raises ``Disagreement``, ``ReplayError``, and ``ModelError`` when the model leaves a domain or has no run
    at all.
    """
    deadline = limits.deadline() if deadline is None else deadline
    callbacks.progress(Stage(f"lowering {task.system.name}"))
    require_initial_tick(lowered(task.system))
    query = EngineCall(engine, limits, callbacks, deadline, task.recorded)
    for prop in task.properties:
        if isinstance(prop.form, Unbounded):
            yield _unbounded(prop, systems, query)
    left: Sequence[Property] = [p for p in task.properties if not isinstance(p.form, Unbounded)]
    if left and limits.timers is Timers.FREE:
        done, left = decide_with_free_timers(task.system, left, query)
        yield from done
    if left:
        yield from _exactly(Task(task.system, tuple(left), task.recorded), systems, query)


@dataclass(frozen=True)
class EngineCall:
    """Runs what the user chose: an engine, within limits until the deadline, with callbacks.

    Engines in turn try what is ``recorded`` first, as far as the system still has its variables.
    """

    engine: str | Engine
    limits: Limits
    callbacks: Callbacks
    deadline: float | None = None
    recorded: Sequence[Tree] | None = None

    def __call__(self, system: TransitionSystem, goals: Sequence[Var], prior: Prior = Prior.NONE) -> Found:
        """An answer for each goal and for each check of the system."""
        engine = AUTO if prior is Prior.CONCRETE and self.engine != ALL else self.engine
        question = PortfolioQuestion(system, tuple(goals), prior, self._candidates(system))
        return self._late(question) or answers(question, engine, self._left(system), self.callbacks)

    def as_found(self, system: TransitionSystem, goals: Sequence[Var]) -> Iterator[Found]:
        """The same, each as soon as it is known."""
        question = PortfolioQuestion(system, tuple(goals), candidates=self._candidates(system))
        if late := self._late(question):
            yield late
        else:
            yield from as_found(question, self.engine, self._left(system), self.callbacks)

    def _candidates(self, system: TransitionSystem) -> tuple[Expr, ...] | None:
        if self.recorded is None:
            return None
        known = {v.name: v for v in (*system.frozen, *system.variables)}
        return tuple(readable(self.recorded, known))

    def _left(self, system: TransitionSystem) -> Limits:
        self.callbacks.progress(Stage(f"slicing {system.name}"))
        return self.limits.until(self.deadline)

    def _late(self, question: PortfolioQuestion) -> Found:
        """What is answered when the time is over before a question is asked; nothing before that."""
        if self.deadline is None or monotonic() < self.deadline:
            return {}
        reason = f"time: {self.limits.seconds:g} s ended before an engine was asked"
        return {goal.name: EngineAnswer(Open(reason, 0), "none") for goal in question.goals}


def _unbounded(prop: Property, systems: Mapping[str, System], query: EngineCall) -> Result:
    """The result of one property about infinite runs; unknown where an internal error ends its search."""

    def work() -> Result:
        return unbounded(prop, systems, query, query.callbacks.progress)

    found = attempted(f"the search about {prop.id}", prop.on, work, Disagreement, ReplayError)
    if isinstance(found, Failed):
        return Result(prop, Unknown(found.reason, 0, "none"), prop.on)
    return found


def _exactly(task: Task, systems: Mapping[str, System], query: EngineCall) -> Iterator[Result]:
    question = reduce(lowered(task.system), task.properties)
    by_goal = {g.var.name: g for g in question.goals}
    runs: dict[str, tuple[Reached, str]] = {}
    for found in query.as_found(question.system, [g.var for g in question.goals]):
        check_domains(question.system, found)
        for name, (answer, by) in found.items():
            if isinstance(answer, Reached) and task.system.over:
                runs |= {name: (answer, by)} if name in by_goal else {}
            elif name in by_goal:
                yield result(question.system, by_goal[name], answer, by)
    if runs and task.system.concrete:
        yield from reproduced(question, runs, systems[task.system.concrete], query)
    elif runs:
        yield from not_reproducible(question, runs)


__all__ = ["Disagreement", "Task", "decide", "tasks"]
