"""The mapping file of a C supervisor: which functions to call, and where the signals are held."""

import tomllib
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rovercheck.checker.adapters.c_units import conversion, known_units
from rovercheck.checker.adapters.implementation import ImplementationError
from rovercheck.spec_model.abstraction.stamps import NOW
from rovercheck.spec_model.lang.domain import Enum, Num
from rovercheck.spec_model.lang.errors import did_you_mean

if TYPE_CHECKING:
    from rovercheck.spec_model.abstraction import Board
    from rovercheck.spec_model.abstraction.signals import BoardSignal

ROUNDINGS = ("nearest", "floor", "truncate")
PLACE_KEYS = ("at", "scale", "offset", "unit", "rounding", "values", "not_yet", "mask", "counter", "wraps")
ONLY = {"outputs": ("not_yet",), "inputs": ("counter", "wraps")}
"""Keys that have a meaning in one section only."""
LISTS = ("sources", "header", "include", "flags", "initialize", "step", "terminate")
KEYS = (*LISTS, "declarations", "constants", "inputs", "outputs")


@dataclass(frozen=True)
class CPlace:
    """Where a signal is held: an expression of C, which for an input can be assigned to.

    The signal is what is held times ``scale`` plus ``offset``, each a number or a constant of the code, in
    ``unit``.  ``values`` gives the C constants of each number of an enumeration, of which an input is given
    the first; ``not_yet`` those that are no value yet; ``mask`` the bits that hold a truth value.
    ``rounding`` says what becomes of an input that the integer type cannot hold, ``wraps`` that it is held
    modulo what the type holds.  ``counts``: what is held counts the new stamps.
    """

    signal: str
    at: str
    scale: float | str = 1.0
    offset: float | str = 0.0
    rounding: str = ""
    values: Mapping[int, tuple[str, ...]] = field(default_factory=dict)
    not_yet: tuple[str, ...] = ()
    mask: str = ""
    counts: bool = False
    wraps: bool = False
    boolean: bool = False
    factor: float = 1.0
    shift: float = 0.0
    """How many units of the signal one of ``unit`` is, and what 0 of it is."""


@dataclass(frozen=True)
class CMap:
    """A mapping file as read; names of files are relative to its folder."""

    file: Path
    inputs: tuple[CPlace, ...]
    outputs: tuple[CPlace, ...]
    step: tuple[str, ...]
    initialize: tuple[str, ...] = ()
    terminate: tuple[str, ...] = ()
    sources: tuple[str, ...] = ()
    header: tuple[str, ...] = ()
    include: tuple[str, ...] = ()
    flags: tuple[str, ...] = ()
    declarations: str = ""
    constants: Mapping[str, str] = field(default_factory=dict)


def read(file: Path, board: "Board") -> CMap:
    """The mapping file.  Raises ``ImplementationError`` for one that cannot be read or has no meaning."""
    try:
        found = tomllib.loads(file.read_text(encoding="utf-8"))
    except OSError as error:
        raise ImplementationError(
            f"{file}: the mapping file cannot be read: {error.strerror}; write c:PATH,map=FILE."
        ) from None
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise ImplementationError(f"{file}: the mapping file is no TOML: {error}") from None
    return _Reader(file, found).map(board)


