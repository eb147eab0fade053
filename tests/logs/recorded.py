"""Logs for tests: the executable supervisors run with inputs held for a while, and faults put into them."""

import csv
from collections.abc import Iterable, Iterator, Sequence
from functools import cache
from io import StringIO
from pathlib import Path
from random import Random

from rovercheck.checker.adapters.firmware import places
from rovercheck.checker.adapters.python_calls import Instance
from rovercheck.spec_model.abstraction import Board, BoardSignal, boards
from rovercheck.supervisor.board1 import Board1
from rovercheck.supervisor.board2.board import Board2

Row = dict[str, bool | int | float]

FIRMWARE = {"board1": Board1, "board2": Board2}
HEALTHY = {
    "temperature_degC": 25.0, "battery_pct": 80.0, "isMotionConsistent": True, "crit_mask_b1": 4,
    "y_norm": 0.8, "ay_norm": 0.8, "d1": 301, "d2": 301, "d3": 301,
}  # fmt: skip
"""Inputs with which the rover drives, where the initial values are none."""

SELDOM = {
    "crit_mask_b2",
    "degr_mask_b2",
    "crit_mask_b1",
    "degr_mask_b1",
    "d1",
    "d2",
    "d3",
    "isMotionConsistent",
}
"""Inputs that stop the rover."""

PAUSES = (1, 2, 5, 6, 7, 8, 12, 30, 60, 160, 260)


def value(signal: BoardSignal, random: Random) -> bool | int | float:
    """Healthy half of the time, else one of the values on both sides of the limits, or any."""
    kind = random.random()
    if kind < 0.5:
        return HEALTHY.get(signal.name, signal.initial)
    if kind < 0.8 or not signal.high:
        raw = random.choice(signal.domain.values)
        number = raw * getattr(signal.domain.sort, "resolution", 1)
        return int(number) if number == int(number) else float(number)
    if signal.whole:
        return random.randint(int(signal.low), int(signal.high))
    return round(random.uniform(signal.low, signal.high), 3)


def record(board: Board, steps: int, seed: int = 1, restless: float = 0.04) -> list[Row]:
    """The rows of a log: a step each, from power-up."""
    return list(recorded(board, steps, seed, restless))


def recorded(board: Board, steps: int, seed: int = 1, restless: float = 0.04) -> Iterator[Row]:
    """The same rows one by one, as many as one likes."""
    random, firmware = Random(seed), Instance(FIRMWARE[board.name], places(board))
    at: Row = {s.name: HEALTHY.get(s.name, s.initial) for s in board.inputs}
    pauses = dict.fromkeys((s.name for s in board.inputs if s.stamp), 0)
    for step in range(1, steps + 1):
        for signal in board.inputs:
            _renew(at, signal, 20 * step, pauses, random, restless)
        yield {**at, **firmware.step(at)}


def _renew(
    at: Row, signal: BoardSignal, now: int, pauses: dict[str, int], random: Random, restless: float
) -> None:
    name = signal.name
    if name == "now_ms":
        at[name] = now
    elif signal.stamp and pauses[name]:
        pauses[name] -= 1
    elif signal.stamp:
        at[name] = now
        if random.random() < restless / 4:
            pauses[name] = random.choice(PAUSES)
    elif random.random() < (restless / 8 if name in SELDOM else restless):
        at[name] = value(signal, random)


@cache
def long_log(board: str) -> tuple[Row, ...]:
    """A log of 2,000 steps; tests copy what they change."""
    return tuple(record(boards()[board], 2000))


def copied(rows: Iterable[Row]) -> list[Row]:
    return [dict(row) for row in rows]


def text(rows: Sequence[Row], without: Iterable[str] = (), separator: str = ",") -> str:
    """The rows as CSV; what a row does not have is an empty cell."""
    left_out = set(without)
    names = [n for n in dict.fromkeys(n for row in rows for n in row) if n not in left_out]
    lines = StringIO()
    writer = csv.writer(lines, delimiter=separator, lineterminator="\n")
    writer.writerow(names)
    writer.writerows([_cell(row.get(name)) for name in names] for row in rows)
    return lines.getvalue()


def _cell(value: bool | int | float | None) -> str:
    return "" if value is None else str(int(value)) if isinstance(value, bool | int) else repr(value)


def written(folder: Path, rows: Sequence[Row], without: Iterable[str] = (), name: str = "log.csv") -> Path:
    """The rows as a CSV file."""
    file = folder / name
    file.write_text(text(rows, without), encoding="utf-8")
    return file


def late(rows: list[Row], output: str) -> None:
    """The output of every step one step later."""
    for row, before in zip(rows[:0:-1], rows[-2::-1], strict=True):
        row[output] = before[output]


def swapped(rows: list[Row], one: str, other: str) -> None:
    for row in rows:
        row[one], row[other] = row[other], row[one]


def frozen(rows: list[Row], outputs: Iterable[str], start: int, end: int) -> None:
    """The outputs of one step in all of start..end."""
    for name in outputs:
        for row in rows[start + 1 : end]:
            row[name] = rows[start][name]
