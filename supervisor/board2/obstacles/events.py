"""The local events of the obstacle chart: sending one is a call that returns when the receiver has run."""

from collections.abc import Callable
from enum import Enum, auto


class Event(Enum):
    """What one part of the chart tells another [spec Figs 25-27]."""

    EMERGENCY = auto()
    SAFE = auto()
    FALL1 = auto()
    FALL2 = auto()
    FALL3 = auto()
    MOVE_TO_S1 = auto()
    MOVE_TO_S2 = auto()
    MOVE_TO_S3 = auto()


Send = Callable[[Event], None]
"""A directed send: the receiver is executed at once and completely, then the sender goes on."""
