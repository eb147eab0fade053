"""From the texts of cells to the values that charts compute with, exactly, one converter for each column."""

from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from math import isfinite, isnan

from rovercheck.checker.conformance.recording import Raw
from rovercheck.checker.logs.errors import SHORT, LogError, shortened
from rovercheck.checker.logs.mapping import Column, conversion
from rovercheck.spec_model.abstraction import BoardSignal
from rovercheck.spec_model.lang.domain import Bool, Enum, Num, exact
from rovercheck.spec_model.lang.errors import ModelError, did_you_mean

MOST_DIGITS = 40
EXPONENT = 4
"""Digits of an exponent, at most: exact arithmetic with more would never end."""
LARGEST = 2**128 - 2**104
"""The largest number of a 32-bit float, which the firmware computes with.  IEEE 754, binary32."""
LARGEST_WHOLE = 1 << 53
MOST_KNOWN, MOST_WRONG = 100_000, 1_000
"""Texts of a column that are remembered, and those of them without meaning."""
TRUTH = {"true": 1, "false": 0, "yes": 1, "no": 0, "on": 1, "off": 0, "1": 1, "0": 0}
NAN = ("nan", "+nan", "-nan")


class _NoValue(Exception):
    """A cell that stands for no value of its signal; the message says why."""


class CellConverter:
    """The raw values of the texts of one column, ``None`` of an empty cell and of one without meaning."""

    def __init__(self, read: Callable[[str], Raw | None], most: float) -> None:
        self._known = _Known(read)
        self._most = most

    def __call__(self, texts: Sequence[str]) -> list[Raw | None]:
        times = _times(texts, self._most)
        return list(map(self._known.__getitem__, texts)) if times is None else times

    def without_meaning(self, texts: Sequence[str]) -> list[tuple[int, str]]:
        """Which of the texts that were just converted have no meaning, and why."""
        wrong = self._known.wrong
        if not wrong or wrong.keys().isdisjoint(texts):
            return []
        found = [(i, wrong[text]) for i, text in enumerate(texts) if text in wrong]
        if len(wrong) > MOST_WRONG or any(len(text) > SHORT for text in wrong):
            self._known.clear()
            wrong.clear()
        return found


def converter(column: Column, signal: BoardSignal, an_input: bool, comma: bool) -> CellConverter:
    """The converter of one column.  Raises ``LogError`` for what the map says that the signal does not have.

    An input must be one that firmware can hold; an output may be any number, which then is a deviation.
    """
    scale, offset = conversion(column, _unit(signal))
    names = {**_names(signal), **_own_names(column, signal)}
    factor, shift = exact(scale), exact(offset)
    as_is = factor == 1 and shift == 0
    most = signal.high if signal.stamp and as_is and not column.absent else -1
    truth = TRUTH if isinstance(signal.domain.sort, Bool) else {}
    texts, numbers = _absent(column.absent)
    meaning = _meaning(column, signal, an_input)

    expected = _expected(column, signal, an_input)

    def read(text: str) -> Raw | None:
        try:
            return value(text)
        except _NoValue as error:
            told = str(error)
            known = " outside " in told or "(0.." in told or "Known: " in told
            raise _NoValue(told if known else f"{told} {expected}") from error

    def value(text: str) -> Raw | None:
        cell = text.strip()
        if not cell or (texts and cell.lower() in texts):
            return None
        if cell in names:
            return names[cell]
        if cell.lower() in truth:
            return truth[cell.lower()]
        number = _number(cell.replace(",", ".") if comma else cell, names)
        if numbers and number in numbers:
            return None
        return meaning(_held(number if as_is else number * factor + shift, cell))

    return CellConverter(read, most)


def _expected(column: Column, signal: BoardSignal, an_input: bool) -> str:
    """What the model knows of the signal, in a sentence."""
    sort, unit = signal.domain.sort, _unit(signal)
    in_unit = f" {unit}" if unit else ""
    if column.kind == "update" or isinstance(sort, Bool):
        known = "true or false"
    elif column.kind == "age":
        known = "an age in ms"
    elif signal.stamp:
        known = f"a time in ms, 0..{signal.high:.0f}"
    elif not isinstance(sort, Num):
        known = str(signal.domain)
    elif an_input:
        known = f"a number in {signal.low:g}..{signal.high:g}{in_unit}"
    else:
        known = f"{'an' if str(signal.domain)[0] in 'aeiou' else 'a'} {signal.domain}"
    return f"The model knows {signal.name} as {known}."


def _absent(given: Sequence[str | float]) -> tuple[set[str], set[Fraction]]:
    """What a column holds where there is no value: texts in small letters, and numbers however written."""
    texts = {g.lower() for g in given if isinstance(g, str)}
    if any(not isinstance(g, str) and isnan(g) for g in given):
        texts |= set(NAN)
    return texts, {exact(g) for g in given if not isinstance(g, str) and isfinite(g)}


class _Known(dict[str, Raw | None]):
    """Cells repeat themselves: what was read once is looked up; long ones would fill the memory.

    ``wrong``: those without meaning, and why.
    """

    def __init__(self, read: Callable[[str], Raw | None]) -> None:
        super().__init__()
        self._read = read
        self.wrong: dict[str, str] = {}

    def __missing__(self, text: str) -> Raw | None:
        try:
            value = self._read(text)
        except _NoValue as error:
            self.wrong[text] = str(error)
            value = None
        if len(self) > MOST_KNOWN:
            self.clear()
        if len(text) <= SHORT:
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


def _unit(signal: BoardSignal) -> str:
    sort = signal.domain.sort
    return str(sort.unit) if isinstance(sort, Num) else ""


