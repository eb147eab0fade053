"""Decision diagrams of sets of states: exact, reduced, and never trusting a hash."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.strategies import DrawFn

from rovercheck.checker.certify import reduction
from rovercheck.checker.certify.diagram import CertifiedDiagram, Nodes, count, members
from rovercheck.checker.results.closed_set import BitPlace, ClosedSet
from rovercheck.spec_model.lang.expr import Var
from tests.certifying import closed_set
from tests.naive import vectors
from tests.strategies_ts import DOMAINS

Row = tuple[int, ...]


@st.composite
def sets(draw: DrawFn) -> tuple[tuple[Var, ...], set[Row]]:
    """Up to five variables and some states of them, at least one."""
    domains = draw(st.lists(st.sampled_from(DOMAINS), min_size=1, max_size=5))
    variables = tuple(Var(f"x{i}", d, d.low) for i, d in enumerate(domains))
    row = st.tuples(*(st.sampled_from(list(d.values)) for d in domains))
    rows: set[Row] = draw(st.sets(row, min_size=1, max_size=60))
    return variables, rows


def made(variables: tuple[Var, ...], rows: set[Row]) -> CertifiedDiagram:
    names = [v.name for v in variables]
    return reduction.diagram(closed_set(variables, [dict(zip(names, r, strict=True)) for r in rows]))


def holds_exactly(found: CertifiedDiagram, variables: tuple[Var, ...], rows: set[Row]) -> None:
    for at in vectors(variables):
        assert (at in found) == (tuple(at.values()) in rows)
    by_name = {v.name: v.domain for v in variables}
    domains = [by_name[name] for name in found.variables]
    assert count(found, domains) == len(rows)
    listed = [tuple(at[v.name] for v in variables) for at in members(found, domains)]
    assert len(listed) == len(rows) and set(listed) == rows


@given(sets())
def test_a_diagram_holds_exactly_the_set(drawn: tuple[tuple[Var, ...], set[Row]]) -> None:
    variables, rows = drawn
    holds_exactly(made(variables, rows), variables, rows)


@given(sets())
def test_a_diagram_is_reduced(drawn: tuple[tuple[Var, ...], set[Row]]) -> None:
    found = made(*drawn)
    domains = {v.name: v.domain for v in drawn[0]}
    assert len(set(found.nodes)) == len(found.nodes)
    for number, node in enumerate(found.nodes, 1):
        assert all(to < number for _, _, to in node.edges)
        for (_, high, to), (low, _, other) in zip(node.edges, node.edges[1:], strict=False):
            assert high < low and not (high + 1 == low and to == other)
        asked = domains[found.variables[node.variable]]
        assert len(node.edges) > 1 or node.edges[0][:2] != (asked.low, asked.high) or not asked.dense


@given(sets(), st.integers(1, 3))
def test_a_weak_hash_does_no_harm(drawn: tuple[tuple[Var, ...], set[Row]], weak: int) -> None:
    variables, rows = drawn
    strong = reduction._mixed

    def colliding(values: reduction.Codes, child: reduction.Codes, seed: int) -> reduction.Words:
        return strong(values, child, seed) if seed >= weak else np.ones(len(values), dtype=np.uint64)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(reduction, "_mixed", colliding)
        holds_exactly(made(variables, rows), variables, rows)


def test_packed_words_with_strides() -> None:
    by_twenty = Var("level", DOMAINS[-1], 0)
    sparse = Var("odd", DOMAINS[-2], 0)
    places = (BitPlace(sparse, 0, 3, 6, 1, -7), BitPlace(by_twenty, 0, 0, 2, 20, 0))
    rows: set[Row] = {(30, 60), (-7, 0), (0, 20), (1, 40), (30, 40)}
    words = [[(odd + 7) << 3 | level // 20] for odd, level in rows]
    found = reduction.diagram(ClosedSet(places, np.array(words, dtype=np.uint64)))
    holds_exactly(found, (sparse, by_twenty), rows)


def test_a_large_set_of_few_shapes_is_a_small_diagram() -> None:
    count_ = Var("count", DOMAINS[3], 0)
    rows = np.arange(4**9, dtype=np.uint64).reshape(-1, 1)
    places = tuple(BitPlace(Var(f"x{i}", count_.domain, 0), 0, 2 * i, 2, 1, 0) for i in range(9))
    assert reduction.diagram(ClosedSet(places, rows)).nodes == Nodes.of(())
    odd = reduction.diagram(ClosedSet(places, rows[rows[:, 0] % 4 == 3]))
    assert len(odd.nodes) == 1
