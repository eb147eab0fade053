"""A chart in the figure that was drawn of it: its states and transitions where they stand there."""

from collections.abc import Mapping, Sequence
from math import hypot

from rovercheck.checker.render.drawing.folding import shortened
from rovercheck.checker.render.drawing.graph import Point
from rovercheck.checker.render.drawing.labels import (
    ChartArrow,
    action_lines,
    arrows,
    execution_order,
    label_parts,
)
from rovercheck.checker.render.drawing.picture import Box, DrawnPicture, PicturePiece, Spot
from rovercheck.checker.render.drawing.text import LINE, block, width, wrap
from rovercheck.spec_model.lang.chart import Chart, Path
from rovercheck.spec_model.lang.figure import ChartFigure, Frame

RADIUS, SMALL = 7, 5
LARGEST = 2.5
"""How much larger than drawn a figure is shown at most, so that its texts have room."""
APART = 48
"""Between the sheets of subcharts, which are drawn below each other."""
LETTERS = 34
"""Letters of a line of a label."""
BENDS = 8
"""Straight pieces of a curve."""


def own_picture(chart: Chart, figure: ChartFigure, folded: bool = False) -> DrawnPicture:
    """The picture.  Contents of a subchart are drawn below, in a frame of its name."""
    lines = {
        path: shortened(action_lines(s)) if folded else action_lines(s) for path, s in chart.states.items()
    }
    scale = _scale(chart, figure, lines)
    frames, offsets, panels = _placed(chart, figure, scale)
    boxes = [*(_box(chart, path, frame, lines) for path, frame in panels.items())]
    boxes += [_box(chart, path, frame, {} if path in panels else lines) for path, frame in frames.items()]
    spots = {
        path: (
            round(x * scale + offsets[_sheet(figure, path)][0]),
            round(y * scale + offsets[_sheet(figure, path)][1]),
        )
        for path, (x, y) in figure.spots.items()
    }
    drawn = [Spot(path, x, y, RADIUS, dot=False) for path, (x, y) in spots.items()]
    pieces = []
    for arrow in arrows(chart):
        points = _points(arrow, figure, scale, offsets, frames, spots)
        if arrow.default:
            drawn.append(Spot((), points[0][0], points[0][1], SMALL, dot=True))
        dx, dy = offsets[_sheet(figure, arrow.target)]
        label = figure.labels.get(arrow.name)
        at = None if label is None else (round(label[0] * scale + dx), round(label[1] * scale + dy))
        pieces.append(_piece(arrow, points, at))
    return _fitted(boxes, drawn, pieces)


def _scale(chart: Chart, figure: ChartFigure, lines: Mapping[Path, Sequence[str]]) -> float:
    """Large enough for the names and actions of the states that hold no others."""
    wanted = [1.0]
    for path, (_, _, across, down) in figure.frames.items():
        if not chart.states[path].states:
            wide, high = block(tuple(lines[path]))
            wanted += [(max(wide, width(path[-1], 13, bold=True)) + 24) / across, (high + 34) / down]
    return min(LARGEST, max(wanted))


def _sheet(figure: ChartFigure, path: Path) -> Path:
    """The subchart in which something is drawn; the empty path is the chart itself."""
    around = [one for one in figure.sheets if path[: len(one)] == one and path != one]
    return max(around, key=len, default=())


def _placed(
    chart: Chart, figure: ChartFigure, scale: float
) -> tuple[dict[Path, Frame], dict[Path, tuple[float, float]], dict[Path, Frame]]:
    """The frames in pixels, how far each sheet is moved, and the frames around the sheets of subcharts."""
    offsets: dict[Path, tuple[float, float]] = {(): (0.0, 0.0)}
    panels, bottom = dict[Path, Frame](), 0.0
    for sheet in ((), *figure.sheets):
        own = [f for path, f in figure.frames.items() if _sheet(figure, path) == sheet]
        if not own:
            continue
        left, top = min(f[0] for f in own) * scale, min(f[1] for f in own) * scale
        right, low = (max(f[n] + f[n + 2] for f in own) * scale for n in (0, 1))
        if sheet:
            room = 26 + LINE * len(action_lines(chart.states[sheet])) + 40
            offsets[sheet] = 40 - left, bottom + APART + room - top
            panels[sheet] = (0, bottom + APART, right - left + 80, low - top + room + 40)
            bottom += APART + low - top + room + 40
        else:
            bottom = low
    frames = {}
    for path, (x, y, across, down) in figure.frames.items():
        dx, dy = offsets[_sheet(figure, path)]
        frames[path] = (x * scale + dx, y * scale + dy, across * scale, down * scale)
    return frames, offsets, panels


def _box(chart: Chart, path: Path, frame: Frame, lines: Mapping[Path, Sequence[str]]) -> Box:
    x, y, across, down = map(round, frame)
    composite = bool(chart.states[path].states)
    return Box(path, x, y, across, down, tuple(lines.get(path, ())), execution_order(chart, path), composite)