def _resolution(signal: BoardSignal) -> Fraction:
    sort = signal.domain.sort
    return sort.resolution if isinstance(sort, Num) else Fraction(1)


def _names(signal: BoardSignal) -> dict[str, Raw]:
    sort = signal.domain.sort
    return dict(sort.members) if isinstance(sort, Enum) else {}


def _own_names(column: Column, signal: BoardSignal) -> dict[str, Raw]:
    """The names that the map gives the values."""
    found: dict[str, Raw] = {}
    for text, meaning in column.names.items():
        if isinstance(signal.domain.sort, Bool):
            if meaning.lower() not in TRUTH:
                raise LogError(f"names of {column.signal}: {text!r} = {meaning!r}; write true or false.")
            found[text] = TRUTH[meaning.lower()]
            continue
        try:
            found[text] = signal.domain.raw(meaning)
        except (ModelError, ValueError) as error:
            raise LogError(f"names of {column.signal}: {text!r} = {meaning!r}: {error}") from error
    return found


def _number(cell: str, names: Mapping[str, Raw]) -> Fraction:
    whole, _, rest = cell.partition(".")
    digits = whole.removeprefix("-") + rest
    if whole and digits.isdecimal() and len(digits) < MOST_DIGITS:  # quicker than ``Fraction`` of a text
        number = Fraction(int(digits), 10 ** len(rest))
        return -number if whole[0] == "-" else number
    shown = repr(shortened(cell))
    exponent = cell.lower().partition("e")[2].lstrip("+-").replace("_", "")
    if len(exponent) <= EXPONENT or not exponent.isdecimal():
        try:
            return Fraction(cell)
        except (ValueError, ZeroDivisionError):
            pass
    if cell.lower().lstrip("+-") in ("nan", "inf", "infinity"):
        raise _NoValue(f"{cell} is no finite number; the charts give it no meaning.")
    if names:
        raise _NoValue(f"{shown} is no number and no name of a value. {did_you_mean(cell[:SHORT], names)}")
    raise _NoValue(f"{shown} is no number.")


def _held(number: Fraction, cell: str) -> Fraction:
    """The number of a cell, if firmware can hold it at all."""
    if abs(number.numerator) <= LARGEST * number.denominator:  # quicker than to compare fractions
        return number
    shown = shortened(cell)
    raise _NoValue(f"{shown} is a larger number than any of a 32-bit float ({float(LARGEST):.3g}).")


Meaning = Callable[[Fraction], Raw]
"""The raw value of a number in the unit of a signal."""


def _meaning(column: Column, signal: BoardSignal, an_input: bool) -> Meaning:
    """How the numbers of a column are read.  Raises ``LogError`` for options without meaning for it."""
    sort = signal.domain.sort
    if column.nonzero and not isinstance(sort, Bool):
        raise LogError(f"nonzero of {column.signal}: it is not true or false; leave `nonzero` out.")
    if column.clamp and (not an_input or signal.stamp or not isinstance(sort, Num)):
        raise LogError(f"clamp of {column.signal}: it is no measurement that the board reads; leave it out.")
    if column.nonzero:
        return lambda number: int(number != 0)
    read = _input(signal, column.kind) if an_input else _output(signal)
    if not column.clamp:
        return read
    low, high = exact(signal.low), exact(signal.high)
    return lambda number: read(min(max(number, low), high))


def in_bits(signal: BoardSignal) -> bool:
    """Whether the number is a mask, of which charts read single bits."""
    return signal.whole and "mask" in signal.name


def _output(signal: BoardSignal) -> Meaning:
    resolution = _resolution(signal)
    if resolution != 1:
        return lambda number: _whole(number / resolution)

    def read(number: Fraction) -> Raw:
        if abs(number) > LARGEST_WHOLE or (in_bits(signal) and number.denominator != 1):
            raise _NoValue(f"{float(number):g} is no whole number that a board can hold.")
        return _whole(number)

    return read


def _input(signal: BoardSignal, kind: str) -> Meaning:
    """What firmware can hold; ``_NoValue`` for anything else."""
    sort = signal.domain.sort
    if kind == "age":
        return _age
    if signal.stamp:
        return lambda number: _time(number, signal)
    if isinstance(sort, Num):
        return _measurement(signal, str(sort.unit))
    return lambda number: _member(number, signal)


def _age(number: Fraction) -> Raw:
    if number < 0:
        raise _NoValue(f"an age of {float(number):g} ms is negative.")
    return _whole(number)


def _time(number: Fraction, signal: BoardSignal) -> Raw:
    time = round(number)
    if not 0 <= time <= signal.high:
        raise _NoValue(f"{float(number):g} ms is no time of a 32-bit clock (0..{signal.high:.0f}).")
    return time


def _measurement(signal: BoardSignal, unit: str) -> Meaning:
    low, high, raw = exact(signal.low), exact(signal.high), _output(signal)
    in_unit = f" {unit}".rstrip()

    def read(number: Fraction) -> Raw:
        if low <= number <= high:
            return raw(number)
        raise _NoValue(
            f"{float(number):g}{in_unit} is outside {signal.low:g}..{signal.high:g}{in_unit}; "
            "is it in another unit? Write unit = or scale = in the map; or clamp = true, or "
            "absent = [...] for no value."
        )

    return read


def _member(number: Fraction, signal: BoardSignal) -> Raw:
    if number.denominator == 1 and int(number) in signal.domain:
        return int(number)
    more = "; write nonzero = true in the map if it is true" if isinstance(signal.domain.sort, Bool) else ""
    raise _NoValue(f"{float(number):g} is outside {signal.domain}{more}, or absent = [...] for no value.")


def _whole(number: Fraction) -> Raw:
    return number.numerator if number.denominator == 1 else number
