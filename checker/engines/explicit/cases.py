"""A search case by case: once for each value of a frozen enumeration, so that memory holds one of them.

The valuations of a case are given up with it where there are many: what is proved so has no certificate.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from itertools import product
from math import prod

from checker.encode.values import possible
from checker.results.closed import ClosedSet, union
from checker.results.verdict import Answer, Exhausted, Open, Reached, Unreachable
from spec_model.lang.domain import Enum
from spec_model.lang.expr import Var
from spec_model.lang.system import TransitionSystem

Case = Callable[[TransitionSystem], TransitionSystem]
"""What leaves one case of a system, or of a slice of it."""

KEPT = 1 << 21
"""Valuations of all cases that are kept for a certificate: more could not be checked."""


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
    """The answer of a case, without the valuations if these would keep much memory."""
    match answer:
        case Open(reason, depth):
            return Open(f"{case}: {reason}", depth)
        case Unreachable(Exhausted(closed=closed) as because) if closed is not None and len(closed) > KEPT:
            return Unreachable(replace(because, closed=None))
    return answer


def joined(part: TransitionSystem, found: Sequence[Mapping[str, Answer]]) -> dict[str, Answer]:
    """What the cases of a slice together say of each goal."""
    kept: dict[tuple[int, ...], ClosedSet | None] = {}
    return {name: _joined(part, [answers[name] for answers in found], kept) for name in found[0]}


def _joined(
    part: TransitionSystem, answers: Sequence[Answer], kept: dict[tuple[int, ...], ClosedSet | None]
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
    memory = tuple(0 if e.closed is None else e.closed.words.ctypes.data for e in exhausted)
    if memory not in kept:
        kept[memory] = _union(part, [e.closed for e in exhausted])
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


def _union(part: TransitionSystem, found: Sequence[ClosedSet | None]) -> ClosedSet | None:
    """The valuations of all cases, also of those in which no tick is possible: there they are initial."""
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
    return union(sets, (*part.frozen, *part.variables), initial)
