"""The three records of ten intervals: the literal one, the window of arrivals, the over-approximation.

Update sequences are blocks of equal intervals, so that bursts, silences and means on the limit occur.
"""

from collections.abc import Iterator
from fractions import Fraction
from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from spec_model.environment import arrival_window, slow_record
from spec_model.lang.chart import Block
from spec_model.lang.interpret import Interpreter
from spec_model.lang.system import TICK_MS, in_order
from spec_model.signals.board1 import rx_update

blocks = st.lists(st.tuples(st.integers(1, 26), st.integers(1, 12)), min_size=1, max_size=8)
"""Intervals in ticks, and how often each is repeated."""

EXACT = [slow_record("rx", rx_update, exact=True), arrival_window("rx", rx_update)]


def updates(sequence: list[tuple[int, int]]) -> list[bool]:
    """Whether there is an update, tick by tick; the first interval is the silence after power-up."""
    return [last for gap, times in sequence for _ in range(times) for last in (*[False] * (gap - 1), True)]


def answers(record: Block, sequence: list[bool], guesses: list[bool] | None = None) -> Iterator[bool]:
    """``rx_slow`` after each tick."""
    machine = Interpreter(in_order("record", record))
    for tick, update in enumerate(sequence):
        inputs = {"rx_update": int(update)}
        if guesses is not None:
            inputs["rx_mean_slow"] = int(guesses[tick])
        machine.step(inputs)
        yield bool(machine.data["rx_slow"])


def by_time_stamps(sequence: list[bool]) -> Iterator[bool]:
    """The definition: time stamps in ms, the mean of the last ten differences as a fraction."""
    stamps: list[int] = []
    for tick, update in enumerate(sequence, start=1):
        if update:
            stamps.append(tick * TICK_MS)
        intervals = [later - earlier for earlier, later in pairwise(stamps)][-10:]
        yield len(intervals) == 10 and Fraction(sum(intervals), 10) > 40


@pytest.mark.parametrize("record", EXACT, ids=lambda record: record.name)
@given(sequence=blocks)
def test_an_exact_record_computes_the_mean_of_the_time_stamps(
    record: Block, sequence: list[tuple[int, int]]
) -> None:
    ticks = updates(sequence)
    assert list(answers(record, ticks)) == list(by_time_stamps(ticks))


@pytest.mark.parametrize("record", EXACT, ids=lambda record: record.name)
@pytest.mark.parametrize(
    ("gaps", "slow"),
    [
        ([1, *[2] * 10], False),
        ([1, *[2] * 9, 3], True),
        ([1, *[1] * 9, 11], False),
        ([1, *[1] * 9, 12], True),
        ([1, *[3] * 9], False),
        ([45, *[1] * 10], False),
    ],
    ids=["mean 40", "mean 42", "one of 220 ms", "one of 240 ms", "nine intervals", "silence after power-up"],
)
def test_an_exact_record_on_the_limit(record: Block, gaps: list[int], slow: bool) -> None:
    assert list(answers(record, updates([(gap, 1) for gap in gaps])))[-1] is slow


@given(sequence=blocks)
def test_every_run_of_the_exact_record_is_a_run_of_the_over_approximation(
    sequence: list[tuple[int, int]],
) -> None:
    ticks = updates(sequence)
    exact = list(answers(EXACT[0], ticks))
    assert list(answers(slow_record("rx", rx_update, exact=False), ticks, guesses=exact)) == exact


@given(sequence=blocks)
def test_the_over_approximation_is_not_slow_before_ten_intervals(sequence: list[tuple[int, int]]) -> None:
    ticks = updates(sequence)[:300]
    always_slow = answers(slow_record("rx", rx_update, exact=False), ticks, guesses=[True] * len(ticks))
    for tick, slow in enumerate(always_slow):
        assert slow == (sum(ticks[: tick + 1]) >= 11)
