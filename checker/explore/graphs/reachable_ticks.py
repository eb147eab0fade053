"""What an exploration found: reachable states, and all ticks that leave those it expanded."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from rovercheck.checker.explore.graphs.row_numbers import Numbers
from rovercheck.spec_model.lang.errors import ModelError, did_you_mean
from rovercheck.spec_model.lang.expr import Var


@dataclass(frozen=True, eq=False)
class ReachableTicks:
    """States, numbered as they were found, breadth first, and the pairs of them that a tick joins.

    ``columns`` are their raw values, one row for each of ``variables``.  ``levels`` has the number of the
    first state of each level: what is found after so many ticks and not before; ``parents`` the
    state from which each was found.  Each pair of a ``source`` and a ``target`` is there once, by
    source.  Ticks are known of the first ``expanded`` states only; where that is not all of them,
    ``stopped`` says why.
    """

    variables: tuple[Var, ...]
    columns: NDArray[np.int64]
    initial: int
    levels: tuple[int, ...]
    parents: Numbers
    sources: Numbers
    targets: Numbers
    expanded: int
    stopped: str = ""

    def __len__(self) -> int:
        return int(self.columns.shape[1])

    def column(self, name: str) -> Numbers:
        """The values of a variable in each state.  Raises ``ModelError`` for an unknown name."""
        names = [v.name for v in self.variables]
        if name not in names:
            raise ModelError(f"There is no variable {name!r} to project on. {did_you_mean(name, names)}")
        return np.asarray(self.columns[names.index(name)])

    def any_of(self, names: Sequence[str]) -> NDArray[np.bool_]:
        """The states in which one of these variables is not 0.  Raises ``ModelError`` as ``column``."""
        found = np.zeros(len(self), dtype=np.bool_)
        for name in names:
            found |= self.column(name) != 0
        return found

    def at(self, number: int) -> dict[str, int]:
        """A state by name."""
        return {v.name: int(c) for v, c in zip(self.variables, self.columns[:, number], strict=True)}

    @cached_property
    def depths(self) -> Numbers:
        """The ticks after which each state is first reached."""
        starts = np.array(self.levels, dtype=np.int64)
        return np.searchsorted(starts, np.arange(len(self)), side="right") - 1

    @cached_property
    def dead(self) -> NDArray[np.bool_]:
        """The states from which no input is admissible."""
        result = np.ones(len(self), dtype=np.bool_)
        result[self.sources] = False
        result[self.expanded :] = False
        return result
