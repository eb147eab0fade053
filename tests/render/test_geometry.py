"""Nothing that must be read lies under something else."""

from itertools import combinations, pairwise

import pytest

from checker.render.drawing.graph import Point
from checker.render.drawing.nested import picture
from checker.render.drawing.picture import Box, Picture, Piece
from checker.render.drawing.text import LINE, block, width, wrap
from spec_model.rover import charts
from tests.render.zoo import CHARTS

Rectangle = tuple[int, int, int, int]
"""Left, top, right, bottom."""


EVERY = {**CHARTS, **charts()}


@pytest.fixture(params=EVERY, scope="module")
def drawn(request: pytest.FixtureRequest) -> Picture:
    return picture(EVERY[request.param])


def label(piece: Piece) -> Rectangle:
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


def test_labels_lie_apart(drawn: Picture) -> None:
    labels = [label(p) for p in drawn.pieces if p.lines]
    assert not [(a, b) for a, b in combinations(labels, 2) if overlap(a, b)]


def test_labels_lie_beside_boxes(drawn: Picture) -> None:
    labels = [label(p) for p in drawn.pieces if p.lines]
    assert not [(a, b.path) for a in labels for b in drawn.boxes if overlap(a, opaque(b))]


def test_lines_run_beside_labels(drawn: Picture) -> None:
    lines = [line for p in drawn.pieces for line in pairwise(p.points)]
    labels = [label(p) for p in drawn.pieces if p.lines]
    assert not [(line, area) for line in lines for area in labels if crosses(line, area)]


def test_lines_run_around_simple_states(drawn: Picture) -> None:
    lines = [line for p in drawn.pieces for line in pairwise(p.points)]
    inner = [
        (b.x + 1, b.y + 1, b.x + b.width - 1, b.y + b.height - 1) for b in drawn.boxes if not b.composite
    ]
    assert not [(line, area) for line in lines for area in inner if crosses(line, area)]


def test_states_lie_in_their_parents_and_apart(drawn: Picture) -> None:
    box = {b.path: b for b in drawn.boxes}
    for path, b in box.items():
        if path[:-1]:
            outer = box[path[:-1]]
            assert outer.x < b.x and b.x + b.width < outer.x + outer.width
            assert outer.y < b.y and b.y + b.height < outer.y + outer.height
    siblings = [(a, b) for a, b in combinations(box.values(), 2) if a.path[:-1] == b.path[:-1]]
    area = {b.path: (b.x, b.y, b.x + b.width, b.y + b.height) for b in box.values()}
    assert not [(a.path, b.path) for a, b in siblings if overlap(area[a.path], area[b.path])]


def test_everything_lies_on_the_page(drawn: Picture) -> None:
    for piece in drawn.pieces:
        assert all(0 <= x <= drawn.width and 0 <= y <= drawn.height for x, y in piece.points)
        assert not piece.lines or label(piece)[2] <= drawn.width


def test_pieces_of_an_arrow_meet(drawn: Picture) -> None:
    names = {p.arrow.name for p in drawn.pieces}
    for name in names:
        pieces = [p for p in drawn.pieces if p.arrow.name == name]
        assert sum(p.starts for p in pieces) == sum(p.ends for p in pieces) == 1
        starts, ends = {p.points[0] for p in pieces}, {p.points[-1] for p in pieces}
        assert len(starts & ends) == len(pieces) - 1


def test_wrapping_keeps_words_and_indents() -> None:
    assert wrap("  a || b && c", 5, "  ") == ("  a", "    || b", "    && c")
    assert wrap("", 5) == ()
    assert " ".join(wrap("one two three four", 9)) == "one two three four"
