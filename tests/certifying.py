"""What the tests of certificates share: an engine that searches naively and keeps its closed set."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from checker.certify.certificate import Certificate, certificates
from checker.certify.check import By, Effort
from checker.closed import ClosedSet, Place
from checker.engine import Limits, Progress
from checker.slice import sliced
from checker.verdict import Answer, Exhausted, Open, Unreachable
from spec_model.lang.expr import Var
from spec_model.lang.system import TransitionSystem
from tests.naive import projected, search

SOLVER, ENUMERATION, BOTH = (Effort(by) for by in By)

Rows = Iterable[Mapping[str, int]]


def closed_set(variables: Sequence[Var], rows: Rows) -> ClosedSet:
    """Distinct valuations, each variable in a word of its own."""
    values = [[at[v.name] - v.domain.low for v in variables] for at in rows]
    words = np.array(values, dtype=np.uint64).reshape(len(values), len(variables))
    bits = [(v.domain.high - v.domain.low).bit_length() for v in variables]
    return ClosedSet(tuple(Place(v, i, 0, bits[i], 1) for i, v in enumerate(variables)), words)


def part_of(system: TransitionSystem, goals: Sequence[Var]) -> tuple[TransitionSystem, tuple[Var, ...]]:
    """What the goals depend on, the goals being variables of it, and the variables of a valuation."""
    part = sliced(system, goals)
    own = (*part.frozen, *part.variables)
    names = {v.name for v in own}
    more = tuple(g for g in goals if g.name not in names)
    temps = tuple(v for v in part.temps if v.name not in {g.name for g in more})
    return replace(part, variables=(*part.variables, *more), temps=temps), own


def reachable(system: TransitionSystem, goals: Sequence[Var]) -> list[dict[str, int]]:
    """The reachable valuations of what the goals depend on."""
    part, own = part_of(system, goals)
    return [dict(state) for state in projected(search(part, goals).states, [v.name for v in own])]


class Naive:
    """An engine: unreachable with the closed set, or open."""

    NAME = "naive"
    SUMMARY = "the reference semantics on every valuation"

    def check(
        self, system: TransitionSystem, goals: Sequence[Var], limits: Limits, progress: Progress
    ) -> Mapping[str, Answer]:
        part, own = part_of(system, goals)
        found = search(part, goals)
        rows = projected(found.states, [v.name for v in own])
        kept = closed_set(own, map(dict, rows))
        because = Exhausted(len(rows), 0, 0, tuple(v.name for v in own), closed=kept)
        reached = Open("some run reaches it", 0)
        return {g.name: reached if g.name in found.reached else Unreachable(because) for g in goals}


def certified(system: TransitionSystem, goals: Sequence[Var]) -> list[Certificate]:
    """The certificates of the naive engine: one, or none where every goal is reached."""
    answers = Naive().check(system, goals, Limits(), lambda _: None)
    return certificates(system, goals, answers, Naive.NAME)


def inline(work: Callable[..., None], *args: Any, seconds: float | None = None) -> Iterator[Any]:
    """``checker.isolate.messages`` without a child, for many small questions."""
    sent: list[Any] = []
    work(sent.append, *args)
    yield from sent
