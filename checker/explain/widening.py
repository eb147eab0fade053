"""From the values that inputs had to those that do as well: ``sonar in 0..70``, not ``sonar = 12``.

Stretches of ticks in which an input had one value are widened together, so that they stay one line to
read: numbers to the longest interval that still forces the end, then, where there are few different
cases, to any other of these.
"""

from collections.abc import Container, Iterable, Iterator, Mapping, Sequence

from checker.explain.unrolled import Over, Place, Unrolled
from checker.partition import Partition
from spec_model.lang.domain import Num

FEW = 24
"""Cells of an input that are tried one by one."""
CONFLICTS = 1_000
"""What the solver may spend on one question: there are many, and less is lost by giving up."""


def widened(
    unrolled: Unrolled,
    kept: Mapping[Place, int],
    cells: Mapping[str, Partition],
    over: Over,
) -> dict[Place, frozenset[int]]:
    """For each place that is kept the values it may have; any combination of them forces the end.

    More values might do, where the solver gives up or the time is ``over``.
    """
    assumed = dict(kept)
    found: dict[Place, frozenset[int]] = {}
    blocks = [_Block(unrolled, b, cells[b[0][1]], assumed) for b in _blocks(unrolled, kept)]
    changes = [change for block in blocks for change in block.changes()]
    avoiding = {c for c, avoids in zip(changes, unrolled.avoids(changes), strict=True) if avoids}
    for block in blocks:
        block.exclude(avoiding)
        block.widen(over)
        found |= dict.fromkeys(block.places, frozenset(block.values))
    return found


def _blocks(unrolled: Unrolled, kept: Iterable[Place]) -> Iterator[list[Place]]:
    """Neighbouring ticks in which an input has one value."""
    places = sorted(kept, key=lambda p: (p[1], p[0]))
    block: list[Place] = []
    for place in places:
        if block and not (
            (place[0] - 1, place[1]) == block[-1] and unrolled.own(place) == unrolled.own(block[-1])
        ):
            yield block
            block = []
        block.append(place)
    if block:
        yield block


class _Block:
    """One input over some ticks, and the cells that it may be in so far."""

    def __init__(
        self,
        unrolled: Unrolled,
        places: Sequence[Place],
        cells: Partition,
        assumed: dict[Place, int],
    ) -> None:
        self._unrolled, self._cells, self._assumed = unrolled, cells, assumed
        self.places = places
        self._at = cells.cell_of[unrolled.own(places[0])]
        self.values: Sequence[int] = list(cells.members(self._at))
        """At first those that nothing can tell from the own one."""
        self._others = set(range(len(cells.cells))) - {self._at}
        self._chosen = {self._at}

    def changes(self) -> Iterator[tuple[Place, int]]:
        """Some changes to another value in one tick."""
        for cell in self._others if len(self._others) < FEW else ():
            for place in {self.places[0], self.places[len(self.places) // 2], self.places[-1]}:
                yield place, self._cells.cells[cell].value

    def exclude(self, avoiding: Container[tuple[Place, int]]) -> None:
        """Leave out cells with a value that alone avoids the end."""
        out = {self._cells.cell_of[value] for place, value in self.changes() if (place, value) in avoiding}
        self._others -= out

    def widen(self, over: Over) -> None:
        """Take in as many cells as possible."""
        if isinstance(self._cells.var.sort, Num):
            self._stretch(-1, over)
            self._stretch(1, over)
        if len(self._cells.cells) <= FEW:
            for cell in sorted(self._others - self._chosen, key=lambda c: abs(c - self._at)):
                if not over():
                    self._takes(self._chosen | {cell})

    def _stretch(self, way: int, over: Over) -> None:
        """The farthest cell that can be reached in one direction with all in between, by bisection."""
        base = set(self._chosen)
        low = high = 0
        while self._at + way * (high + 1) in self._others:
            high += 1
        while low < high and not over():
            middle = (low + high + 1) // 2
            if self._takes(base | {self._at + way * i for i in range(middle + 1)}):
                low = middle
            else:
                high = middle - 1

    def _takes(self, chosen: set[int]) -> bool:
        """Allow these cells if the end is still forced."""
        values = [v for v in self._cells.values if self._cells.cell_of[v] in chosen]
        ranges = list(_ranges(values))
        fresh = {place: self._unrolled.within(place, ranges) for place in self.places}
        if not self._unrolled.asked((self._assumed | fresh).values(), CONFLICTS).forced:
            return False
        self._assumed |= fresh
        self._chosen, self.values = chosen, values
        return True


def _ranges(values: Sequence[int]) -> Iterator[tuple[int, int]]:
    """Ascending values as ranges without gaps."""
    first = last = values[0]
    for value in values[1:]:
        if value != last + 1:
            yield first, last
            first = value
        last = value
    yield first, last
