"""Does the rotation of the IMU agree with that of the wheels: windows, limits, the ring of ten."""

from math import inf, nan

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rovercheck.supervisor.board2.coherence import DPS_PER_RPM, Coherence, wheel_yaw_rate

REST = (0.0, 0.0, 0.0, 0.0)


def turning(dps: float) -> tuple[float, float, float, float]:
    """Wheel speeds that make the rover turn clockwise so fast."""
    rpm = dps / DPS_PER_RPM / 2
    return (rpm, -rpm, rpm, -rpm) if dps else REST


def results(
    rates: list[float],
    wheels: tuple[float, float, float, float] = REST,
    period_ms: int = 20,
    start_ms: int = 1000,
) -> list[bool]:
    """The initial step, and one for each yaw rate in degrees/s, all with new data of both sources."""
    coherence = Coherence()
    return [
        coherence.step(start_ms + i * period_ms, start_ms + i * period_ms, wheels, rate)
        for i, rate in enumerate([0.0, *rates])
    ]


def incoherent(windows: list[bool]) -> list[int]:
    """The fast windows, from 1, whose closing step says incoherent, if no long window does.

    A rotation of 20 degrees/s turns round after every window so that no 5 degrees come together.
    """
    coherence, found, sign = Coherence(), [], 1
    coherence.step(0, 0, REST, 0)
    for i, hit in enumerate(windows):
        sign = -sign if hit else sign
        for j in range(5):
            stamp = i * 100 + (j + 1) * 20
            if not coherence.step(stamp, stamp, REST, sign * 20.0 if hit else 0.0):
                assert j == 4, "only a step that closes a window can say it"
                found.append(i + 1)
    return found


def test_the_factor_is_that_of_the_document():
    assert pytest.approx(1743 / 1900, rel=1e-15) == DPS_PER_RPM
    assert wheel_yaw_rate((10, 0, 20, 0)) == pytest.approx(15 * 1743 / 1900)
    assert wheel_yaw_rate((0, 10, 0, 20)) == pytest.approx(-15 * 1743 / 1900)


@pytest.mark.parametrize("rate", [0.0, 5.0, -90.0, 300.0])
def test_wheels_that_turn_as_the_imu_says_agree(rate):
    assert all(results([rate] * 400, turning(rate)))


def test_the_eighth_hit_of_the_last_ten_windows_disagrees():
    assert incoherent([True] * 7) == []
    assert incoherent([True] * 8) == [8]
    assert incoherent([True] * 12) == [8, 9, 10, 11, 12]


def test_the_ring_holds_ten_windows():
    assert incoherent([False] * 2 + [True] * 8) == [10]
    assert incoherent([True, False, False] + [True] * 7) == [10]
    assert incoherent([True, False, False, False] + [True] * 7) == []
    assert incoherent([True] * 8 + [False] * 3) == [8, 9, 10]


@pytest.mark.parametrize(("rate", "hits"), [(9.9, False), (10.0, True), (-10.0, True), (-9.9, False)])
def test_a_fast_window_needs_one_degree_of_the_imu(rate, hits):
    """Eight windows of 100 ms, the sign of all the same; no long window closes."""
    assert all(results([rate] * 40)) is not hits


@pytest.mark.parametrize(("wheels", "hits"), [(10.1, False), (9.9, True), (30.1, True), (29.9, False)])
def test_a_fast_window_needs_one_degree_of_difference(wheels, hits):
    assert all(results([20.0] * 40, turning(wheels))) is not hits


def test_wheels_that_turn_alone_are_no_fast_hit():
    assert all(results([0.0] * 149, turning(90.0)))


@pytest.mark.parametrize(("rate", "agrees"), [(1.6, True), (5 / 3 + 0.001, False), (-5 / 3 - 0.001, False)])
def test_a_long_window_allows_less_than_5_degrees_in_3_s(rate, agrees):
    found = results([rate] * 300)
    assert [i for i, ok in enumerate(found) if not ok] == ([] if agrees else [150, 300])


def test_exactly_5_degrees_disagree():
    assert results([0.0] * 145 + [50.0] * 5)[-1] is False
    assert results([0.0] * 145 + [49.0] * 5)[-1] is True


def test_a_long_window_begins_anew():
    found = results([0.0] * 140 + [50.0] * 9 + [0.0] * 300)
    assert [i for i, ok in enumerate(found) if not ok] == [150]


@pytest.mark.parametrize(("period", "counts"), [(99, True), (100, False), (101, False)])
def test_data_after_a_gap_of_100_ms_are_left_out(period, counts):
    """The windows close all the same."""
    found = results([40.0] * 40, period_ms=period)
    assert (False in found) is counts


def test_data_after_a_long_gap_count_for_no_time_at_all():
    assert all(results([1e6] * 40, turning(-1e6), period_ms=100))


@pytest.mark.parametrize(("steps", "closes"), [(149, False), (150, True), (151, False)])
def test_the_long_window_closes_at_3000_ms(steps, closes):
    found = results([2.0] * steps)
    assert found[-1] is not closes


def test_without_new_imu_data_no_window_closes():
    coherence = Coherence()
    coherence.step(0, 0, REST, 0)
    assert all(coherence.step(i * 20, 0, turning(90.0), 90.0) for i in range(1, 1000))


def test_wheel_speeds_count_once_for_each_stamp():
    """The stamp of the wheels moves every second step: each update stands for 40 ms."""
    coherence = Coherence()
    coherence.step(0, 0, REST, 0)
    for i in range(1, 320):
        assert coherence.step(i // 2 * 40, i * 20, turning(40.0), 40.0)


def test_the_first_step_takes_its_stamps_as_the_beginning():
    coherence = Coherence()
    assert coherence.step(5_000_000, 4_000_000, REST, 500.0)
    assert coherence.step(5_000_000, 4_000_000, REST, 500.0)


def test_a_clock_that_starts_again_at_0_changes_nothing():
    def run(start: int, rate: float) -> list[bool]:
        coherence, clock = Coherence(), 1 << 32
        stamps = [(start + i * 20) % clock for i in range(200)]
        return [coherence.step(s, s, REST, rate) for s in stamps]

    for rate in (1.0, 2.0, 20.0):
        assert run((1 << 32) - 1000, rate) == run(1000, rate)


@pytest.mark.parametrize("value", [nan, inf, -inf])
def test_a_yaw_rate_that_is_no_number_disagrees(value):
    found = results([value if i == 70 else 0.0 for i in range(150)])
    assert [i for i, ok in enumerate(found) if not ok] == [150]
    assert results([value] * 40)[-1] is False


@pytest.mark.parametrize("value", [nan, inf, -inf])
def test_a_wheel_speed_that_is_no_number_disagrees(value):
    assert results([0.0] * 150, (value, 0, 0, 0))[-1] is False
    assert results([20.0] * 40, (0, value, 0, 0))[-1] is False


@given(st.lists(st.sampled_from([-20.0, 0.0, 9.0, 20.0]), max_size=200))
def test_only_a_step_that_closes_a_window_can_disagree(rates):
    assert all(ok for i, ok in enumerate(results(rates)) if i % 5)
