"""Faults put into k-induction on purpose: each one leads to a claim that plain enumeration rejects."""

from collections.abc import Callable, Iterator, Mapping
from functools import partial
from typing import ClassVar

import pytest

from rovercheck.checker.encode.bitvector import Term
from rovercheck.checker.encode.cone import Slice
from rovercheck.checker.encode.terms import Terms
from rovercheck.checker.engines.kinduction import houdini, invariant_search, search
from rovercheck.checker.engines.kinduction.ticks import Ticks
from rovercheck.checker.results.verdict import Inductive
from rovercheck.checker.search import DepthSearched, GoalsExcluded, SearchEvent
from rovercheck.spec_model.lang.expr import Expr
from rovercheck.spec_model.lang.system import TransitionSystem
from tests.faults import PatchSuite
from tests.inductive import problems
from tests.toys import GOAL, counter, once, overflowing, relay, waiting

Patch = pytest.MonkeyPatch
Fault = Callable[[Patch], None]
PROVED = (partial(relay, 9), waiting)
"""Systems of which the engine claims something; of the others it must not."""
OTHERS = (
    partial(counter, 15, top=20),
    partial(counter, 15, top=20, beside=True),
    partial(overflowing, 20),
    once,
)


def claims(system: TransitionSystem) -> list[str] | None:
    """What plain enumeration says against the engine's claim; None if it makes none."""
    for event in search.search(system, [GOAL.name], None):
        if isinstance(event, GoalsExcluded) and isinstance(event.because, Inductive):
            return problems(system, GOAL, event.because)
    return None


def all_candidates_are_taken_as_they_come(patch: Patch) -> None:
    """What random runs did not break within their time is said to be inductive."""

    def grow(self: houdini.Consecution, candidates: list[Expr]) -> list[Expr]:
        self._known |= self._ticks.assumed(candidates)
        return candidates

    patch.setattr(search, "SIMULATED", 10)
    patch.setattr(houdini.Consecution, "support", lambda self, needed: list(needed))
    patch.setattr(houdini.Consecution, "grow", grow)


def a_support_is_left_out(patch: Patch) -> None:
    """One of the conjuncts that exclude the goal together is told, and none of those that make it inductive.

    Which one is the first depends on all that Z3 was asked before: it may be inductive, and not enough.
    """
    patch.setattr(houdini.Consecution, "support", lambda self, needed: list(needed)[:1])


def a_domain_constraint_is_dropped(patch: Patch) -> None:
    def nothing(part: Slice, terms: Terms) -> dict[str, Expr]:
        return {}

    patch.setattr(search, "SIMULATED", 10)
    patch.setattr(search, "straying", nothing)


def the_base_case_is_not_looked_at(patch: Patch) -> None:
    def unseen(self: search.InductionGroup) -> Iterator[SearchEvent]:
        self.deep = search.BASE
        yield DepthSearched(tuple(self.open), self.deep)

    patch.setattr(search.InductionGroup, "_first_ticks", unseen)
    patch.setattr(search, "SIMULATED", 0)


def an_unrolling_is_one_tick_off(patch: Patch) -> None:
    after = Ticks.after

    def earlier(self: Ticks, tick: int, name: str) -> Term:
        return after(self, tick - 1, name) if tick > 1 else after(self, tick, name)

    patch.setattr(Ticks, "after", earlier)
    patch.setattr(search, "SIMULATED", 10)


def simple_paths_are_too_simple(patch: Patch) -> None:
    """Every variable has to differ between any two ticks, not just some variable."""

    def differ(ticks: Ticks, last: int) -> None:
        for tick in range(last):
            one, other = ticks.valuation(tick), ticks.valuation(last)
            ticks.solver.add(*(one[name] != other[name] for name in one))

    no_candidates(patch)
    patch.setattr(search, "_differ", differ)


def no_candidates(patch: Patch) -> None:
    """Nothing is found to strengthen with: no fault, but simple paths alone must do."""

    def no_phases(self: object) -> Iterator[str]:
        yield from ()

    patch.setattr(search, "SIMULATED", 10)
    patch.setattr(invariant_search.InvariantSearch, "phases", no_phases)


class TestKinduction(PatchSuite):
    OBLIGATIONS: ClassVar[Mapping[Fault, set[str]]] = {
        all_candidates_are_taken_as_they_come: {"consecution"},
        a_support_is_left_out: {"consecution", "safety"},
        a_domain_constraint_is_dropped: {"domains"},
        the_base_case_is_not_looked_at: {"base"},
        an_unrolling_is_one_tick_off: {"safety"},
        simple_paths_are_too_simple: {"safety"},
    }
    """Each fault with the obligations of which plain enumeration must find one broken."""
    FAULTS = tuple(OBLIGATIONS)

    def wrong(self) -> Iterator[str]:
        for make in (*PROVED, *OTHERS):
            yield from claims(make()) or ()

    def killed(self, fault: Fault, patch: Patch) -> bool:
        fault(patch)
        return not self.OBLIGATIONS[fault].isdisjoint(self.wrong())


@pytest.mark.parametrize("make", PROVED)
def test_something_is_claimed_of_what_holds(make: Callable[[], TransitionSystem]) -> None:
    assert claims(make()) == []


@pytest.mark.parametrize("simulated", [10, 0])
def test_short_random_runs_are_no_fault(simulated: int, monkeypatch: Patch) -> None:
    """What some faults add to be seen does no harm alone."""
    monkeypatch.setattr(search, "SIMULATED", simulated)
    assert list(TestKinduction().wrong()) == [] and all(claims(make()) is None for make in OTHERS)


def test_no_candidates_are_no_fault(monkeypatch: Patch) -> None:
    no_candidates(monkeypatch)
    assert list(TestKinduction().wrong()) == [] and all(claims(make()) is None for make in OTHERS)
