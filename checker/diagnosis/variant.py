"""Variants of a board as small files of changes: written from causes, read, and applied again."""

import re
import tomllib
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from pathlib import Path

from rovercheck.checker.conformance.numbers import numbers_in
from rovercheck.checker.diagnosis.change import KINDS, ChartChange
from rovercheck.checker.diagnosis.hypotheses import (
    age_changes,
    beginning_changes,
    delay_changes,
    during_changes,
    extra_changes,
    mutant_changes,
    region_changes,
    rewrite_changes,
    signals_of,
    stamp_changes,
    timer_changes,
    written_changes,
)
from rovercheck.checker.diagnosis.limits import number_slots
from rovercheck.spec_model.abstraction import Board
from rovercheck.spec_model.abstraction.board import with_readings
from rovercheck.spec_model.lang.chart import parts
from rovercheck.spec_model.lang.errors import ModelError, did_you_mean
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.system import System

KEYS = ("kind", "chart", "at", "from", "to")
_WRITE = "Write a file as `rovercheck compare --write-variant` or `rovercheck diagnose --write` does."
_NUMBER = re.compile(r"-?\d{1,30}(?:\.\d{1,30}|/\d{1,30})?")
_SPAN = re.compile(r"(\d+(?:\.\d+)?) (s|ms|ticks?)\b")


class VariantError(Exception):
    """A variant without meaning: the message begins with the place in the file."""


@dataclass(frozen=True)
class WrittenChange:
    """One change as it is written in a file."""

    kind: str
    chart: str
    at: str
    old: str
    new: str

    @property
    def key(self) -> tuple[str, ...]:
        return (self.kind, self.chart, self.at, self.old, self.new)


@dataclass(frozen=True)
class BoardVariant:
    """Changes of a board's charts, in the order in which they are made.

    ``evidence`` says what was compared with them, and how much they explain.
    """

    board: str
    changes: tuple[WrittenChange, ...]
    evidence: str = ""


def written(
    board: str,
    changes: Sequence[ChartChange | WrittenChange],
    comments: Sequence[str] = (),
    evidence: str = "",
) -> str:
    """The file of a variant, in TOML; ``comments`` are said before each change."""
    lines = [f"board = {_quoted(board)}", *([f"evidence = {_quoted(evidence)}"] if evidence else [])]
    for number, change in enumerate(changes):
        said = [f"# {line}" for line in comments[number : number + 1] if line]
        lines += ["", *said, "[[change]]"]
        lines += [f"{key} = {_quoted(value)}" for key, value in zip(KEYS, change.key, strict=True)]
    return "\n".join(lines) + "\n"


def _quoted(text: str) -> str:
    if "'" not in text and text.isprintable():
        return f"'{text}'" if '"' in text or "\\" in text else f'"{text}"'
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n") + '"'


def read_variant(file: Path) -> BoardVariant:
    """A variant from its file.  Raises ``VariantError``."""
    try:
        table = tomllib.loads(file.read_text(encoding="utf-8"))
    except OSError as error:
        raise VariantError(f"{file}: {error.strerror}. {_WRITE}") from error
    except (UnicodeDecodeError, tomllib.TOMLDecodeError) as error:
        raise VariantError(f"{file}: {error}. {_WRITE}") from error
    board, rows, evidence = table.get("board"), table.get("change", []), table.get("evidence", "")
    texts = isinstance(board, str) and isinstance(evidence, str)
    if not texts or not isinstance(rows, list) or set(table) - {"board", "evidence", "change"}:
        raise VariantError(
            f'{file}: a variant holds board = "...", tables [[change]], evidence = "..." if there is any, '
            "and nothing else."
        )
    found: list[WrittenChange] = []
    for number, row in enumerate(rows, 1):
        if not (isinstance(row, dict) and set(row) == set(KEYS) and _are_texts(row.values())):
            raise VariantError(f"{file}, change {number}: write {', '.join(KEYS)}, each a text.")
        found.append(WrittenChange(*(row[key] for key in KEYS)))
    return BoardVariant(str(board), tuple(found), evidence)


def _are_texts(values: Iterable[object]) -> bool:
    return all(isinstance(value, str) for value in values)


def applied(board: Board, variant: BoardVariant, file: str = "the variant") -> Board:
    """The board with the changes of a variant.  Raises ``VariantError`` for one that does not fit."""
    if variant.board != board.name:
        raise VariantError(f"{file}: it is a variant of {variant.board}, and not of {board.name}.")
    for number, change in enumerate(variant.changes, 1):
        try:
            board = with_change(board, change)
        except ModelError as error:
            where = f"{file}, change {number} ({change.kind} in {change.chart})"
            raise VariantError(f"{where}: {error}") from error
    return board


