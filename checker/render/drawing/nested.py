"""Place a whole chart: every level by a layered layout of its own, parallel regions packed in rows.

An arrow that crosses the border of a composite is cut there into pieces; the composite's own layout
keeps a port on its left or right side for it.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

from checker.render.drawing.cuts import DOT, Cut, Sides, Way, cuts, edges, meetings, padded
from checker.render.drawing.graph import Edge, Node, Placed
from checker.render.drawing.layered import layered
from checker.render.drawing.packing import cost, extent, packed
from checker.render.drawing.picture import Box, Picture, Piece, Spot
from checker.render.drawing.placing import EDGE, PITCH
from checker.render.drawing.ranking import backward
from checker.render.drawing.scheme import ChartArrow, action_lines, arrows, execution_order
from checker.render.drawing.text import LINE, block, width, wrap
from spec_model.lang.chart import Chart, Path
from spec_model.lang.errors import ModelError

PAD = 16
RADIUS = 7
SMALL = 5
TITLE = 13
HEAD = 22
"""Height of a title line with its air, in pixels."""

ACTION = 62
"""Characters in a line of actions."""


@dataclass(frozen=True)
class _Sheet:
    """The chart and its arrows, which every level looks at."""

    chart: Chart
    arrows: tuple[ChartArrow, ...]


def picture(chart: Chart) -> Picture:
    """The chart with coordinates.

    Raises ``ModelError`` for an arrow to an unknown name or between parallel regions.
    """
    return _level(_Sheet(chart, arrows(chart)), (), {}, 0)


def _level(sheet: _Sheet, level: Path, sides: Sides, least: int) -> Picture:
    """What is inside a composite; arrows that cross its border end at the picture's left or right."""
    found = list(cuts(sheet.arrows, level))
    if sheet.chart.states[level].parallel:
        return _regions(sheet, level, found, sides, least)
    state = sheet.chart.states[level]
    names = [DOT] * bool(state.default) + [s.name for s in state.states] + [j.name for j in state.junctions]
    options = [_laid(sheet, level, names, found, sides, way) for way in _ways(sheet, level, names, found)]
    return min(options, key=lambda option: cost((option.width, option.height)))


def _ways(sheet: _Sheet, level: Path, names: Sequence[str], found: Sequence[Cut]) -> Iterable[Way]:
    """The ways of drawing a level that are worth trying."""
    states = sheet.chart.states
    inside = [c for c in found if not c.crosses and not c.loop]
    big = {s.name for s in states[level].states if s.states}
    between = frozenset(c.name for c in inside if {c.source, c.target} <= big)
    ways: dict[Way, None] = {}
    for folded in dict.fromkeys([frozenset[str](), between]):
        straight = [(c.name, c.source, c.target) for c in inside if c.name not in folded]
        for breadth in (False, True):
            ways[Way(backward(names, straight, breadth), folded)] = None
    return ways


def _laid(
    sheet: _Sheet, level: Path, names: Sequence[str], found: Sequence[Cut], sides: Sides, way: Way
) -> Picture:
    """A level of exclusive states, drawn in the way given."""
    inner = {s.name: _child(sheet, (*level, s.name), found, way) for s in sheet.chart.states[level].states}
    nodes = [_node(name, found, inner) for name in names]
    lines = [c for c in found if not c.loop]
    drawn = {c.name: edges(c, way, sides) for c in lines}
    ports = [c for c in lines if c.crosses]
    nodes += [Node(c.port, 0, 0, {c.name: 0}) for c in ports]
    nodes += [_turn(c, names) for c in lines if c.name in way.folded]
    left = [c.port for c in ports if drawn[c.name][0].tail == c.port]
    right = [c.port for c in ports if drawn[c.name][0].head == c.port]
    placed = layered(nodes, [e for pair in drawn.values() for e in pair], left, right)
    return _assembled(level, found, inner, drawn, placed)


def _node(name: str, found: Sequence[Cut], inner: Mapping[str, Picture]) -> Node:
    if name == DOT:
        return Node(name, 2 * SMALL, 2 * SMALL, round=True)
    if name not in inner:
        ends = [sum(c.source == name for c in found), sum(c.target == name for c in found)]
        high = 2 * RADIUS + PITCH * max(0, *(n - 1 for n in ends))
        return Node(name, 2 * RADIUS, high, round=True)
    child = inner[name]
    turns = {c.turn: child.ports[c.name] for c in found if c.name in child.ports}
    return Node(name, child.width, child.height, {**child.ports, **turns}, lead=child.boxes[0].y)


def _turn(cut: Cut, names: Sequence[str]) -> Node:
    """The bend of a folded arrow: its label, then two lines, the upper from or to the upper state."""
    wide, high = padded(cut.lines)
    first, second = high + 3, high + 3 + PITCH
    if names.index(cut.source) > names.index(cut.target):
        first, second = second, first
    return Node(cut.turn, max(wide, 12), high + PITCH + 6, {cut.name: first, cut.turn: second})


def _assembled(
    level: Path,
    found: Sequence[Cut],
    inner: Mapping[str, Picture],
    drawn: Mapping[str, Sequence[Edge]],
    placed: Placed,
) -> Picture:
    boxes: list[Box] = []
    spots: list[Spot] = []
    pieces: list[Piece] = []
    for name, (x, y) in placed.nodes.items():
        if name in inner:
            child = _higher(inner[name], placed.heights[name]).moved(x, y)
            boxes += child.boxes
            spots += child.spots
            pieces += child.pieces
        elif not name.startswith(("|", "~")):
            radius = SMALL if name == DOT else RADIUS
            middle = y + placed.heights[name] // 2
            spots.append(Spot((*level, name), x + radius, middle, radius, name == DOT))
    for cut in found:
        if not cut.loop:
            pieces.append(_piece(cut, drawn[cut.name], placed))
    ports = {c.name: placed.nodes[c.port][1] for c in found if c.crosses}
    return Picture(placed.width, placed.height, tuple(boxes), tuple(spots), tuple(pieces), ports)


