"""From the texts of cells to the values that charts compute with, exactly, one converter for each column."""

from collections.abc import Callable, Sequence
from fractions import Fraction

from checker.conform.logs.errors import LogError
from checker.conform.logs.mapping import Column, conversion
from spec_model.abstraction import Signal
from spec_model.lang.domain import Bool, Enum, Num, exact
from spec_model.lang.errors import ModelError, did_you_mean

Raw = int | Fraction
"""A raw value, as in the charts; a fraction lies between two values of a domain."""

Convert = Callable[[Sequence[str]], list[Raw | None]]
"""The raw values of texts, ``None`` of an empty cell.  Raises ``LogError`` for one without meaning."""

MOST_DIGITS = 40
EXPONENT = 4
"""Digits of an exponent, at most: exact arithmetic with more would never end."""
TRUTH = {"true": 1, "false": 0, "yes": 1, "no": 0, "on": 1, "off": 0}


def converter(column: Column, signal: Signal, an_input: bool, comma: bool) -> Convert:
    """The converter of one column.  Raises ``LogError`` for a unit or a name that the signal does not have.

    An input must be one that firmware can hold; an output may be any number, which then is a deviation.
    """
    scale, offset = conversion(column, _unit(signal))
    names = {**_names(signal), **_own_names(column, signal)}
    factor, shift = exact(scale), exact(offset)
    as_is = factor == 1 and shift == 0
    most = signal.high if signal.stamp and as_is else -1
    meaning = _input(signal, column.kind) if an_input else _output(signal)

    def read(text: str) -> Raw | None:
        cell = text.strip()
        if not cell:
            return None
        if cell in names:
            return names[cell]
        if cell.lower() in TRUTH and isinstance(signal.domain.sort, Bool):
            return TRUTH[cell.lower()]
        number = _number(cell.replace(",", ".") if comma else cell, signal, names)
        return meaning(number if as_is else number * factor + shift)

    known = _Known(read)

    def convert(texts: Sequence[str]) -> list[Raw | None]:
        times = _times(texts, most)
        return list(map(known.__getitem__, texts)) if times is None else times

    return convert


class _Known(dict[str, Raw | None]):
    """Cells repeat themselves: what was read once is looked up."""

    def __init__(self, read: Callable[[str], Raw | None]) -> None:
        super().__init__()
        self._read = read

    def __missing__(self, text: str) -> Raw | None:
        value = self._read(text)
        if len(self) > 100_000:
            self.clear()
        self[text] = value
        return value


def _times(texts: Sequence[str], most: float) -> list[Raw | None] | None:
    """Whole numbers, each of which is another one, if all texts are such and none is greater."""
    if most < 0 or not "".join(texts).isdecimal():
        return None
    try:
        times = list(map(int, texts))
    except ValueError:  # one is empty, or longer than any
        return None
    return [*times] if max(times, default=0) <= most else None


def _unit(signal: Signal) -> str:
    sort = signal.domain.sort
    return str(sort.unit) if isinstance(sort, Num) else ""


def _resolution(signal: Signal) -> Fraction:
    sort = signal.domain.sort
    return sort.resolution if isinstance(sort, Num) else Fraction(1)


def _names(signal: Signal) -> dict[str, Raw]:
    sort = signal.domain.sort
    return dict(sort.members) if isinstance(sort, Enum) else {}


def _own_names(column: Column, signal: Signal) -> dict[str, Raw]:
    """The names that the map gives the values."""
    found: dict[str, Raw] = {}
    for text, meaning in column.names.items():
        try:
            truth = TRUTH.get(meaning.lower()) if isinstance(signal.domain.sort, Bool) else None
            found[text] = signal.domain.raw(meaning) if truth is None else truth
        except (ModelError, ValueError) as error:
            raise LogError(f"names of {column.signal}: {text!r} = {meaning!r}: {error}") from error
    return found


def _number(cell: str, signal: Signal, names: dict[str, Raw]) -> Fraction:
    whole, _, rest = cell.partition(".")
    digits = whole.removeprefix("-") + rest
    if whole and digits.isdecimal() and len(digits) < MOST_DIGITS:  # quicker than ``Fraction`` of a text
        number = Fraction(int(digits), 10 ** len(rest))
        return -number if whole[0] == "-" else number
    if len(cell.lower().partition("e")[2].lstrip("+-")) > EXPONENT and not names:
        raise LogError(f"{cell!r} is no number.")
    try:
        return Fraction(cell)
    except (ValueError, ZeroDivisionError):
        pass
    if names:
        raise LogError(f"{cell!r} is no number and no name of a value. {did_you_mean(cell, names)}")
    if cell.lower().lstrip("+-") in ("nan", "inf", "infinity"):
        raise LogError(f"{cell} is no finite number; the charts give it no meaning. Leave the cell empty.")
    raise LogError(f"{cell!r} is no number.")


Meaning = Callable[[Fraction], Raw]
"""The raw value of a number in the unit of a signal."""


def _output(signal: Signal) -> Meaning:
    resolution = _resolution(signal)
    return _whole if resolution == 1 else lambda number: _whole(number / resolution)


def _input(signal: Signal, kind: str) -> Meaning:
    """What firmware can hold; ``LogError`` for anything else."""
    sort = signal.domain.sort
    if kind != "value":
        return _age
    if signal.stamp:
        return lambda number: _time(number, signal)
    if isinstance(sort, Num):
        return _measurement(signal, str(sort.unit))
    return lambda number: _member(number, signal)


def _age(number: Fraction) -> Raw:
    if number < 0:
        raise LogError(f"an age of {float(number):g} ms is negative.")
    return _whole(number)


def _time(number: Fraction, signal: Signal) -> Raw:
    time = round(number)
    if not 0 <= time <= signal.high:
        raise LogError(f"{float(number):g} ms is no time of a 32-bit clock (0..{signal.high:.0f}).")
    return time


def _measurement(signal: Signal, unit: str) -> Meaning:
    low, high, raw = exact(signal.low), exact(signal.high), _output(signal)

    def read(number: Fraction) -> Raw:
        if low <= number <= high:
            return raw(number)
        in_unit = f" {unit}".rstrip()
        raise LogError(
            f"{float(number):g}{in_unit} is outside {signal.low:g}..{signal.high:g}{in_unit}; "
            "is it in another unit? Write unit = or scale = in the map."
        )

    return read


def _member(number: Fraction, signal: Signal) -> Raw:
    if number.denominator != 1 or int(number) not in signal.domain:
        raise LogError(f"{float(number):g} is outside {signal.domain}.")
    return int(number)


def _whole(number: Fraction) -> Raw:
    return number.numerator if number.denominator == 1 else number
