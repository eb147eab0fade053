"""The layered layout and the linear programme behind it, against brute force on small cases."""

from itertools import product

from hypothesis import given, settings
from hypothesis import strategies as st

from rovercheck.checker.render.drawing.graph import DrawnNode, Edge
from rovercheck.checker.render.drawing.layered_layout import layered
from rovercheck.checker.render.drawing.min_cost_flow import least_stretch
from rovercheck.checker.render.drawing.ranks import backward
from tests.profiles import examples

SIZE = 4
bounds = st.lists(
    st.tuples(
        st.integers(0, SIZE - 2), st.integers(1, SIZE - 1), st.integers(0, 2), st.integers(0, 3)
    ).filter(lambda b: b[0] < b[1]),
    min_size=1,
    max_size=6,
)


def stretch(values: tuple[int, ...] | list[int], given: list[tuple[int, int, int, int]]) -> int:
    return sum(w * (values[v] - values[u]) for u, v, _, w in given)


@examples(60)
@given(bounds)
def test_least_stretch_is_least(given: list[tuple[int, int, int, int]]) -> None:
    found = least_stretch(SIZE, given)
    assert all(found[v] - found[u] >= gap for u, v, gap, _ in given)
    fitting = [v for v in product(range(7), repeat=SIZE) if all(v[b] - v[a] >= gap for a, b, gap, _ in given)]
    assert stretch(found, given) == min(stretch(v, given) for v in fitting)


arrow_lists = st.lists(st.tuples(st.integers(0, 6), st.integers(0, 6)), max_size=14)


@settings(examples(60), deadline=None)
@given(arrow_lists, st.booleans())
def test_any_graph_gets_a_layout_without_overlaps(pairs: list[tuple[int, int]], breadth: bool) -> None:
    names = [str(i) for i in range(7)]
    arrows = [(f"e{k}", str(a), str(b)) for k, (a, b) in enumerate(pairs) if a != b]
    back = backward(names, arrows, breadth)
    edges = [Edge(n, b, a, (50, 20)) if n in back else Edge(n, a, b, (50, 20)) for n, a, b in arrows]
    placed = layered([DrawnNode(n, 40, 30) for n in names], edges)
    areas = [(x, y, x + 40, y + placed.heights[n]) for n, (x, y) in placed.nodes.items()]
    areas += [(x, y, x + 50, y + 20) for x, y in placed.labels.values()]
    for i, a in enumerate(areas):
        for b in areas[:i]:
            assert not (a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3])
    for name, source, target in arrows:
        tail, head = (target, source) if name in back else (source, target)
        route = placed.routes[name]
        assert route[0][0] == placed.nodes[tail][0] + 40 and route[-1][0] == placed.nodes[head][0]
