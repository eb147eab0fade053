"""The memory of the explicit search: parents in two bits, tables that grow, states that stay."""

from dataclasses import dataclass
from typing import cast

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from benchmarks.roverlite import roverlite
from rovercheck.checker.encode.native import NativeSearch, NativeTask, layout
from rovercheck.checker.engines import Limits, quiet
from rovercheck.checker.engines.explicit.levels import ExplicitFound, LevelSearch
from rovercheck.checker.engines.explicit.parents import Unary
from rovercheck.checker.engines.explicit.store import StateStore
from rovercheck.checker.system.slice import sliced


@given(st.lists(st.integers(0, 40), max_size=300), st.integers(1, 3))
def test_parents_are_read_as_they_were_noted(steps: list[int], times: int) -> None:
    parents = [int(p) for p in np.cumsum([0, *steps * times])]
    bits = np.zeros(2 * (len(parents) + parents[-1]) // 8 + 1, dtype=np.uint8)
    for number, parent in enumerate(parents):
        bits[(number + parent) // 8] |= 1 << (number + parent) % 8
    read = Unary(bits)
    assert [read[n] for n in range(len(parents))] == parents
    for beyond in (-1, len(parents)):
        with pytest.raises(IndexError):
            read[beyond]


def searched(k: int, memory: int = 1 << 30) -> tuple[LevelSearch, ExplicitFound]:
    system, goals = roverlite(28, k)
    part = sliced(system, goals)
    task = NativeTask(part, layout(part.variables), goals[-1:])
    search = LevelSearch(NativeSearch.compile(task), Limits(memory=memory), None, quiet)
    return search, search.run()


def test_every_parent_is_of_the_level_before() -> None:
    _, found = searched(5)
    assert found.states > 10_000 and not found.stopped
    parents = [int(found.parents[n]) for n in range(found.initial, found.states)]
    assert parents == sorted(parents)
    for number, parent in enumerate(parents[:5000], found.initial):
        assert found.level(parent) == found.level(number) - 1


def test_the_table_knows_exactly_what_is_stored() -> None:
    search, found = searched(10)
    store, native = search.store, search.native
    assert native.known(store.table, store.words, found.words).all()
    assert np.count_nonzero(store.table) == found.states == len(np.unique(found.words))
    others = np.setdiff1d(found.words ^ np.uint64(1), found.words)[:, None]
    assert len(others) > 100 and not native.known(store.table, store.words, others).any()


@dataclass(frozen=True)
class _Fake:
    """What a store needs of a search."""

    task: NativeTask

    def rehash(self, *_: object) -> None:
        """Nothing is stored."""


@pytest.mark.parametrize("words", [1, 3])
def test_bytes_for_each_valuation_at_any_size(words: int) -> None:
    """From a million on: at most 24 for one word, however far the arrays have grown."""
    system, goals = roverlite(28)
    task = NativeTask(system, layout(system.variables), goals[-1:])
    packing = type(task.layout)(task.layout.fields, words)
    store = StateStore(cast(NativeSearch, _Fake(NativeTask(system, packing, task.goals))), 1 << 31)
    count = 0
    while count < 12_000_000:
        assert store.grow(count) and store.room > count
        if count > 1_000_000:
            assert store.bytes <= (24 + 8 * (words - 1) * 17 / 16) * count
        count = store.room


def test_no_more_memory_than_allowed() -> None:
    for memory in (3 << 20, 10 << 20):
        search, found = searched(1, memory)
        assert "memory" in found.stopped and search.store.bytes <= memory
        assert found.states > memory / 40, "most of what is allowed is used"
