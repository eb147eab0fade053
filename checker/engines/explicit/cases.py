"""A search case by case: once for each value of a frozen enumeration, so that memory holds one of them.

The valuations of a case are given up with it: what is proved so has no certificate.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial

from checker.encode.values import possible
from checker.verdict import Answer, Exhausted, Open, Reached, Unreachable
from spec_model.lang.domain import Enum
from spec_model.lang.expr import Var
from spec_model.lang.system import TransitionSystem

Case = Callable[[TransitionSystem], TransitionSystem]
"""What leaves one case of a system, or of a slice of it."""


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
    """The answer of a case, without the valuations that would keep the memory of it."""
    match answer:
        case Open(reason, depth):
            return Open(f"{case}: {reason}", depth)
        case Unreachable(Exhausted() as because):
            return Unreachable(replace(because, closed=None))
    return answer


def joined(found: Sequence[Mapping[str, Answer]]) -> dict[str, Answer]:
    """What the cases together say of each goal."""
    return {name: _joined([answers[name] for answers in found]) for name in found[0]}


def _joined(answers: Sequence[Answer]) -> Answer:
    reached = [a for a in answers if isinstance(a, Reached)]
    left = [a for a in answers if isinstance(a, Open)]
    if reached:
        best = min(reached, key=lambda a: (len(a.run), not a.shortest))
        return Reached(best.run, best.shortest and all(a.depth >= len(best.run) - 1 for a in left))
    if left:
        return min(left, key=lambda a: a.depth)
    done = [a.because for a in answers if isinstance(a, Unreachable)]
    exhausted = [e for e in done if isinstance(e, Exhausted)]
    return Unreachable(
        Exhausted(
            sum(e.states for e in exhausted),
            sum(e.transitions for e in exhausted),
            max(e.depth for e in exhausted),
            exhausted[0].variables,
            exhausted[0].skipped,
        )
    )
