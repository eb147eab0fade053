"""A closed set of states: what an exhausted search visited, and no tick leads out of."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from rovercheck.spec_model.lang.expr import Var


@dataclass(frozen=True)
class BitPlace:
    """Where a variable lies in a packed state: ``(raw - low) / stride`` in ``bits`` bits of a word."""

    var: Var
    word: int
    shift: int
    bits: int
    stride: int
    low: int


@dataclass(frozen=True, eq=False)
class ClosedSet:
    """Distinct packed states, one per row of 64-bit words, in no particular order.

    Variables that have no place were sliced away: the goals do not depend on them.
    """

    places: tuple[BitPlace, ...]
    words: NDArray[np.uint64]

    def __len__(self) -> int:
        return len(self.words)

    @property
    def size(self) -> int:
        """Values in it: states times variables."""
        return len(self) * len(self.places)

    @property
    def whole(self) -> "ClosedSet":
        """Itself."""
        return self


@dataclass(frozen=True, eq=False)
class ClosedUnion:
    """All states of some sets, and ``more`` of them; put together only where somebody asks for the ``whole``.

    Each of the sets has a place for each of the ``variables``, whose domains may be wider than there.
    """

    sets: tuple[ClosedSet, ...]
    variables: tuple[Var, ...]
    more: tuple[Mapping[str, int], ...]

    @property
    def size(self) -> int:
        """Values in it, or more: a state may be in several of the sets."""
        return len(self.variables) * (sum(map(len, self.sets)) + len(self.more))

    @cached_property
    def whole(self) -> ClosedSet:
        """The states in places of one layout."""
        return union(self.sets, self.variables, self.more)


def union(
    sets: Sequence[ClosedSet], variables: Sequence[Var], further: Sequence[Mapping[str, int]]
) -> ClosedSet:
    """The states of a union."""
    words, places = [np.empty(0, dtype=np.uint64)], list[BitPlace]()
    used = 64
    for var in variables:
        column = np.concatenate([*(_column(one, var.name) for one in sets), [v[var.name] for v in further]])
        column = column.astype(np.int64)
        low = int(column.min(initial=var.init))
        bits = (int(column.max(initial=var.init)) - low).bit_length()
        if used + bits > 64:
            words.append(np.zeros(len(column), dtype=np.uint64))
            used = 0
        words[-1] |= (column - low).astype(np.uint64) << np.uint64(used)
        places.append(BitPlace(var, len(words) - 2, used, bits, 1, low))
        used += bits
    return ClosedSet(tuple(places), np.unique(np.stack(words[1:], axis=1), axis=0))


def _column(closed: ClosedSet, name: str) -> NDArray[np.int64]:
    place = next(p for p in closed.places if p.var.name == name)
    code = closed.words[:, place.word] >> np.uint64(place.shift) & np.uint64((1 << place.bits) - 1)
    return code.astype(np.int64) * place.stride + place.low
