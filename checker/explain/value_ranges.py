"""From the values that inputs had to those that do as well: ``sonar in 0..70``, not ``sonar = 12``.

Stretches of ticks in which an input had one value are widened together, so that they stay one line to
read: numbers to the longest interval that still forces the end, then, where there are few different
cases, to any other of these.
"""

from collections.abc import Callable, Container, Iterable, Iterator, Mapping, Sequence

from rovercheck.checker.explain.unrolled_run import Over, Place, Unrolled
from rovercheck.checker.system.partition import Partition
from rovercheck.spec_model.lang.domain import Num

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


def widest(
    cells: Partition,
    own: int,
    others: set[int],
    takes: Callable[[Sequence[int]], bool],
    over: Over,
) -> list[int]:
    """The values that an input may have: those of the cell that ``own`` is in, and of as many others as
    ``takes`` allows, which is asked about all of them together."""
    at = cells.cell_of[own]
    chosen = {at}

    def values(wanted: set[int]) -> list[int]:
        return [v for v in cells.values if cells.cell_of[v] in wanted]

    def taken(wanted: set[int]) -> bool:
        if not takes(values(wanted)):
            return False
        chosen.update(wanted)
        return True

    if isinstance(cells.var.sort, Num):
        for way in (-1, 1):
            base = set(chosen)
            stretch = [at + way * i for i in range(len(cells.cells) + 1)]
            high = next(i for i, cell in enumerate(stretch) if i and cell not in others) - 1
            _farthest(high, lambda i: taken(base | set(stretch[: i + 1])), over)  # noqa: B023
    if len(cells.cells) <= FEW:
        for cell in sorted(others - chosen, key=lambda c: abs(c - at)):
            if not over():
                taken(chosen | {cell})
    return values(chosen)


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
        self._own = unrolled.own(places[0])
        at = cells.cell_of[self._own]
        self.values: Sequence[int] = list(cells.members(at))
        """At first those that nothing can tell from the own one."""
        self._others = set(range(len(cells.cells))) - {at}

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
        self.values = widest(self._cells, self._own, self._others, self._takes, over)

    def _takes(self, values: Sequence[int]) -> bool:
        """Allow these values if the end is still forced."""
        ranges = list(_ranges(values))
        fresh = {place: self._unrolled.within(place, ranges) for place in self.places}
        if not self._unrolled.asked((self._assumed | fresh).values(), CONFLICTS).forced:
            return False
        self._assumed |= fresh
        return True


def _farthest(high: int, reaches: Callable[[int], bool], over: Over) -> None:
    """Try how far one can go, at most to ``high``, by bisection: what reaches far reaches all before."""
    low = 0
    while low < high and not over():
        middle = (low + high + 1) // 2
        if reaches(middle):
            low = middle
        else:
            high = middle - 1


def _ranges(values: Sequence[int]) -> Iterator[tuple[int, int]]:
    """Ascending values as ranges without gaps."""
    first = last = values[0]
    for value in values[1:]:
        if value != last + 1:
            yield first, last
            first = value
        last = value
    yield first, last
