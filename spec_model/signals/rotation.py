"""Domains of the 180° rotation: headings in steps in which every limit of the charts is exact.

The limits are 7.5, 15 and 45 degrees; headings are multiples of 2.5 degrees, so that each limit and
values on both sides of it occur, and 0.005 times an error is exact.
"""

from fractions import Fraction

from rovercheck.spec_model.lang.domain import Domain, Num, Unit, exact, fixed

GRID = Fraction("2.5")
"""Degrees between two headings of the model."""

HEADING = fixed(0, "357.5", GRID, "°")
"""Yaw: [0;360[ degrees, clockwise positive."""

TARGET = fixed(0, 360, GRID, "°")
"""The heading at which the rotation ends; ``angle180`` can return 360."""

ERROR = fixed(-180, "177.5", GRID, "°")
"""What is left to turn: wrap(...), so -180 and not 180."""

_ONE_SIDE = [exact(e) for e in (5, 7.5, 10, 15, 30, 45, 90)]
_CLASSES = sorted([exact(-180), exact(0), *_ONE_SIDE, *(-e for e in _ONE_SIDE)])
ERROR_CLASSES = Domain(Num(GRID, Unit.of("°")), tuple(int(e / GRID) for e in _CLASSES))
"""One error for each set that no comparison of the motion charts divides."""
