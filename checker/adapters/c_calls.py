"""Calls a compiled C supervisor: values by name become what its variables hold, and back."""

import ctypes
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import count
from typing import Any

from rovercheck.checker.adapters.child import PowerUp, RefusedStep
from rovercheck.checker.adapters.implementation import KEPT, Value, Values
from rovercheck.spec_model.lang.domain import exact

INTEGERS = frozenset({
    "bool", "char", "signed char", "unsigned char", "short", "unsigned short", "int", "unsigned int", "long",
    "unsigned long", "long long", "unsigned long long", "integer",
})  # fmt: skip
ROUND: Mapping[str, Callable[[Fraction], int]] = {
    "nearest": lambda x: math.floor(x + Fraction(1, 2)),
    "floor": math.floor,
    "truncate": math.trunc,
}


@dataclass(frozen=True)
class HeldPointer:
    """A signal, where it is held, and how: as in the mapping file, with the numbers of its constants."""

    signal: str
    at: str
    scale: float
    offset: float
    rounding: str
    values: Sequence[tuple[int, float]]
    not_yet: Sequence[float]
    mask: str
    counts: bool
    wraps: bool
    boolean: bool
    factor: float
    shift: float
    type: str

    @property
    def integer(self) -> bool:
        return self.type in INTEGERS


class CLibrary:
    """A compiled supervisor at power-up."""

    def __init__(
        self,
        library: ctypes.CDLL,
        inputs: Sequence[HeldPointer],
        outputs: Sequence[HeldPointer],
        hostile: bool = False,
    ) -> None:
        """``hostile``: an input that a place cannot hold stays as it was, an odd output is given as it is."""
        self._library, self._inputs = library, inputs
        self._names = [held.signal for held in inputs]
        self._put = [(n, _putting(held, hostile)) for n, held in enumerate(inputs) if not _as_it_is(held)]
        self._get = [(held.signal, _getting(held, hostile)) for held in outputs]
        self._hostile, self._latest = hostile, [0.0] * len(inputs)
        self._in: Any = (ctypes.c_double * len(inputs))()
        self._out = (ctypes.c_double * len(outputs))()
        self._call = library.rovercheck_step
        library.rovercheck_initialize()

    def step(self, inputs: Values) -> Mapping[str, Value]:
        """Write the inputs, execute one step, read the outputs."""
        numbers: list[float] = [inputs[name] for name in self._names]
        for index, put in self._put:
            numbers[index] = put(numbers[index])
        self._in[:] = numbers
        kept: dict[str, Value] = {}
        while wrong := self._call(self._in, self._out):
            if not self._hostile or self._in[wrong - 1] == self._latest[wrong - 1]:
                raise RefusedStep(_unfit(self._inputs[wrong - 1], inputs, numbers[wrong - 1]))
            self._in[wrong - 1] = self._latest[wrong - 1]
            kept[f"{KEPT}{self._names[wrong - 1]}"] = True
        self._latest[:] = self._in
        found = ((name, get(value)) for (name, get), value in zip(self._get, self._out, strict=True))
        return {name: value for name, value in found if value is not None} | kept

    def end(self) -> None:
        """Call what the mapping file gives for the end."""
        self._library.rovercheck_terminate()


def made(
    library: str, before: str, inputs: Sequence[Any], outputs: Sequence[Any], hostile: bool = False
) -> PowerUp:
    """Power-ups of a shared object that was compiled with its shim; ``before`` is loaded first."""
    try:
        if before:
            ctypes.CDLL(before)
        loaded = ctypes.CDLL(library)
    except OSError as error:
        raise RefusedStep(f"the library cannot be loaded: {error}") from None
    loaded.rovercheck_constant.restype = ctypes.c_double
    loaded.rovercheck_input_type.restype = loaded.rovercheck_output_type.restype = ctypes.c_char_p
    numbers = count()

    def constant(written: Any) -> float:
        """A number, or the one that the compiler gave a constant of the code."""
        return float(loaded.rovercheck_constant(next(numbers)) if isinstance(written, str) else written)

    def held(place: Mapping[str, Any], kind: bytes) -> HeldPointer:
        scale, offset = constant(place["scale"]), constant(place["offset"])
        if scale == 0 or not (math.isfinite(scale) and math.isfinite(offset)):
            raise RefusedStep(f"{place['signal']}: scale {place['scale']} is {scale:g}, offset {offset:g}")
        values = [(int(n), constant(text)) for n, texts in place["values"].items() for text in texts]
        _check_values(place["signal"], values)
        not_yet = [constant(text) for text in place["not_yet"]]
        found = {"scale": scale, "offset": offset, "values": values, "not_yet": not_yet}
        return HeldPointer(**{**place, **found, "type": kind.decode()})

    ins = [held(place, loaded.rovercheck_input_type(n)) for n, place in enumerate(inputs)]
    outs = [held(place, loaded.rovercheck_output_type(n)) for n, place in enumerate(outputs)]
    return lambda: CLibrary(loaded, ins, outs, hostile)


