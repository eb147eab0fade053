"""Whether a run is what its scenario expects, and if not, what happened instead."""

from bisect import bisect_left, bisect_right
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from rovercheck.supervisor.bench.columns import Scalar, inputs1, inputs2, outputs1, outputs2
from rovercheck.supervisor.bench.expectation import Expectation
from rovercheck.supervisor.bench.quantities import shown
from rovercheck.supervisor.bench.record import Record
from rovercheck.supervisor.bench.scenario import Scenario
from rovercheck.supervisor.bench.signals import SIGNALS, name_of


@dataclass(frozen=True)
class Outcome:
    """An expectation, and the sentence that says what was found."""

    expectation: Expectation
    met: bool
    said: str


@dataclass(frozen=True)
class History:
    """The values of a signal: each holds from its time on; before the first one it is as at power-up."""

    times_us: Sequence[int]
    values: Sequence[Scalar]
    initial: Scalar

    def at(self, time_us: int) -> Scalar:
        """The value at a time."""
        place = bisect_right(self.times_us, time_us)
        return self.values[place - 1] if place else self.initial

    def between(self, from_us: int, until_us: int) -> list[Scalar]:
        """The values that it has from one time to another, both included."""
        first, last = bisect_right(self.times_us, from_us), bisect_right(self.times_us, until_us)
        return [self.at(from_us), *self.values[first:last]]

    def first_us(self, wanted: Callable[[Scalar], bool], from_us: int) -> int | None:
        """When it first has such a value, from a time on."""
        start = bisect_left(self.times_us, from_us)
        later = zip(self.times_us[start:], self.values[start:], strict=True)
        return next((time_us for time_us, value in later if wanted(value)), None)


def history(record: Record, signal: str) -> History:
    """The values of a signal that exists."""
    place, _, name = signal.partition(".")
    initial = SIGNALS[signal].initial
    if place == "rover":
        samples = record.samples
        return History([s.time_us for s in samples], [getattr(s, name) for s in samples], initial)
    if place == "board1":
        one = record.board1
        row1 = inputs1 if one and name in inputs1(one[0].inputs) else None
        values = [row1(s.inputs)[name] if row1 else outputs1(s.outputs)[name] for s in one]
        return History([s.time_us for s in one], values, initial)
    two = record.board2
    row2 = inputs2 if two and name in inputs2(two[0].inputs) else None
    values = [row2(s.inputs)[name] if row2 else outputs2(s.outputs)[name] for s in two]
    return History([s.time_us for s in two], values, initial)


def judge(scenario: Scenario, record: Record) -> list[Outcome]:
    """The outcome of every expectation, in the order in which they are written."""
    return [_judge(one, history(record, one.signal)) for one in scenario.expectations]


def _judge(expected: Expectation, found: History) -> Outcome:
    values = found.between(expected.at_us, expected.end_us)
    held = [expected.holds(value) for value in values]
    met = any(held) if expected.within_us else all(held)
    said = f"{expected.path}: {_wanted(expected)}"
    if met:
        return Outcome(expected, True, said)
    return Outcome(expected, False, f"{said}; {_instead(expected, found, held[0])}.")


def _wanted(expected: Expectation) -> str:
    if expected.value is not None:
        what = f"= {name_of(expected.value)}"
    elif expected.least is None or expected.most is None:
        what = f">= {expected.least:g}" if expected.least is not None else f"<= {expected.most:g}"
    else:
        what = f"in {expected.least:g}..{expected.most:g}"
    when = f"at {shown(expected.at_us)}"
    if expected.within_us or expected.during_us:
        word = "at some time" if expected.within_us else "all the time"
        when = f"{word} from {shown(expected.at_us)} to {shown(expected.end_us)}"
    return f"{expected.signal} {what} {when}"


def _instead(expected: Expectation, found: History, held_at_first: bool) -> str:
    """What happened instead, and when what was expected began or ended."""
    if held_at_first:
        until_us = found.first_us(lambda value: not expected.holds(value), expected.at_us) or expected.end_us
        return f"it was {name_of(found.at(until_us))} at {shown(until_us)}"
    was = f"it was {name_of(found.at(expected.at_us))}"
    from_us = found.first_us(expected.holds, expected.at_us)
    if from_us is not None:
        return f"{was} until {shown(from_us)}"
    return f"{was}, and not so later either"
