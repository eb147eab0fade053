"""Nothing that must be read lies under something else."""

import re
from collections.abc import Iterator
from itertools import combinations, pairwise
from xml.etree import ElementTree

import pytest

from rovercheck.checker.render import statechart_svg
from rovercheck.checker.render.drawing.graph import Point
from rovercheck.checker.render.drawing.nested_layout import picture
from rovercheck.checker.render.drawing.picture import Box, DrawnPicture, PicturePiece
from rovercheck.checker.render.drawing.text import LINE, SIZE, block, width, wrap
from rovercheck.spec_model.lang.system import charts_of
from rovercheck.spec_model.rover import systems
from tests.render.zoo import CHARTS

SVG = "{http://www.w3.org/2000/svg}"
Rectangle = tuple[int, int, int, int]
"""Left, top, right, bottom."""


EVERY = {**CHARTS, **charts_of(systems())}


@pytest.fixture(params=EVERY, scope="module")
def drawn(request: pytest.FixtureRequest) -> DrawnPicture:
    return picture(EVERY[request.param])


def label(piece: PicturePiece) -> Rectangle:
    (x, y), (wide, high) = piece.label, block(piece.lines)
    return x, y, x + wide, y + high


def opaque(box: Box) -> Rectangle:
    """What of a box is taken: all of a simple one, the heading of a composite."""
    high = 22 + LINE * len(box.lines) if box.composite else box.height
    wide = (
        box.width if not box.composite else max(width(box.path[-1], 13, bold=True), block(box.lines)[0]) + 12
    )
    return box.x, box.y, box.x + wide, box.y + high


def overlap(a: Rectangle, b: Rectangle) -> bool:
    return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]


def crosses(line: tuple[Point, Point], area: Rectangle) -> bool:
    (x0, y0), (x1, y1) = line
    return overlap((min(x0, x1), min(y0, y1), max(x0, x1) + 1, max(y0, y1) + 1), area)


def test_labels_lie_apart(drawn: DrawnPicture) -> None:
    labels = [label(p) for p in drawn.pieces if p.lines]
    assert not [(a, b) for a, b in combinations(labels, 2) if overlap(a, b)]


def test_labels_lie_beside_boxes(drawn: DrawnPicture) -> None:
    labels = [label(p) for p in drawn.pieces if p.lines]
    assert not [(a, b.path) for a in labels for b in drawn.boxes if overlap(a, opaque(b))]


def test_lines_run_beside_labels(drawn: DrawnPicture) -> None:
    lines = [line for p in drawn.pieces for line in pairwise(p.points)]
    labels = [label(p) for p in drawn.pieces if p.lines]
    assert not [(line, area) for line in lines for area in labels if crosses(line, area)]


def test_lines_run_around_simple_states(drawn: DrawnPicture) -> None:
    lines = [line for p in drawn.pieces for line in pairwise(p.points)]
    inner = [
        (b.x + 1, b.y + 1, b.x + b.width - 1, b.y + b.height - 1) for b in drawn.boxes if not b.composite
    ]
    assert not [(line, area) for line in lines for area in inner if crosses(line, area)]


def test_states_lie_in_their_parents_and_apart(drawn: DrawnPicture) -> None:
    box = {b.path: b for b in drawn.boxes}
    for path, b in box.items():
        if path[:-1]:
            outer = box[path[:-1]]
            assert outer.x < b.x and b.x + b.width < outer.x + outer.width
            assert outer.y < b.y and b.y + b.height < outer.y + outer.height
    siblings = [(a, b) for a, b in combinations(box.values(), 2) if a.path[:-1] == b.path[:-1]]
    area = {b.path: (b.x, b.y, b.x + b.width, b.y + b.height) for b in box.values()}
    assert not [(a.path, b.path) for a, b in siblings if overlap(area[a.path], area[b.path])]


def test_everything_lies_on_the_page(drawn: DrawnPicture) -> None:
    for piece in drawn.pieces:
        assert all(0 <= x <= drawn.width and 0 <= y <= drawn.height for x, y in piece.points)
        assert not piece.lines or label(piece)[2] <= drawn.width


def test_pieces_of_an_arrow_meet(drawn: DrawnPicture) -> None:
    names = {p.arrow.name for p in drawn.pieces}
    for name in names:
        pieces = [p for p in drawn.pieces if p.arrow.name == name]
        assert sum(p.starts for p in pieces) == sum(p.ends for p in pieces) == 1
        starts, ends = {p.points[0] for p in pieces}, {p.points[-1] for p in pieces}
        assert len(starts & ends) == len(pieces) - 1


def test_wrapping_keeps_words_and_indents() -> None:
    assert wrap("  a || b && c", 5, "  ") == ("  a", "    || b", "    && c")
    assert wrap("", 5) == ()
    assert wrap("[now - then > 120 ms && it == HERE]", 14, "  ") == (
        "[now - then",
        "  > 120 ms",
        "  && it",
        "  == HERE]",
    )
    assert " ".join(wrap("one two three four", 9)) == "one two three four"


LETTERS = {"chart": 17, "title": 13, "order": 12, "number": 10}
"""Heights of letters in pixels by class; all other texts have the usual one."""


@pytest.fixture(params=EVERY, scope="module")
def svg(request: pytest.FixtureRequest) -> ElementTree.Element:
    return ElementTree.fromstring(statechart_svg.render(EVERY[request.param]))


def texts(svg: ElementTree.Element) -> list[tuple[str, Rectangle]]:
    """Each text with the area of its letters."""
    found = []
    for text in svg.iter(f"{SVG}text"):
        size, words = LETTERS.get(text.get("class", ""), SIZE), "".join(text.itertext())
        x, y = (round(float(text.get(name, ""))) for name in "xy")
        wide = width(words, size, bold=text.get("class") in ("chart", "title"))
        found.append((words, (x, y - 3 * size // 4, x + wide, y + size // 5)))
    return found


def lines(svg: ElementTree.Element) -> Iterator[tuple[Point, Point]]:
    """The straight pieces of all arrows, those that slant cut into short ones."""
    for path in svg.iter(f"{SVG}path"):
        if path.get("class") == "line":
            points = [(float(x), float(y)) for x, y in re.findall(r"([\d.]+) ([\d.]+)", path.get("d", ""))]
            for (x0, y0), (x1, y1) in pairwise(points):
                cuts = 1 if x0 == x1 or y0 == y1 else 8
                at = [
                    (round(x0 + (x1 - x0) * k / cuts), round(y0 + (y1 - y0) * k / cuts))
                    for k in range(cuts + 1)
                ]
                yield from pairwise(at)


def clashes(written: list[tuple[str, Rectangle]]) -> list[tuple[str, str]]:
    return [(a, b) for (a, here), (b, there) in combinations(written, 2) if overlap(here, there)]


def test_no_text_lies_on_another(svg: ElementTree.Element) -> None:
    written = texts(svg)
    assert not clashes(written)
    moved = (written[0][0], written[-1][1])
    assert clashes([moved, *written[1:]]), "the check sees a text that is moved onto another"


def test_no_line_runs_through_a_text(svg: ElementTree.Element) -> None:
    drawn = list(lines(svg))
    assert not [(words, line) for words, area in texts(svg) for line in drawn if crosses(line, area)]


def test_the_picture_holds_every_text_and_fits_a_window(svg: ElementTree.Element) -> None:
    wide, high = (int(svg.get(name, "")) for name in ("width", "height"))
    assert all(x >= 0 and y >= 0 and right <= wide and low <= high for _, (x, y, right, low) in texts(svg))
    assert wide <= 1280
