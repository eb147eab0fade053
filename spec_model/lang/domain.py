"""Finite domains: booleans, enumerations, bounded integers and fixed-point numbers with units.

Every value is stored as one integer, its *raw* value: 0/1 for a boolean, the member's number for
an enumeration, value / resolution for a number.  Arithmetic on raw values is exact.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from decimal import Context, Decimal
from fractions import Fraction
from functools import cached_property
from math import gcd, lcm
from operator import index
from typing import Any, SupportsIndex

from rovercheck.spec_model.lang.errors import ModelError, brief, did_you_mean, several

Number = int | float | Fraction | str

MOST = 1 << 62
"""Values of a domain at most."""


def own(value: Any) -> Any:
    """A whole number, truth value or decimal of NumPy's as Python's own; anything else as it is."""
    if isinstance(value, int | float | Fraction | str):
        return value
    kind = type(value)
    if kind.__module__ == "numpy" and kind.__name__.startswith("bool"):
        return bool(value)
    if kind.__module__ == "numpy" and kind.__name__.startswith("float"):
        return float(str(value))
    return index(value) if isinstance(value, SupportsIndex) else value


def exact(value: Number | SupportsIndex) -> Fraction:
    """The decimal a person wrote, exactly: 0.42 is 21/50, not the nearest binary fraction."""
    plain = own(value)
    return Fraction(str(plain)) if isinstance(plain, float) else Fraction(plain)


@dataclass(frozen=True)
class Unit:
    """A product of powers of unit symbols, e.g. ``°C/ms``; empty for a plain number."""

    powers: tuple[tuple[str, int], ...] = ()

    @staticmethod
    def of(text: "str | Unit") -> "Unit":
        """Read ``a·b/c``: what follows a slash is divided by.  Raises ``ModelError`` for what is no text."""
        if isinstance(text, Unit):
            return text
        if not isinstance(text, str):
            raise ModelError(f"{brief(text)} is no unit; write one as a text, such as 'ms' or '°C/s'.")
        powers: dict[str, int] = {}
        for position, part in enumerate(text.split("/")):
            for symbol in filter(None, part.replace("*", "·").split("·")):
                if symbol != "1":
                    powers[symbol] = powers.get(symbol, 0) + (1 if position == 0 else -1)
        return Unit._made(powers)

    @staticmethod
    def _made(powers: Mapping[str, int]) -> "Unit":
        return Unit(tuple(sorted((s, p) for s, p in powers.items() if p)))

    def __mul__(self, other: "Unit") -> "Unit":
        powers = dict(self.powers)
        for symbol, power in other.powers:
            powers[symbol] = powers.get(symbol, 0) + power
        return Unit._made(powers)

    def __bool__(self) -> bool:
        """Whether this is a unit at all, not that of a plain number."""
        return bool(self.powers)

    def __str__(self) -> str:
        up = "·".join(s for s, p in self.powers for _ in range(p))
        down = "".join("/" + s for s, p in self.powers for _ in range(-p))
        return up + down if up or not down else "1" + down


@dataclass(frozen=True)
class Bool:
    """The sort of truth values; raw 0 is false, raw 1 is true."""

    def __str__(self) -> str:
        return "boolean"


@dataclass(frozen=True)
class Enum:
    """The sort of an enumeration: its name and its members with their numbers."""

    name: str
    members: tuple[tuple[str, int], ...]

    def member(self, raw: int) -> str:
        """The member's name.  Raises ``ModelError`` for a number that is no member."""
        for name, number in self.members:
            if number == raw:
                return name
        raise ModelError(f"{raw} is no member of {self.name}.")

    def number(self, name: str) -> int:
        """The member's number.  Raises ``ModelError`` for an unknown name, offering near ones."""
        if name not in self._numbers:
            raise ModelError(f"{name!r} is no member of {self.name}. {did_you_mean(name, self._numbers)}")
        return self._numbers[name]

    @cached_property
    def _numbers(self) -> dict[str, int]:
        return dict(reversed(self.members))  # of two with one name the first

    def __hash__(self) -> int:
        return hash((self.name, len(self.members)))  # thousands of members are hashed as quickly as two

    def __str__(self) -> str:
        return self.name


@dataclass(frozen=True)
class Num:
    """The sort of numbers that are whole multiples of ``resolution`` in ``unit``."""

    resolution: Fraction = Fraction(1)
    unit: Unit = Unit()

    def __str__(self) -> str:
        return f"{self.kind} in {self.unit}" if self.unit else self.kind

    @property
    def kind(self) -> str:
        """``integer``, ``number in steps of 0.5``."""
        return "integer" if self.resolution == 1 else f"number in steps of {show(self.resolution)}"


Sort = Bool | Enum | Num


def show(value: Fraction) -> str:
    """The shortest text: a decimal where the fraction has one, otherwise p/q."""
    if value.denominator == 1:
        return str(value.numerator)
    rest = value.denominator
    for prime in (2, 5):
        while rest % prime == 0:
            rest //= prime
    if rest > 1:
        return str(value)
    short = f"{float(value):.10g}"
    return short if Fraction(short) == value else f"{_decimal(value):f}"


def _decimal(value: Fraction) -> Decimal:
    """A fraction that has a decimal, whole."""
    digits = len(str(value.numerator)) + len(str(value.denominator)) * 4
    return Context(prec=digits).divide(Decimal(value.numerator), Decimal(value.denominator))


def in_resolution(raw: int, old: Fraction, new: Fraction) -> int | None:
    """The raw value of the same number in another resolution; None where that has none for it."""
    found, rest = divmod(raw * old.numerator * new.denominator, old.denominator * new.numerator)
    return None if rest else found


