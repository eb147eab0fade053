"""The three records of ten intervals: the literal one, the window of arrivals, the over-approximation.

Update sequences are blocks of equal intervals, so that bursts, silences and means on the limit occur.
"""

from collections.abc import Iterator, Mapping
from fractions import Fraction
from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rovercheck.spec_model.ambiguity import fixed
from rovercheck.spec_model.lang.chart import Block
from rovercheck.spec_model.lang.interpret import Interpreter
from rovercheck.spec_model.lang.system import TICK_MS, in_order
from rovercheck.spec_model.records import arrival_window, slow_record
from rovercheck.spec_model.signals.board1 import rx_update
from tests.profiles import examples

blocks = st.lists(st.tuples(st.integers(1, 26), st.integers(1, 12)), min_size=1, max_size=8)
"""Intervals in ticks, and how often each is repeated."""

EXACT = [slow_record("rx", rx_update, exact=True), arrival_window("rx", rx_update)]
ANY = slow_record("rx", rx_update, exact=False)

AS_READ: Mapping[str, str] = {}
READINGS: list[Mapping[str, str]] = [
    AS_READ,
    {"S34": "PARTIAL"},
    {"S35": "OPEN"},
    {"S37": "GE"},
    {"S66": "COUNT"},
    {"S34": "PARTIAL", "S35": "OPEN", "S37": "GE", "S66": "COUNT"},
]


def updates(sequence: list[tuple[int, int]]) -> list[bool]:
    """Whether there is an update, tick by tick; the first interval is the silence after power-up."""
    return [last for gap, times in sequence for _ in range(times) for last in (*[False] * (gap - 1), True)]


def answers(
    record: Block,
    sequence: list[bool],
    guesses: list[bool] | None = None,
    choices: Mapping[str, str] = AS_READ,
) -> Iterator[bool]:
    """``rx_slow`` after each tick."""
    machine = Interpreter(fixed(choices).system(in_order("record", record)))
    for tick, update in enumerate(sequence):
        inputs = {"rx_update": int(update)}
        if guesses is not None:
            inputs["rx_mean_slow"] = int(guesses[tick])
        machine.step(inputs)
        yield bool(machine.data["rx_slow"])


def by_time_stamps(sequence: list[bool], choices: Mapping[str, str] = AS_READ) -> Iterator[bool]:
    """The definition: time stamps in ms, the mean of the last ten differences as a fraction."""
    stamps = [0] if choices.get("S66") == "COUNT" else []
    slow = False
    for tick, update in enumerate(sequence, start=1):
        now = tick * TICK_MS
        if update:
            stamps.append(now)
        if update or choices.get("S35") == "OPEN":
            ends = stamps if update or not stamps else [*stamps, now]
            intervals = [later - earlier for earlier, later in pairwise(ends)][-10:]
            mean = Fraction(sum(intervals), max(len(intervals), 1))
            needed = 1 if choices.get("S34") == "PARTIAL" else 10
            slow = len(intervals) >= needed and (mean > 40 or (mean == 40 and choices.get("S37") == "GE"))
        yield slow


@pytest.mark.parametrize("choices", READINGS, ids=lambda choices: "-".join(choices.values()) or "as read")
@pytest.mark.parametrize("record", EXACT, ids=lambda record: record.name)
@examples(40)
@given(sequence=blocks)
def test_an_exact_record_computes_the_mean_of_the_time_stamps(
    record: Block, choices: Mapping[str, str], sequence: list[tuple[int, int]]
) -> None:
    ticks = updates(sequence)
    assert list(answers(record, ticks, choices=choices)) == list(by_time_stamps(ticks, choices))


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


@pytest.mark.parametrize("choices", READINGS, ids=lambda choices: "-".join(choices.values()) or "as read")
@examples(40)
@given(sequence=blocks)
def test_every_run_of_the_exact_record_is_a_run_of_the_over_approximation(
    choices: Mapping[str, str], sequence: list[tuple[int, int]]
) -> None:
    ticks = updates(sequence)
    exact = list(by_time_stamps(ticks, choices))
    assert list(answers(ANY, ticks, guesses=exact, choices=choices)) == exact


@given(sequence=blocks)
def test_the_over_approximation_is_not_slow_before_ten_intervals(sequence: list[tuple[int, int]]) -> None:
    ticks = updates(sequence)[:300]
    always_slow = answers(ANY, ticks, guesses=[True] * len(ticks))
    for tick, slow in enumerate(always_slow):
        assert slow == (sum(ticks[: tick + 1]) >= 11)
