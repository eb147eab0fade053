"""Where things stand in a figure that a person has drawn."""

from collections.abc import Mapping
from dataclasses import dataclass, field

Spot = tuple[float, float]
Frame = tuple[float, float, float, float]
"""Left, top, width and height."""
Path = tuple[str, ...]


@dataclass(frozen=True)
class ChartFigure:
    """The drawing of a chart: frames of states and places of junctions by path, the points of transitions and
    the upper left corners of their labels.

    A transition is known by its start, ``Off.Idle``, its kind, ``*`` for a default and ``^`` for an inner
    one, and its number, ``#2``.  ``sheets`` are subcharts, whose contents are drawn elsewhere, with
    coordinates of their own.
    """

    frames: Mapping[Path, Frame]
    spots: Mapping[Path, Spot] = field(default_factory=dict)
    lines: Mapping[str, tuple[Spot, ...]] = field(default_factory=dict)
    labels: Mapping[str, Spot] = field(default_factory=dict)
    sheets: tuple[Path, ...] = ()


__all__ = ["ChartFigure", "Frame", "Spot"]
