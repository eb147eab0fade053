"""Fault masks of Board 1, and what it makes of those of Board 2."""

import pytest

from rovercheck.supervisor.board1.classify import Requirements, classify
from rovercheck.supervisor.board1.masks import Masks, fault_masks
from rovercheck.supervisor.board1.signals import Statuses
from rovercheck.supervisor.types import Level

COMPONENTS = [
    ("temp_status", None, 1),
    ("batt_status", None, 2),
    ("rx_status", None, 4),
    ("wheel_status", 0, 8),
    ("wheel_status", 1, 16),
    ("wheel_status", 2, 32),
    ("wheel_status", 3, 64),
    ("b2_sup_status", None, 128),
]


@pytest.mark.parametrize("name, wheel, value", COMPONENTS)
def test_one_bit_per_component(name, wheel, value):
    def masks(level):
        if wheel is None:
            return fault_masks(Statuses(**{name: level}))
        wheels = [Level.OK] * 4
        wheels[wheel] = level
        fl, fr, rl, rr = wheels
        return fault_masks(Statuses(wheel_status=(fl, fr, rl, rr)))

    assert masks(Level.OK) == Masks(0, 0)
    assert masks(Level.DEGRADED) == Masks(0, value)
    assert masks(Level.CRITICAL) == Masks(value, 0)


def test_all_components():
    for level, masks in ((Level.CRITICAL, Masks(255, 0)), (Level.DEGRADED, Masks(0, 255))):
        assert fault_masks(Statuses(level, level, (level,) * 4, level, level)) == masks


@pytest.mark.parametrize("critical", range(16))
@pytest.mark.parametrize("degraded", range(16))
def test_classification(critical, degraded):
    assert classify(critical, degraded) == Requirements(
        stop=critical % 4 > 0, degraded=critical >= 4 or degraded > 0
    )


def test_unused_bits():
    assert classify(0xF0, 0) == Requirements(False, False)
    assert classify(0, 0xF0) == Requirements(False, True)