def _points(
    arrow: ChartArrow, figure: ChartFigure, scale: float, offsets: Mapping[Path, tuple[float, float]],
    frames: Mapping[Path, Frame], spots: Mapping[Path, Point],
) -> tuple[Point, ...]:  # fmt: skip
    """The way of a transition: as drawn, or straight where it crosses from sheet to sheet."""
    sheet = _sheet(figure, arrow.target)
    drawn = figure.lines.get(arrow.name)
    if drawn is not None:
        dx, dy = offsets[sheet]
        return _curve([(x * scale + dx, y * scale + dy) for x, y in drawn])
    target = _middle(arrow.target, frames, spots)
    if arrow.default:
        x, y, across, _ = frames.get(arrow.target, (*target, 0, 0))
        return (round(x + across / 2), round(y - 26)), (round(x + across / 2), round(y))
    source = _middle(arrow.source, frames, spots)
    if arrow.source == arrow.target:
        x, y, across, _ = frames[arrow.source]
        right = x + across
        return tuple(
            (round(a), round(b))
            for a, b in ((right - 24, y), (right - 24, y - 20), (right - 6, y - 20), (right - 6, y))
        )
    return (
        _border(frames.get(arrow.source), source, target), _border(frames.get(arrow.target), target, source)
    )  # fmt: skip


def _middle(path: Path, frames: Mapping[Path, Frame], spots: Mapping[Path, Point]) -> tuple[float, float]:
    if path in spots:
        return spots[path]
    x, y, across, down = frames[path]
    return x + across / 2, y + down / 2


def _border(frame: Frame | None, inside: tuple[float, float], toward: tuple[float, float]) -> Point:
    """Where the line from the middle of a state to another point crosses its border."""
    (x, y), dx, dy = inside, toward[0] - inside[0], toward[1] - inside[1]
    half = (RADIUS, RADIUS) if frame is None else (frame[2] / 2, frame[3] / 2)
    if frame is None:
        length = hypot(dx, dy) or 1
        return round(x + dx / length * RADIUS), round(y + dy / length * RADIUS)
    shares = [h / abs(d) for h, d in zip(half, (dx, dy), strict=True) if d]
    share = min(shares, default=0)
    return round(x + dx * share), round(y + dy * share)


def _curve(points: Sequence[tuple[float, float]]) -> tuple[Point, ...]:
    """A line through the middle point of three, bent as a parabola."""
    if len(points) != 3:
        return tuple((round(x), round(y)) for x, y in points)
    (x0, y0), (x, y), (x1, y1) = points
    cx, cy = 2 * x - (x0 + x1) / 2, 2 * y - (y0 + y1) / 2
    found = []
    for step in range(BENDS + 1):
        t = step / BENDS
        a, b, c = (1 - t) ** 2, 2 * t * (1 - t), t * t
        found.append((round(a * x0 + b * cx + c * x1), round(a * y0 + b * cy + c * y1)))
    return tuple(found)


def _piece(arrow: ChartArrow, points: tuple[Point, ...], at: Point | None) -> PicturePiece:
    if at is not None:
        return PicturePiece(arrow, points, lines=label_parts(arrow.transition), label=at)
    lines = tuple(line for part in label_parts(arrow.transition) for line in wrap(part, LETTERS, "  "))
    x, y = points[len(points) // 2] if len(points) > 2 else _between(*points)
    return PicturePiece(arrow, points, lines=lines, label=(x + 6, y - 6 - (LINE * (len(lines) - 1)) // 2))


def _between(one: Point, other: Point) -> Point:
    return (one[0] + other[0]) // 2, (one[1] + other[1]) // 2


def _fitted(boxes: Sequence[Box], spots: Sequence[Spot], pieces: Sequence[PicturePiece]) -> DrawnPicture:
    """The picture from its upper left corner."""
    across = [x for b in boxes for x in (b.x, b.x + b.width)] + [x for p in pieces for x, _ in p.points]
    down = [y for b in boxes for y in (b.y, b.y + b.height)] + [y for p in pieces for _, y in p.points]
    across += [x for p in pieces for x in (p.label[0], p.label[0] + block(p.lines)[0])]
    down += [y for p in pieces for y in (p.label[1], p.label[1] + block(p.lines)[1])]
    across += [s.x + by for s in spots for by in (-s.radius, s.radius)]
    down += [s.y + by for s in spots for by in (-s.radius, s.radius)]
    left, top = min(across, default=0), min(down, default=0)
    whole = DrawnPicture(
        max(across, default=0) - left, max(down, default=0) - top, tuple(boxes), tuple(spots), tuple(pieces)
    )
    return whole.moved(-left, -top)


__all__ = ["own_picture"]
