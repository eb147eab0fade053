"""Certificates that somebody altered or made up are rejected, whatever stands in them."""

from dataclasses import replace
from itertools import pairwise

import pytest

from rovercheck.checker.certify.check import check
from rovercheck.checker.certify.diagram import CertifiedDiagram, CertifiedNode, Nodes
from rovercheck.checker.certify.invariant import Conjuncts
from rovercheck.checker.certify.outcome import Accepted, Rejected, Undecided
from rovercheck.spec_model.lang.action import Assign
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import TRUE, all_of, const, flag, ite, var
from rovercheck.spec_model.lang.system import TransitionSystem
from tests.certifying import (
    BACK,
    BOTH,
    COUNT,
    ENUMERATION,
    SOLVER,
    asked_anew,
    claimed,
    counting,
)

pytestmark = pytest.mark.usefixtures("solver_in_this_process")


def test_a_conjunct_that_is_needed_cannot_be_dropped() -> None:
    other, held, bad = var("other", integer(0, 7)), var("held", integer(0, 7)), flag("bad")
    swap = (Assign(held, other), Assign(other, ite(COUNT < 3, const(0), COUNT)), Assign(COUNT, held))
    program = (*swap, Assign(bad, COUNT == 6))
    system = TransitionSystem("", (), (), (COUNT, other, bad), (held,), program)
    one = claimed(system, bad, COUNT < 3, other < 3)
    assert isinstance(check(one, system, BOTH), Accepted)
    found = one.invariant
    assert isinstance(found, Conjuncts)
    for i in range(2):
        fewer = replace(found, conjuncts=found.conjuncts[:i] + found.conjuncts[i + 1 :])
        assert isinstance(check(replace(one, invariant=fewer), system, BOTH), Rejected)
    for a, b in (("(_ bv3 3)", "(_ bv7 3)"), ("bvslt", "bvsgt"), ("|count@0|", "|other@0|")):
        text = tuple(d.replace(a, b) for d in found.definitions)
        assert text != found.definitions
        assert isinstance(
            check(replace(one, invariant=replace(found, definitions=text)), system, BOTH), Rejected
        )


@pytest.mark.parametrize(
    "changed",
    [
        Conjuncts(("(define-fun |:c0@0| () Bool true) (assert false)",), ("|:c0@0|",)),
        Conjuncts((), ("|count@1|",)),
        Conjuncts((), ("false) (assert false",)),
        Conjuncts((), ("|:invariant@0|",)),
        Conjuncts((), (), ticks=0),
        Conjuncts((), ("|count@0|",)),
        Conjuncts(("(define-fun |:c0@0| () Bool (not))",), ("|:c0@0|",)),
        Conjuncts(("(define-fun |:c0@0| () Bool (= |count@0| (_ bv0 4) (_ bv0 4)))",), ("|:c0@0|",)),
        Conjuncts(("(define-fun |:c0@0| () Bool (= |count@0| (_ bv0 99999999999)))",), ("|:c0@0|",)),
        Conjuncts((f"(define-fun |:c0@0| () Bool {'(not ' * 9999}true{')' * 9999})",), ("|:c0@0|",)),
        Conjuncts(("(define-fun |:c0@0| () Bool (bvslt |count@0| (_ bv1 9)))",), ("|:c0@0|",)),
        CertifiedDiagram(("count", "count"), Nodes.of(()), 0),
        CertifiedDiagram(("unheard",), Nodes.of(()), 0),
        CertifiedDiagram(("count",), Nodes.of(()), 1),
        CertifiedDiagram(("count",), Nodes.of(()), -1),
        CertifiedDiagram(("count",), Nodes.of((CertifiedNode(1, ((0, 3, 0),)),)), 1),
        CertifiedDiagram(("count",), Nodes.of((CertifiedNode(0, ((0, 3, 1),)),)), 1),
        CertifiedDiagram(("count",), Nodes.of((CertifiedNode(0, ((3, 0, 0),)),)), 1),
        CertifiedDiagram(("count",), Nodes.of((CertifiedNode(0, ((0, 99, 0),)),)), 1),
        CertifiedDiagram(("count",), Nodes.of((CertifiedNode(0, ((0, 3, 0), (2, 5, 0))),)), 1),
        CertifiedDiagram(
            ("count",), Nodes.of((CertifiedNode(0, ((0, 3, 0),)), CertifiedNode(0, ((0, 3, 1),)))), 2
        ),
    ],
)
def test_what_has_no_meaning_is_rejected(changed: Conjuncts | CertifiedDiagram) -> None:
    system, bad = counting((BACK,), COUNT)
    one = claimed(system, bad, COUNT <= 3)
    for effort in (SOLVER, ENUMERATION, BOTH):
        outcome = check(replace(one, invariant=changed), system, effort)
        assert isinstance(outcome, Rejected) and outcome.obligation == "invariant", outcome


def test_names_and_positions_that_do_not_exist_are_rejected() -> None:
    system, bad = counting((BACK,), COUNT, flag("go"))
    one = claimed(system, bad, COUNT <= 3)
    for forged in (
        replace(one, claims=("unheard",)),
        replace(one, claims=()),
        replace(one, kept=(0,)),
        replace(one, kept=(-1,)),
        replace(one, about=("unheard",)),
        replace(one, about=("count", "count")),
        asked_anew(replace(one, about=("go",)), system),
        asked_anew(replace(one, claims=("bad", "go")), system),
        asked_anew(replace(one, claims=("count",)), system),
    ):
        outcome = check(forged, system, BOTH)
        assert isinstance(outcome, Rejected) and outcome.obligation == "question"


@pytest.mark.parametrize(("ticks", "simple"), [(10**30, False), (10**6, True)])
def test_a_number_of_ticks_out_of_all_reason_is_undecided(ticks: int, simple: bool) -> None:
    system, bad = counting((BACK,), COUNT)
    one = claimed(system, bad, ticks=ticks, simple=simple)
    assert isinstance(check(one, system, BOTH), Undecided)


def test_a_variable_starts_within_its_domain() -> None:
    """Or no state would be before the first tick, and anything could be shown of it."""
    with pytest.raises(ModelError):
        var("count", integer(0, 7), 9)


def test_what_is_too_much_to_enumerate_is_undecided() -> None:
    wide = tuple(var(f"w{i}", integer(0, 99)) for i in range(4))
    never = flag("never")
    moved = tuple(Assign(a, b) for a, b in pairwise(wide))
    program = (*moved, Assign(never, all_of(*(w > 99 for w in wide))))
    system = TransitionSystem("", (), (), (*wide, never), (), program)
    one = claimed(system, never, TRUE)
    assert isinstance(check(one, system, ENUMERATION), Undecided)
    assert isinstance(check(one, system, BOTH), Accepted)
