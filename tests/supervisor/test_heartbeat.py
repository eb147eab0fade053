"""The heartbeat is compared for change alone, in the steps of the receiver [spec Table 2, S40]."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rovercheck.supervisor.link.heartbeat import AliveCounter, Heartbeat
from rovercheck.supervisor.link.payloads import FromBoard1, FromBoard2

COUNTERS = st.integers(0, 2**32 - 1)


def test_the_counter_carries_the_number_of_the_execution():
    counter = AliveCounter()
    assert [counter.executed() for _ in range(3)] == [1, 2, 3]


def test_the_counter_wraps_to_zero_and_the_wrap_is_an_update():
    counter, heartbeat = AliveCounter(2**32 - 2), Heartbeat()
    sent = [counter.executed() for _ in range(3)]
    assert sent == [2**32 - 1, 0, 1]
    assert [heartbeat.update(n, now) for n, now in zip(sent, (20, 40, 60), strict=True)] == [20, 40, 60]


@pytest.mark.parametrize("bits", range(32))
def test_the_counter_has_all_its_bits(bits):
    assert AliveCounter((1 << bits) - 1).executed() == 1 << bits


@pytest.mark.parametrize("payload", [FromBoard1(), FromBoard2()])
def test_what_is_there_before_the_first_frame_is_no_heartbeat(payload):
    heartbeat = Heartbeat()
    assert [heartbeat.update(payload.alive_counter, now) for now in (20, 40, 5000)] == [0, 0, 0]


def test_a_counter_that_stands_still_keeps_the_stamp():
    heartbeat = Heartbeat()
    assert [heartbeat.update(7, now) for now in (1000, 1020, 1140)] == [1000, 1000, 1000]


def test_a_jump_is_one_update():
    """[S40] ANY-CHANGE: +3 every 60 ms is an update every 60 ms."""
    heartbeat = Heartbeat()
    received = [3, 3, 3, 6, 6, 6, 9]
    stamps = [heartbeat.update(counter, 20 * step) for step, counter in enumerate(received, start=1)]
    assert stamps == [20, 20, 20, 80, 80, 80, 140]


def test_a_sender_that_starts_again_is_alive():
    heartbeat = Heartbeat()
    assert [heartbeat.update(counter, now) for counter, now in ((900, 20), (1, 40), (2, 60))] == [20, 40, 60]


@given(st.lists(COUNTERS), COUNTERS)
def test_the_stamp_is_that_of_the_last_change(received, first):
    heartbeat, before, expected = Heartbeat(), 0, 0
    for step, counter in enumerate([first, *received], start=1):
        expected = 20 * step if counter != before else expected
        assert heartbeat.update(counter, 20 * step) == expected
        before = counter
