"""Lengths of time: ``4 * sec``, ``3 * sec + 20 * ms``, ``2 * ticks``, and their number of ticks."""

from dataclasses import dataclass
from fractions import Fraction

from rovercheck.spec_model.lang.domain import MOST, Number, exact, show
from rovercheck.spec_model.lang.errors import ModelError


@dataclass(frozen=True)
class Span:
    """A length of time, in milliseconds or in ticks."""

    amount: Fraction
    unit: str

    def __mul__(self, factor: Number) -> "Span":
        return Span(self.amount * exact(factor), self.unit)

    __rmul__ = __mul__

    def __add__(self, other: object) -> "Span":
        if isinstance(other, Span) and other.unit == self.unit:
            return Span(self.amount + other.amount, self.unit)
        raise ModelError(
            f"{self} and {other} are not added: how long a tick is, is the system's to say. Write one "
            "length, in ms or in ticks."
        )

    __radd__ = __add__

    def __sub__(self, other: object) -> "Span":
        raise ModelError(f"{other} is not taken from {self}; write one length, in ms or in ticks.")

    __rsub__ = __sub__

    def ticks(self, tick_ms: int) -> int:
        """The number of ticks.  Raises ``ModelError`` unless it is a whole number >= 0."""
        count = self.amount if self.unit == "ticks" else self.amount / tick_ms
        if count.denominator != 1 or count < 0:
            raise ModelError(
                f"{self} is not a whole number of ticks of {tick_ms} ms; write a multiple of the tick."
            )
        if count + 2 >= MOST:  # what counts them has one value for none, and one for more
            raise ModelError(f"{self} is longer than any board counts in 64 bits; write less.")
        return int(count)

    def measured(self, elapsed: object) -> bool:
        """Whether it is measured in ms where ``elapsed`` says how long a tick lasts (None: all the same)."""
        return elapsed is not None and self.unit == "ms"

    def __str__(self) -> str:
        if self.unit == "ms" and self.amount % 1000 == 0:
            return f"{show(self.amount / 1000)} s"
        return f"{show(self.amount)} {'tick' if self == ticks else self.unit}"


ms = Span(Fraction(1), "ms")
sec = Span(Fraction(1000), "ms")
ticks = Span(Fraction(1), "ticks")
tick = ticks
