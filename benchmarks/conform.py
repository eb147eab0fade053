"""How quickly logs are checked: monitors in ticks per second, and inference on logs of 2,000 ticks.

    python -m benchmarks.conform [repetitions]

Seconds are of the processor, medians; "x real time" is how much longer the recorded run took.
"""

import sys
from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory
from time import process_time

from rovercheck.checker.conformance.cones import cones
from rovercheck.checker.conformance.decoder import InputDecoder
from rovercheck.checker.conformance.follower import BoardFollower
from rovercheck.checker.conformance.recording import LogBlock
from rovercheck.checker.conformance.signals import Vocabulary
from rovercheck.checker.logs.log import LogLayout, open_log
from rovercheck.checker.logs.mapping import ColumnMap
from rovercheck.checker.logs.monitors import LogMonitors
from rovercheck.checker.logs.selection import choose
from rovercheck.properties.catalogue import catalogue
from rovercheck.spec_model.abstraction import boards
from rovercheck.spec_model.lang.system import TICK_MS
from rovercheck.spec_model.rover import systems
from tests.logs.recorded import long_log, record, written

LONG = 20_000
"""Ticks of the log for the monitors."""

NOT_LOGGED: dict[str, tuple[tuple[str, ...], ...]] = {
    "board1": (
        (),
        ("btn1", "btn2"),
        ("hasNoFeedback_FL", "hasNoFeedback_FR", "crit_mask_b2"),
        ("last_valid_b2_ms", "b2_data_last_valid_ms", "temp_last_valid_ms"),
        ("x_norm", "y_norm", "current_yaw"),
        ("rx_status", "critical_mask", "current_action"),
    ),
    "board2": (
        (),
        ("btn1", "btn2"),
        ("crit_mask_b1", "ble_last_valid_ms"),
        ("d1", "d2", "d3"),
        ("esp_status", "rover_safety_state", "DEG_B1"),
    ),
}
"""Columns left out; the last case of each board is that of no input at all."""


def read(file: Path) -> tuple[list[LogBlock], LogLayout]:
    log = open_log(file, ColumnMap())
    return list(log.blocks()), log.layout


def known_of(vocabulary: Vocabulary, eyes: InputDecoder, layout: LogLayout) -> frozenset[str]:
    return eyes.seen | {o.var.name for o in vocabulary.board.outputs if o.name in layout.signals}


def monitors(board: str, file: Path) -> tuple[float, float, float, int]:
    """Seconds to read the log, to see it as the charts do, of all monitors; number of monitors."""
    vocabulary = Vocabulary(boards()[board])
    start = process_time()
    blocks, layout = read(file)
    reading = process_time() - start
    eyes = InputDecoder(vocabulary, layout.signals, True)
    known = known_of(vocabulary, eyes, layout)
    choice = choose(vocabulary, known, catalogue().values(), systems().__getitem__)
    made = LogMonitors(vocabulary, choice, known, True)
    start = process_time()
    columns = [made.columns(block, eyes.decode(block)) for block in blocks]
    seeing = process_time() - start
    start = process_time()
    for block, values in zip(blocks, columns, strict=True):
        made.block(block, values)
    return reading, seeing, process_time() - start, len(choice.monitored)


def inference(board: str, file: Path) -> tuple[float, str]:
    """Seconds to follow the charts, from taking them apart on, and what was found."""
    vocabulary = Vocabulary(boards()[board])
    blocks, layout = read(file)
    eyes = InputDecoder(vocabulary, layout.signals, True)
    start = process_time()
    parts = cones(vocabulary.board, eyes.seen, layout.signals - vocabulary.inputs)
    follow = BoardFollower([replace(part) for part in parts], {}, eyes.seen, True)
    for block in blocks:
        follow.block(block, eyes.decode(block))
    found = follow.end()
    seconds = process_time() - start
    return seconds, f"{len(found.deviations)} deviations, {len(found.undecided)} parts undecided"


def cases(board: str) -> Iterable[tuple[str, ...]]:
    yield from NOT_LOGGED[board]
    yield tuple(s.name for s in boards()[board].inputs if s.name != "now_ms")


def main(repetitions: int) -> None:
    with TemporaryDirectory() as folder:
        for board in boards():
            _monitors(board, Path(folder), repetitions)
        for board in boards():
            _inference(board, Path(folder), repetitions)


def _monitors(board: str, folder: Path, repetitions: int) -> None:
    file = written(folder, record(boards()[board], LONG))
    found = [monitors(board, file) for _ in range(repetitions)]
    reading, seeing, judging, number = (median(column) for column in zip(*found, strict=True))
    print(
        f"{board}: {number:.0f} monitors together: {LONG / judging:,.0f} ticks/s, with what the charts see "
        f"of the log {LONG / (seeing + judging):,.0f}; reading the CSV {LONG / reading:,.0f} rows/s, "
        f"from the file to the verdicts {LONG / (reading + seeing + judging):,.0f} rows/s"
    )


def _inference(board: str, folder: Path, repetitions: int) -> None:
    rows = list(long_log(board))
    for missing in cases(board):
        file = written(folder, rows, missing)
        found = [inference(board, file) for _ in range(repetitions)]
        seconds = median(seconds for seconds, _ in found)
        times = len(rows) * TICK_MS / 1000 / seconds
        shown = ", ".join(missing) if len(missing) < 5 else "every input"
        print(
            f"{board}: {seconds:5.2f} s = {times:4.0f} x real time; {found[0][1]}; not logged: {shown or '-'}"
        )


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 3)
