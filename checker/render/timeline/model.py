"""What a timeline shows, in ticks and words and without coordinates: lanes of spans, limits and marks."""

from dataclasses import dataclass
from enum import StrEnum
from fractions import Fraction

from rovercheck.checker.render.lanes import Tone
from rovercheck.checker.render.periods import RepeatedTicks


class LaneKind(StrEnum):
    """How a lane is drawn: labelled bands, a step line, the ramp of a timer, or true and false."""

    BAND = "band"
    LINE = "line"
    RAMP = "ramp"
    TRUTH = "truth"


class LaneGroup(StrEnum):
    """What a lane belongs to; groups are drawn in this order."""

    INPUTS = "Inputs"
    CHARTS = "Charts"
    VALUES = "Computed"
    PROPERTY = "Property"


@dataclass(frozen=True)
class TimelineRun:
    """Ticks ``first`` to ``last`` (from 1, both included) in which a lane shows one thing.

    ``low`` and ``high`` are the numbers at its first and last tick: they differ only in a steady count.
    ``label`` is what is shown, ``until`` the same of the last tick where it differs.
    """

    first: int
    last: int
    label: str
    low: Fraction = Fraction(0)
    high: Fraction = Fraction(0)
    tone: Tone = Tone.IDLE
    until: str = ""


@dataclass(frozen=True)
class Limit:
    """A constant with which the number of a lane is compared, and what to write at its line."""

    value: Fraction
    label: str


@dataclass(frozen=True)
class Shot:
    """A transition that fired in a tick, in a few words."""

    tick: int
    text: str


@dataclass(frozen=True)
class NeededTicks:
    """Ticks ``first`` to ``last`` in which an input had to be so, as in ``d1 >= 71 cm``."""

    first: int
    last: int
    condition: str


@dataclass(frozen=True)
class Lane:
    """One variable over time (or one part of the property).

    ``runs`` cover ticks in order without overlap; a tick in none of them has no value.  ``needed`` tells
    where the value determines the end of the run.  ``shots`` are transitions fired, for the location of a
    chart.
    """

    name: str
    kind: LaneKind
    group: LaneGroup
    runs: tuple[TimelineRun, ...]
    limits: tuple[Limit, ...] = ()
    needed: tuple[NeededTicks, ...] = ()
    shots: tuple[Shot, ...] = ()
    doc: str = ""

    @property
    def extent(self) -> tuple[Fraction, Fraction]:
        """The lowest and the highest number that occurs."""
        ends = [end for run in self.runs for end in (run.low, run.high)]
        return min(ends, default=Fraction(0)), max(ends, default=Fraction(0))


@dataclass(frozen=True)
class Timeline:
    """A run over time; ``clock`` is that of its trace.

    ``constant`` are the variables that never change and have no lane, ``quiet`` the stretches of ticks
    (first, last) in which nothing happens but running counters, ``repeated`` those that repeat the
    period before them.  ``wrong`` says what is false at the end, and
    ``cause`` which inputs determine it, where that was examined; ``because`` is why, as it is written.
    """

    property: str
    text: str
    heading: str
    ticks: int
    clock: int | tuple[int, ...]
    lanes: tuple[Lane, ...]
    constant: tuple[tuple[str, str], ...] = ()
    quiet: tuple[tuple[int, int], ...] = ()
    repeated: tuple[RepeatedTicks, ...] = ()
    loop: int | None = None
    wrong: tuple[str, ...] = ()
    ending: str = ""
    cause: str = ""
    because: str = ""

    def ms(self, tick: int) -> int:
        """The time at the end of a tick."""
        return self.clock * tick if isinstance(self.clock, int) else self.clock[tick]

    def of(self, group: LaneGroup) -> tuple[Lane, ...]:
        """The lanes of a group, in their order."""
        return tuple(lane for lane in self.lanes if lane.group is group)