@dataclass(frozen=True)
class _Reader:
    file: Path
    found: Mapping[str, Any]

    def map(self, board: "Board") -> CMap:
        self._known("", self.found, KEYS)
        texts = {key: self._texts(key) for key in LISTS}
        if not texts["step"]:
            raise self._wrong("step is missing; write the function that executes one step")
        outputs = {o.name: o.signal for o in board.outputs}
        return CMap(
            file=self.file,
            inputs=self._places("inputs", {s.name: s for s in board.inputs}, board.name),
            outputs=self._places("outputs", outputs, board.name),
            declarations=self._declarations(),
            constants={at: self._constant(at, value) for at, value in self._table("constants").items()},
            **texts,
        )

    def _places(self, section: str, signals: Mapping[str, "BoardSignal"], board: str) -> tuple[CPlace, ...]:
        table = self._table(section)
        if not table:
            raise self._wrong(f'[{section}] is missing; write SIGNAL = "where.it.is.held" for each signal')
        for name in table:
            if name not in signals:
                hint = did_you_mean(name, signals)
                raise self._wrong(f"[{section}] {name}: {board} has no {section[:-1]} of this name. {hint}")
        return tuple(
            place
            for name, at in table.items()
            for place in self._all_places(section, f"[{section}] {name}", signals[name], at)
        )

    def _all_places(
        self, section: str, where: str, signal: "BoardSignal", written: object
    ) -> Iterator[CPlace]:
        """The place of a signal; of a stamp also the counter that goes with it."""
        table: Mapping[str, Any] = (
            {"at": written} if isinstance(written, str) else self._is_table(where, written)
        )
        self._known(where, table, PLACE_KEYS)
        for other, keys in ONLY.items():
            if wrong := [key for key in keys if key in table and section != other]:
                raise self._wrong(f"{where}: {wrong[0]} has a meaning in [{other}] only")
        if "counter" in table:
            if not signal.stamp or signal.name == NOW:
                raise self._wrong(
                    f"{where}: counter counts the new stamps of a source; {signal.name} is none"
                )
            yield CPlace(signal.name, self._expression(where, table["counter"]), counts=True)
        if "at" in table or "counter" not in table:
            yield self._place(where, signal, {k: v for k, v in table.items() if k != "counter"})

    def _place(self, where: str, signal: "BoardSignal", table: Mapping[str, Any]) -> CPlace:
        boolean = signal.domain.sort.__class__.__name__ == "Bool"
        if "values" in table and table.keys() - {"at", "values", "not_yet"}:
            raise self._wrong(
                f"{where}: values says it all; leave scale, offset, unit, mask and rounding out"
            )
        if "mask" in table and (not boolean or table.keys() - {"at", "mask"}):
            raise self._wrong(f"{where}: mask is of a truth value alone; write at and mask")
        if "wraps" in table and (not signal.stamp or table["wraps"] is not True):
            raise self._wrong(
                f"{where}: wraps = true is of a time stamp; {signal.name} is none, or leave it out"
            )
        if table.get("rounding", "nearest") not in ROUNDINGS:
            raise self._wrong(f"{where}: rounding is one of {', '.join(ROUNDINGS)}")
        factor, shift = self._unit(where, signal, table.get("unit"))
        return CPlace(
            signal=signal.name,
            at=self._expression(where, table.get("at")),
            scale=self._number(where, "scale", table.get("scale", 1.0)),
            offset=self._number(where, "offset", table.get("offset", 0.0)),
            rounding=table.get("rounding", ""),
            values=self._values(where, signal, table.get("values", {})),
            not_yet=self._constants(f"{where}: not_yet", table.get("not_yet", [])),
            mask=self._constant(where, table["mask"]) if "mask" in table else "",
            wraps="wraps" in table,
            boolean=boolean,
            factor=factor,
            shift=shift,
        )

    def _unit(self, where: str, signal: "BoardSignal", written: object) -> tuple[float, float]:
        sort = signal.domain.sort
        if written is None:
            return 1.0, 0.0
        own = str(sort.unit) if isinstance(sort, Num) else ""
        if not isinstance(written, str) or (found := conversion(written, own)) is None:
            known = known_units(own)
            advice = f"; write one of {', '.join(known)}" if known else ", which has no unit; leave it out"
            raise self._wrong(f"{where}: unit = {written!r} does not become {own or signal.name}{advice}")
        return found

    def _values(self, where: str, signal: "BoardSignal", written: object) -> dict[int, tuple[str, ...]]:
        sort = signal.domain.sort
        if isinstance(sort, Enum):
            members = dict(sort.members)
        elif isinstance(sort, Num):
            members = {str(n): n for n in signal.domain.values} if signal.whole and written else {}
        else:
            members = {"false": 0, "true": 1}
        found: dict[int, tuple[str, ...]] = {}
        for name, value in self._is_table(f"{where}: values", written).items():
            if name not in members:
                raise self._wrong(
                    f"{where}: values: {signal.name} has no {name!r}. {did_you_mean(name, members)}"
                )
            found[members[name]] = self._constants(f"{where}: values: {name}", value)
            if not found[members[name]]:
                raise self._wrong(f"{where}: values: {name} = [] holds no constant; write one at least")
        return found

    def _constants(self, where: str, written: object) -> tuple[str, ...]:
        """One constant of the code, or several in brackets."""
        each = written if isinstance(written, list) else [written]
        return tuple(self._constant(where, one) for one in each)

    def _texts(self, key: str) -> tuple[str, ...]:
        written = self.found.get(key, [])
        texts = [written] if isinstance(written, str) else written
        if not isinstance(texts, list) or not all(isinstance(text, str) and text.strip() for text in texts):
            raise self._wrong(f"{key} = {written!r}; write a text, or several in brackets")
        return tuple(texts)

    def _declarations(self) -> str:
        written = self.found.get("declarations", "")
        if not isinstance(written, str):
            raise self._wrong(f"declarations = {written!r}; write C declarations in triple quotes")
        return written

    def _table(self, key: str) -> Mapping[str, Any]:
        return self._is_table(f"[{key}]", self.found.get(key, {}))

    def _is_table(self, where: str, written: object) -> Mapping[str, Any]:
        if not isinstance(written, dict):
            raise self._wrong(f"{where} = {written!r} has no meaning here; write a table")
        return written

    def _expression(self, where: str, written: object) -> str:
        """C on one line that cannot end the statement it is put in."""
        if not isinstance(written, str) or not written.strip() or any(sign in written for sign in ";{}#\n\\"):
            raise self._wrong(
                f'{where}: {written!r} is no place in C; write one such as "rtU.health.temperature"'
            )
        return written.strip()

    def _constant(self, where: str, written: object) -> str:
        if isinstance(written, bool):
            return str(int(written))
        return str(written) if isinstance(written, int | float) else self._expression(where, written)

    def _number(self, where: str, key: str, written: object) -> float | str:
        """A number, or a constant of the code that stands for one."""
        if isinstance(written, str):
            return self._expression(f"{where}: {key}", written)
        if (
            isinstance(written, bool)
            or not isinstance(written, int | float)
            or (key == "scale" and written == 0)
        ):
            raise self._wrong(f"{where}: {key} = {written!r} is no number" + " but 0" * (key == "scale"))
        return float(written)

    def _known(self, where: str, table: Mapping[str, Any], keys: Collection[str]) -> None:
        for key in table:
            if key not in keys:
                raise self._wrong(
                    f"{where + ': ' if where else ''}{key!r} has no meaning here. {did_you_mean(key, keys)}"
                )

    def _wrong(self, what: str) -> ImplementationError:
        return ImplementationError(f"{self.file}: {what if what[-1] in '.?' else what + '.'}")
