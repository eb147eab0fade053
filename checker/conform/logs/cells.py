"""From the text of a cell to the value that charts compute with, exactly, one converter for each column."""

from collections.abc import Callable
from fractions import Fraction

from checker.conform.logs.errors import LogError
from checker.conform.logs.mapping import Column, conversion
from spec_model.abstraction import Signal
from spec_model.lang.domain import Bool, Enum, Num, exact
from spec_model.lang.errors import ModelError, did_you_mean

Raw = int | Fraction
"""A raw value, as in the charts; a fraction lies between two values of a domain."""

Convert = Callable[[str], Raw | None]
"""The raw value of a text, ``None`` of an empty cell.  Raises ``LogError`` for one without meaning."""

TRUTH = {"true": 1, "false": 0, "yes": 1, "no": 0, "on": 1, "off": 0}


def converter(column: Column, signal: Signal, an_input: bool, comma: bool) -> Convert:
    """The converter of one column.  Raises ``LogError`` for a unit or a name that the signal does not have.

    An input must be one that firmware can hold; an output may be any number, which then is a deviation.
    """
    scale, offset = conversion(column, _unit(signal))
    names = {**_names(signal), **_own_names(column, signal)}
    factor, shift = exact(scale), exact(offset)
    most = signal.high if signal.stamp and factor == 1 and shift == 0 else -1

    def read(text: str) -> Raw | None:
        cell = text.strip()
        if not cell:
            return None
        if cell.isdecimal() and int(cell) <= most:  # a time, each of which is another
            return int(cell)
        if cell in names:
            return names[cell]
        if cell.lower() in TRUTH and isinstance(signal.domain.sort, Bool):
            return TRUTH[cell.lower()]
        number = _number(cell.replace(",", ".") if comma else cell, signal, names) * factor + shift
        return _within(number, signal, column.kind) if an_input else _whole(number / _resolution(signal))

    return _remembering(read)


def _remembering(read: Convert) -> Convert:
    """Cells repeat themselves: what was read once is looked up."""
    known: dict[str, Raw | None] = {}

    def look(text: str) -> Raw | None:
        try:
            return known[text]
        except KeyError:
            value = read(text)
            if len(known) > 100_000:
                known.clear()
            known[text] = value
            return value

    return look


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
    try:
        return Fraction(cell)
    except (ValueError, ZeroDivisionError):
        pass
    if names:
        raise LogError(f"{cell!r} is no number and no name of a value. {did_you_mean(cell, names)}")
    if cell.lower().lstrip("+-") in ("nan", "inf", "infinity"):
        raise LogError(f"{cell} is no finite number; the charts give it no meaning. Leave the cell empty.")
    raise LogError(f"{cell!r} is no number.")


def _within(number: Fraction, signal: Signal, kind: str) -> Raw:
    """The raw value of an input.  Raises ``LogError`` outside what firmware can hold."""
    if kind != "value":
        if number < 0:
            raise LogError(f"an age of {float(number):g} ms is negative.")
        return _whole(number)
    if signal.stamp:
        if number.denominator != 1:
            number = Fraction(round(number))
        if not 0 <= number <= signal.high:
            raise LogError(f"{float(number):g} ms is no time of a 32-bit clock (0..{signal.high:.0f}).")
        return int(number)
    sort = signal.domain.sort
    if isinstance(sort, Num):
        if not exact(signal.low) <= number <= exact(signal.high):
            unit = f" {sort.unit}".rstrip()
            raise LogError(
                f"{float(number):g}{unit} is outside {signal.low:g}..{signal.high:g}{unit}; "
                "is it in another unit? Write unit = or scale = in the map."
            )
        return _whole(number / sort.resolution)
    if number.denominator != 1 or int(number) not in signal.domain:
        raise LogError(f"{float(number):g} is outside {signal.domain}.")
    return int(number)


def _whole(number: Fraction) -> Raw:
    return number.numerator if number.denominator == 1 else number
