"""Cut arrows at the borders of composites: what of each arrow belongs to one level."""

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

from rovercheck.checker.render.drawing.graph import Edge
from rovercheck.checker.render.drawing.labels import ChartArrow, label_parts
from rovercheck.checker.render.drawing.text import block, wrap
from rovercheck.spec_model.lang.chart import Path

DOT = "*"
"""The member of a level that stands for the dot of its default transition."""

Sides = Mapping[str, bool]
"""For arrows that cross the border of a composite: whether they do so on its right side."""


@dataclass(frozen=True)
class Cut:
    """The part of an arrow between two members of a level; an empty end lies on the level's border.

    ``limit`` is the number of characters in a line of its label.
    """

    arrow: ChartArrow
    source: str
    target: str
    starts: bool
    ends: bool
    limit: int

    @property
    def name(self) -> str:
        return self.arrow.name

    @property
    def crosses(self) -> bool:
        """Whether it runs from or to the border."""
        return not (self.source and self.target)

    @property
    def loop(self) -> bool:
        return self.source == self.target

    @property
    def port(self) -> str:
        """The node that stands for the point where it meets the border."""
        return f"|{self.name}"

    @property
    def turn(self) -> str:
        """The node in which a folded arrow bends, below its label."""
        return f"~{self.name}"

    @cached_property
    def lines(self) -> tuple[str, ...]:
        """The lines of the label, which is written where the arrow starts."""
        if not self.starts:
            return ()
        parts = (each for part in label_parts(self.arrow.transition) for each in _apart(part, self.limit))
        return tuple(line for part in parts for line in wrap(part, self.limit, "  "))


def _apart(part: str, limit: int) -> list[str]:
    """A part of a label; actions that do not fit into one line stand on lines of their own."""
    actions = re.split(r"(?<=;) ", part) if len(part) > limit else [part]
    return [actions[0], *(f"  {action}" for action in actions[1:])]


def cuts(arrows: Sequence[ChartArrow], level: Path, limit: int) -> Iterator[Cut]:
    """The parts of the arrows that belong to a level, in order, labels in lines of ``limit`` characters."""
    for arrow in arrows:
        start = (*arrow.source, DOT) if arrow.default else arrow.source
        cut = _cut(arrow, start, arrow.target, level, limit)
        if cut is not None:
            yield cut


def _cut(arrow: ChartArrow, start: Path, end: Path, level: Path, limit: int) -> Cut | None:
    depth = len(level)
    source, target = _member(start, level), _member(end, level)
    if not (source or target):
        return None
    loop = start == end and len(end) == depth + 1
    if source == target and not loop:
        return None
    starts = start[:-1] == level if source else start == level
    ends = end[:-1] == level if target else end == level
    return Cut(arrow, source, target, starts, ends, limit)


def _member(path: Path, level: Path) -> str:
    depth = len(level)
    return path[depth] if path[:depth] == level and len(path) > depth else ""


@dataclass(frozen=True)
class CutWay:
    """How a level is drawn: arrows that run from right to left, and arrows that leave their source to
    the right and bend back to the right side of their target (``folded``).

    With ``upright`` it is drawn from top to bottom; what is said of left and right here and in
    ``Sides`` then means above and below.
    """

    back: frozenset[str]
    folded: frozenset[str] = frozenset()
    upright: bool = False


def edges(cut: Cut, way: CutWay, sides: Sides) -> list[Edge]:
    """The cut as an edge from left to right; for a folded one also the edge that leads back."""
    source, target = cut.source or cut.port, cut.target or cut.port
    label, weight = padded(cut.lines, way.upright), 4 if cut.arrow.default else 1
    if cut.name in way.folded:
        return [Edge(cut.name, source, cut.turn), Edge(cut.turn, target, cut.turn)]
    reverse = cut.name in way.back
    if cut.crosses:
        on_right = sides.get(cut.name, bool(cut.source))
        reverse = on_right != (target == cut.port)
    tail, head = (target, source) if reverse else (source, target)
    return [Edge(cut.name, tail, head, label, weight)]


def padded(lines: tuple[str, ...], upright: bool = False) -> tuple[int, int]:
    """The room a label takes: its text, a little air at its ends and before the line beside it."""
    wide, high = block(lines)
    around = (8, 4) if upright else (10, 3)
    return (wide + around[0], high + around[1]) if lines else (0, 0)


def meetings(found: Sequence[Cut], member: str, way: CutWay) -> dict[str, bool]:
    """The arrows that meet a member from outside, and whether they meet it on its right side."""
    return {
        c.name: c.name in way.folded or (c.source == member) != (c.name in way.back)
        for c in found
        if not c.loop and member in (c.source, c.target)
    }
