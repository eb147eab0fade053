"""From properties to verdicts: properties that share a system and its monitors are searched together."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from math import prod

from checker.engine import Engine, Limits, Progress, Timers
from checker.freely import freely
from checker.liveness.verdicts import unbounded
from checker.lowered import lowered
from checker.portfolio import ALL, AUTO, Disagreement, Hint, Told, answers, as_found
from checker.portfolio import Question as Asked
from checker.result import Answers, Result, check_domains, result
from checker.runs.reproduce import not_reproducible, reproduced
from checker.starting import check_starts
from checker.verdict import Reached
from properties.forms import Property, Unbounded
from properties.reduce import Question, reduce
from spec_model.lang.errors import ModelError, did_you_mean
from spec_model.lang.expr import Var
from spec_model.lang.system import System, TransitionSystem

FEW = 64
"""Monitors with at most this many combinations of values share a search: compiling costs more."""
MOST = 16
"""Properties in one search: what is compiled grows faster than their number."""


@dataclass(frozen=True)
class Task:
    """Properties of one system that are searched together."""

    system: System
    properties: tuple[Property, ...]

    @property
    def title(self) -> str:
        """``relay PB1-11 and 4 more``."""
        more = f" and {len(self.properties) - 1} more" if len(self.properties) > 1 else ""
        return f"{self.system.name} {self.properties[0].id}{more}"

    @property
    def size(self) -> int:
        """The bits of all that the charts and blocks of the system write: what costs most, roughly, first."""
        return sum((len(v.domain) - 1).bit_length() for v in _names_of(self.system).variables)


def tasks(properties: Sequence[Property], systems: Mapping[str, System]) -> Iterator[Task]:
    """Properties grouped by system, and within a system by the size of the monitors they need.

    Raises ``ModelError`` for a property about an unknown system, or an ill-formed one.
    """
    by_system: dict[str, list[Property]] = {}
    for prop in properties:
        if prop.on not in systems:
            near = did_you_mean(prop.on, systems)
            raise ModelError(f"{prop.id} is about {prop.on!r}, no known system. {near}")
        by_system.setdefault(prop.on, []).append(prop)
    for name, group in by_system.items():
        yield from (Task(systems[name], (p,)) for p in group if isinstance(p.form, Unbounded))
        bounded = [p for p in group if not isinstance(p.form, Unbounded)]
        for together in _together(reduce(_names_of(systems[name]), bounded)):
            yield Task(systems[name], tuple(together))


def _names_of(system: System) -> TransitionSystem:
    """What properties may speak of, without the step: enough to see which memories they need."""
    places = [v for c in system.charts for v in (*c.locations, c.entered)]
    own = [v for v in system.written.values() if v.name not in {f.name for f in system.frozen}]
    inputs = tuple(system.inputs.values())
    return TransitionSystem(
        system.name, inputs, system.frozen, (*places, *own), (), (), tick_ms=system.tick_ms
    )


def _together(question: Question) -> list[list[Property]]:
    """Properties to search together: not too many, whose monitors have few values between them."""
    values = {v.name: len(v.domain) for v in question.system.variables}
    bins: list[tuple[set[str], list[Property]]] = []
    for goal in sorted(question.goals, key=lambda g: prod(values[n] for n in g.memory)):
        for memory, members in bins:
            fits = goal.memory <= memory or prod(values[n] for n in memory | goal.memory) <= FEW
            if fits and len(members) < MOST:
                memory |= goal.memory
                members.append(goal.property)
                break
        else:
            bins.append((set(goal.memory), [goal.property]))
    return [members for _, members in bins]


def decide(
    task: Task,
    systems: Mapping[str, System],
    engine: str | Engine,
    limits: Limits,
    progress: Progress,
    told: Told | None = None,
) -> Iterator[Result]:
    """A verdict for each property of the task, each as soon as it is known.

    ``engine`` is one, or the name of one, ``auto`` (engines in turn, see ``checker.portfolio.order``) or
    ``all`` (every engine, answers compared).  With free timers in ``limits``, what the system with timers
    that run out at will does not settle is then searched exactly.  Raises ``Disagreement``,
    ``ReplayError``, and ``ModelError`` when the model itself leaves a domain or has no run at all.
    """
    check_starts(lowered(task.system))
    exact = Timers.EXACT if limits.timers is Timers.FREE else limits.timers
    asking = Asking(engine, replace(limits, timers=exact), told or Told(progress))
    for prop in task.properties:
        if isinstance(prop.form, Unbounded):
            yield unbounded(prop, systems, asking, progress)
    left: Sequence[Property] = [p for p in task.properties if not isinstance(p.form, Unbounded)]
    if left and limits.timers is Timers.FREE:
        done, left = freely(task.system, left, asking)
        yield from done
    if left:
        yield from _exactly(Task(task.system, tuple(left)), systems, asking)


@dataclass(frozen=True)
class Asking:
    """Asks what the user chose: an engine, within limits, telling those who listen."""

    engine: str | Engine
    limits: Limits
    told: Told

    def __call__(self, system: TransitionSystem, goals: Sequence[Var], hint: Hint = Hint.NONE) -> Answers:
        """An answer for each goal and for each check of the system."""
        engine = AUTO if hint is Hint.CONCRETE and self.engine != ALL else self.engine
        return answers(Asked(system, tuple(goals), hint), engine, self.limits, self.told)

    def as_found(self, system: TransitionSystem, goals: Sequence[Var]) -> Iterator[Answers]:
        """The same, each as soon as it is known."""
        return as_found(Asked(system, tuple(goals)), self.engine, self.limits, self.told)


def _exactly(task: Task, systems: Mapping[str, System], asking: Asking) -> Iterator[Result]:
    question = reduce(lowered(task.system), task.properties)
    by_goal = {g.var.name: g for g in question.goals}
    runs: dict[str, tuple[Reached, str]] = {}
    for found in asking.as_found(question.system, [g.var for g in question.goals]):
        check_domains(question.system, found)
        for name, (answer, by) in found.items():
            if isinstance(answer, Reached) and task.system.over:
                runs |= {name: (answer, by)} if name in by_goal else {}
            elif name in by_goal:
                yield result(question.system, by_goal[name], answer, by)
    if runs and task.system.concrete:
        yield from reproduced(question, runs, systems[task.system.concrete], asking)
    elif runs:
        yield from not_reproducible(question, runs)


__all__ = ["ALL", "AUTO", "Disagreement", "Task", "decide", "tasks"]
