"""Each obligation of a certificate is needed: one that fails alone is what a certificate is rejected for."""

from dataclasses import replace

import pytest

from rovercheck.checker.certify import solver
from rovercheck.checker.certify.certificate import Certificate
from rovercheck.checker.certify.check import check
from rovercheck.checker.certify.invariant import Conjuncts
from rovercheck.checker.certify.outcome import Accepted, Rejected
from rovercheck.spec_model.lang.action import Assign
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.expr import const, flag, ite, var
from rovercheck.spec_model.lang.system import TransitionSystem
from rovercheck.spec_model.lang.words import minimum
from tests.certifying import (
    BACK,
    BOTH,
    COUNT,
    ENUMERATION,
    SOLVER,
    certified,
    claimed,
    counting,
)

pytestmark = pytest.mark.usefixtures("solver_in_this_process")


def rejected_for(one: Certificate, system: TransitionSystem, obligation: str) -> None:
    outcome = check(one, system, SOLVER)
    assert isinstance(outcome, Rejected) and outcome.obligation == obligation, outcome
    if not (isinstance(one.invariant, Conjuncts) and one.invariant.ticks > 1):
        outcome = check(one, system, ENUMERATION)
        assert isinstance(outcome, Rejected) and outcome.obligation == obligation, outcome


def test_an_invariant_is_accepted() -> None:
    system, bad = counting((BACK,), COUNT)
    for one in (claimed(system, bad, COUNT <= 3), claimed(system, bad, COUNT < 5, ~(COUNT == 4))):
        assert check(one, system, SOLVER) == Accepted(f"4 obligations by {solver.name()}")
        assert check(one, system, ENUMERATION) == Accepted("4 ticks tried")
        assert isinstance(check(one, system, BOTH), Accepted)


def test_only_initiation_fails() -> None:
    system, bad = counting((Assign(COUNT, ite(COUNT < 3, const(1), COUNT)),), COUNT)
    rejected_for(claimed(system, bad, COUNT >= 1, COUNT <= 5), system, "initiation")


def test_only_consecution_fails() -> None:
    system, bad = counting((BACK,), COUNT)
    rejected_for(claimed(system, bad, COUNT <= 2), system, "consecution")


def test_only_domains_fail() -> None:
    small = var("count", integer(0, 3))
    system, bad = counting((Assign(small, small + 1),), small)
    rejected_for(claimed(system, bad), system, "domains")


def test_only_safety_fails() -> None:
    system, bad = counting((BACK,), COUNT)
    rejected_for(claimed(system, bad, COUNT <= 6), system, "safety")


CLIMB = Assign(COUNT, ite(COUNT < 3, COUNT + 1, ite(COUNT == 3, const(0), minimum(COUNT + 1, const(7)))))
"""0 1 2 3 0 ...; from 4, where no run gets, on to 6 and 7."""


def test_k_induction_with_the_k_it_needs() -> None:
    system, bad = counting((CLIMB,), COUNT)
    for k in (3, 4):
        assert isinstance(check(claimed(system, bad, ticks=k), system, BOTH), Accepted)
    for k in (1, 2):
        outcome = check(claimed(system, bad, ticks=k), system, SOLVER)
        assert isinstance(outcome, Rejected)
        assert outcome.obligation == ("safety" if k == 1 else "step of bad")
    assert isinstance(
        check(claimed(system, bad, ~(COUNT == 5), ~(COUNT == 4), ticks=2), system, SOLVER), Accepted
    )


def test_only_the_base_fails() -> None:
    start = var("count", integer(0, 7), 4)
    system, bad = counting((Assign(start, minimum(start + 1, const(7))),), start)
    rejected_for(claimed(system, bad, ticks=4), system, "base of bad")


def test_the_base_knows_what_is_assumed() -> None:
    start, go = var("count", integer(0, 7), 4), flag("go")
    system, bad = counting((Assign(start, ite(go, minimum(start + 1, const(7)), start)),), start, go)
    blocked = replace(system, assume=(start < 4) | ~go)
    assert isinstance(check(claimed(blocked, bad, ticks=2), blocked, SOLVER), Accepted)
    rejected_for(claimed(system, bad, ticks=8), system, "base of bad")


def test_simple_paths_prove_what_no_k_proves_without() -> None:
    stay = flag("stay")
    program = (Assign(COUNT, ite(COUNT < 4, const(0), ite(stay, COUNT, minimum(COUNT + 1, const(6))))),)
    system, bad = counting(program, COUNT, stay)
    assert isinstance(check(claimed(system, bad, ticks=4, simple=True), system, SOLVER), Accepted)
    for k in (2, 4, 6):
        rejected_for(claimed(system, bad, ticks=k), system, "step of bad")
    rejected_for(claimed(system, bad, ticks=2, simple=True), system, "step of bad")


def test_a_frozen_variable_may_have_any_value() -> None:
    top = var("top", integer(2, 5))
    program = (Assign(COUNT, ite(COUNT < top, COUNT + 1, COUNT)),)
    bad = flag("bad")
    system = TransitionSystem("", (), (top,), (COUNT, bad), (), (*program, Assign(bad, COUNT == 6)))
    assert isinstance(check(claimed(system, bad, COUNT <= top), system, BOTH), Accepted)
    (closed,) = certified(system, [bad])
    assert isinstance(check(closed, system, BOTH), Accepted)
    rejected_for(claimed(system, bad, COUNT <= 2), system, "consecution")
    rejected_for(claimed(system, bad, top == 3, COUNT <= top), system, "initiation")
