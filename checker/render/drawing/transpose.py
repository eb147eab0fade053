"""Draw a level from top to bottom: the layered layout runs from left to right, on mirrored boxes.

Mirrored is what has x and y exchanged: a box of 200 by 40 pixels takes part as one of 40 by 200.
"""

from collections.abc import Sequence
from dataclasses import replace

from rovercheck.checker.render.drawing.graph import DrawnNode, Edge, PlacedNode, Point
from rovercheck.checker.render.drawing.layered_layout import layered


def from_top(
    nodes: Sequence[DrawnNode], edges: Sequence[Edge], first: Sequence[str], last: Sequence[str]
) -> PlacedNode:
    """Like ``layered``, from top to bottom: ports are distances from the left of a node.

    Labels lie to the right of their lines, and ``heights`` holds the widths that nodes were given.
    """
    mirrored = [replace(node, width=node.height, height=node.width) for node in nodes]
    turned = [replace(edge, label=_swapped(edge.label)) for edge in edges]
    placed = layered(mirrored, turned, first, last, upright=True)
    return PlacedNode(
        {name: _swapped(at) for name, at in placed.nodes.items()},
        placed.heights,
        {name: _swapped(at) for name, at in placed.labels.items()},
        {name: tuple(map(_swapped, points)) for name, points in placed.routes.items()},
        placed.height,
        placed.width,
    )


def _swapped(point: Point) -> Point:
    return point[1], point[0]
