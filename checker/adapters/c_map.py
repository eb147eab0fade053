"""The mapping file of a C supervisor: which functions to call, and where the signals are held."""

import tomllib
from collections.abc import Collection, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rovercheck.checker.adapters.implementation import ImplementationError
from rovercheck.spec_model.lang.domain import Enum
from rovercheck.spec_model.lang.errors import did_you_mean

if TYPE_CHECKING:
    from rovercheck.spec_model.abstraction import Board
    from rovercheck.spec_model.abstraction.signals import BoardSignal

ROUNDINGS = ("nearest", "floor", "truncate")
PLACE_KEYS = ("at", "scale", "offset", "rounding", "values")
LISTS = ("sources", "header", "include", "flags", "initialize", "step", "terminate")
KEYS = (*LISTS, "declarations", "constants", "inputs", "outputs")


@dataclass(frozen=True)
class CPlace:
    """Where a signal is held: an expression of C, which for an input can be assigned to.

    The signal is what is held times ``scale`` plus ``offset``.  ``values`` gives the C constant of each
    number of an enumeration; ``rounding`` says what becomes of an input that the integer type cannot hold.
    """

    signal: str
    at: str
    scale: float = 1.0
    offset: float = 0.0
    rounding: str = ""
    values: Mapping[int, str] = field(default_factory=dict)
    boolean: bool = False


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
        return tuple(self._place(f"[{section}] {name}", signals[name], at) for name, at in table.items())

    def _place(self, where: str, signal: "BoardSignal", written: object) -> CPlace:
        table: Mapping[str, Any] = (
            {"at": written} if isinstance(written, str) else self._is_table(where, written)
        )
        self._known(where, table, PLACE_KEYS)
        if "values" in table and len(table) > 2:
            raise self._wrong(f"{where}: values says it all; leave scale, offset and rounding out")
        if table.get("rounding", "nearest") not in ROUNDINGS:
            raise self._wrong(f"{where}: rounding is one of {', '.join(ROUNDINGS)}")
        return CPlace(
            signal=signal.name,
            at=self._expression(where, table.get("at")),
            scale=self._number(where, "scale", table.get("scale", 1.0)),
            offset=self._number(where, "offset", table.get("offset", 0.0)),
            rounding=table.get("rounding", ""),
            values=self._values(where, signal, table.get("values", {})),
            boolean=signal.domain.sort.__class__.__name__ == "Bool",
        )

    def _values(self, where: str, signal: "BoardSignal", written: object) -> dict[int, str]:
        sort = signal.domain.sort
        members = dict(sort.members) if isinstance(sort, Enum) else {"false": 0, "true": 1}
        found: dict[int, str] = {}
        for name, value in self._is_table(f"{where}: values", written).items():
            if name not in members:
                raise self._wrong(
                    f"{where}: values: {signal.name} has no {name!r}. {did_you_mean(name, members)}"
                )
            found[members[name]] = self._constant(f"{where}: values: {name}", value)
        return found

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

    def _number(self, where: str, key: str, written: object) -> float:
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
