"""What a layered layout is given and what it returns; ranks run from left to right."""

from collections.abc import Mapping
from dataclasses import dataclass, field

Point = tuple[int, int]
"""x to the right and y downward, in pixels."""


@dataclass(frozen=True)
class DrawnNode:
    """A box of a given size.

    ``ports`` are distances from its top at which named edges must meet it; other edges meet it
    where it suits them, below the first ``lead`` pixels.  Edges of a ``round`` node fan out from
    its centre.
    """

    name: str
    width: int
    height: int
    ports: Mapping[str, int] = field(default_factory=dict)
    round: bool = False
    lead: int = 0


@dataclass(frozen=True)
class Edge:
    """A line from the right side of ``tail`` to the left side of ``head``; ``label`` is width, height."""

    name: str
    tail: str
    head: str
    label: tuple[int, int] = (0, 0)
    weight: int = 1


@dataclass(frozen=True)
class PlacedNode:
    """Top-left corners of nodes and labels, a polyline per edge (tail to head), and the whole size."""

    nodes: Mapping[str, Point]
    heights: Mapping[str, int]
    labels: Mapping[str, Point]
    routes: Mapping[str, tuple[Point, ...]]
    width: int
    height: int


@dataclass(eq=False)
class Item:
    """Something that takes a place in a rank: a node, or a point of an edge (perhaps its label)."""

    rank: int
    width: int
    above: int
    below: int
    node: DrawnNode | None = None
    edge: Edge | None = None
    labelled: bool = False


Chain = list[Item]
"""The items of one edge, one per rank, from its tail node to its head node."""
