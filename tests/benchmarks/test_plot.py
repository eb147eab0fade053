"""The pictures of the benchmarks: every line has its name, and no name lies over another."""

from collections.abc import Mapping, Sequence
from itertools import combinations, pairwise
from xml.etree import ElementTree

import pytest
from hypothesis import given
from hypothesis import strategies as st

from benchmarks.growth import SCALES, SEARCH, pictured, symbolic
from benchmarks.labels import HEIGHT, SIZE, Box, labels
from benchmarks.measure import Sample
from benchmarks.plot import Series, plot
from rovercheck.checker.engines import engines
from rovercheck.checker.render.drawing.text import width

SVG = "{http://www.w3.org/2000/svg}"
TOOLS = (SEARCH, *sorted(engines()), "ABC pdr", "ABC bmc3", "Z3", "SPIN")
GROUND = Box(0, 0, 500, 300)

Line = Sequence[tuple[float, float]]
seconds = st.none() | st.floats(0.0005, 500)


@st.composite
def measurements(draw: st.DrawFn) -> Series:
    """Seconds of some tools for a few cases; often two tools end at nearly the same place."""
    cases = draw(st.integers(1, 7))
    names = draw(st.lists(st.sampled_from(TOOLS), min_size=1, unique=True))
    like = draw(st.lists(seconds, min_size=cases, max_size=cases))
    near = st.floats(0.9, 1.1).map(lambda f: [v and v * f for v in like])
    return {name: draw(near | st.lists(seconds, min_size=cases, max_size=cases)) for name in names}


def drawn(series: Series) -> ElementTree.Element:
    cases = [str(n) for n in range(len(next(iter(series.values()))))]
    return ElementTree.fromstring(plot("title", "cases", cases, series))


def names(picture: ElementTree.Element) -> dict[str, str]:
    """The names beside lines, with their colours."""
    texts = picture.findall(f"{SVG}text")
    return {t.text or "": t.attrib["fill"] for t in texts if t.text in TOOLS}


def boxes(picture: ElementTree.Element) -> dict[str, Box]:
    """The space that each text takes, from its attributes alone."""
    found = {}
    for text in picture.findall(f"{SVG}text"):
        written, x, y = text.text or "", float(text.attrib["x"]), float(text.attrib["y"])
        wide = width(written, SIZE, bold=text.attrib["font-weight"] == "bold")
        left = x - wide * {"start": 0, "middle": 0.5, "end": 1}[text.attrib["text-anchor"]]
        assert written not in found, "a text that is written twice"
        found[written] = Box(left, y - SIZE + 1, left + wide, y + 2)
    return found


@given(measurements())
def test_every_line_has_its_name_and_none_lies_over_another_text(series: Series) -> None:
    picture = drawn(series)
    found = boxes(picture)
    assert names(picture).keys() == {name for name, values in series.items() if any(values)}
    for one, other in combinations(found, 2):
        if one in series or other in series:
            assert not found[one].overlaps(found[other]), (one, other)
    *_, wide, high = map(float, picture.attrib["viewBox"].split())
    assert all(Box(0, 0, wide, high).contains(found[name]) for name in names(picture))


def test_the_benchmark_draws_all_that_it_measured() -> None:
    sample = Sample(0.5, 0.5, "proved", states=1000, memory=20_000)
    taken = {str(k): {tool: [sample] for tool in (SEARCH, *symbolic())} for k in SCALES}
    found = boxes(picture := ElementTree.fromstring(pictured("title", "K", taken)))
    assert names(picture).keys() == {SEARCH, *symbolic()}
    assert {str(k) for k in SCALES} <= found.keys()
    assert not any(found[one].overlaps(found[other]) for one, other in combinations(names(picture), 2))


def test_names_of_lines_that_end_together_keep_their_order() -> None:
    found = boxes(drawn({"search": [1.0, 0.30], "bdd": [1.0, 0.31], "pdr": [1.0, 0.32]}))
    assert found["pdr"].bottom <= found["bdd"].top and found["bdd"].bottom <= found["search"].top


def test_a_name_far_from_its_end_gets_a_leader() -> None:
    lines: Mapping[str, Line] = {n: [(0, 150), (300, 150)] for n in TOOLS[:5]}
    placed = labels(lines, GROUND)
    assert [p.leader is not None for p in placed] == [False, False, False, True, True]
    for label in placed:
        if label.leader:
            end, to = label.leader
            assert end == (300, 150) and label.box.nearest(end) == to


def test_a_name_avoids_the_lines() -> None:
    lines: Mapping[str, Line] = {
        "kinduction": [(0, 150), (150, 150)],
        "pdr": [(0, 150), (150, 150), (300, 120)],
        "search": [(0, 290), (150, 200), (300, 130)],
    }
    for label in labels(lines, GROUND):
        for points in lines.values():
            assert not any(label.box.meets(a, b) for a, b in pairwise(points))


def test_names_without_room_are_an_error() -> None:
    with pytest.raises(ValueError, match=r"no place is left for 'bdd'.*room"):
        labels({"search": [(0, 10)], "bdd": [(0, 10)]}, Box(0, 0, 60, HEIGHT + 1))


@pytest.mark.parametrize(
    ("start", "end", "meets"),
    [
        ((0, 15), (30, 15), True),
        ((15, 0), (15, 30), True),
        ((0, 0), (30, 30), True),
        ((15, 15), (16, 16), True),
        ((0, 10), (30, 10), False),  # along an edge
        ((0, 15), (10, 15), False),  # up to an edge
        ((0, 22), (8, 30), False),
        ((30, 0), (30, 30), False),
    ],
)
def test_a_segment_meets_a_box(start: tuple[int, int], end: tuple[int, int], meets: bool) -> None:
    assert Box(10, 10, 20, 20).meets(start, end) is meets
    assert Box(10, 10, 20, 20).meets(end, start) is meets


def test_a_tool_keeps_its_colour_where_another_decided_nothing() -> None:
    all_of_them = names(drawn({"search": [1.0, 2.0], "bmc": [1.0, 3.0], "pdr": [1.0, 4.0]}))
    without = names(drawn({"search": [1.0, 2.0], "bmc": [None, None], "pdr": [1.0, 4.0]}))
    assert without == {name: colour for name, colour in all_of_them.items() if name != "bmc"}
    assert len(set(all_of_them.values())) == 3


def test_a_line_has_a_gap_where_nothing_was_decided() -> None:
    picture = drawn({"search": [1.0, 2.0, None, 3.0]})
    [line] = [p for p in picture.findall(f"{SVG}path") if p.attrib.get("fill") == "none"]
    assert line.attrib["d"].count("M") == 2 and line.attrib["d"].count("L") == 1
    assert len(picture.findall(f"{SVG}circle")) == 3
