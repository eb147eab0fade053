"""Ten-interval records with updates at any ms: against the time stamps, and the over-approximation."""

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import accumulate, pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rovercheck.spec_model.ambiguity import fixed
from rovercheck.spec_model.environment.milliseconds import (
    heartbeat_record,
    reception_any_mean,
    reception_record,
)
from rovercheck.spec_model.lang.chart import Block
from rovercheck.spec_model.lang.interpret import Interpreter
from rovercheck.spec_model.lang.system import TICK_MS, in_order
from tests.interpretations.arrivals import at
from tests.profiles import examples

intervals = st.lists(
    st.tuples(st.sampled_from([20, 21, 38, 39, 40, 41, 50, 130, 421, *range(1, 20)]), st.integers(1, 12)),
    min_size=1,
    max_size=6,
)
"""Intervals in ms, and how often each is repeated; the first is the silence after power-up."""

AS_READ: Mapping[str, str] = {}
READINGS: list[Mapping[str, str]] = [
    AS_READ,
    {"S34": "PARTIAL"},
    {"S35": "OPEN"},
    {"S36": "ARRIVAL"},
    {"S37": "GE"},
    {"S66": "COUNT"},
    {"S34": "PARTIAL", "S35": "OPEN", "S37": "GE", "S66": "COUNT"},
    {"S34": "PARTIAL", "S35": "OPEN", "S36": "ARRIVAL", "S37": "GE", "S66": "COUNT"},
]
under_each = pytest.mark.parametrize("choices", READINGS, ids=lambda c: "-".join(c.values()) or "as read")


def stamps(sequence: Sequence[tuple[int, int]]) -> list[int]:
    """The instants of the updates, at most two in a tick."""
    found: list[int] = []
    for stamp in accumulate(gap for gap, times in sequence for _ in range(times)):
        if sum(_tick(stamp) == _tick(other) for other in found) < 2:
            found.append(stamp)
    return found


def _tick(stamp: int) -> int:
    return -(-stamp // TICK_MS)


def answers(
    record: Block, times: Sequence[int], choices: Mapping[str, str], guesses: Sequence[bool] = ()
) -> Iterator[bool]:
    """``rx_slow`` after each tick, until 10 ticks after the last update."""
    system = fixed(choices).system(in_order("record", record))
    machine = Interpreter(system)
    for tick, (_, arrived) in enumerate(at(times, first_step=20, last_step=_last_step(times))):
        inputs = {**arrived, "rx_mean_slow": bool(guesses) and guesses[tick]}
        machine.step({name: int(inputs.get(name, 0)) for name in system.inputs})
        yield bool(machine.data["rx_slow"])


def _last_step(times: Sequence[int]) -> int:
    return TICK_MS * (_tick(times[-1]) + 10)


def by_time_stamps(times: Sequence[int], choices: Mapping[str, str]) -> Iterator[bool]:
    """The definition: the mean of the last ten differences of stamps as a fraction."""
    known = [0] if choices.get("S66") == "COUNT" else []
    slow = False
    for now in range(TICK_MS, _last_step(times) + 1, TICK_MS):
        arrived = [stamp for stamp in times if now - TICK_MS < stamp <= now]
        known += arrived if choices.get("S36") == "ARRIVAL" else arrived[-1:]
        if arrived or choices.get("S35") == "OPEN":
            ends = known if arrived or not known else [*known, now]
            last = [later - earlier for earlier, later in pairwise(ends)][-10:]
            mean = Fraction(sum(last), max(len(last), 1))
            needed = 1 if choices.get("S34") == "PARTIAL" else 10
            slow = len(last) >= needed and (mean > 40 or (mean == 40 and choices.get("S37") == "GE"))
        yield slow


@under_each
@examples(25)
@given(sequence=intervals)
def test_the_record_computes_the_mean_of_the_time_stamps(
    choices: Mapping[str, str], sequence: list[tuple[int, int]]
) -> None:
    times = stamps(sequence)
    assert list(answers(reception_record(), times, choices)) == list(by_time_stamps(times, choices))


@under_each
@examples(25)
@given(sequence=intervals)
def test_every_run_of_the_record_is_a_run_of_the_over_approximation(
    choices: Mapping[str, str], sequence: list[tuple[int, int]]
) -> None:
    times = stamps(sequence)
    exact = list(by_time_stamps(times, choices))
    assert list(answers(reception_any_mean, times, choices, guesses=exact)) == exact


@pytest.mark.parametrize(("limit", "slow"), [("GT", False), ("GE", True)])
@pytest.mark.parametrize("phase", [0, 7, 19])
def test_a_mean_of_exactly_40_ms_at_any_phase(phase: int, limit: str, slow: bool) -> None:
    times = [100 + phase + 40 * n for n in range(11)]
    assert list(answers(reception_record(), times, {"S37": limit}))[-1] is slow


@pytest.mark.parametrize(("gap", "slow"), [(120, False), (123, True)])
def test_a_counter_that_moves_by_three_closes_three_intervals(gap: int, slow: bool) -> None:
    system = fixed({"S40": "COUNT-DELTA"}).system(in_order("record", heartbeat_record()))
    machine = Interpreter(system)
    times = [100 + gap * n for n in range(5)]
    for _, arrived in at(times, first_step=20, last_step=_last_step(times), link="heartbeat"):
        inputs = {**arrived, "heartbeat_moves": 3}
        machine.step({name: int(inputs.get(name, 0)) for name in system.inputs})
    assert bool(machine.data["heartbeat_slow"]) is slow
