"""One level of a chart: what takes part in its layout, and the picture made of the result."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

from checker.render.drawing.cuts import DOT, Cut, padded
from checker.render.drawing.graph import DrawnNode, Edge, PlacedNode
from checker.render.drawing.picture import Box, DrawnPicture, PicturePiece, Spot
from checker.render.drawing.placing import PITCH
from spec_model.lang.chart import Path

RADIUS = 7
SMALL = 5


def node(name: str, found: Sequence[Cut], inner: Mapping[str, DrawnPicture], upright: bool) -> DrawnNode:
    if name == DOT:
        return DrawnNode(name, 2 * SMALL, 2 * SMALL, round=True)
    if name not in inner:
        ends = [sum(c.source == name for c in found), sum(c.target == name for c in found)]
        size = (2 * RADIUS, 2 * RADIUS + PITCH * max(0, *(n - 1 for n in ends)))
        wide, high = size[::-1] if upright else size
        return DrawnNode(name, wide, high, round=True)
    child = inner[name]
    turns = {c.turn: child.ports[c.name] for c in found if c.name in child.ports}
    return DrawnNode(name, child.width, child.height, {**child.ports, **turns}, lead=child.boxes[0].y)


def turn(cut: Cut, names: Sequence[str]) -> DrawnNode:
    """The bend of a folded arrow: its label, then two lines, the upper from or to the upper state."""
    wide, high = padded(cut.lines)
    first, second = high + 3, high + 3 + PITCH
    if names.index(cut.source) > names.index(cut.target):
        first, second = second, first
    return DrawnNode(cut.turn, max(wide, 12), high + PITCH + 6, {cut.name: first, cut.turn: second})


def assembled(
    level: Path,
    found: Sequence[Cut],
    inner: Mapping[str, DrawnPicture],
    drawn: Mapping[str, Sequence[Edge]],
    placed: PlacedNode,
    upright: bool,
) -> DrawnPicture:
    boxes: list[Box] = []
    spots: list[Spot] = []
    pieces: list[PicturePiece] = []
    for name, (x, y) in placed.nodes.items():
        if name in inner:
            child = _grown(inner[name], placed.heights[name], upright).moved(x, y)
            boxes += child.boxes
            spots += child.spots
            pieces += child.pieces
        elif not name.startswith(("|", "~")):
            radius, half = SMALL if name == DOT else RADIUS, placed.heights[name] // 2
            middle = (x + half, y + radius) if upright else (x + radius, y + half)
            spots.append(Spot((*level, name), *middle, radius, name == DOT))
    for cut in found:
        if not cut.loop:
            pieces.append(_piece(cut, drawn[cut.name], placed, upright))
    ports = {c.name: placed.nodes[c.port][not upright] for c in found if c.crosses}
    return DrawnPicture(
        placed.width, placed.height, tuple(boxes), tuple(spots), tuple(pieces), ports, upright
    )


def _grown(child: DrawnPicture, extent: int, upright: bool) -> DrawnPicture:
    """The child with its frame made higher, or wider if upright, as the layout wanted it."""
    frame = child.boxes[0]
    if upright:
        return replace(child, width=extent, boxes=(replace(frame, width=extent), *child.boxes[1:]))
    frame = replace(frame, height=extent - frame.y)
    return replace(child, height=extent, boxes=(frame, *child.boxes[1:]))


def _piece(cut: Cut, drawn: Sequence[Edge], placed: PlacedNode, upright: bool) -> PicturePiece:
    if len(drawn) > 1:
        return _bent(cut, placed)
    points = placed.routes[cut.name]
    if drawn[0].tail != (cut.source or cut.port):
        points = points[::-1]
    x, y = placed.labels.get(cut.name, (0, 0))
    label = (x + 6, y + 2) if upright else (x + 5, y)
    return PicturePiece(cut.arrow, points, cut.starts, cut.ends, cut.lines, label)


def _bent(cut: Cut, placed: PlacedNode) -> PicturePiece:
    there, back = placed.routes[cut.name], placed.routes[cut.turn][::-1]
    x, y = placed.nodes[cut.turn]
    end = x + max(padded(cut.lines)[0], 12)
    points = (*there, (end, there[-1][1]), (end, back[0][1]), *back)
    return PicturePiece(cut.arrow, points, cut.starts, cut.ends, cut.lines, (x + 5, y))
