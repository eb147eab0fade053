"""What the tests of certificates share: an engine that searches naively, forged and written certificates."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, settings
from hypothesis import strategies as st
from hypothesis.strategies import DrawFn

from rovercheck.checker.certify import solver
from rovercheck.checker.certify.certificate import Certificate, certificates
from rovercheck.checker.certify.check import CheckEffort, CheckMethod
from rovercheck.checker.certify.diagram import CertifiedDiagram
from rovercheck.checker.certify.invariant import Conjuncts
from rovercheck.checker.certify.question import question
from rovercheck.checker.certify.tick import executed
from rovercheck.checker.engines import Limits, Progress
from rovercheck.checker.results.closed_set import BitPlace, ClosedSet
from rovercheck.checker.results.verdict import Answer, Exhausted, Inductive, Open, Unreachable
from rovercheck.checker.system.slice import sliced
from rovercheck.spec_model.lang.action import Assign
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.expr import Expr, Var, const, flag, ite, var
from rovercheck.spec_model.lang.system import TransitionSystem
from tests.naive import projected, search
from tests.profiles import examples
from tests.strategies_ts import goals, transition_systems

SOLVER, ENUMERATION, BOTH = (CheckEffort(by) for by in CheckMethod)

Rows = Iterable[Mapping[str, int]]


def closed_set(variables: Sequence[Var], rows: Rows) -> ClosedSet:
    """Distinct states, each variable in a word of its own."""
    values = [[at[v.name] - v.domain.low for v in variables] for at in rows]
    words = np.array(values, dtype=np.uint64).reshape(len(values), len(variables))
    bits = [(v.domain.high - v.domain.low).bit_length() for v in variables]
    return ClosedSet(
        tuple(BitPlace(v, i, 0, bits[i], 1, v.domain.low) for i, v in enumerate(variables)), words
    )


def part_of(system: TransitionSystem, goals: Sequence[Var]) -> tuple[TransitionSystem, tuple[Var, ...]]:
    """What the goals depend on, the goals being variables of it, and the variables of a state."""
    part = sliced(system, goals)
    own = (*part.frozen, *part.variables)
    names = {v.name for v in own}
    more = tuple(g for g in goals if g.name not in names)
    temps = tuple(v for v in part.temps if v.name not in {g.name for g in more})
    return replace(part, variables=(*part.variables, *more), temps=temps), own


def reachable(system: TransitionSystem, goals: Sequence[Var]) -> list[dict[str, int]]:
    """The reachable states of what the goals depend on."""
    part, own = part_of(system, goals)
    return [dict(state) for state in projected(search(part, goals).states, [v.name for v in own])]


class Naive:
    """An engine: unreachable with the closed set, or open."""

    NAME = "naive"
    SUMMARY = "the reference semantics on every state"

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
    """``checker.process.isolate.messages`` without a child, for many small questions."""
    sent: list[Any] = []
    work(sent.append, *args)
    yield from sent


@contextmanager
def solving_here() -> Iterator[None]:
    """The solver called in this process, for many small questions."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(solver, "messages", inline)
        yield


# --- certificates to begin with -------------------------------------------------------------------

many = settings(examples(50), suppress_health_check=[HealthCheck.filter_too_much, HealthCheck.too_slow])


@st.composite
def proofs(draw: DrawFn) -> tuple[TransitionSystem, Certificate]:
    """A random system with some goal that is never reached, and the certificate of that."""
    system = draw(transition_systems())
    never = flag("never")
    system = replace(
        system,
        variables=(*system.variables, never),
        step=(*system.step, Assign(never, system.variables[0] != system.variables[0])),
    )
    (one,) = certified(system, (*goals(system), never))
    return system, one


def with_invariant(
    one: Certificate, system: TransitionSystem, invariant: CertifiedDiagram | Conjuncts
) -> Certificate:
    return asked_anew(replace(one, invariant=invariant), system)


def asked_anew(one: Certificate, system: TransitionSystem) -> Certificate:
    """What a forger writes: text and digest that fit what is claimed."""
    found = question(executed(system), one.claims, one.kept, one.about)
    return replace(one, text=found.text, digest=found.digest)


def counting(program: tuple[Assign, ...], count: Var, *inputs: Var) -> tuple[TransitionSystem, Var]:
    """A system with one variable, and the goal that it is 6."""
    bad = flag("bad")
    variables = (count, bad)
    return TransitionSystem("counting", inputs, (), variables, (), (*program, Assign(bad, count == 6))), bad


def claimed(
    system: TransitionSystem, bad: Var, *conjuncts: Expr, ticks: int = 1, simple: bool = False
) -> Certificate:
    answer = Unreachable(Inductive(conjuncts, ticks, simple))
    (one,) = certificates(system, [bad], {bad.name: answer}, "hand")
    return one


COUNT = var("count", integer(0, 7))
BACK = Assign(COUNT, ite(COUNT < 3, COUNT + 1, ite(COUNT == 3, const(0), COUNT)))
"""0 1 2 3 0 1 2 3 ...; from 4 on it stays."""
