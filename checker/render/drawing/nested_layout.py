"""Place a whole chart: every level by a layered layout of its own, parallel regions packed in rows.

A level is drawn from left to right, or from top to bottom where it would be too wide; a chart that still
is too wide for a page is drawn again with its texts in shorter lines.

An arrow that crosses the border of a composite is cut there into pieces; the composite's own layout
keeps a port on its left or right side for it (or above or below, if drawn from top to bottom).
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import lru_cache

from rovercheck.checker.render.drawing.cuts import DOT, Cut, CutWay, Sides, cuts, edges, meetings, padded
from rovercheck.checker.render.drawing.folding import shortened
from rovercheck.checker.render.drawing.graph import DrawnNode, Edge, PlacedNode
from rovercheck.checker.render.drawing.labels import action_lines, arrows, execution_order
from rovercheck.checker.render.drawing.layered_layout import layered
from rovercheck.checker.render.drawing.layout_options import MANNERS, Sheet, ways
from rovercheck.checker.render.drawing.packing import PackedSpan, cost, extent, packed
from rovercheck.checker.render.drawing.picture import Box, DrawnPicture, PicturePiece, Spot
from rovercheck.checker.render.drawing.placement import EDGE, PITCH
from rovercheck.checker.render.drawing.text import LINE, block, width, wrap
from rovercheck.checker.render.drawing.transpose import from_top
from rovercheck.spec_model.lang.chart import Chart, Path
from rovercheck.spec_model.lang.errors import ModelError

# --- one level of a chart ------------------------------------------------------------------------------

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


PAD = 16
TITLE = 13
HEAD = 22
"""Height of a title line with its air, in pixels."""

PAGE = 1232
"""A picture should be no wider, so that with its margins it fits into a window of 1280 pixels."""

TALL = 2000
"""A picture higher than this is worth a try with shorter lines, in pixels."""

SHORTER = 1.05
"""By how much a picture must get better for lines to be made shorter."""


@lru_cache(maxsize=64)
def picture(chart: Chart, folded: bool = False) -> DrawnPicture:
    """The chart with coordinates, in the first manner that fits a page or else the best.

    ``folded``: of long lists of actions only the beginning is drawn.

    Raises ``ModelError`` for an arrow to an unknown name or between parallel regions.
    """
    every, page = arrows(chart), PackedSpan(0, PAGE)
    tried: list[tuple[float, float, DrawnPicture]] = []
    for number, manner in enumerate(MANNERS):
        found = _level(Sheet(chart, every, manner, folded), (), {}, page, None)
        if found.width <= PAGE and found.height <= TALL:
            return found
        tried.append((page.excess(found.width), SHORTER**number * cost((found.width, found.height)), found))
    return min(tried, key=lambda option: option[:2])[2]


def _level(sheet: Sheet, level: Path, sides: Sides, span: PackedSpan, upright: bool | None) -> DrawnPicture:
    """What is inside a composite; arrows that cross its border end at the picture's left or right.

    Where there are such arrows it is drawn as what is around it, ``upright`` or not.
    """
    key = (level, *sorted(sides.items()), span, upright)
    if key not in sheet.drawn:
        sheet.drawn[key] = _best(sheet, level, sides, span, upright)
    return sheet.drawn[key]


def _best(sheet: Sheet, level: Path, sides: Sides, span: PackedSpan, upright: bool | None) -> DrawnPicture:
    """The best drawing of a level: from left to right, or where that is too wide from top to bottom."""
    found = list(cuts(sheet.arrows, level, sheet.manner.label))
    if sheet.chart.states[level].parallel:
        return _regions(sheet, level, found, sides, span)
    state = sheet.chart.states[level]
    names = [DOT] * bool(state.default) + [s.name for s in state.states] + [j.name for j in state.junctions]
    able = list(ways(sheet, level, names, found))
    turns = [bool(upright)] if any(c.crosses for c in found) else [False, True]
    options: list[DrawnPicture] = []
    for turned in turns:
        of_kind = [way for way in able if way.upright == turned]
        options += [_laid(sheet, level, names, found, sides, way, span.most) for way in of_kind]
        if any(option.width <= span.most for option in options):
            break
    return min(options, key=lambda p: (span.excess(p.width), cost((p.width, p.height))))


def _laid(
    sheet: Sheet,
    level: Path,
    names: Sequence[str],
    found: Sequence[Cut],
    sides: Sides,
    way: CutWay,
    most: int,
) -> DrawnPicture:
    """A level of exclusive states, drawn in the way given."""
    inner = {
        s.name: _child(sheet, (*level, s.name), found, way, most) for s in sheet.chart.states[level].states
    }
    nodes = [node(name, found, inner, way.upright) for name in names]
    lines = [c for c in found if not c.loop]
    drawn = {c.name: edges(c, way, sides) for c in lines}
    ports = [c for c in lines if c.crosses]
    nodes += [DrawnNode(c.port, 0, 0, {c.name: 0}) for c in ports]
    nodes += [turn(c, names) for c in lines if c.name in way.folded]
    left = [c.port for c in ports if drawn[c.name][0].tail == c.port]
    right = [c.port for c in ports if drawn[c.name][0].head == c.port]
    place = from_top if way.upright else layered
    placed = place(nodes, [e for pair in drawn.values() for e in pair], left, right)
    return assembled(level, found, inner, drawn, placed, way.upright)


def _child(sheet: Sheet, path: Path, found: Sequence[Cut], way: CutWay, most: int) -> DrawnPicture:
    """A state's box with everything in it and its self loops above it."""
    sides = meetings(found, path[-1], way)
    loops = [c for c in found if c.loop and c.source == path[-1]]
    least = max((padded(c.lines)[0] + 50 for c in loops), default=0)
    box = _box(sheet, path, sides, PackedSpan(least, most), way.upright)
    return _looped(box, loops) if loops else box


