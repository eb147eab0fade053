"""Calls a compiled C supervisor: values by name become what its variables hold, and back."""

import ctypes
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from rovercheck.checker.adapters.child import PowerUp, RefusedStep
from rovercheck.checker.adapters.implementation import Value, Values
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
    boolean: bool
    type: str

    @property
    def integer(self) -> bool:
        return self.type in INTEGERS


class CLibrary:
    """A compiled supervisor at power-up."""

    def __init__(
        self, library: ctypes.CDLL, inputs: Sequence[HeldPointer], outputs: Sequence[HeldPointer]
    ) -> None:
        self._library, self._inputs = library, inputs
        self._names = [held.signal for held in inputs]
        self._put = [(n, _putting(held)) for n, held in enumerate(inputs) if not _as_it_is(held)]
        self._get = [(held.signal, _getting(held)) for held in outputs]
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
        if wrong := self._call(self._in, self._out):
            raise RefusedStep(_unfit(self._inputs[wrong - 1], inputs, numbers[wrong - 1]))
        return {name: get(value) for (name, get), value in zip(self._get, self._out, strict=True)}

    def end(self) -> None:
        """Call what the mapping file gives for the end."""
        self._library.rovercheck_terminate()


def made(library: str, before: str, inputs: Sequence[Any], outputs: Sequence[Any]) -> PowerUp:
    """Power-ups of a shared object that was compiled with its shim; ``before`` is loaded first."""
    try:
        if before:
            ctypes.CDLL(before)
        loaded = ctypes.CDLL(library)
    except OSError as error:
        raise RefusedStep(f"the library cannot be loaded: {error}") from None
    loaded.rovercheck_constant.restype = ctypes.c_double
    loaded.rovercheck_input_type.restype = loaded.rovercheck_output_type.restype = ctypes.c_char_p
    constants = iter(range(sum(len(place["values"]) for place in (*inputs, *outputs))))

    def held(place: Mapping[str, Any], kind: bytes) -> HeldPointer:
        values = [(int(n), loaded.rovercheck_constant(next(constants))) for n in place["values"]]
        return HeldPointer(**{**place, "values": values, "type": kind.decode()})

    ins = [held(place, loaded.rovercheck_input_type(n)) for n, place in enumerate(inputs)]
    outs = [held(place, loaded.rovercheck_output_type(n)) for n, place in enumerate(outputs)]
    return lambda: CLibrary(loaded, ins, outs)


def _as_it_is(held: HeldPointer) -> bool:
    return not held.values and (held.scale, held.offset, held.rounding) == (1.0, 0.0, "")


def _putting(held: HeldPointer) -> Callable[[float], float]:
    """What a place holds for a value."""
    numbers, scale, offset = dict(held.values), exact(held.scale), exact(held.offset)

    def put(value: float) -> float:
        if numbers:
            if value not in numbers:
                raise RefusedStep(f"{held.signal} = {value:g}: the mapping file gives no C value for it")
            return numbers[int(value)]
        if not math.isfinite(value):
            return value
        raw = (exact(value) - offset) / scale
        return ROUND[held.rounding](raw) if held.rounding and held.integer else float(raw)

    return put


def _getting(held: HeldPointer) -> Callable[[float], Value]:
    """The value for what a place holds."""
    meanings = {raw: number for number, raw in held.values}
    scale, offset = exact(held.scale), exact(held.offset)

    def get(raw: float) -> Value:
        if meanings:
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
        return int(raw) if held.integer else raw

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