def with_change(board: Board, change: WrittenChange) -> Board:
    """The board with one more change.  Raises ``ModelError`` for one that does not fit.

    A stamp is taken by the board and not by each chart, so that what was found in two charts is made once.
    """
    made = found_change(board, board.system, change)
    taken = board.interface.taken
    readings = [] if made.reading is None or made.reading in taken else [made.reading]
    system = made.make()
    return with_readings(replace(board, system=system, constants=numbers_in(system)), readings)


def with_changes(board: Board, keys: Iterable[Sequence[str]]) -> Board:
    """The board with changes by their keys, one on top of the other.  Raises ``ModelError``."""
    for key in keys:
        board = with_change(board, WrittenChange(*key))
    return board


def found_change(board: Board, system: System, change: WrittenChange) -> ChartChange:
    """The change of the charts, or of some of them, that is written.

    Raises ``ModelError`` for one that does not fit.
    """
    if change.kind not in KINDS:
        raise ModelError(f"there is no kind {change.kind!r}. {did_you_mean(change.kind, KINDS)}")
    names = [part.name for part in parts(system.components)]
    if change.chart not in names:
        near = did_you_mean(change.chart, names)
        raise ModelError(f"{board.name} has no chart or block of that name. {near}")
    there: list[str] = []
    for one in _like(board, system, change):
        if one.key == change.key:
            return one
        if one.at == change.at and one.chart == change.chart:
            there.append(one.old)
    if not there:
        raise ModelError(f"there is nothing for {KINDS[change.kind]} at {change.at!r}.")
    if change.old not in there:
        raise ModelError(f"at {change.at!r} is `{there[0]}`, and not `{change.old}`.")
    raise ModelError(f"at {change.at!r}, `{change.old}` cannot become `{change.new}`.")


def _like(board: Board, system: System, change: WrittenChange) -> Iterator[ChartChange]:
    """Every change of the kind in the chart."""
    for one in _all_like(board, system, change):
        if one.kind == change.kind and one.chart == change.chart:
            yield one


def _all_like(board: Board, system: System, change: WrittenChange) -> Iterator[ChartChange]:
    only = frozenset({change.chart})
    match change.kind:
        case "limit" | "constant":
            yield from _numbers(system, only, change)
        case "comparison":
            yield from _numbers(system, only, change)
            yield from mutant_changes(system, only)
            yield from rewrite_changes(system, signals_of(board), only)
        case "timer":
            yield from timer_changes(system, _steps(system, change.new), only)
        case "interpretation" | "repair":
            yield from written_changes(board, system)
        case "late" | "stale" | "held" | "frozen" | "unread":
            yield from delay_changes(system, only)
        case "single-precision":
            yield from age_changes(board, system, only)
        case "stamp":
            yield from stamp_changes(board, system, only)
        case "shared" if change.at.startswith("stamp/"):
            yield from stamp_changes(board, system, only)
        case "shared" if change.at.startswith("regions"):
            yield from region_changes(system, only)
        case "extra":
            yield from extra_changes(system, only)
        case "initial":
            yield from beginning_changes(system, only)
            yield from mutant_changes(system, only)
        case "missing":
            yield from mutant_changes(system, only)
            yield from during_changes(system, only)
        case _:
            yield from mutant_changes(system, only)
            yield from rewrite_changes(system, signals_of(board), only)


def _numbers(system: System, only: frozenset[str], change: WrittenChange) -> Iterator[ChartChange]:
    for slot in number_slots(system, only):
        head, _, number = change.new.rpartition(" ")
        word = head.rpartition(" ")[2]
        op = Op(word) if slot.op is not None and word in set(Op) else None
        if (slot.op is None) != (op is None):
            continue
        text = number if op else change.new
        if _NUMBER.fullmatch(text) is None:
            continue
        try:
            raw = Fraction(text) / slot.sort.resolution
        except (ValueError, ZeroDivisionError):
            continue
        yield slot.change(op, raw)


def _steps(system: System, text: str) -> list[int]:
    found = []
    for amount, unit in _SPAN.findall(text):
        value = Fraction(amount) * {"s": 1000, "ms": 1}.get(unit, system.step_ms) / system.step_ms
        if value.denominator == 1:
            found.append(int(value))
    return found


__all__ = [
    "BoardVariant", "VariantError", "WrittenChange", "applied", "found_change", "read_variant", "with_change",
    "with_changes", "written",
]  # fmt: skip
