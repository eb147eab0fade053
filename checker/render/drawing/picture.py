"""A chart with coordinates: boxes, junctions, dots and pieces of arrows, in pixels."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from rovercheck.checker.render.drawing.graph import Point
from rovercheck.checker.render.drawing.labels import ChartArrow
from rovercheck.spec_model.lang.chart import Path


@dataclass(frozen=True)
class Box:
    """A state: its rectangle, its action lines; ``order`` numbers a parallel region, else 0."""

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
class PicturePiece:
    """A piece of an arrow between two borders; the label (top left corner) is on the first piece."""

    arrow: ChartArrow
    points: tuple[Point, ...]
    starts: bool = True
    ends: bool = True
    lines: tuple[str, ...] = ()
    label: Point = (0, 0)


@dataclass(frozen=True)
class DrawnPicture:
    """Everything to be drawn, from the top left corner.

    ``ports`` are the heights at which arrows, known by name, cross the left or right border; in a
    picture drawn from top to bottom (``upright``) how far from the left they cross the upper or lower one.
    """

    width: int
    height: int
    boxes: tuple[Box, ...] = ()
    spots: tuple[Spot, ...] = ()
    pieces: tuple[PicturePiece, ...] = ()
    ports: Mapping[str, int] = field(default_factory=dict)
    upright: bool = False

    def moved(self, dx: int, dy: int) -> "DrawnPicture":
        """The same, shifted; its size stays, its ports shift with it."""
        return replace(
            self,
            boxes=tuple(replace(b, x=b.x + dx, y=b.y + dy) for b in self.boxes),
            spots=tuple(replace(s, x=s.x + dx, y=s.y + dy) for s in self.spots),
            pieces=tuple(_moved(p, dx, dy) for p in self.pieces),
            ports={name: at + (dx if self.upright else dy) for name, at in self.ports.items()},
        )

    def bordered(self, old: tuple[int, int], new: tuple[int, int]) -> "DrawnPicture":
        """The same, with arrows that cross the border led on from the old left and right x to the new.

        In an upright picture from the old upper and lower y.
        """
        change = dict(zip(old, new, strict=True))
        pieces = tuple(
            _led(p, change, self.upright) if p.arrow.name in self.ports else p for p in self.pieces
        )
        return replace(self, pieces=pieces)


def _moved(piece: PicturePiece, dx: int, dy: int) -> PicturePiece:
    points = tuple((x + dx, y + dy) for x, y in piece.points)
    return replace(piece, points=points, label=(piece.label[0] + dx, piece.label[1] + dy))


def _led(piece: PicturePiece, change: Mapping[int, int], upright: bool) -> PicturePiece:
    first, *middle, last = piece.points
    ends = [(x, change.get(y, y)) if upright else (change.get(x, x), y) for x, y in (first, last)]
    return replace(piece, points=(ends[0], *middle, ends[1]))
