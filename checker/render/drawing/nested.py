"""Place a whole chart: every level by a layered layout of its own, parallel regions packed in rows.

An arrow that crosses the border of a composite is cut there into pieces; the composite's own layout
keeps a port on its left or right side for it.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import zip_longest

from checker.render.drawing.graph import Edge, Node, Placed, Point
from checker.render.drawing.layered import layered
from checker.render.drawing.packing import rows
from checker.render.drawing.placing import EDGE, PITCH
from checker.render.drawing.ranking import backward
from checker.render.drawing.scheme import ChartArrow, action_lines, arrows, execution_order, label_parts
from checker.render.drawing.text import LINE, block, width, wrap
from spec_model.lang.chart import Chart, Path

PAD = 16
RADIUS = 7
DOT = 5
LABEL = 34
"""Characters in a line of a label; in a line of actions there may be ``ACTION`` of them."""
ACTION = 46


@dataclass(frozen=True)
class Box:
    """A state: its rectangle, its title and action lines; ``order`` numbers a parallel region."""

    path: Path
    x: int
    y: int
    width: int
    height: int
    lines: tuple[str, ...]
    order: int
    composite: bool


@dataclass(frozen=True)
class Spot:
    """A junction (``path`` names it) or the dot at the start of a default transition."""

    path: Path
    x: int
    y: int
    radius: int
    dot: bool


@dataclass(frozen=True)
class Piece:
    """A piece of an arrow between two borders; the label (top-left corner) is on the first piece."""

    arrow: ChartArrow
    points: tuple[Point, ...]
    starts: bool
    ends: bool
    lines: tuple[str, ...] = ()
    label: Point = (0, 0)


@dataclass(frozen=True)
class Drawing:
    """Everything to be drawn, in pixels from the top left corner."""

    width: int
    height: int
    boxes: tuple[Box, ...] = ()
    spots: tuple[Spot, ...] = ()
    pieces: tuple[Piece, ...] = ()
    ports: Mapping[str, int] = field(default_factory=dict)

    def moved(self, dx: int, dy: int) -> "Drawing":
        """The same, shifted; ports are heights and shift too."""
        return replace(
            self,
            boxes=tuple(replace(b, x=b.x + dx, y=b.y + dy) for b in self.boxes),
            spots=tuple(replace(s, x=s.x + dx, y=s.y + dy) for s in self.spots),
            pieces=tuple(_moved(p, dx, dy) for p in self.pieces),
            ports={name: y + dy for name, y in self.ports.items()},
        )


def _moved(piece: Piece, dx: int, dy: int) -> Piece:
    points = tuple((x + dx, y + dy) for x, y in piece.points)
    return replace(piece, points=points, label=(piece.label[0] + dx, piece.label[1] + dy))


def drawing(chart: Chart) -> Drawing:
    """The chart with coordinates.  Raises ``ModelError`` for an arrow to an unknown name."""
    return _level(chart, arrows(chart), (), {})


Sides = Mapping[str, bool]
"""For arrows that cross the border of a composite: whether they do so on its right side."""


def _level(chart: Chart, all_arrows: Sequence[ChartArrow], level: Path, sides: Sides) -> Drawing:
    """What is inside a composite, from its top left content corner; ports at its left and right end."""
    if chart.states[level].parallel:
        return _regions(chart, all_arrows, level, sides)
    cuts = [c for c in (_cut(a, level) for a in all_arrows) if c is not None]
    names = _members(chart, level)
    back = backward(names, [(c.arrow.name, c.source, c.target) for c in cuts if c.source and c.target])
    children = {
        path: _box(chart, all_arrows, path, _child_sides(cuts, path, back))
        for path in (s for s in chart.states if s and s[:-1] == level)
    }
    nodes = _nodes(chart, level, children, cuts, sides)
    edges = [_edge(cut, cut.arrow.name in back, sides) for cut in cuts if cut.source != cut.target]
    first = [_port(c.arrow) for c in cuts if _outside(c) and not sides.get(c.arrow.name, False)]
    last = [_port(c.arrow) for c in cuts if _outside(c) and sides.get(c.arrow.name, False)]
    placed = layered(nodes, edges, first, last)
    return _assembled(chart, level, placed, children, cuts, back, sides)


@dataclass(frozen=True)
class _Cut:
    """The piece of an arrow that belongs to a level; an empty end lies on the border of the level."""

    arrow: ChartArrow
    source: str
    target: str


def _cut(arrow: ChartArrow, level: Path) -> _Cut | None:
    depth = len(level)
    start, end = (*arrow.source, "*") if arrow.default else arrow.source, arrow.target
    inside = start[:depth] == level, end[:depth] == level
    if not any(inside) or (start == level and end == level):
        return None
    source = start[depth] if inside[0] and len(start) > depth else ""
    target = end[depth] if inside[1] and len(end) > depth else ""
    whole = len(start) == len(end) == depth + 1
    if (source == target and not whole) or not (source or target):
        return None
    return _Cut(arrow, source, target)


def _outside(cut: _Cut) -> bool:
    return not (cut.source and cut.target)


def _port(arrow: ChartArrow) -> str:
    return f"|{arrow.name}"


def _members(chart: Chart, level: Path) -> list[str]:
    state = chart.states[level]
    dot = ["*"] if state.default else []
    return [*dot, *(s.name for s in state.states), *(j.name for j in state.junctions)]


def _child_sides(cuts: Sequence[_Cut], path: Path, back: set[str]) -> dict[str, bool]:
    """On which side of a child each arrow at this level meets it."""
    sides: dict[str, bool] = {}
    for cut in cuts:
        leaves, enters = cut.source == path[-1], cut.target == path[-1]
        if leaves or enters:
            sides[cut.arrow.name] = leaves != (cut.arrow.name in back)
    return sides


def _edge(cut: _Cut, back: bool, sides: Sides) -> Edge:
    name, port = cut.arrow.name, _port(cut.arrow)
    source, target = cut.source or port, cut.target or port
    if _outside(cut):
        back = sides.get(name, False) != (target == port)
    tail, head = (target, source) if back else (source, target)
    return Edge(name, tail, head, block(_label(cut)), 4 if cut.arrow.default else 1)


def _label(cut: _Cut) -> tuple[str, ...]:
    """The lines of the label on this piece: it is written where the arrow starts."""
    starts_here = bool(cut.source) and (cut.arrow.default or cut.source == cut.arrow.source[-1])
    inner = not cut.source and cut.target and not cut.arrow.default
    if not starts_here and not inner:
        return ()
    return tuple(line for part in label_parts(cut.arrow.transition) for line in wrap(part, LABEL, "  "))
