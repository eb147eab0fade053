"""How quickly long logs are checked, and in how much memory: `check-log` as a process of its own on one core.

    python -m benchmarks.long_logs [rows...]

Each log is recorded once and checked twice: as it is, and with about one output in 20,000 rows changed.
"""

import csv
import os
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory
from time import process_time

from rovercheck.checker.conformance.cones import cones
from rovercheck.checker.conformance.decoder import InputDecoder
from rovercheck.checker.conformance.follower import BoardFollower
from rovercheck.checker.conformance.signals import Vocabulary
from rovercheck.checker.logs.log import open_log
from rovercheck.checker.logs.mapping import ColumnMap
from rovercheck.spec_model.abstraction import boards
from tests.logs.recorded import Row, record, recorded, written

ROWS = (100_000, 1_000_000)
SELDOM = 20_000
COMPARED = 20_000
"""Rows on which what is taken together is set beside what is taken row by row."""


def main(numbers: tuple[int, ...]) -> None:
    with TemporaryDirectory() as folder:
        for board in boards():
            print(f"{board}: {ratio(board, Path(folder)):.1f} times as many rows/s together as one by one")
            for rows in numbers:
                for differ in (False, True):
                    file = Path(folder) / "long.csv"
                    write_log(file, board, rows, differ)
                    used = checked(file)
                    kind = "with differences" if differ else "clean"
                    print(
                        f"{board}: {rows:9,} rows, {kind}: {used.seconds:6.1f} s of the processor, "
                        f"{rows / used.seconds:7,.0f} rows/s, {used.bytes / 1e6:.0f} MB at most",
                        flush=True,
                    )


def write_log(file: Path, board: str, rows: int, differ: bool) -> None:
    """A recording of so many rows, in which an output differs now and then, or none does."""
    with file.open("w", encoding="utf-8", newline="") as out:
        writer: csv.DictWriter[str] | None = None
        for row in _rows(board, rows, differ):
            if writer is None:
                every = dict.fromkeys([*row, *(one.name for one in boards()[board].outputs)])
                writer = csv.DictWriter(out, list(every), lineterminator="\n")  # not each is in each step
                writer.writeheader()
            writer.writerow({n: int(v) if isinstance(v, bool) else v for n, v in row.items()})


def _rows(board: str, rows: int, differ: bool) -> Iterator[Row]:
    random, outputs = Random(7), boards()[board].outputs
    for row in recorded(boards()[board], rows):
        output = random.choice(outputs)
        if differ and random.random() < 1 / SELDOM and output.name in row:
            row[output.name] = 0 if row[output.name] else 1
        yield row


@dataclass(frozen=True)
class LogUse:
    """Seconds of the processor and most bytes of one check."""

    seconds: float
    bytes: int


def checked(file: Path) -> LogUse:
    """What `check-log` takes, on one core."""
    core = min(os.sched_getaffinity(0))
    command = ["taskset", "-c", str(core), sys.executable, "-m", "rovercheck", "check-log", str(file)]
    with subprocess.Popen(command, stdout=subprocess.DEVNULL) as child:
        _, _, used = os.wait4(child.pid, 0)
        child.returncode = 0
    return LogUse(used.ru_utime + used.ru_stime, used.ru_maxrss * 1024)


def ratio(board: str, folder: Path) -> float:
    """How many times as long the charts take row by row, in the same process."""
    file = written(folder, record(boards()[board], COMPARED))
    _follow(board, file, plainly=False)
    return _follow(board, file, plainly=True) / _follow(board, file, plainly=False)


def _follow(board: str, file: Path, plainly: bool) -> float:
    log, vocabulary = open_log(file, ColumnMap()), Vocabulary(boards()[board])
    decoder = InputDecoder(vocabulary, log.layout.signals, True)
    parts = cones(vocabulary.board, decoder.seen, log.layout.signals - vocabulary.inputs)
    watch = (lambda *_: None) if plainly else None
    follower = BoardFollower([replace(part) for part in parts], {}, decoder.seen, True, watch)
    seconds = 0.0
    for block in log.blocks():
        seen = decoder.decode(block)
        start = process_time()
        follower.block(block, seen)
        seconds += process_time() - start
    return seconds


if __name__ == "__main__":
    main(tuple(map(int, sys.argv[1:])) or ROWS)
