"""The figure of a chart as it was drawn, if its coordinates are those of a drawing at all."""

from collections.abc import Callable, Iterator, Sequence
from itertools import combinations

from rovercheck.checker.drawn.parsed import JunctionNode, ParsedChart, StateNode, TransitionNode
from rovercheck.spec_model.lang.figure import ChartFigure, Frame, Path, Spot

NEAR = 15.0
"""How far, in its units, a transition may end from the border of its state."""


def figure_of(
    chart: ParsedChart, paths: dict[int, Path], junction_name: Callable[[JunctionNode], str]
) -> ChartFigure | None:
    """The figure, or nothing where states lie outside of those that they are in, or over each other.

    Programs write such files.
    """
    frames, spots = dict[Path, Frame](), dict[Path, Spot]()
    sheets = list[Path]()
    drawn = {state.ssid: state for state in chart.drawn.content.every_state()}
    for node in chart.root.every():
        if node.parent is not None:
            state = drawn[node.ssid]
            frames[paths[node.ssid]] = state.rectangle
            inside = [drawn[child.ssid].rectangle for child in node.children]
            if state.subchart and not all(_within(one, state.rectangle) for one in inside):
                sheets.append(paths[node.ssid])
    places = {one.ssid: one.at for level in chart.drawn.content.every_level() for one in level.junctions}
    for junction in chart.junctions.values():
        if junction.holder.ssid in paths:
            spots[(*paths[junction.holder.ssid], junction_name(junction))] = places[junction.ssid]
    for node in chart.root.every():
        if not _in_order(node, frames, paths, sheets):
            return None
    found = dict(_lines(chart, paths, junction_name, frames, spots))
    lines = {name: one.drawn.points for name, one in found.items()}
    labels = {name: at for name, one in found.items() if (at := one.drawn.label_at) is not None}
    return ChartFigure(frames, spots, lines, labels, tuple(sheets))


def _in_order(
    node: StateNode, frames: dict[Path, Frame], paths: dict[int, Path], sheets: Sequence[Path]
) -> bool:
    """Whether the children of a state lie in it, beside each other."""
    inside = [frames[paths[child.ssid]] for child in node.children]
    if any(width <= 0 or height <= 0 for _, _, width, height in inside):
        return False
    own = frames.get(paths[node.ssid])
    if own is not None and paths[node.ssid] not in sheets and not all(_within(one, own) for one in inside):
        return False
    return not any(_overlap(one, other) for one, other in combinations(inside, 2))


def _within(one: Frame, other: Frame) -> bool:
    (x, y, width, height), (left, top, across, down) = one, other
    return left - 2 <= x and top - 2 <= y and x + width <= left + across + 2 and y + height <= top + down + 2


def _overlap(one: Frame, other: Frame) -> bool:
    (x, y, width, height), (left, top, across, down) = one, other
    return x < left + across - 1 and left < x + width - 1 and y < top + down - 1 and top < y + height - 1


def _lines(
    chart: ParsedChart, paths: dict[int, Path], junction_name: Callable[[JunctionNode], str],
    frames: dict[Path, Frame], spots: dict[Path, Spot],
) -> Iterator[tuple[str, TransitionNode]]:  # fmt: skip
    """The transitions whose points are where their ends are, with their names in a figure."""

    def place(end: StateNode | JunctionNode | None) -> Path | None:
        if isinstance(end, JunctionNode):
            return (*paths.get(end.holder.ssid, ()), junction_name(end))
        return None if end is None else paths[end.ssid]

    def rows() -> Iterator[tuple[str, Sequence[TransitionNode]]]:
        for node in chart.root.every():
            start = ".".join(paths[node.ssid])
            yield f"{start}*", node.defaults
            yield start, node.outer
            yield f"{start}^", node.inner
        for junction in chart.junctions.values():
            yield ".".join(place(junction) or ()), junction.outgoing

    for start, transitions in rows():
        led = [one for one in transitions if one.target is not None]
        for order, one in enumerate(led, 1):
            points = one.drawn.points
            ends = place(one.source), place(one.target)
            near = all(
                end is None or _near(point, frames.get(end), spots.get(end))
                for end, point in zip(ends, (points[0], points[-1]) if points else (), strict=False)
            )
            if len(points) > 1 and near:
                yield f"{start}#{order}", one


def _near(point: Spot, frame: Frame | None, spot: Spot | None) -> bool:
    """Whether a point is on the border of a state, or at a junction."""
    x, y = point
    if spot is not None:
        return abs(x - spot[0]) < NEAR and abs(y - spot[1]) < NEAR
    if frame is None:
        return True
    left, top, width, height = frame
    inside = left - NEAR < x < left + width + NEAR and top - NEAR < y < top + height + NEAR
    deep = left + NEAR < x < left + width - NEAR and top + NEAR < y < top + height - NEAR
    return inside and not deep


__all__ = ["figure_of"]
