"""A run over time as stacked lanes that share the time axis: curves, and bands of labelled states."""

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum


class Tone(Enum):
    """What a band means, apart from its label."""

    OK = "ok"
    DEGRADED = "degraded"
    CRITICAL = "critical"
    IDLE = "idle"
    FIRST = "first"
    SECOND = "second"
    ACTION = "action"


@dataclass(frozen=True)
class Curve:
    """A number over time; ``steps``: it keeps each value until the next time."""

    name: str
    times_s: Sequence[float]
    values: Sequence[float]
    steps: bool = False


@dataclass(frozen=True)
class LaneLimit:
    """A value at which something changes."""

    value: float
    name: str


@dataclass(frozen=True)
class ChartLane:
    """Curves on one axis; ``low`` and ``high`` are shown at least."""

    title: str
    curves: Sequence[Curve]
    low: float
    high: float
    limits: Sequence[LaneLimit] = ()
    ticks: Sequence[float] = ()


@dataclass(frozen=True)
class Band:
    """A state that lasts from one time to another."""

    start_s: float
    end_s: float
    label: str
    tone: Tone


@dataclass(frozen=True)
class LaneRow:
    """The states of one signal, one after the other."""

    name: str
    bands: Sequence[Band]


@dataclass(frozen=True)
class LaneRows:
    """Signals that belong together."""

    title: str
    rows: Sequence[LaneRow]


@dataclass(frozen=True)
class Mark:
    """An event from outside, shown by its number and explained below; it is over at ``until_s``."""

    number: int
    at_s: float
    until_s: float
    text: str


@dataclass(frozen=True)
class Lanes:
    """The whole picture, from time 0 to ``end_s``."""

    title: str
    note: str
    end_s: float
    lanes: Sequence[ChartLane | LaneRows]
    marks: Sequence[Mark] = ()
