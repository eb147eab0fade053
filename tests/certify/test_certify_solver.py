"""A solver that is missing, slow, silent or dead never shows anything."""

import os
import sys
from collections.abc import Callable, Iterator, Sequence
from time import sleep
from typing import Any

import pytest

from rovercheck.checker.certify import solver
from rovercheck.checker.certify.check import CheckEffort, CheckMethod, check
from rovercheck.checker.certify.outcome import Accepted, Outcome, Rejected, Undecided
from rovercheck.checker.process.isolate import Send
from tests.certifying import BACK, BOTH, COUNT, SOLVER, claimed, counting, inline

Solve = Callable[..., None]


def missing(send: Send, scripts: Sequence[str], symbols: Sequence[Sequence[str]]) -> None:
    """Like the solver where it is not installed."""
    sys.modules["bitwuzla"] = None  # type: ignore[assignment]
    solver.solve(send, scripts, symbols)


def unsure(send: Send, scripts: Sequence[str], symbols: Sequence[Sequence[str]]) -> None:
    send(True)
    send("the solver answers unknown")


def silent(send: Send, scripts: Sequence[str], symbols: Sequence[Sequence[str]]) -> None:
    send(True)


def dead(send: Send, scripts: Sequence[str], symbols: Sequence[Sequence[str]]) -> None:
    send(True)
    os.kill(os.getpid(), 9)


def failing(send: Send, scripts: Sequence[str], symbols: Sequence[Sequence[str]]) -> None:
    raise RuntimeError("it is broken")


def slow(send: Send, scripts: Sequence[str], symbols: Sequence[Sequence[str]]) -> None:
    send(True)
    sleep(3600)


def outcome(solve: Solve, effort: CheckEffort, monkeypatch: pytest.MonkeyPatch) -> Outcome:
    monkeypatch.setattr(solver, "solve", solve)
    system, bad = counting((BACK,), COUNT)
    return check(claimed(system, bad, COUNT <= 3), system, effort)


@pytest.mark.parametrize(
    ("solve", "said"),
    [
        (missing, "needs bitwuzla, which is not installed"),
        (unsure, "consecution: the solver answers unknown"),
        (silent, "consecution: the solver ended without an answer"),
        (dead, "consecution: the solver process was ended by SIGKILL"),
        (failing, "initiation: RuntimeError: it is broken"),
        (slow, "consecution: the time limit of 5 s is reached"),
    ],
)
def test_a_solver_that_does_not_answer(solve: Solve, said: str, monkeypatch: pytest.MonkeyPatch) -> None:
    found = outcome(solve, CheckEffort(CheckMethod.SOLVER, 5), monkeypatch)
    assert isinstance(found, Undecided) and said in found.reason, found


def test_the_enumeration_needs_no_solver(monkeypatch: pytest.MonkeyPatch) -> None:
    assert outcome(missing, BOTH, monkeypatch) == Accepted("4 ticks tried")


def test_a_counterexample_is_no_acceptance(monkeypatch: pytest.MonkeyPatch) -> None:
    def lying(*args: Any, seconds: float | None = None) -> Iterator[Any]:
        found = list(inline(*args))
        yield from [*found[:-1], {}]

    monkeypatch.setattr(solver, "messages", lying)
    assert isinstance(outcome(solver.solve, SOLVER, monkeypatch), Rejected)
