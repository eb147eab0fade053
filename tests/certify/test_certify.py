"""Certificates are accepted when they prove their claims, and rejected when anything in them is wrong."""

from dataclasses import replace

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from hypothesis.strategies import DataObject

from rovercheck.checker.certify.certificate import Certificate, certificate, certificates, document
from rovercheck.checker.certify.check import check
from rovercheck.checker.certify.diagram import CertifiedDiagram, CertifiedNode, Nodes
from rovercheck.checker.certify.outcome import Accepted, Rejected
from rovercheck.checker.certify.reduction import diagram
from rovercheck.checker.results.closed_set import ClosedSet
from rovercheck.checker.results.verdict import Exhausted, Unreachable
from rovercheck.spec_model.lang.action import Assign, If
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.evaluate import admissible, step
from rovercheck.spec_model.lang.expr import TRUE, flag, var
from rovercheck.spec_model.lang.system import TransitionSystem
from rovercheck.spec_model.lang.words import minimum
from tests.certifying import (
    BOTH,
    ENUMERATION,
    SOLVER,
    asked_anew,
    certified,
    closed_set,
    many,
    proofs,
    reachable,
    with_invariant,
)
from tests.naive import search, vectors
from tests.strategies_ts import goals

pytestmark = pytest.mark.usefixtures("solver_in_this_process")


def inductive(one: Certificate, system: TransitionSystem) -> bool:
    """Whether the diagram really proves the claims: initial, closed, free of them; by definition."""
    found = one.invariant
    assert isinstance(found, CertifiedDiagram)
    state = (*system.frozen, *system.variables)
    for frozen in vectors(system.frozen):
        if {**system.init, **frozen} not in found:
            return False
    for before in vectors(state):
        if before in found:
            for inputs in vectors(system.inputs):
                if admissible(system, before, inputs):
                    after = step(system, before, inputs)
                    if after not in found or any(after[c] for c in one.claims):
                        return False
    return True


# --- right ones ----------------------------------------------------------------------------------


@many
@given(proofs())
def test_what_the_naive_search_proves_is_accepted(drawn: tuple[TransitionSystem, Certificate]) -> None:
    system, one = drawn
    assert set(one.claims) >= {"never"}
    assert isinstance(check(one, system, SOLVER), Accepted)
    assert not isinstance(check(one, system, ENUMERATION), Rejected)
    assert certificate(document(one)) == one


@many
@given(proofs())
def test_unreachable_goals_are_what_is_claimed(drawn: tuple[TransitionSystem, Certificate]) -> None:
    system, one = drawn
    wanted = (*goals(system), system.var("never"))
    assert set(one.claims) == {g.name for g in wanted} - search(system, wanted).reached.keys()


def test_goals_of_one_search_share_a_certificate() -> None:
    count, first, second = var("count", integer(0, 3)), flag("first"), flag("second")
    program = (Assign(count, minimum(count + 1, 2)), Assign(first, count == 3), Assign(second, count > 2))
    system = TransitionSystem("", (), (), (count, first, second), (), program)
    kept = closed_set([count], [{"count": i} for i in range(3)])
    for_each = [
        Exhausted(3, 3, 3, ("count",), closed=ClosedSet(kept.places, kept.words[:3])) for _ in range(2)
    ]
    answers = {"first": Unreachable(for_each[0]), "second": Unreachable(for_each[1])}
    (one,) = certificates(system, [first, second], answers, "twice")
    assert one.claims == ("first", "second") and isinstance(check(one, system, BOTH), Accepted)


def test_no_closed_set_no_certificate() -> None:
    count, bad = var("count", integer(0, 3)), flag("bad")
    system = TransitionSystem("", (), (), (count, bad), (), (Assign(bad, count == 3),))
    kept = closed_set([count], [{"count": 0}])
    for found in (Exhausted(1, 1, 1, ("count",)), Exhausted(1, 1, 1, ("count",), True, kept)):
        assert certificates(system, [bad], {"bad": Unreachable(found)}, "explicit") == []


# --- wrong ones ----------------------------------------------------------------------------------


