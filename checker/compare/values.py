"""Concrete values of the inputs: at every boundary, close to it on both sides, and anywhere between two."""

from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import pairwise

import numpy as np

from rovercheck.checker.compare.aims import Aims, Boundary, aims, together
from rovercheck.checker.compare.stimulus import Toward, clocked
from rovercheck.spec_model.abstraction import Board, BoardSignal, Value
from rovercheck.spec_model.abstraction.signals import units
from rovercheck.spec_model.lang.domain import Num, Unit

DEGREES = Unit.of("°")
TOP = Fraction(2879, 8)
"""The largest heading in use.  Headings are eighths of a degree, so that firmware subtracts them exactly."""
SPACING = 2.0**-24
"""Between numbers of single precision just below 1."""
PARTS = 64
"""Between two boundaries a value divides the distance in so many parts."""


@dataclass(frozen=True)
class Values:
    """What may be put on the inputs of a board; ``also``: boards with other charts, to aim at theirs, too."""

    board: Board
    also: tuple[Board, ...] = ()

    @cached_property
    def aims(self) -> Aims:
        return together(map(aims, (self.board, *self.also)))

    @cached_property
    def signals(self) -> dict[str, BoardSignal]:
        """The inputs that are no stamps, by name."""
        return {s.name: s for s in self.board.inputs if not s.stamp}

    @cached_property
    def stamps(self) -> tuple[str, ...]:
        """The stamps of sources."""
        return tuple(s.name for s in self.board.inputs if clocked(s))

    @cached_property
    def aimed(self) -> dict[str, tuple[Value, ...]]:
        """Values of each input: those of the model, and at, next to and beside each of its boundaries."""
        found: dict[str, set[Value]] = {}
        for name, signal in self.signals.items():
            limits = [
                b.value for b in self.aims.boundaries if b.signal == name and not b.datum and not b.source
            ]
            beside = {v for b in limits for v in (*around(signal, b), *nearest(signal, b))}
            found[name] = set(_representatives(signal)) | beside
        return {name: tuple(sorted(values)) for name, values in found.items()}

    @cached_property
    def cells(self) -> dict[str, tuple[tuple[Fraction, Fraction], ...]]:
        """The intervals between the boundaries of each number that is measured."""
        found = {}
        for name, signal in self.signals.items():
            if isinstance(signal.domain.sort, Num):
                own = {
                    b.value for b in self.aims.boundaries if b.signal == name and not b.datum and not b.source
                }
                ends = sorted({Fraction(str(signal.low)), _top(signal), *own})
                found[name] = tuple(pairwise(ends))
        return found

    def inside(self, name: str, cell: int, part: int) -> Value:
        """A value of one of the cells of an input."""
        low, high = self.cells[name][cell]
        value = low + (high - low) * part / PARTS
        return _concrete(self.signals[name], _eighths(value) if _is_heading(self.signals[name]) else value)

    @cached_property
    def relative(self) -> tuple[tuple[str, Toward], ...]:
        """Headings at and beside each boundary of a distance from what the charts hold."""
        found = []
        for b in self.aims.boundaries:
            if b.datum:
                found += [
                    (b.signal, Toward(b.datum, float(b.value + d))) for d in _beside(self.signals[b.signal])
                ]
        return tuple(found)

    @cached_property
    def aging(self) -> tuple[tuple[Boundary, Value], ...]:
        """Boundaries that move while a source is silent, with values at and beside them."""
        return tuple(
            (b, value)
            for b in self.aims.boundaries
            if b.source
            for value in around(self.signals[b.signal], b.value)
            if Fraction(str(value)) != b.value or _exact_in_binary(b.value)
        )


def around(signal: BoardSignal, boundary: Fraction) -> Iterable[Value]:
    """The boundary and values beside it, as far as firmware can hold them."""
    for distance in _beside(signal):
        value = boundary + distance
        if signal.low <= value <= signal.high:
            yield _concrete(signal, value)


def nearest(signal: BoardSignal, boundary: Fraction) -> Iterable[Value]:
    """The numbers of single precision next to a boundary on both sides, as far as firmware can hold them.

    Firmware may compute in single precision, to which the neighbours in double precision are the boundary
    itself; at 0, whose neighbours vanish when they are multiplied, the spacing below 1 is used instead.
    """
    if signal.whole or _is_heading(signal):
        return
    at = np.float32(float(boundary))
    for side in (-1, 1):
        value = float(at)
        if not boundary:
            value = side * SPACING
        elif (Fraction(value) - boundary) * side <= 0:
            value = float(np.nextafter(at, np.float32(side * np.inf)))
        if signal.low <= value <= signal.high:
            yield value


def _beside(signal: BoardSignal) -> tuple[Fraction, ...]:
    """Distances from a boundary, those on one side after those on the other."""
    if signal.whole:
        steps: tuple[Fraction, ...] = (Fraction(1), Fraction(2))
    elif _is_heading(signal):
        steps = (Fraction(1, 8), Fraction(1))
    else:
        steps = (Fraction(1, 1000), Fraction(1, 10))
    return (Fraction(0), *(-s for s in steps), *steps)


def _is_heading(signal: BoardSignal) -> bool:
    return isinstance(signal.domain.sort, Num) and signal.domain.sort.unit == DEGREES


def _top(signal: BoardSignal) -> Fraction:
    return TOP if _is_heading(signal) else Fraction(str(signal.high))


def _eighths(value: Fraction) -> Fraction:
    return Fraction(round(value * 8), 8)


def _exact_in_binary(value: Fraction) -> bool:
    """Whether firmware that computes in binary meets the boundary exactly."""
    return value.denominator <= 1024 and value.denominator & (value.denominator - 1) == 0


def _concrete(signal: BoardSignal, value: Fraction) -> Value:
    return round(value) if signal.whole or value.denominator == 1 else float(value)


def _representatives(signal: BoardSignal) -> Iterable[Value]:
    """The values that the model gives the input; of a mask each bit alone, none, all and a few."""
    sort = signal.domain.sort
    if isinstance(sort, Num) and signal.whole and signal.low == 0 and len(signal.domain) == signal.high + 1:
        top = int(signal.high)
        return [0, top, top // 2, *(1 << k for k in range(top.bit_length()))]
    ends = [_concrete(signal, Fraction(str(signal.low))), _concrete(signal, _top(signal))]
    step = max(1, len(signal.domain) // 24)  # of a fine grid of headings, every few
    values = [units(signal.domain, raw) for raw in signal.domain.values[::step]]
    return values + ends if isinstance(sort, Num) else values


__all__ = ["PARTS", "Values", "around", "nearest"]
