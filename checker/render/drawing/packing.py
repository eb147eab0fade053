"""Set boxes in rows or in columns, in reading order, so that the whole has a pleasant shape."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations

from rovercheck.checker.render.drawing.graph import Point

SHAPE = 0.9
"""The width to height ratio aimed at: pages are scrolled downwards, and wide pictures shrunk to fit."""

MANY = 8
"""Up to so many boxes every division into rows or columns is tried, beyond only even ones."""

Size = tuple[int, int]
Cells = list[tuple[Point, Size]]
Lines = list[range]


@dataclass(frozen=True)
class PackedSpan:
    """How wide something has to be at least, and should be at most, in pixels."""

    least: int
    most: int

    def excess(self, wide: int) -> int:
        """By how much something is too wide."""
        return max(0, wide - self.most)


def packed(sizes: Sequence[Size], gap: int, span: PackedSpan, one_column: bool = False) -> Cells:
    """A corner and a new size for each box; boxes grow to leave no holes, as wide as ``span`` wants."""
    if one_column:
        return rows(sizes, [range(i, i + 1) for i in range(len(sizes))], gap, span.least)
    options = [rows(sizes, lines, gap, span.least) for lines in _divisions(len(sizes))]
    options += [_columns(sizes, lines, gap, span.least) for lines in _divisions(len(sizes))]
    return min(options, key=lambda cells: (span.excess(extent(cells)[0]), cost(extent(cells))))


def extent(cells: Cells) -> Size:
    """The size of the rectangle around the cells."""
    return (
        max((x + w for (x, _), (w, _) in cells), default=0),
        max((y + h for (_, y), (_, h) in cells), default=0),
    )


def cost(size: Size) -> float:
    """How unpleasant a rectangle is: large, or far from the shape aimed at."""
    wide, high = size[0] / SHAPE, size[1]
    return max(wide, high) + (wide + high) / 2


def _divisions(count: int) -> Iterator[Lines]:
    """Divisions of 0..count-1 into consecutive lines, few lines first."""
    if count > MANY:
        for each in range(count, 0, -1):
            yield [range(i, min(i + each, count)) for i in range(0, count, each)]
        return
    for breaks in range(count):
        for ends in combinations(range(1, count), breaks):
            yield [range(a, b) for a, b in zip((0, *ends), (*ends, count), strict=True)]


def rows(sizes: Sequence[Size], lines: Lines, gap: int, least: int) -> Cells:
    """The boxes row by row; each row is as wide as the widest."""
    wide = max([least, *(_length(sizes, line, gap) for line in lines)])
    found: Cells = []
    y = 0
    for line in lines:
        high = max(sizes[i][1] for i in line)
        spare, x = wide - _length(sizes, line, gap), 0
        for place, i in enumerate(line):
            grown = sizes[i][0] + spare * (place + 1) // len(line) - spare * place // len(line)
            found.append(((x, y), (grown, high)))
            x += grown + gap
        y += high + gap
    return found


def _columns(sizes: Sequence[Size], lines: Lines, gap: int, least: int) -> Cells:
    """The boxes column by column: rows of the mirrored boxes, mirrored back."""
    mirrored = rows([(h, w) for w, h in sizes], lines, gap, 0)
    cells = [((y, x), (h, w)) for (x, y), (w, h) in mirrored]
    spare = least - extent(cells)[0]
    if spare > 0:
        start = cells[lines[-1].start][0][0]
        cells = [(p, (w + spare, h) if p[0] == start else (w, h)) for p, (w, h) in cells]
    return cells


def _length(sizes: Sequence[Size], line: range, gap: int) -> int:
    return sum(sizes[i][0] for i in line) + gap * (len(line) - 1)
