"""Logs of a twin: of scenarios, of long covering tests and of random inputs; most are damaged, by seed."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from random import Random

from benchmarks.measure import ROOT
from benchmarks.twins.exposed import outputs
from benchmarks.twins.firmware import Firmware
from rovercheck.checker.adapters.implementation import Implementation, Value
from rovercheck.checker.testgen import kept as covering_tests
from rovercheck.spec_model.abstraction import Board
from rovercheck.supervisor.bench.columns import inputs1, inputs2
from rovercheck.supervisor.bench.scenario import loads
from rovercheck.supervisor.bench.simulation import simulate
from tests.logs.recorded import Row, record, text

STEPS, COVERING = 1500, 8
DAMAGES = (
    "whole",
    "cut",
    "columns lost",
    "cells out of range",
    "rows missing",
    "all of it",
    "last line torn",
)
CELLS = (1e12, -1e12, float("nan"))
"""What stands in a damaged cell of an input: no input of a board may have one of these values."""


@dataclass(frozen=True)
class TwinLog:
    """A log: its inputs from power-up, and what was done to it."""

    name: str
    inputs: tuple[Mapping[str, Value], ...]
    damage: str
    seed: int


@cache
def driven(board: str) -> tuple[tuple[Mapping[str, Value], ...], ...]:
    """What the board reads in each scenario of ``examples/scenarios``, then in the longest covering tests."""
    found = []
    for file in sorted((ROOT / "examples" / "scenarios").glob("*.toml")):
        run = simulate(loads(file.read_text(encoding="utf-8")))
        steps = (
            [inputs1(step.inputs) for step in run.board1]
            if board == "board1"
            else [inputs2(step.inputs) for step in run.board2]
        )
        found.append(tuple(steps[:STEPS]))
    longest = sorted(covering_tests(board), key=lambda test: -len(test.steps))
    return (*found, *(tuple(dict(given) for given in test.steps) for test in longest[:COVERING]))


def drawn(board: Board, seed: int) -> tuple[Mapping[str, Value], ...]:
    """Inputs held for a while, as many changes as the seed says."""
    rows = record(board, STEPS, seed, (0.01, 0.03, 0.1)[seed % 3])
    names = [s.name for s in board.inputs]
    return tuple({name: row[name] for name in names} for row in rows)


def logs(firmware: Firmware, number: int) -> Iterator[TwinLog]:
    """So many logs, the same each time: every other one of a scenario or a covering test while there are."""
    board, drives = firmware.board, driven(firmware.board_name)
    for n in range(number):
        inputs = drives[n // 2 % len(drives)] if n % 2 and n // 2 < len(drives) else drawn(board, n)
        yield TwinLog(f"{firmware.name}_{n:03}.csv", inputs, DAMAGES[n % len(DAMAGES)], n)


def rows(twin: Implementation, log: TwinLog) -> list[Row]:
    """The rows of a log before anything is done to it."""
    found = outputs(twin, log.inputs)
    return [{**given, **got} for given, got in zip(log.inputs, found, strict=True)]


@dataclass(frozen=True)
class KeptRows:
    """What is left of a log: the rows of so many steps, and the columns that it has."""

    steps: tuple[int, ...]
    without: frozenset[str]


def kept(log: TwinLog, board: Board) -> KeptRows:
    """Which rows and columns a log keeps."""
    random = Random(log.seed)
    steps = list(range(len(log.inputs)))
    without: set[str] = set()
    if log.damage in ("cut", "all of it"):
        first, last = sorted(random.sample(range(len(steps)), 2))
        steps = steps[max(0, min(first, len(steps) - 200)) : max(last, first + 200)]
    if log.damage in ("rows missing", "all of it"):
        lost = {random.choice(steps) + k for _ in range(5) for k in range(random.choice((1, 1, 2, 7, 40)))}
        steps = [s for s in steps if s not in lost]
    if log.damage in ("columns lost", "all of it"):
        names = [s.name for s in board.inputs if s.name != "now_ms"] + [o.name for o in board.outputs]
        without = set(random.sample(names, random.randint(1, 6)))
    return KeptRows(tuple(steps), frozenset(without))


def written(twin: Implementation, log: TwinLog, board: Board, folder: Path) -> Path:
    """Writes a log as the project writes logs, with what was done to it."""
    left, every = kept(log, board), rows(twin, log)
    found: Sequence[Row] = [dict(every[s]) for s in left.steps]
    if log.damage in ("cells out of range", "all of it"):
        _spoil(found, board, Random(log.seed + 1))
    file = folder / log.name
    whole = text(found, left.without)
    file.write_text(_torn(whole) if log.damage == "last line torn" else whole, encoding="utf-8")
    return file


def _spoil(found: Sequence[Row], board: Board, random: Random) -> None:
    """Cells that stand for no value: of inputs and outputs, never of the time."""
    inputs = {s.name for s in board.inputs if s.name != "now_ms"}
    names = sorted(inputs | {o.name for o in board.outputs})
    for _ in range(random.randint(3, 12)):
        first, name = random.randrange(len(found)), random.choice(names)
        cell = random.choice(CELLS) if name in inputs else float("nan")
        for row in found[first : first + random.choice((1, 1, 3, 20))]:
            row[name] = cell


def _torn(whole: str) -> str:
    """The log up to some cell of its last line, as where the power is lost."""
    lines = whole.splitlines(keepends=True)
    return "".join(lines[:-1]) + lines[-1].rpartition(",")[0]
