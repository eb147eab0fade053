"""Trying all states of a closed set at once, against trying them one by one."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from hypothesis.strategies import DataObject

import rovercheck.checker.certify.check as checking
from rovercheck.checker.certify import diagram as diagrams
from rovercheck.checker.certify import enumeration, sweep
from rovercheck.checker.certify.certificate import Certificate
from rovercheck.checker.certify.check import CheckMethod, check
from rovercheck.checker.certify.diagram import TRUE as END
from rovercheck.checker.certify.diagram import CertifiedDiagram, CertifiedNode, Nodes
from rovercheck.checker.certify.enumeration import enumerated
from rovercheck.checker.certify.outcome import Accepted, Rejected, TooMuch, Undecided
from rovercheck.checker.certify.question import question
from rovercheck.checker.certify.reduction import diagram
from rovercheck.checker.certify.sweep import Formulas, SweepRows, columns, swept
from rovercheck.checker.certify.tick import executed
from rovercheck.checker.system.intervals import postorder
from rovercheck.spec_model.lang.evaluate import step
from rovercheck.spec_model.lang.expr import Var, flag
from rovercheck.spec_model.lang.system import TransitionSystem
from tests.certify.test_certify_diagram import sets
from tests.certifying import BACK, BOTH, COUNT, certified, closed_set, counting, many, proofs
from tests.naive import vectors
from tests.strategies_ts import transition_systems


@many
@given(proofs(), st.data())
def test_sweeping_and_enumerating_agree(
    drawn: tuple[TransitionSystem, Certificate], data: DataObject
) -> None:
    """Also on a diagram in which an edge leads elsewhere."""
    system, one = drawn
    found = one.invariant
    assert isinstance(found, CertifiedDiagram)
    if data.draw(st.booleans()) and found.nodes:
        at = data.draw(st.integers(0, len(found.nodes) - 1))
        node = found.nodes[at]
        edges = [(low, high, data.draw(st.sampled_from([to, END]))) for low, high, to in node.edges]
        nodes = (*found.nodes[:at], CertifiedNode(node.variable, tuple(edges)), *found.nodes[at + 1 :])
        found = replace(found, nodes=Nodes.of(nodes))
    asked = question(executed(system), one.claims, one.kept, one.about)
    slow, fast = enumerated(system, asked, found), swept(asked, found)
    assume(not isinstance(slow, TooMuch) and not isinstance(fast, TooMuch))
    assert type(slow) is type(fast)
    if isinstance(slow, Rejected) and slow.obligation == "initiation":
        assert isinstance(fast, Rejected) and fast.obligation == "initiation"


@given(transition_systems(), st.data())
def test_columns_mean_what_the_reference_means(system: TransitionSystem, data: DataObject) -> None:
    outside = (*system.variables, *system.inputs, *system.frozen)
    rows = [{v.name: data.draw(st.sampled_from(list(v.domain.values))) for v in outside} for _ in range(3)]
    at = {v.name: np.array([row[v.name] for row in rows]) for v in outside}
    after = executed(system).next
    known = columns(postorder(*after.values()), at, {})
    for name, found in ((name, known[id(one)]) for name, one in after.items()):
        expected = [step(system, row, {v.name: row[v.name] for v in system.inputs})[name] for row in rows]
        assert np.broadcast_to(found, 3).tolist() == expected


Valuations = set[tuple[int, ...]]


def of(variables: tuple[Var, ...], rows: Valuations) -> CertifiedDiagram:
    names = [v.name for v in variables]
    return diagram(closed_set(variables, [dict(zip(names, r, strict=True)) for r in rows]))


@given(sets(), st.booleans())
def test_unfolding_a_diagram_gives_its_set(drawn: tuple[tuple[Var, ...], Valuations], narrow: bool) -> None:
    """Also in words of few bits, so that rows are looked up word by word."""
    variables, rows = drawn
    names, found = [v.name for v in variables], of(variables, rows)
    domains = {v.name: v.domain for v in variables}
    others = list(vectors(variables))
    columns = {n: np.array([at[n] for at in others]) for n in names}
    beyond = {names[0]: np.array([variables[0].domain.high + 1])}
    with pytest.MonkeyPatch.context() as patch:
        if narrow:
            patch.setattr(sweep, "FIRST_BITS", 8)
            patch.setattr(sweep, "BITS", 8)
        kept = SweepRows(found, domains, len(rows))
        parts = [np.stack([part[n] for n in names], axis=1) for part in kept]
        assert sorted(map(tuple, np.concatenate(parts).tolist())) == sorted(rows)
        assert kept.contain(columns).tolist() == [tuple(at.values()) in rows for at in others]
        assert kept.contain({n: c[:1] for n, c in columns.items()} | beyond).tolist() == [False]


@given(sets())
def test_valuations_are_counted_alike_in_either_way(drawn: tuple[tuple[Var, ...], Valuations]) -> None:
    variables, rows = drawn
    found, domains = of(variables, rows), {v.name: v.domain for v in variables}
    asked = [domains[name] for name in found.variables]
    assert diagrams.count(found, asked) == diagrams.counted(found, asked) == len(rows)


def test_paths_that_lead_to_no_valuation_are_not_followed() -> None:
    """A million million of them."""
    variables = [*(flag(f"x{i}") for i in range(40)), flag("last")]
    nodes = [CertifiedNode(40, ()), *(CertifiedNode(40 - i, ((0, 1, i),)) for i in range(1, 41))]
    found = CertifiedDiagram(tuple(v.name for v in variables), Nodes.of(nodes), 41)
    domains = {v.name: v.domain for v in variables}
    assert diagrams.count(found, list(domains.values())) == 0
    with pytest.raises(sweep.DeadEnd):
        SweepRows(found, domains, 1)


def test_a_large_diagram_is_swept() -> None:
    system, bad = counting((BACK,), COUNT)
    (one,) = certified(system, [bad])
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(checking, "LARGE", 0)
        patch.setattr(enumeration, "MOST", 0)
        assert check(one, system, BOTH) == Accepted("4 states and 1 vectors of inputs tried")
        lost = replace(
            one, invariant=CertifiedDiagram(("count",), Nodes.of([CertifiedNode(0, ((0, 2, 0),))]), 1)
        )
        outcome = check(lost, system, BOTH)
        assert isinstance(outcome, Rejected) and outcome.obligation == "consecution"
        assert outcome.shown == "count = 2; after 1 ticks count = 3, bad = false"


def test_no_solver_is_asked_about_a_large_diagram_that_is_too_much_to_try() -> None:
    """It would take its whole time; who wants that asks it alone."""
    system, bad = counting((BACK,), COUNT)
    (one,) = certified(system, [bad])
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(checking, "LARGE", 0)
        patch.setattr(enumeration, "MOST", 0)
        patch.setattr(sweep, "MOST", 0)
        too_many = "4 states and 1 vectors of inputs are too many to try"
        assert check(one, system, BOTH) == Undecided(too_many)
        assert isinstance(check(one, system, replace(BOTH, by=CheckMethod.SOLVER)), Accepted)


def test_work_is_counted_as_often_as_it_is_done() -> None:
    """What reads one input of two is evaluated for each of its values, what reads both for all pairs."""
    often, rarely, held = flag("often"), flag("rarely"), flag("held")
    both, first = often & rarely, ~often
    formulas = Formulas((rarely, often), (), {"both": both, "first": first, "held": held})
    assert formulas.work == 1 + 2 * 2 + 4 * 2  # held; often, first; rarely, both


def test_inputs_that_the_assumption_rules_out_are_not_tried() -> None:
    a, b = flag("a"), flag("b")
    formulas = Formulas((a, b), (a | b, ~b), {"next": a})
    tried = [(int(at["a"]), int(at["b"])) for at, _, _ in formulas.each({"x": np.zeros(1, dtype=np.int64)})]
    assert tried == [(1, 0)]
