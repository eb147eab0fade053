"""The answers of the explicit search: goals that depend on nearly the same variables are decided together."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import product
from math import prod
from time import monotonic

from rovercheck.checker.encode.counters import counters
from rovercheck.checker.encode.dead_branches import narrowed
from rovercheck.checker.encode.gather import bits, gathered
from rovercheck.checker.encode.native import Field, Layout, NativeSearch, NativeTask, TooWide, layout, shifts
from rovercheck.checker.encode.native.layout import WORD_BITS
from rovercheck.checker.encode.values import possible
from rovercheck.checker.engines import Limits, Progress, Stage, Timers
from rovercheck.checker.engines.explicit.levels import ExplicitFound, LevelSearch, SearchUsage
from rovercheck.checker.engines.explicit.lines import LineSearch
from rovercheck.checker.engines.explicit.runs import Runs
from rovercheck.checker.results.closed_set import BitPlace, ClosedSet, ClosedUnion
from rovercheck.checker.results.verdict import Answer, Exhausted, Open, Reached, Unreachable
from rovercheck.checker.system.slice import sliced
from rovercheck.spec_model.lang.domain import Enum
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.system import TransitionSystem

# --- A search case by case -----------------------------------------------------------------------------

Case = Callable[[TransitionSystem], TransitionSystem]
"""What leaves one case of a system, or of a slice of it."""

KEPT = 1 << 21
"""States of all cases that are kept for a certificate: more could not be checked."""


def cases(system: TransitionSystem, part: TransitionSystem) -> Iterator[tuple[str, Case]]:
    """One for each value of that enumeration frozen in a slice that has the most, and in words which.

    None for two values: searches that have little in common are what is worth a start of its own.  A value
    with which no tick is possible is left out.
    """
    several = [v for v in part.frozen if isinstance(v.sort, Enum) and len(v.domain) > 2]
    if several:
        chosen = max(several, key=lambda v: len(v.domain))
        for raw in chosen.domain.values:
            only = partial(_only, chosen, raw)
            if possible(only(system)):
                yield f"{chosen.name} = {chosen.domain.show(raw)}", only


def _only(chosen: Var, raw: int, system: TransitionSystem) -> TransitionSystem:
    one = replace(chosen, domain=replace(chosen.domain, values=(raw,)), init=raw)
    return replace(system, frozen=tuple(one if v.name == chosen.name else v for v in system.frozen))


def about(case: str, answer: Answer) -> Answer:
    """The answer of a case, without the states if these would keep much memory."""
    match answer:
        case Open(reason, depth):
            return Open(f"{case}: {reason}", depth)
        case Unreachable(Exhausted(closed=closed) as because) if (
            isinstance(closed, ClosedSet) and len(closed) > KEPT
        ):
            return Unreachable(replace(because, closed=None))
    return answer


def joined(part: TransitionSystem, found: Sequence[Mapping[str, Answer]]) -> dict[str, Answer]:
    """What the cases of a slice together say of each goal."""
    kept: dict[tuple[int, ...], ClosedUnion | None] = {}
    return {name: _joined(part, [answers[name] for answers in found], kept) for name in found[0]}


def _joined(
    part: TransitionSystem, answers: Sequence[Answer], kept: dict[tuple[int, ...], ClosedUnion | None]
) -> Answer:
    reached = [a for a in answers if isinstance(a, Reached)]
    left = [a for a in answers if isinstance(a, Open)]
    if reached:
        best = min(reached, key=lambda a: (len(a.run), not a.shortest))
        return Reached(best.run, best.shortest and all(a.depth >= len(best.run) - 1 for a in left))
    if left:
        return min(left, key=lambda a: a.depth)
    done = [a.because for a in answers if isinstance(a, Unreachable)]
    exhausted = [e for e in done if isinstance(e, Exhausted)]
    sets = [e.closed if isinstance(e.closed, ClosedSet) else None for e in exhausted]
    memory = tuple(0 if one is None else one.words.ctypes.data for one in sets)
    if memory not in kept:
        kept[memory] = _union(part, sets)
    return Unreachable(
        Exhausted(
            sum(e.states for e in exhausted),
            sum(e.transitions for e in exhausted),
            max(e.depth for e in exhausted),
            exhausted[0].variables,
            exhausted[0].skipped,
            kept[memory],
        )
    )


def _union(part: TransitionSystem, found: Sequence[ClosedSet | None]) -> ClosedUnion | None:
    """The states of all cases, also of those in which no tick is possible: there they are initial."""
    sets = [one for one in found if one is not None]
    frozen = prod(len(v.domain) for v in part.frozen)
    if len(sets) < len(found) or sum(map(len, sets)) + frozen > KEPT:
        return None
    names = [v.name for v in part.frozen]
    started = {v.name: v.init for v in part.variables}
    initial = (
        started | dict(zip(names, values, strict=True))
        for values in product(*(v.domain.values for v in part.frozen))
    )
    return ClosedUnion(tuple(sets), (*part.frozen, *part.variables), tuple(initial))


NARROW = 3 * WORD_BITS
"""Bits of a state up to which memory is not what ends searches."""
EXTRA, APART = 10, 128
"""Bits that a goal may add to those of others and still be searched with them, and bits of all goals from
which on they are anyhow: compiling so wide a step takes longer than most searches."""


def answers(
    system: TransitionSystem, goals: Sequence[Var], limits: Limits, progress: Progress
) -> Mapping[str, Answer]:
    """An answer for each goal, by name; raises what ``check`` of the engine raises."""
    _check_goals(system, goals)
    deadline, spent = limits.deadline(), SearchUsage()
    answered: dict[str, Answer] = {}
    for wanted in _groups(system, goals):
        if answered and deadline is not None and monotonic() > deadline:
            late = Open(f"the time limit of {limits.seconds:g} s is reached before it is searched for", 0)
            answered |= {g.name: late for g in wanted}
        else:
            found, spent = _by_cases(system, wanted, _Within(limits, deadline, progress), spent)
            answered |= found
    return answered


def _check_goals(system: TransitionSystem, goals: Sequence[Var]) -> None:
    own = {v.name for v in (*system.variables, *system.frozen)}
    for goal in goals:
        if goal.name not in own:
            raise ModelError(
                f"{goal.name} is no variable of {system.name}, so no run reaches it; "
                "ask for a variable that the system writes."
            )


def _groups(system: TransitionSystem, goals: Sequence[Var]) -> list[list[Var]]:
    """The goals that are searched together, those that depend on little first."""
    by_name = {g.name: g for g in goals}
    if len(goals) < 2 or bits(_part(system, goals)) > APART:
        return [list(goals)] if goals else []
    parts = {g.name: _part(system, [g]) for g in goals}
    return [[by_name[name] for name in together] for together in gathered(parts, EXTRA)]


def _part(system: TransitionSystem, goals: Sequence[Var]) -> dict[str, Var]:
    part = sliced(system, goals)
    return {v.name: v for v in (*part.frozen, *part.variables)}


@dataclass(frozen=True)
class _Within:
    """What bounds a search, and who hears of it."""

    limits: Limits
    deadline: float | None
    progress: Progress

    def over(self, spent: SearchUsage) -> str:
        """Which limit leaves nothing for another search; empty if none does."""
        limits = self.limits
        if self.deadline is not None and monotonic() > self.deadline:
            return f"the time limit of {limits.seconds:g} s"
        if limits.transitions is not None and spent.transitions >= limits.transitions:
            return f"the limit of {limits.transitions:,} transitions"
        return ""


def _by_cases(
    system: TransitionSystem, goals: Sequence[Var], within: _Within, spent: SearchUsage
) -> tuple[Mapping[str, Answer], SearchUsage]:
    """An answer for each goal, and what is spent after it; a wide system is searched case by case.

    A limit of transitions is shared by the cases, so that the largest does not keep the others from a run.
    """
    part = sliced(system, goals)
    several = list(cases(system, part)) if _wide(part) else []
    if len(several) < 2:
        return _searched(system, part, goals, within, spent)
    least, found = narrowed(part).system, list[Mapping[str, Answer]]()
    for number, (case, one) in enumerate(several):
        if reached := within.over(spent):
            found.append({g.name: Open(f"{reached} is reached before {case}", 0) for g in goals})
            continue
        told = replace(within, progress=partial(_report_case, within.progress, case))
        before = _shared(within.limits.transitions, spent, len(several) - number)
        answers, after = _searched(one(system), one(least), goals, told, before)
        found.append({name: about(case, answer) for name, answer in answers.items()})
        spent = replace(spent, transitions=spent.transitions + after.transitions - before.transitions)
    return joined(part, found), spent


def _shared(most: int | None, spent: SearchUsage, cases: int) -> SearchUsage:
    """What counts as spent for a case, so that each of some cases may spend as much as this one."""
    return spent if most is None else replace(spent, transitions=most - (most - spent.transitions) // cases)


def _wide(part: TransitionSystem) -> bool:
    return bits({v.name: v for v in (*part.frozen, *part.variables)}) > NARROW


def _report_case(progress: Progress, case: str, line: str) -> None:
    whole = line.replace("explicit: ", f"explicit: {case}, ", 1)
    progress(Stage(whole) if isinstance(line, Stage) else whole)


def _searched(
    system: TransitionSystem,
    part: TransitionSystem,
    goals: Sequence[Var],
    within: _Within,
    spent: SearchUsage,
) -> tuple[Mapping[str, Answer], SearchUsage]:
    """One search of a slice: an answer for each goal, and what is spent after it."""
    limits = within.limits
    try:
        least, packing = _narrow(part, limits)
        moved = shifts(packing, counters(part)) if limits.timers is Timers.SKIP else ()
        task = NativeTask(least, packing, tuple(goals), moved)
        within.progress(Stage(f"explicit: compiling {len(packing.fields)} variables in {packing.bits} bits"))
        native = NativeSearch.compile(task)
    except (TooWide, ValueError) as problem:
        return {g.name: Open(str(problem), 0) for g in goals}, spent
    search = (LineSearch if task.shifts else LevelSearch)(
        native, limits, within.deadline, within.progress, spent
    )
    found = search.run()
    runs = Runs(system, task, found)
    if found.outside is not None:
        raise runs.left_domain(found.outside)
    answers = {g.name: _answer(found, runs, number, g) for number, g in enumerate(goals)}
    kept = search.store.words.nbytes if any(isinstance(a, Unreachable) for a in answers.values()) else 0
    return answers, SearchUsage(spent.transitions + found.transitions, spent.bytes + kept)


def _narrow(part: TransitionSystem, limits: Limits) -> tuple[TransitionSystem, Layout]:
    """What is compiled of a slice, and its states in as few words as it takes.

    What values there are, and which branches no run takes, is looked at where there is much to compile.
    """
    stored = (*part.frozen, *part.variables)
    if not _wide(part) or limits.timers is Timers.SKIP:  # quiet ticks move counters as far as they go
        return part, layout(stored)
    least = narrowed(part)
    return least.system, layout(stored, least.values)


def _answer(found: ExplicitFound, runs: Runs, number: int, goal: Var) -> Answer:
    if found.hits[number] is not None:
        return Reached(runs.to_goal(number, goal))
    if found.stopped:
        return Open(found.stopped, found.depth)
    packing = runs.task.layout
    counted = tuple(f.var.name for f in packing.fields)
    skipped = bool(runs.task.shifts)
    closed = None if skipped else ClosedSet(tuple(map(_place, packing.fields)), found.words)
    return Unreachable(Exhausted(found.states, found.transitions, found.depth, counted, skipped, closed))


def _place(field: Field) -> BitPlace:
    return BitPlace(field.var, field.word, field.shift, field.bits, field.stride, field.low)
