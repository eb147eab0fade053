"""What makes a search large: the variable that multiplies the stored states most, and what would help.

For a state of a sample, its *group* is the stored states that differ from it in one variable
only.  Without the variable, a group is one state, so the store would shrink to the mean of
1 / (size of the group) over all states; the sample estimates that mean.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from rovercheck.checker.encode.counters import counters
from rovercheck.checker.encode.native import (
    Field,
    NativeSearch,
    NativeSuccessors,
    NativeTask,
    moved_on,
    shifts,
)
from rovercheck.checker.encode.native.quiet import NOTHING
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expiry import free_timers
from rovercheck.spec_model.lang.lower import lower
from rovercheck.spec_model.lang.system import System, TransitionSystem

MOST_ASKED = 1 << 15
"""States looked up for one estimate."""
_MOST_EXPANDED, _ROOM = 1 << 12, 1 << 20
"""States whose ticks are looked at for another estimate, and how many ticks of theirs."""
_WORTH_SKIPPING = 10
"""Times fewer states that make it worth while to skip quiet ticks."""
_KNOWN = 0.25
"""The part of all ticks that must lead to what other ticks lead to, or the estimate is none."""
_MOST_VALUES = 256
_MOST_SAMPLED = 256
_WORTH_NAMING = 1.5

Words = NDArray[np.uint64]


@dataclass(frozen=True)
class Multiplier:
    """A variable, and by how much it multiplies the stored states."""

    field: Field
    factor: float


class Advisor:
    """Names what multiplies the states of one search.

    ``freed``: what is searched is what was left open with timers that may expire at any time.
    """

    def __init__(self, native: NativeSearch, *, freed: bool = False) -> None:
        self.native, self.freed = native, freed
        self.system: TransitionSystem = native.task.system

    def multiplier(self, words: Words, table: Words, count: int) -> Multiplier | None:
        """The variable that multiplies the first ``count`` states most; None if none does by much."""
        fields = self.native.task.layout.fields
        asked = sum(min(_values(f), _MOST_VALUES) for f in fields)
        number = max(1, min(_MOST_SAMPLED, MOST_ASKED // max(1, asked), count))
        if not count or not fields:
            return None
        sample = words[np.linspace(0, count - 1, number).astype(np.int64)]
        each = [Multiplier(f, self._factor(f, sample, words, table)) for f in fields]
        most = max(each, key=lambda m: m.factor)
        return most if most.factor >= _WORTH_NAMING else None

    def _factor(self, field: Field, sample: Words, words: Words, table: Words) -> float:
        codes = _spread(_values(field), _MOST_VALUES)
        asked = np.repeat(sample, len(codes), axis=0)
        clear = np.uint64(~(field.mask << field.shift) & (1 << 64) - 1)
        placed = np.tile(codes << np.uint64(field.shift), len(sample))
        asked[:, field.word] = asked[:, field.word] & clear | placed
        own = np.repeat(sample[:, field.word], len(codes)) == asked[:, field.word]
        others = self.native.known(table, words, asked) & ~own
        found = others.reshape(len(sample), len(codes)).sum(axis=1)
        tried = (~own).reshape(len(sample), len(codes)).sum(axis=1)
        groups = 1 + found * (_values(field) - 1) / np.maximum(tried, 1)
        return float(len(sample) / np.sum(1 / groups))

    def sentence(self, most: Multiplier) -> str:
        """``window_12 multiplies them by about 150``."""
        return f"{most.field.var.name} multiplies them by about {_round(most.factor)}"

    def remedy(self, name: str, stored: Words, *, memory: bool) -> str:
        """The option that would help with a variable in a search that has ``stored`` states; or nothing.

        ``memory``: it was that which ran out.  Skipping quiet ticks saves no time.
        """
        if name not in self._counters:
            return ""
        if not self.freed and name in self._freed:
            return "try --timers free"
        if memory and not self.native.task.shifts and self.anchors(stored) < len(stored) / _WORTH_SKIPPING:
            return "try --timers skip"
        return ""

    def anchors(self, stored: Words) -> float:
        """About how many of the states would still be stored if quiet ticks were skipped.

        All ticks from a sample are looked at: those that are not quiet lead to states that are stored
        in any case.  How many there are is estimated from how often one that is met is met only once (Good,
        *The population frequencies of species and the estimation of population parameters*, 1953); as some
        are met more easily than others, there may be three times as many.
        """
        task, total = self.native.task, len(stored)
        moved = shifts(task.layout, counters(self.system))
        if not moved or not total:
            return float(total)
        chosen = np.random.default_rng(0).permutation(total)[:_MOST_EXPANDED]
        native = NativeSuccessors.compile(NativeTask(task.system, task.layout, ()))
        _, expanded, rows, origins = native(stored[chosen], _ROOM)
        onward = [
            moved_on(words, moved) or (NOTHING,) * task.layout.words for words in stored[chosen].tolist()
        ]
        eventful = (rows.astype(np.int64) != np.array(onward)[origins]).any(axis=1)
        ticks = np.unique(np.column_stack([rows[eventful], origins[eventful].astype(np.uint64)]), axis=0)
        met, times = np.unique(ticks[:, :-1], axis=0, return_counts=True)
        if expanded == total:
            return float(len(met))
        known = 1 - (times == 1).sum() / max(1, len(ticks))
        return len(met) / known if known > _KNOWN else float(total)

    @cached_property
    def _counters(self) -> set[str]:
        return {c.var.name for c in counters(self.system)}

    @cached_property
    def _freed(self) -> set[str]:
        """The variables that have fewer values, or are gone, where timers may expire at any time."""
        source = self.system.source
        if source is None:
            return set()
        try:
            exact, free = _sizes(source), _sizes(free_timers(source))
        except ModelError:
            return set()
        return {name for name, size in exact.items() if free.get(name, 0) < size}


def _sizes(system: System) -> dict[str, int]:
    return {v.name: len(v.domain) for v in lower(system).variables}


def _values(field: Field) -> int:
    """How many codes a field may hold."""
    return field.most + 1


def _spread(size: int, most: int) -> Words:
    """All codes below ``size``, or ``most`` of them at equal distances."""
    return np.unique(np.linspace(0, size - 1, min(size, most)).astype(np.uint64))


def _round(factor: float) -> str:
    """Two figures, as more would promise too much."""
    if factor < 10:
        return f"{factor:.1f}"
    digits = len(str(round(factor)))
    return f"{round(factor, 2 - digits):,.0f}"
