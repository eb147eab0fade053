"""The masks of Board 2, bit by bit, and what the critical masks of both boards ask for."""

import pytest

from rovercheck.supervisor.board2.classify import Classification, classify
from rovercheck.supervisor.board2.masks import Statuses, mask
from rovercheck.supervisor.types import Level

BITS = {"esp_status": 1, "imu_status": 2, "rx_status": 4, "b1_sup_status": 8}


@pytest.mark.parametrize("name", BITS)
@pytest.mark.parametrize("level", Level)
def test_each_component_has_its_bit_in_one_mask_at_most(name: str, level: Level) -> None:
    statuses = Statuses(**{name: level})
    assert mask(statuses, Level.CRITICAL) == (BITS[name] if level is Level.CRITICAL else 0)
    assert mask(statuses, Level.DEGRADED) == (BITS[name] if level is Level.DEGRADED else 0)


def test_the_bits_add_up() -> None:
    statuses = Statuses(Level.CRITICAL, Level.DEGRADED, Level.CRITICAL, Level.DEGRADED)
    assert (mask(statuses, Level.CRITICAL), mask(statuses, Level.DEGRADED)) == (0b0101, 0b1010)


@pytest.mark.parametrize("bit", range(4))
def test_joystick_and_imu_are_the_emergencies_of_board_2(bit: int) -> None:
    assert classify(1 << bit, 0) == Classification(b2_emergency=bit in (0, 1))


@pytest.mark.parametrize("bit", range(8))
def test_a_critical_bit_of_board_1_asks_for_the_motors_or_is_an_emergency(bit: int) -> None:
    switch = bit in (2, 7)
    expected = Classification(b1_requests_switch=switch, b1_emergency=not switch)
    assert classify(0, 1 << bit) == expected
    assert expected.emergency is not switch


def test_both_may_be_asked_for_at_once() -> None:
    assert classify(0xFF, 0xFF) == Classification(True, True, True)
