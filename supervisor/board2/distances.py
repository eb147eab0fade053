"""What the three sonars say: left, centre and right, in centimetres."""

from math import isfinite

Distances = tuple[float, float, float]
"""Sonars 1, 2 and 3; 301 without an echo (E13), 0 before the first scan."""

STOP_CM = 70
STOP_DEGRADED_CM = 300
MOVING_CM = (100, 300)


def within(distances: Distances, limit_cm: int) -> bool:
    """Whether some sonar sees an obstacle at the limit or nearer (E02, E27).

    A distance that is no finite number counts as an obstacle, like the 0 before the first scan.
    """
    return any(distance <= limit_cm or not isfinite(distance) for distance in distances)


def close_range(distance: float) -> bool:
    """Whether an obstacle is where one that moves is watched: beyond 100 cm, to 300 included (E01, E03)."""
    low, high = MOVING_CM
    return low < distance <= high