def _box(
    sheet: Sheet, path: Path, sides: Sides, span: PackedSpan, upright: bool | None = None
) -> DrawnPicture:
    """A state's box, its frame first, with ports for the arrows that go on inside."""
    state = sheet.chart.states[path]
    actions = shortened(action_lines(state)) if sheet.folded else action_lines(state)
    lines = tuple(x for line in actions for x in wrap(line, sheet.manner.action, "    "))
    wide = max(width(path[-1], TITLE, bold=True) + 30, block(lines)[0], 60 - 2 * PAD, span.least - 2 * PAD)
    head = HEAD + LINE * len(lines) + (4 if lines else 0)
    if not state.states:
        high = max(head + 6, 36)
        frame = Box(path, 0, 0, wide + 2 * PAD, high, lines, execution_order(sheet.chart, path), False)
        return DrawnPicture(frame.width, high, (frame,))
    content = _level(sheet, path, sides, PackedSpan(wide, span.most - 2 * PAD), upright)
    free = [side for name, side in sides.items() if name not in content.ports]
    meet = EDGE + PITCH * max(free.count(True), free.count(False))
    left = _inset(content, sides, wide, meet) if content.upright else PAD
    head = head + 8 if content.upright else max(head + 8, meet)
    full, high = max(wide + 2 * PAD, left + content.width + PAD), head + content.height + PAD
    content = content.moved(left, head)
    if content.upright:
        content = content.bordered((head, head + content.height), (0, high))
    else:
        content = content.bordered((left, left + content.width), (0, full))
    frame = Box(path, 0, 0, full, high, lines, execution_order(sheet.chart, path), True)
    return replace(content, width=full, height=high, boxes=(frame, *content.boxes))


def _inset(content: DrawnPicture, sides: Sides, wide: int, meet: int) -> int:
    """How far from the left content that is drawn from top to bottom lies.

    Transitions from above pass the heading on its right; those that end at the border meet it before others.
    """
    above = [wide + PAD + EDGE - at for name, at in content.ports.items() if not sides.get(name)]
    return max([PAD, *above, *(meet - at for at in content.ports.values())])


def _looped(box: DrawnPicture, loops: Sequence[Cut]) -> DrawnPicture:
    """The box with arrows from it to itself over its top."""
    pieces: list[PicturePiece] = []
    height = 0
    for inset, cut in enumerate(loops):
        wide, high = padded(cut.lines)
        height += high + 14
        left, right = 16 + 9 * inset, max(box.width - 16 - 9 * inset, 40)
        points = ((right, 0), (right, -height + high), (left, -height + high), (left, 0))
        pieces.append(PicturePiece(cut.arrow, points, lines=cut.lines, label=(right - wide - 6, -height)))
    whole = replace(box, pieces=(*box.pieces, *pieces), height=box.height + height)
    return whole.moved(0, height)


def _regions(sheet: Sheet, level: Path, found: Sequence[Cut], sides: Sides, span: PackedSpan) -> DrawnPicture:
    """Parallel regions in rows; in one column where an arrow crosses their borders."""
    for cut in found:
        if not cut.crosses:
            raise ModelError(
                f"{sheet.chart.name}: a transition from {'.'.join(cut.arrow.source)} to "
                f"{'.'.join(cut.arrow.target)} joins two parallel regions; send a local event instead."
            )
    crossing = {c.name: sides.get(c.name, bool(c.source)) for c in found}
    whole = _packed(sheet, level, found, crossing, span, span)
    if whole.height <= TALL:
        return whole
    half = PackedSpan(span.least, (span.most - PAD) // 2)
    options = [whole, _packed(sheet, level, found, crossing, span, half)]
    return min(options, key=lambda p: (span.excess(p.width), cost((p.width, p.height))))


def _packed(
    sheet: Sheet, level: Path, found: Sequence[Cut], crossing: Sides, span: PackedSpan, each: PackedSpan
) -> DrawnPicture:
    """Parallel regions, ``each`` as wide as given."""
    regions = []
    for state in sheet.chart.states[level].states:
        own = {c.name: crossing[c.name] for c in found if state.name in (c.source, c.target)}
        regions.append(_box(sheet, (*level, state.name), own, PackedSpan(0, each.most)))
    cells = packed([(r.width, r.height) for r in regions], PAD, span, one_column=bool(found))
    grown = [
        _sized(region, size).moved(*corner) for region, (corner, size) in zip(regions, cells, strict=True)
    ]
    wide, high = extent(cells)
    ports = {name: y for r in grown for name, y in r.ports.items()}
    return DrawnPicture(
        wide,
        high,
        tuple(b for r in grown for b in r.boxes),
        tuple(s for r in grown for s in r.spots),
        tuple(p for r in grown for p in r.pieces),
        ports,
    )


def _sized(region: DrawnPicture, size: tuple[int, int]) -> DrawnPicture:
    wider = region.bordered((0, region.width), (0, size[0]))
    frame = replace(region.boxes[0], width=size[0], height=size[1])
    return replace(wider, width=size[0], height=size[1], boxes=(frame, *region.boxes[1:]))
