"""The time of firmware: a clock that wraps, timers at N-1, N and N+1 steps, edges."""

import pytest

from rovercheck.supervisor.timing import (
    CLOCK,
    After,
    Age,
    Duration,
    Held,
    IntervalMean,
    Rising,
    elapsed_ms,
    steps,
)


def test_the_clock_has_32_bits():
    assert CLOCK == 4_294_967_296
    assert elapsed_ms(5, 4_294_967_290) == 11
    assert [elapsed_ms(7, 7), elapsed_ms(4_294_967_295, 0)] == [0, 4_294_967_295]


@pytest.mark.parametrize("seconds, count", [(0.02, 1), (0.5, 25), (1, 50), (3, 150), (4, 200)])
def test_steps(seconds, count):
    assert steps(seconds) == count


def test_held_counts_milliseconds_from_the_first_true_step():
    held = Held(100)
    assert [held.update(True, now) for now in (1000, 1099, 1100, 1101)] == [False, False, True, True]
    assert [held.update(False, 1120), held.update(True, 1140), held.update(True, 1239)] == [False] * 3
    assert held.update(True, 1240)


def test_held_lasts_as_long_as_its_condition():
    held = Held(100)
    assert [held.update(True, now) for now in (1000, 1100, 990, 1000, 1020)] == [
        False,
        True,
        True,
        True,
        True,
    ]


def test_age():
    age = Age()
    assert [age.update(0, 0), age.update(0, 30), age.update(10, 30), age.update(30, 30)] == [0, 30, 20, 0]
    assert [age.update(30, 20), age.update(30, 40)] == [CLOCK - 10] * 2
    assert age.update(31, 40) == 9


def test_mean_of_ten_intervals():
    mean = IntervalMean(40)
    stamps = [1000 + 41 * i for i in range(11)]
    assert [mean.update(stamp) for stamp in stamps] == [False] * 10 + [True]
    assert mean.update(stamps[-1])
    assert not mean.update(stamps[-1] + 31)


def test_after():
    after = After(3)
    over = []
    for _ in range(5):
        after.tick()
        over.append(after.over)
    assert over == [False, False, True, True, True]
    after.enter()
    assert not after.over


def outcomes(duration, conditions):
    """The guard in each step; the condition does not change within a step."""
    found = []
    for condition in conditions:
        found.append(duration.test(condition))
        duration.end_step(True, condition)
    return found


def test_duration_is_longer_than_its_limit():
    assert outcomes(Duration(3), [True] * 6) == [False] * 4 + [True] * 2
    assert outcomes(Duration(3), [True] * 4 + [False] + [True] * 5) == [False] * 9 + [True]


def test_duration_looks_at_the_end_of_a_step_too():
    duration = Duration(1)
    for at_end in (True, False, True, True):
        assert not duration.test(True)
        duration.end_step(True, at_end)
    assert duration.test(True)
    duration.enter()
    assert not duration.test(True)


def test_duration_stands_still_while_its_state_is_inactive():
    duration = Duration(1)
    duration.end_step(True, True)
    duration.end_step(False, True)
    assert not duration.test(True)
    duration.end_step(True, True)
    assert duration.test(True)


def test_rising():
    rising = Rising()
    assert [rising.update(v) for v in (1, 1, 0, 1, 1, 0, 0, 0.5)] == [
        False, False, False, True, False, False, False, True,
    ]  # fmt: skip
    late = Rising()
    assert [late.update(v) for v in (0, 1, -1, 2)] == [False, True, False, True]
