"""What the faults that Board 2 reports ask of Board 1: to stop, or to go on with care [spec Fig 19]."""

from dataclasses import dataclass

STOPPING = 0b0011
"""Joystick link and IMU: without them nobody steers."""
DEGRADING = 0b1100
"""Reception from Board 1 and the supervisor of Board 1."""


@dataclass(frozen=True, slots=True)
class Requirements:
    """``stop_required`` and ``degraded_required`` of the block that processes the masks of Board 2."""

    stop: bool
    degraded: bool


def classify(b2_critical_mask: int, b2_degraded_mask: int) -> Requirements:
    """The requirements of both received masks (S55)."""
    return Requirements(
        stop=b2_critical_mask & STOPPING != 0,
        degraded=b2_critical_mask & DEGRADING != 0 or b2_degraded_mask != 0,
    )
