"""Concrete signals of firmware, named as in the document, and their values as charts compute with them."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from math import isfinite
from typing import cast

from rovercheck.spec_model.lang.domain import Bool, Domain, Enum, Num, exact, fixed
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.evaluate import evaluate
from rovercheck.spec_model.lang.expr import FALSE, Expr, Var

MILLISECONDS = fixed(0, (1 << 32) - 1, 1, "ms")

Value = bool | int | float
"""A concrete value: a boolean, a whole number (also the number of an enumeration's member) or a float."""

Values = Mapping[str, Value]
Raw = int | Fraction
"""A raw value; a fraction lies between two values of the domain."""


def computed(values: Mapping[str, Raw]) -> dict[str, int]:
    """Raw values as evaluation takes them: every operator computes with fractions as with integers."""
    return cast(dict[str, int], dict(values))


@dataclass(frozen=True)
class BoardSignal:
    """A concrete quantity of the firmware, by the document's name.

    ``domain`` has its sort, its unit and its representative values; firmware may hold every number from
    ``low`` to ``high``, in units (whole ones only if ``whole``).  ``stamp`` marks a time in ms of the
    board's 32-bit clock, which has no domain of its own.
    """

    name: str
    domain: Domain
    initial: Value
    doc: str = ""
    low: float = 0.0
    high: float = 0.0
    whole: bool = False
    stamp: bool = False

    @classmethod
    def stamped(cls, name: str, doc: str) -> "BoardSignal":
        """A time of the board's clock, 0 at power-up."""
        return cls(name, MILLISECONDS, 0, doc, 0, MILLISECONDS.high, whole=True, stamp=True)

    def raw(self, value: Value) -> Raw:
        """The value as charts compute with it.  Raises ``ModelError`` for one that firmware cannot hold."""
        if not isfinite(value):
            raise ModelError(
                f"{self.name} = {value}: the charts give no meaning to what is no finite number."
            )
        match self.domain.sort:
            case Bool() | Enum():
                if value != int(value) or int(value) not in self.domain:
                    raise ModelError(f"{self.name} = {value} is outside {self.domain}.")
                return int(value)
            case Num(resolution, _):
                if not self.low <= value <= self.high:
                    raise ModelError(f"{self.name} = {value} is outside {self.low:g}..{self.high:g}.")
                return _raw(value, resolution)

    def show(self, value: Value) -> str:
        """The value as a person writes it: a member's name, ``true``, a number."""
        if not isfinite(value):
            return str(value)
        match self.domain.sort:
            case Enum() as enum if value == int(value) and int(value) in self.domain:
                return enum.member(int(value))
            case Bool() if value in (0, 1):
                return "true" if value else "false"
        return f"{value:g}"


def whole(value: Fraction) -> Raw:
    """An integer where the fraction is one: arithmetic on integers is much quicker."""
    return value.numerator if value.denominator == 1 else value


@lru_cache(100_000)
def _raw(value: Value, resolution: Fraction) -> Raw:
    return whole(exact(value) / resolution)


@lru_cache(100_000)
def _number(raw: Raw, resolution: Fraction) -> Value:
    value = raw * resolution
    return int(value) if value.denominator == 1 else float(value)


def units(domain: Domain, raw: Raw) -> Value:
    """The concrete value of a raw one."""
    match domain.sort:
        case Bool():
            return bool(raw)
        case Enum():
            return int(raw)
        case Num(resolution, _):
            return _number(raw, resolution)


@dataclass(frozen=True)
class Output:
    """A quantity that the firmware produces, and the chart variable it must equal.

    ``unless``: where this holds after the step, the charts give the variable up and nothing is required.
    """

    signal: BoardSignal
    var: Var
    unless: Expr = FALSE

    @property
    def name(self) -> str:
        return self.signal.name

    def expected(self, after: Mapping[str, int]) -> Value | None:
        """What the firmware must produce, given the state of the charts; ``None``: anything."""
        if evaluate(self.unless, after):
            return None
        return units(self.var.domain, after[self.var.name])


def measured(var: Var, low: float, high: float, *, whole: bool = False, name: str = "") -> BoardSignal:
    """A number that firmware measures or receives as it comes."""
    return BoardSignal(name or plain(var), var.domain, units(var.domain, var.init), var.doc, low, high, whole)


def discrete(var: Var, name: str = "") -> BoardSignal:
    """What firmware holds as values of the domain: a boolean, an enumeration, a mask, an output."""
    domain, initial = var.domain, units(var.domain, var.init)
    if isinstance(domain.sort, Num):
        resolution = domain.sort.resolution
        low, high = float(domain.low * resolution), float(domain.high * resolution)
        return BoardSignal(name or plain(var), domain, initial, var.doc, low, high, resolution == 1)
    return BoardSignal(name or plain(var), domain, initial, var.doc)


def outputs(produced: Iterable[Var], unless: Expr = FALSE) -> tuple[Output, ...]:
    """Outputs of the firmware with the names and domains of chart variables."""
    return tuple(Output(discrete(var), var, unless) for var in produced)


def plain(var: Var) -> str:
    """The document's name: without the prefix that tells the boards apart where both are modelled."""
    return var.name.rpartition(".")[2]