def common_resolution(a: Fraction, b: Fraction) -> Fraction:
    """The coarsest resolution in which both are exact: the greatest common divisor."""
    return (
        Fraction(
            gcd(a.numerator * b.denominator, b.numerator * a.denominator),
            a.denominator * b.denominator,
        )
        if a != b
        else a
    )


@dataclass(frozen=True)
class Domain:
    """A finite set of values of one sort, as ascending raw values, in whatever order they are given."""

    sort: Sort
    values: range | tuple[int, ...]

    def __post_init__(self) -> None:
        if not self.values:
            raise ModelError("A domain needs at least one value.")
        if not isinstance(self.values, range) or self.values.step != 1:
            object.__setattr__(self, "values", tuple(sorted(set(self.values))))

    @property
    def low(self) -> int:
        return self.values[0]

    @property
    def high(self) -> int:
        return self.values[-1]

    def __contains__(self, raw: int) -> bool:
        return raw in self.values

    def __len__(self) -> int:
        return len(self.values)

    @property
    def dense(self) -> bool:
        """True when every raw value between low and high belongs to the domain."""
        return len(self.values) == self.high - self.low + 1

    def show(self, raw: int) -> str:
        """The value as a person writes it: ``true``, a member's name, a decimal."""
        match self.sort:
            case Bool():
                return "true" if raw else "false"
            case Enum() as enum:
                return enum.member(raw)
            case Num(resolution, _):
                return show(raw * resolution)

    def raw(self, value: "Number | bool") -> int:
        """The raw value of what a person wrote.  Raises ``ModelError`` outside the domain."""
        match self.sort:
            case Bool():
                raw: Fraction | int = int(own(value) in (True, "true", "1"))
            case Enum() as enum:
                raw = enum.number(value) if isinstance(value, str) else exact(value)
            case Num(resolution, _):
                raw = exact(value) / resolution
        if raw.denominator != 1 or int(raw) not in self:
            raise ModelError(f"{value} is outside {self}.")
        return int(raw)

    def __str__(self) -> str:
        match self.sort:
            case Bool():
                return "boolean"
            case Enum() as enum:
                return f"{enum.name} {{{', '.join(enum.member(v) for v in self.values)}}}"
            case Num() as num:
                ends = f"{self.show(self.low)}..{self.show(self.high)}"
                values = ends if self.dense else f"{{{ends}, {len(self)} values}}"
                return f"{num.kind} in {values} {num.unit}".rstrip()


def check_domain(where: str, domain: object) -> None:
    """Raises ``ModelError`` for what is no domain."""
    if not isinstance(domain, Domain):
        raise ModelError(
            f"{where} takes a domain, such as integer(0, 9) or enumeration(...), and not {brief(domain)}."
        )


boolean = Domain(Bool(), range(2))


def enumeration(name: str, members: Sequence[str] | Mapping[str, int]) -> Domain:
    """An enumeration; a sequence numbers its members from 0."""
    if not isinstance(members, Mapping):
        names = several(f"enumeration({name!r}, ...)", "members", members)
        if len(set(names)) < len(names):
            twice = next(m for m in names if names.count(m) > 1)
            raise ModelError(f"The enumeration {name} has the member {twice!r} twice; leave out one.")
        members = {member: number for number, member in enumerate(names)}
    wrong = [n for n in members.values() if not isinstance(n, int) or isinstance(n, bool)]
    if wrong:
        raise ModelError(f"The enumeration {name} has the number {wrong[0]!r}; write a whole number.")
    ordered = tuple(sorted(members.items(), key=lambda pair: pair[1]))
    if len({n for _, n in ordered}) != len(ordered) or not ordered:
        raise ModelError(f"The enumeration {name} needs at least one member, each with its own number.")
    numbers = tuple(n for _, n in ordered)
    dense = numbers[-1] - numbers[0] + 1 == len(numbers)
    return Domain(Enum(name, ordered), range(numbers[0], numbers[-1] + 1) if dense else numbers)


def integer(low: int, high: int, unit: str = "") -> Domain:
    """The whole numbers low..high, ends included."""
    return fixed(low, high, 1, unit)


def fixed(low: Number, high: Number, resolution: Number, unit: str = "") -> Domain:
    """Fixed point: the multiples of ``resolution`` in low..high, ends included."""
    step = exact(resolution)
    if step <= 0:
        raise ModelError(f"A resolution of {resolution} has no meaning; write a positive one.")
    first, last = exact(low) / step, exact(high) / step
    if first.denominator != 1 or last.denominator != 1:
        raise ModelError(f"{low}..{high} does not start and end on multiples of {resolution}.")
    if first > last:
        raise ModelError(f"{low}..{high} is empty; write the lower end first.")
    if last - first >= MOST:
        values = f"{int(last - first) + 1:,} values"
        raise ModelError(f"{low}..{high} has {values}, which no board holds in 64 bits; write fewer.")
    return Domain(Num(step, Unit.of(unit)), range(int(first), int(last) + 1))


def chosen(values: Iterable[Number], unit: str = "") -> Domain:
    """A finite choice of representative numbers; the resolution is the coarsest that is exact."""
    numbers = sorted({exact(v) for v in values})
    if not numbers:
        raise ModelError("A domain needs at least one value.")
    step = Fraction(1, lcm(*(n.denominator for n in numbers)))
    raws = tuple(int(n / step) for n in numbers)
    return Domain(Num(step, Unit.of(unit)), raws)
