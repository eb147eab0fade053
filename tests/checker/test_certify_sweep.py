"""Trying all valuations of a closed set at once, against trying them one by one."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from hypothesis.strategies import DataObject

import checker.certify.check as checking
from checker.certify import enumeration
from checker.certify.certificate import Certificate
from checker.certify.check import check
from checker.certify.diagram import TRUE as END
from checker.certify.diagram import Diagram, Node
from checker.certify.enumeration import enumerated
from checker.certify.outcome import Accepted, Rejected, TooMuch
from checker.certify.question import question
from checker.certify.reduction import diagram
from checker.certify.sweep import OPERATORS, Formulas, contained, levels, swept, unfolded
from checker.certify.tick import executed
from spec_model.lang.evaluate import step
from spec_model.lang.expr import Var
from spec_model.lang.operators import Op
from spec_model.lang.system import TransitionSystem
from tests.certifying import BACK, BOTH, COUNT, certified, closed_set, counting, many, proofs
from tests.checker.test_certify_diagram import sets
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
    assert isinstance(found, Diagram)
    if data.draw(st.booleans()) and found.nodes:
        at = data.draw(st.integers(0, len(found.nodes) - 1))
        node = found.nodes[at]
        edges = [(low, high, data.draw(st.sampled_from([to, END]))) for low, high, to in node.edges]
        nodes = (*found.nodes[:at], Node(node.variable, tuple(edges)), *found.nodes[at + 1 :])
        found = replace(found, nodes=nodes)
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
    formulas = Formulas(system.inputs, (), executed(system).next)
    _, after = formulas(at, formulas.of_state(at))
    for name, found in after.items():
        expected = [step(system, row, {v.name: row[v.name] for v in system.inputs})[name] for row in rows]
        assert np.broadcast_to(found, 3).tolist() == expected


@given(sets(), st.data())
def test_unfolding_a_diagram_gives_its_set(
    drawn: tuple[tuple[Var, ...], set[tuple[int, ...]]], data: DataObject
) -> None:
    variables, rows = drawn
    names = [v.name for v in variables]
    found = diagram(closed_set(variables, [dict(zip(names, r, strict=True)) for r in rows]))
    asked = levels(found, {v.name: v.domain for v in variables})
    parts = [np.stack([part[n] for n in names], axis=1) for part in unfolded(found.root, asked)]
    assert sorted(map(tuple, np.concatenate(parts).tolist())) == sorted(rows)
    others = list(vectors(variables))
    columns_ = {n: np.array([at[n] for at in others]) for n in names}
    assert contained(found.root, asked, columns_).tolist() == [tuple(at.values()) in rows for at in others]


def test_every_operator_is_evaluated_on_columns() -> None:
    assert set(Op) == OPERATORS


def test_a_large_diagram_is_swept() -> None:
    system, bad = counting((BACK,), COUNT)
    (one,) = certified(system, [bad])
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(checking, "LARGE", 0)
        patch.setattr(enumeration, "MOST", 0)
        assert check(one, system, BOTH) == Accepted("4 valuations and 1 vectors of inputs tried")
        lost = replace(one, invariant=Diagram(("count",), (Node(0, ((0, 2, 0),)),), 1))
        outcome = check(lost, system, BOTH)
        assert isinstance(outcome, Rejected) and outcome.obligation == "consecution"
        assert outcome.shown == "count = 2; after 1 ticks count = 3, bad = false"