@many
@given(proofs(), st.data())
def test_a_set_with_a_valuation_less_is_rejected(
    drawn: tuple[TransitionSystem, Certificate], data: DataObject
) -> None:
    system, one = drawn
    wanted = (*goals(system), system.var("never"))
    rows = reachable(system, wanted)
    lost = data.draw(st.sampled_from(sorted(rows, key=str)))
    places = closed_set([system.var(n) for n in one.about], [r for r in rows if r != lost])
    assume(len(rows) > 1)
    forged = with_invariant(one, system, diagram(places))
    assert isinstance(check(forged, system, SOLVER), Rejected)
    assert not isinstance(check(forged, system, ENUMERATION), Accepted)


@many
@given(proofs(), st.data())
def test_a_changed_diagram_is_accepted_only_if_it_is_inductive(
    drawn: tuple[TransitionSystem, Certificate], data: DataObject
) -> None:
    system, one = drawn
    found = one.invariant
    assert isinstance(found, CertifiedDiagram)
    assume(found.nodes)
    at = data.draw(st.integers(0, len(found.nodes) - 1))
    edges = list(found.nodes[at].edges)
    which = data.draw(st.integers(0, len(edges) - 1))
    low, high, to = edges[which]
    kind = data.draw(st.sampled_from(["drop", "lead elsewhere", "shorten", "lengthen"]))
    match kind:
        case "drop":
            del edges[which]
        case "lead elsewhere":
            edges[which] = low, high, data.draw(st.integers(0, at))
        case "shorten":
            edges[which] = low, high - 1, to
        case "lengthen":
            edges[which] = low, high + 1, to
    nodes = (*found.nodes[:at], CertifiedNode(found.nodes[at].variable, tuple(edges)), *found.nodes[at + 1 :])
    forged = replace(one, invariant=replace(found, nodes=Nodes.of(nodes)))
    outcome = check(forged, system, BOTH)
    try:
        really = inductive(forged, system)
    except KeyError:  # asks for what is not there
        really = False
    if isinstance(outcome, Accepted):
        assert really
    elif really:  # the set is right, but written in a way that has no meaning
        assert isinstance(outcome, Rejected) and outcome.obligation == "invariant"


@many
@given(proofs())
def test_a_claim_that_a_run_refutes_is_rejected(drawn: tuple[TransitionSystem, Certificate]) -> None:
    system, one = drawn
    wanted = goals(system)
    reached = search(system, wanted).reached
    assume(reached)
    forged = asked_anew(replace(one, claims=(*one.claims, min(reached))), system)
    for effort in (SOLVER, BOTH):
        outcome = check(forged, system, effort)
        assert isinstance(outcome, Rejected) and outcome.obligation == "safety"
        assert min(reached) in outcome.shown


@many
@given(proofs(), proofs())
def test_a_certificate_is_about_one_system(
    first: tuple[TransitionSystem, Certificate], second: tuple[TransitionSystem, Certificate]
) -> None:
    (system, one), (_, other) = first, second
    assume(one.text != other.text)
    outcome = check(other, system, SOLVER)
    assert isinstance(outcome, Rejected) and outcome.obligation == "question"


@many
@given(proofs(), st.data())
def test_another_text_of_the_question_is_rejected(
    drawn: tuple[TransitionSystem, Certificate], data: DataObject
) -> None:
    system, one = drawn
    lines = one.text.splitlines(keepends=True)
    del lines[data.draw(st.integers(0, len(lines) - 1))]
    outcome = check(replace(one, text="".join(lines)), system, SOLVER)
    assert isinstance(outcome, Rejected) and outcome.obligation == "question"


def test_an_assumption_that_is_used_cannot_be_dropped() -> None:
    go, far, never = flag("go"), var("far", integer(0, 3)), flag("never")
    program = (If(go, (Assign(far, minimum(far + 1, 3)),)), Assign(never, far == 3))
    system = TransitionSystem("", (go,), (), (far, never), (), program, ~go)
    (one,) = certified(system, [never])
    assert isinstance(check(one, system, BOTH), Accepted)
    freed = asked_anew(replace(one, kept=()), system)
    assert isinstance(check(freed, system, SOLVER), Rejected)
    assert isinstance(check(freed, system, ENUMERATION), Rejected)
    assert isinstance(check(one, replace(system, assume=TRUE), BOTH), Rejected)
