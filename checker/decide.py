"""From properties to verdicts: properties that share a system and its monitors are searched together."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from math import prod

from checker.engine import Engine, Limits, Progress, Timers, engines
from checker.freely import freely
from checker.liveness import unbounded
from checker.reproduce import not_reproducible, reproduced
from checker.result import Answers, Result, check_domains, result
from checker.slice import sliced
from checker.verdict import Answer, Open, Reached, Unreachable
from properties.forms import Property, Unbounded
from properties.reduce import Question, reduce
from spec_model.lang.errors import ModelError, did_you_mean
from spec_model.lang.expr import Var
from spec_model.lang.lower import lower
from spec_model.lang.system import System, TransitionSystem

FEW = 64
"""Monitors with at most this many combinations of values share a search: compiling costs more."""

SHORT = 12
"""Ticks in which ``auto`` looks for a loop before it enumerates pairs of valuations."""
LITTLE = 64 << 20
"""Bytes that it grants to that enumeration."""
WIDE = 160
"""Bits of a valuation, of what the goals depend on, above which it unrolls and does not enumerate."""

AUTO = "auto"
ALL = "all"


class Disagreement(Exception):
    """Two engines gave answers that cannot both be true: a bug of ours."""


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
        for together in _together(reduce(lower(systems[name]), bounded)):
            yield Task(systems[name], tuple(together))


def _together(question: Question) -> list[list[Property]]:
    """Properties to search together: those whose monitors have few values between them."""
    values = {v.name: len(v.domain) for v in question.system.variables}
    bins: list[tuple[set[str], list[Property]]] = []
    for goal in sorted(question.goals, key=lambda g: prod(values[n] for n in g.memory)):
        for memory, members in bins:
            if goal.memory <= memory or prod(values[n] for n in memory | goal.memory) <= FEW:
                memory |= goal.memory
                members.append(goal.property)
                break
        else:
            bins.append((set(goal.memory), [goal.property]))
    return [members for _, members in bins]


def decide(
    task: Task, systems: Mapping[str, System], engine: str, limits: Limits, progress: Progress
) -> list[Result]:
    """A verdict for each property of the task.

    ``engine`` is the name of one, ``auto`` (explicit search first, then bounded model checking of
    what it leaves open) or ``all`` (every engine, answers compared).  With free timers in ``limits``,
    what the system with timers that run out at will does not settle is then searched exactly.  Raises
    ``Disagreement``, ``ReplayError``, and ``ModelError`` when the model itself leaves a domain.
    """
    if isinstance(task.properties[0].form, Unbounded):

        def ask(system: TransitionSystem, goals: Sequence[Var], short: bool = False) -> Answers:
            return _answers(system, goals, engine, limits, progress, short)

        return [unbounded(prop, systems, ask, progress) for prop in task.properties]
    if limits.timers is Timers.FREE:
        return _freely_first(task, systems, engine, replace(limits, timers=Timers.EXACT), progress)
    question = reduce(lower(task.system), task.properties)
    found = _answers(question.system, [g.var for g in question.goals], engine, limits, progress)
    check_domains(question.system, found)
    runs = {n: (a, by) for n, (a, by) in found.items() if isinstance(a, Reached)} if task.system.over else {}
    results = [
        result(question.system, g, *found[g.var.name]) for g in question.goals if g.var.name not in runs
    ]
    if not runs:
        return results
    if not task.system.concrete:
        return results + not_reproducible(question, runs)
    concrete = systems[task.system.concrete]
    return results + reproduced(question, runs, concrete, engines()["bmc"], limits, progress)


def _freely_first(
    task: Task, systems: Mapping[str, System], engine: str, limits: Limits, progress: Progress
) -> list[Result]:
    def ask(system: TransitionSystem, goals: Sequence[Var]) -> Answers:
        return _answers(system, goals, engine, limits, progress)

    done, left = freely(task.system, task.properties, ask)
    exact = Task(task.system, tuple(left))
    return done + (decide(exact, systems, engine, limits, progress) if left else [])


def _answers(
    system: TransitionSystem,
    wanted: Sequence[Var],
    engine: str,
    limits: Limits,
    progress: Progress,
    short: bool = False,
) -> dict[str, tuple[Answer, str]]:
    """Answers for the goals and for the checks of the system.

    ``auto`` looks for ``short`` runs first, and then grants little to an exhaustive search.
    """
    goals = [*wanted, *(check for check, _ in system.checks)]
    if engine == ALL:
        return _compared(system, goals, engines(), limits, progress)
    if engine != AUTO:
        return _ask(engines()[engine], system, goals, limits, progress)
    plan = _plan(limits, short, _width(sliced(system, goals)) > WIDE)
    found: dict[str, tuple[Answer, str]] = {}
    for name, granted in plan:
        left = [g for g in goals if g.name not in found or isinstance(found[g.name][0], Open)]
        if not left or (found and limits.depth is not None):
            break
        if short and found and all(isinstance(found[g.name][0], Reached) for g in wanted):
            break  # whether other runs leave a domain does not matter to a run that is replayed
        for goal, answer in _ask(engines()[name], system, left, granted, progress).items():
            found[goal] = _better(found[goal], answer) if goal in found else answer
    return found


def _plan(limits: Limits, short: bool, wide: bool) -> tuple[tuple[str, Limits], ...]:
    """Which engine ``auto`` asks, and what it grants to each, until all is decided."""
    explicit, unrolling = ("explicit", limits), ("bmc", limits)
    little = ("explicit", replace(limits, memory=min(LITTLE, limits.memory)))
    if wide:
        return (unrolling,)
    if short:
        return ("bmc", replace(limits, depth=min(SHORT, limits.depth or SHORT))), little, unrolling
    return explicit, unrolling


def _width(system: TransitionSystem) -> int:
    """The bits of a valuation."""
    return sum((len(v.domain) - 1).bit_length() for v in system.variables)


def _ask(
    engine: Engine, system: TransitionSystem, goals: Sequence[Var], limits: Limits, progress: Progress
) -> dict[str, tuple[Answer, str]]:
    return {n: (a, engine.NAME) for n, a in engine.check(system, goals, limits, progress).items()}


def _better(first: tuple[Answer, str], second: tuple[Answer, str]) -> tuple[Answer, str]:
    """Of two answers one of which is open: the decided one, or the deeper one, with both reasons."""
    (a, by_a), (b, by_b) = first, second
    if not (isinstance(a, Open) and isinstance(b, Open)):
        return second if isinstance(a, Open) else first
    reason = f"{by_a}: {a.reason}; {by_b}: {b.reason}"
    return Open(reason, max(a.depth, b.depth)), by_a if a.depth > b.depth else by_b


def _compared(
    system: TransitionSystem,
    goals: Sequence[Var],
    known: Mapping[str, Engine],
    limits: Limits,
    progress: Progress,
) -> dict[str, tuple[Answer, str]]:
    each = [_ask(engine, system, goals, limits, progress) for engine in known.values()]
    merged = each[0]
    for other in each[1:]:
        for name, answer in other.items():
            _must_agree(name, merged[name], answer)
            merged[name] = _better(merged[name], answer)
    return merged


def _must_agree(goal: str, first: tuple[Answer, str], second: tuple[Answer, str]) -> None:
    (a, by_a), (b, by_b) = first, second
    if isinstance(b, Reached) and not isinstance(a, Reached):
        (a, by_a), (b, by_b) = (b, by_b), (a, by_a)
    if isinstance(a, Reached):
        same = isinstance(b, Reached) and not (a.shortest and b.shortest and len(a.run) != len(b.run))
        if not same and not (isinstance(b, Open) and b.depth < len(a.run)):
            raise Disagreement(
                f"{goal}: {by_a} reaches it after {len(a.run)} ticks, {by_b} says {_word(b)}. "
                "At least one engine is wrong; please report this with the model."
            )


def _word(answer: Answer) -> str:
    match answer:
        case Reached(run):
            return f"after {len(run)} ticks"
        case Unreachable():
            return "never"
        case Open(_, depth):
            return f"not within {depth} ticks"
