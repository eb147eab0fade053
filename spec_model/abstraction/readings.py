"""Other ways to take a time stamp: in fewer bits, a step late, every other one, two in one record.

And to hold its age: as a sum of steps in single precision.

A task that calls a supervisor hands stamps over; where it does so otherwise, the charts are as they were, and
see other ages, updates and means.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from struct import pack, unpack
from typing import cast

from rovercheck.spec_model.abstraction.stamps import CLOCK, since
from rovercheck.spec_model.lang.system import TICK_MS

Take = Callable[[int | None, int | None], int | None]
"""The stamp that is taken, of the one given and the time of the step; called once in every step.

``None`` is what is not known, as where a log has a gap.
"""

TOGETHER: Mapping[str, int] = {
    "into one record with ": 0, "into one record, added up in 32 bits, with ": 32
}  # fmt: skip
"""Ways to keep the intervals of two stamps, and in how many bits they are added up; 0: in all they need."""


@dataclass(frozen=True)
class StampReading:
    """How one stamp is taken: one of ``READINGS`` or ``AGES``, or into the record of intervals of another."""

    stamp: str
    how: str

    @property
    def text(self) -> str:
        """What an implementation is like: "last_valid_b2_ms went through 16 bits"."""
        if self.other:
            bits = f", added up in {self.bits} bits" if self.bits else ""
            return f"the intervals of {self.other} and {self.stamp} went into one record{bits}"
        return (AGES if self.of_age else READINGS)[self.how][0].format(self.stamp)

    @property
    def of_age(self) -> bool:
        """Whether the stamp is as it was, and beside its age there is another one."""
        return self.how in AGES

    def age(self, ms: int) -> Fraction:
        """The milliseconds that an age is taken for."""
        return AGES[self.how][1](ms)

    @property
    def other(self) -> str:
        """The stamp into whose record this one goes, which is read first; "": none."""
        return next((self.how.removeprefix(w) for w in TOGETHER if self.how.startswith(w)), "")

    @property
    def bits(self) -> int:
        """In how many bits the intervals of two stamps are added up; 0: in as many as needed."""
        return next((bits for way, bits in TOGETHER.items() if self.how.startswith(way)), 0)

    @property
    def earlier(self) -> tuple["StampReading", ...]:
        """Of a stamp that is new in every step from an update on: the same from earlier ones on, in turn."""
        hows = [_new_from(number) for number in UPDATES]
        later = hows[hows.index(self.how) + 1 :] if self.how in hows else []
        return tuple(StampReading(self.stamp, how) for how in later)

    @property
    def since(self) -> str:
        """From which update on: "from update 8 on"."""
        return self.how.removeprefix(NEW).lstrip()

    def start(self) -> Take:
        """Takes the stamp step by step from power-up."""
        return READINGS[self.how][1]()


class StampsTaken:
    """Stamps as some readings take them, step by step from power-up."""

    def __init__(self, readings: Sequence[StampReading]) -> None:
        self._takes = [(one.stamp, one.start()) for one in readings if one.how in READINGS]

    @property
    def names(self) -> list[str]:
        """The stamps that are taken otherwise."""
        return list(dict.fromkeys(name for name, _ in self._takes))

    def step(self, stamps: Mapping[str, int | None], now_ms: int | None) -> dict[str, int | None]:
        """Those that are taken otherwise, known where all is that they are made of."""
        found: dict[str, int | None] = {}
        for name, take in self._takes:
            found[name] = take(found[name] if name in found else stamps.get(name), now_ms)
        return found


def readings_of(stamp: str, recorded: Sequence[str] = ()) -> Iterator[StampReading]:
    """All readings of a stamp; ``recorded``: the stamps whose means are taken, in the order of the steps."""
    for how in READINGS:
        yield StampReading(stamp, how)
    if stamp in recorded:
        for earlier in recorded[: list(recorded).index(stamp)]:
            yield from (StampReading(stamp, way + earlier) for way in TOGETHER)


# --- the ways ---------------------------------------------------------------------------------------


def _bits(number: int) -> Take:
    return lambda stamp, _: None if stamp is None else stamp % (1 << number)


def _age_bits(number: int) -> Take:
    def take(stamp: int | None, now: int | None) -> int | None:
        if stamp is None or now is None:
            return None
        return (now - since(now, stamp) % (1 << number)) % CLOCK

    return take


class _Late:
    def __init__(self) -> None:
        self._before: int | None = 0

    def __call__(self, stamp: int | None, _now: int | None) -> int | None:
        before, self._before = self._before, stamp
        return before


class _EveryOther:
    """Takes new stamps whose number, from 1, is even or odd; after a gap nobody knows their numbers."""

    def __init__(self, rest: int) -> None:
        self._rest, self._number = rest, 0
        self._given: int | None = 0
        self._taken: int | None = 0

    def __call__(self, stamp: int | None, _now: int | None) -> int | None:
        if stamp is None or self._given is None:
            self._given = self._taken = None
        elif stamp != self._given:
            self._number += 1
            if self._number % 2 == self._rest:
                self._taken = stamp
            self._given = stamp
        return self._taken


class _NewFrom:
    """From an update on, every step finds a new stamp: as where a counter no longer equals its copy.

    Behind a gap at least those updates have come that were seen.
    """

    def __init__(self, first: int) -> None:
        self._first, self._number, self._certain = first, 0, True
        self._given: int | None = 0

    def __call__(self, stamp: int | None, now: int | None) -> int | None:
        self._number += None not in (stamp, self._given) and stamp != self._given
        self._certain &= stamp is not None
        self._given = stamp
        if self._number >= self._first:
            return now
        return stamp if self._certain else None


UPDATES = (256, 128, 64, 32, 16, 8, 4, 2, 1)
"""After so many a counter that is cut off may no longer equal its copy; the later, the fewer steps differ."""
NEW = "new in every step"


def _new_from(update: int) -> str:
    return f"{NEW} from update {update} on"


class _First:
    def __init__(self) -> None:
        self._taken: int | None = None
        self._began = False

    def __call__(self, stamp: int | None, _now: int | None) -> int | None:
        if not self._began:
            self._taken, self._began = stamp, True
        return self._taken


READINGS: Mapping[str, tuple[str, Callable[[], Take]]] = {
    "a step late": ("{} were given a step late", _Late),
    "in 16 bits": ("{} went through 16 bits", partial(_bits, 16)),
    "in 8 bits": ("{} went through 8 bits", partial(_bits, 8)),
    "in 24 bits": ("{} went through 24 bits", partial(_bits, 24)),
    "its age in 16 bits": ("the age of {} were counted in 16 bits", partial(_age_bits, 16)),
    "its age in 8 bits": ("the age of {} were counted in 8 bits", partial(_age_bits, 8)),
    "every other one": ("only every other update of {} were seen", partial(_EveryOther, 0)),
    "every other one from the first": (
        "only every other update of {} were seen, the first one too", partial(_EveryOther, 1)
    ),
    **{
        _new_from(n): (f"{{}} were new in every step from its update {n} on", partial(_NewFrom, n))
        for n in UPDATES
    },
    "of the first step": ("{} were read in the first step only", _First),
    "never": ("{} were not read: always 0", lambda: lambda _stamp, _now: 0),
}  # fmt: skip
"""What is said of each way to take a stamp, and how it is done; the nearest first."""


class _AddedUp:
    """An age as a sum of the seconds of a step, each time rounded to single precision."""

    def __init__(self, step_s: float) -> None:
        self._step_s = step_s
        self._sums = [0.0]

    def __call__(self, ms: int) -> Fraction:
        steps = min(ms // TICK_MS, MOST_STEPS)
        while len(self._sums) <= steps:
            self._sums.append(_single(self._sums[-1] + self._step_s))
        return Fraction(self._sums[steps]) * 1000


class _AddedToRest:
    """The same from the milliseconds on that are no whole step."""

    def __init__(self, step_s: float) -> None:
        self._step_s = step_s
        self._of_rest: dict[int, list[float]] = {}

    def __call__(self, ms: int) -> Fraction:
        steps, rest = min(ms // TICK_MS, MOST_STEPS), ms % TICK_MS
        sums = self._of_rest.setdefault(rest, [_single(rest * _single(0.001))])
        while len(sums) <= steps:
            sums.append(_single(sums[-1] + self._step_s))
        return Fraction(sums[steps]) * 1000


def _single(number: float) -> float:
    """The number of 32 bits that is nearest."""
    return cast(float, unpack("f", pack("f", number))[0])


MOST_STEPS = 100_000
"""Steps of an age that are added up, 33 minutes; an older one is not looked at more closely."""

_EXACT, _SINGLE = TICK_MS / 1000, _single(TICK_MS / 1000)

AGES: Mapping[str, tuple[str, Callable[[int], Fraction]]] = {
    "added up in single precision":
        ("the age of {} were a sum of steps of 0.02 s in single precision", _AddedUp(_SINGLE)),
    "added up in single precision, the step in double":
        ("the age of {} were a sum in single precision of steps of 0.02 s in double", _AddedUp(_EXACT)),
    "added up in single precision, after the rest":
        ("the age of {} were what is no whole step and a sum of steps of 0.02 s, in single precision",
         _AddedToRest(_SINGLE)),
}  # fmt: skip
"""The same of each way to hold an age, in which a formula reads it."""
