"""Certificates are accepted when they prove their claims, and rejected when anything in them is wrong."""

from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise

import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st
from hypothesis.strategies import DataObject, DrawFn

from checker.certify import solver
from checker.certify.certificate import Certificate, certificate, certificates, document
from checker.certify.check import check
from checker.certify.diagram import Diagram, Node
from checker.certify.invariant import Conjuncts
from checker.certify.outcome import Accepted, Rejected, Undecided
from checker.certify.question import question
from checker.certify.reduction import diagram
from checker.certify.tick import executed
from checker.closed import ClosedSet
from checker.verdict import Exhausted, Inductive, Unreachable
from spec_model.lang.action import Assign, If
from spec_model.lang.domain import integer
from spec_model.lang.evaluate import admissible, step
from spec_model.lang.expr import TRUE, Expr, Var, all_of, const, flag, ite, var
from spec_model.lang.system import TransitionSystem
from spec_model.lang.words import minimum
from tests.certifying import BOTH, ENUMERATION, SOLVER, certified, closed_set, inline, reachable
from tests.naive import search, vectors
from tests.strategies_ts import goals, transition_systems


@pytest.fixture(autouse=True, scope="module")
def in_this_process() -> Iterator[None]:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(solver, "messages", inline)
        yield


many = settings(max_examples=50, suppress_health_check=[HealthCheck.filter_too_much, HealthCheck.too_slow])


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


def with_invariant(one: Certificate, system: TransitionSystem, invariant: Diagram | Conjuncts) -> Certificate:
    return asked_anew(replace(one, invariant=invariant), system)


def asked_anew(one: Certificate, system: TransitionSystem) -> Certificate:
    """What a forger writes: text and digest that fit what is claimed."""
    found = question(executed(system), one.claims, one.kept, one.about)
    return replace(one, text=found.text, digest=found.digest)


def inductive(one: Certificate, system: TransitionSystem) -> bool:
    """Whether the diagram really proves the claims: initial, closed, free of them; by definition."""
    found = one.invariant
    assert isinstance(found, Diagram)
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
    assert isinstance(found, Diagram)
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
    nodes = (*found.nodes[:at], Node(found.nodes[at].variable, tuple(edges)), *found.nodes[at + 1 :])
    forged = replace(one, invariant=replace(found, nodes=nodes))
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


# --- each obligation alone -----------------------------------------------------------------------


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


def rejected_for(one: Certificate, system: TransitionSystem, obligation: str) -> None:
    outcome = check(one, system, SOLVER)
    assert isinstance(outcome, Rejected) and outcome.obligation == obligation, outcome
    if not (isinstance(one.invariant, Conjuncts) and one.invariant.ticks > 1):
        outcome = check(one, system, ENUMERATION)
        assert isinstance(outcome, Rejected) and outcome.obligation == obligation, outcome


COUNT = var("count", integer(0, 7))
BACK = Assign(COUNT, ite(COUNT < 3, COUNT + 1, ite(COUNT == 3, const(0), COUNT)))
"""0 1 2 3 0 1 2 3 ...; from 4 on it stays."""


def test_an_invariant_is_accepted() -> None:
    system, bad = counting((BACK,), COUNT)
    for one in (claimed(system, bad, COUNT <= 3), claimed(system, bad, COUNT < 5, ~(COUNT == 4))):
        assert check(one, system, SOLVER) == Accepted(f"4 obligations by {solver.NAME}")
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


# --- conjuncts that are altered ------------------------------------------------------------------


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
        Conjuncts(("(define-fun |:c0@0| () Bool (bvslt |count@0| (_ bv1 9)))",), ("|:c0@0|",)),
        Diagram(("count", "count"), (), 0),
        Diagram(("unheard",), (), 0),
        Diagram(("count",), (), 1),
        Diagram(("count",), (), -1),
        Diagram(("count",), (Node(1, ((0, 3, 0),)),), 1),
        Diagram(("count",), (Node(0, ((0, 3, 1),)),), 1),
        Diagram(("count",), (Node(0, ((3, 0, 0),)),), 1),
        Diagram(("count",), (Node(0, ((0, 99, 0),)),), 1),
        Diagram(("count",), (Node(0, ((0, 3, 0), (2, 5, 0))),), 1),
        Diagram(("count",), (Node(0, ((0, 3, 0),)), Node(0, ((0, 3, 1),))), 2),
    ],
)
def test_what_has_no_meaning_is_rejected(changed: Conjuncts | Diagram) -> None:
    system, bad = counting((BACK,), COUNT)
    one = claimed(system, bad, COUNT <= 3)
    outcome = check(replace(one, invariant=changed), system, BOTH)
    assert isinstance(outcome, Rejected) and outcome.obligation == "invariant", outcome


def test_names_and_positions_that_do_not_exist_are_rejected() -> None:
    system, bad = counting((BACK,), COUNT)
    one = claimed(system, bad, COUNT <= 3)
    for forged in (
        replace(one, claims=("unheard",)),
        replace(one, claims=()),
        replace(one, kept=(0,)),
        replace(one, kept=(-1,)),
        replace(one, about=("unheard",)),
    ):
        outcome = check(forged, system, BOTH)
        assert isinstance(outcome, Rejected) and outcome.obligation == "question"


def test_what_is_too_much_to_enumerate_is_undecided() -> None:
    wide = tuple(var(f"w{i}", integer(0, 99)) for i in range(4))
    never = flag("never")
    moved = tuple(Assign(a, b) for a, b in pairwise(wide))
    program = (*moved, Assign(never, all_of(*(w > 99 for w in wide))))
    system = TransitionSystem("", (), (), (*wide, never), (), program)
    one = claimed(system, never, TRUE)
    assert isinstance(check(one, system, ENUMERATION), Undecided)
    assert isinstance(check(one, system, BOTH), Accepted)
