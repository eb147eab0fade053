"""Faults put into k-induction on purpose: each one leads to a claim that plain enumeration rejects."""

from collections.abc import Iterator

import pytest

from rovercheck.checker.encode.bitvector import Term
from rovercheck.checker.encode.cone import Slice
from rovercheck.checker.encode.terms import Terms
from rovercheck.checker.engines.kinduction import houdini, invariant_search, search
from rovercheck.checker.engines.kinduction import search as induction
from rovercheck.checker.engines.kinduction.ticks import Ticks
from rovercheck.checker.results.verdict import Inductive
from rovercheck.checker.search import DepthSearched, GoalsExcluded, SearchEvent
from rovercheck.spec_model.lang.expr import Expr
from rovercheck.spec_model.lang.system import TransitionSystem
from tests.inductive import problems
from tests.toys import GOAL, counter, once, overflowing, relay, waiting


def claims(system: TransitionSystem) -> list[str]:
    """What plain enumeration says of the engine's claim; ``no claim`` if it makes none."""
    for event in search.search(system, [GOAL.name], None):
        if isinstance(event, GoalsExcluded) and isinstance(event.because, Inductive):
            return problems(system, GOAL, event.because)
    return ["no claim"]


@pytest.mark.parametrize("system", [relay(9), waiting(), counter(15, top=20)], ids=lambda s: s.name)
def test_without_a_fault_every_claim_stands(system: TransitionSystem) -> None:
    assert claims(system) in ([], ["no claim"])
    assert (claims(system) == []) == (system.name != "counter")


def test_a_candidate_that_is_not_inductive(monkeypatch: pytest.MonkeyPatch) -> None:
    """All candidates taken as they come: what random runs did not break within their time."""
    monkeypatch.setattr(search, "SIMULATED", 10)
    monkeypatch.setattr(houdini.Consecution, "support", lambda self, needed: list(needed))
    assert claims(counter(15, top=20)) == ["no claim"]

    def grow(self: houdini.Consecution, candidates: list[Expr]) -> list[Expr]:
        self._known |= self._ticks.assumed(candidates)
        return candidates

    monkeypatch.setattr(houdini.Consecution, "grow", grow)
    assert "consecution" in claims(counter(15, top=20))


def test_a_support_that_is_left_out(monkeypatch: pytest.MonkeyPatch) -> None:
    """Only the conjuncts that exclude the goal, not those that make them inductive."""
    monkeypatch.setattr(houdini.Consecution, "support", lambda self, needed: list(needed)[:1])
    assert "consecution" in claims(relay(9))


def test_a_dropped_domain_constraint(monkeypatch: pytest.MonkeyPatch) -> None:
    system = overflowing(20)
    monkeypatch.setattr(search, "SIMULATED", 10)
    assert claims(system) == ["no claim"]

    def nothing(part: Slice, terms: Terms) -> dict[str, Expr]:
        return {}

    monkeypatch.setattr(search, "straying", nothing)
    assert "domains" in claims(system)


def test_a_base_case_that_is_not_looked_at(monkeypatch: pytest.MonkeyPatch) -> None:
    assert claims(once()) == ["no claim"]

    def unseen(self: search.InductionGroup) -> Iterator[SearchEvent]:
        self.deep = search.BASE
        yield DepthSearched(tuple(self.open), self.deep)

    monkeypatch.setattr(search.InductionGroup, "_first_ticks", unseen)
    monkeypatch.setattr(search, "SIMULATED", 0)
    assert claims(once()) == ["base"]


def test_an_unrolling_one_tick_off(monkeypatch: pytest.MonkeyPatch) -> None:
    system = counter(15, top=20)
    after = Ticks.after

    def earlier(self: Ticks, tick: int, name: str) -> Term:
        return after(self, tick - 1, name) if tick > 1 else after(self, tick, name)

    monkeypatch.setattr(Ticks, "after", earlier)
    monkeypatch.setattr(search, "SIMULATED", 10)
    assert "safety" in claims(system)


def test_simple_paths_that_are_too_simple(monkeypatch: pytest.MonkeyPatch) -> None:
    """Every variable has to differ between any two ticks, not just some variable."""
    system = counter(15, top=20, beside=True)

    def differ(ticks: Ticks, last: int) -> None:
        for tick in range(last):
            one, other = ticks.valuation(tick), ticks.valuation(last)
            ticks.solver.add(*(one[name] != other[name] for name in one))

    def no_phases(self: object) -> Iterator[str]:
        yield from ()

    monkeypatch.setattr(search, "SIMULATED", 10)
    monkeypatch.setattr(invariant_search.InvariantSearch, "phases", no_phases)
    assert claims(system) == ["no claim"]
    monkeypatch.setattr(induction, "_differ", differ)
    assert "safety" in claims(system)