def _higher(child: Picture, height: int) -> Picture:
    """The child with its frame made higher, as the layout wanted it."""
    frame = child.boxes[0]
    frame = replace(frame, height=height - frame.y)
    return replace(child, height=height, boxes=(frame, *child.boxes[1:]))


def _piece(cut: Cut, drawn: Sequence[Edge], placed: Placed) -> Piece:
    if len(drawn) > 1:
        return _bent(cut, placed)
    points = placed.routes[cut.name]
    if drawn[0].tail != (cut.source or cut.port):
        points = points[::-1]
    x, y = placed.labels.get(cut.name, (0, 0))
    return Piece(cut.arrow, points, cut.starts, cut.ends, cut.lines, (x + 5, y))


def _bent(cut: Cut, placed: Placed) -> Piece:
    there, back = placed.routes[cut.name], placed.routes[cut.turn][::-1]
    x, y = placed.nodes[cut.turn]
    end = x + max(padded(cut.lines)[0], 12)
    points = (*there, (end, there[-1][1]), (end, back[0][1]), *back)
    return Piece(cut.arrow, points, cut.starts, cut.ends, cut.lines, (x + 5, y))


def _child(sheet: _Sheet, path: Path, found: Sequence[Cut], way: Way) -> Picture:
    """A state's box with everything in it and its self loops above it."""
    sides = meetings(found, path[-1], way)
    loops = [c for c in found if c.loop and c.source == path[-1]]
    least = max((padded(c.lines)[0] + 50 for c in loops), default=0)
    box = _box(sheet, path, sides, least)
    return _looped(box, loops) if loops else box


def _box(sheet: _Sheet, path: Path, sides: Sides, least: int = 0) -> Picture:
    """A state's box, its frame first, with ports for the arrows that go on inside."""
    state = sheet.chart.states[path]
    lines = tuple(x for line in action_lines(state) for x in wrap(line, ACTION, "    "))
    wide = max(width(path[-1], TITLE, bold=True) + 30, block(lines)[0], 60 - 2 * PAD, least - 2 * PAD)
    head = HEAD + LINE * len(lines) + (4 if lines else 0)
    if not state.states:
        high = max(head + 6, 36)
        frame = Box(path, 0, 0, wide + 2 * PAD, high, lines, execution_order(sheet.chart, path), False)
        return Picture(frame.width, high, (frame,))
    content = _level(sheet, path, sides, wide)
    free = [side for name, side in sides.items() if name not in content.ports]
    head = max(head + 8, EDGE + PITCH * max(free.count(True), free.count(False)))
    full = max(wide, content.width) + 2 * PAD
    content = content.moved(PAD, head).bordered((PAD, PAD + content.width), (0, full))
    high = head + content.height + PAD
    frame = Box(path, 0, 0, full, high, lines, execution_order(sheet.chart, path), True)
    return replace(content, width=full, height=high, boxes=(frame, *content.boxes))


def _looped(box: Picture, loops: Sequence[Cut]) -> Picture:
    """The box with arrows from it to itself over its top."""
    pieces: list[Piece] = []
    height = 0
    for inset, cut in enumerate(loops):
        wide, high = padded(cut.lines)
        height += high + 14
        left, right = 16 + 9 * inset, max(box.width - 16 - 9 * inset, 40)
        points = ((right, 0), (right, -height + high), (left, -height + high), (left, 0))
        pieces.append(Piece(cut.arrow, points, lines=cut.lines, label=(right - wide - 6, -height)))
    whole = replace(box, pieces=(*box.pieces, *pieces), height=box.height + height)
    return whole.moved(0, height)


def _regions(sheet: _Sheet, level: Path, found: Sequence[Cut], sides: Sides, least: int) -> Picture:
    """Parallel regions in rows; in one column where an arrow crosses their borders."""
    for cut in found:
        if not cut.crosses:
            raise ModelError(
                f"{sheet.chart.name}: an arrow from {'.'.join(cut.arrow.source)} to "
                f"{'.'.join(cut.arrow.target)} joins two parallel regions; send a local event instead."
            )
    crossing = {c.name: sides.get(c.name, bool(c.source)) for c in found}
    regions = []
    for state in sheet.chart.states[level].states:
        own = {c.name: crossing[c.name] for c in found if state.name in (c.source, c.target)}
        regions.append(_box(sheet, (*level, state.name), own))
    cells = packed([(r.width, r.height) for r in regions], PAD, least, one_column=bool(found))
    grown = [
        _sized(region, size).moved(*corner) for region, (corner, size) in zip(regions, cells, strict=True)
    ]
    wide, high = extent(cells)
    ports = {name: y for r in grown for name, y in r.ports.items()}
    return Picture(
        wide,
        high,
        tuple(b for r in grown for b in r.boxes),
        tuple(s for r in grown for s in r.spots),
        tuple(p for r in grown for p in r.pieces),
        ports,
    )


def _sized(region: Picture, size: tuple[int, int]) -> Picture:
    wider = region.bordered((0, region.width), (0, size[0]))
    frame = replace(region.boxes[0], width=size[0], height=size[1])
    return replace(wider, width=size[0], height=size[1], boxes=(frame, *region.boxes[1:]))