def _check_values(signal: str, values: Sequence[tuple[int, float]]) -> None:
    """Raise ``RefusedStep`` where one value of the code stands for two members."""
    meanings: dict[float, int] = {}
    for number, raw in values:
        if meanings.setdefault(raw, number) != number:
            raise RefusedStep(
                f"{signal}: the mapping file gives {raw:g} for two of its values, {meanings[raw]}, {number}"
            )


def _as_it_is(held: HeldPointer) -> bool:
    plain = (held.scale, held.offset, held.rounding, held.factor, held.shift) == (1.0, 0.0, "", 1.0, 0.0)
    return plain and not (held.values or held.counts)


def _linear(held: HeldPointer) -> tuple[Fraction, Fraction]:
    """The signal for 1 more of what is held, and for 0."""
    factor = exact(held.factor)
    return exact(held.scale) * factor, exact(held.offset) * factor + exact(held.shift)


def _counting() -> Callable[[float], float]:
    """How many stamps there have been; at power-up it is 0."""
    latest, times = 0.0, 0

    def put(stamp: float) -> float:
        nonlocal latest, times
        times += stamp != latest
        latest = stamp
        return times

    return put


def _putting(held: HeldPointer, hostile: bool = False) -> Callable[[float], float]:
    """What a place holds for a value."""
    if held.counts:
        return _counting()
    numbers = dict(reversed(held.values))
    scale, offset = _linear(held)

    def put(value: float) -> float:
        if numbers:
            if hostile:
                return numbers.get(int(value), value) if value == int(value) else value
            if value not in numbers:
                raise RefusedStep(f"{held.signal} = {value:g}: the mapping file gives no C value for it")
            return numbers[int(value)]
        if not math.isfinite(value):
            return value
        raw = (exact(value) - offset) / scale
        rounding = held.rounding or ("floor" if held.wraps else "")
        return ROUND[rounding](raw) if rounding and held.integer else float(raw)

    return put


def _getting(held: HeldPointer, hostile: bool = False) -> Callable[[float], Value | None]:
    """The value for what a place holds; None while it holds what is no value yet."""
    meanings = {raw: number for number, raw in held.values}
    scale, offset = _linear(held)
    unknown = any(map(math.isnan, held.not_yet))

    def get(raw: float) -> Value | None:
        if held.not_yet and (raw in held.not_yet or (unknown and math.isnan(raw))):
            return None
        if meanings:
            if raw not in meanings and hostile:
                return raw
            if raw not in meanings:
                raise RefusedStep(
                    f"{held.signal}: {held.at} is {raw:g}, which the mapping file does not explain"
                )
            raw = meanings[raw]
        elif held.type == "float":
            raw = _single(raw)
        if scale != 1 or offset != 0:
            return float(exact(raw) * scale + offset) if math.isfinite(raw) else raw
        if held.boolean and raw in (0, 1):
            return bool(raw)
        return int(raw) if held.integer or held.mask else raw

    return get


def _single(raw: float) -> float:
    """The shortest decimal that a number of single precision can have been meant to be."""
    near = (float(f"{raw:.{digits}g}") for digits in (6, 7, 8))
    return next((value for value in near if ctypes.c_float(value).value == raw), raw)


def _unfit(held: HeldPointer, inputs: Values, raw: float) -> str:
    """Why a value cannot be held, and what to write."""
    given = f"{held.signal} = {inputs[held.signal]}"
    scaled = "" if _as_it_is(held) else f" (held as {raw:g})"
    advice = "; give the entry a rounding, or a scale" if math.isfinite(raw) and raw % 1 else ""
    return f"{given}{scaled} does not fit {held.at}, which is of type {held.type}{advice}"
