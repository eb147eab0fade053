"""A closed set of valuations: what an exhausted search visited, and no tick leads out of."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from spec_model.lang.expr import Var


@dataclass(frozen=True)
class Place:
    """Where a variable lies in a packed valuation: ``(raw - low) / stride`` in ``bits`` bits of a word."""

    var: Var
    word: int
    shift: int
    bits: int
    stride: int
    low: int


@dataclass(frozen=True, eq=False)
class ClosedSet:
    """Distinct packed valuations, one per row of 64-bit words, in no particular order.

    Variables that have no place were sliced away: the goals do not depend on them.
    """

    places: tuple[Place, ...]
    words: NDArray[np.uint64]

    def __len__(self) -> int:
        return len(self.words)
