"""Logs as recorded runs: opened anew each time that their rows are asked for."""

from collections.abc import Iterator
from contextlib import closing, suppress
from dataclasses import dataclass
from pathlib import Path

from rovercheck.checker.conformance.recording import LogBlock
from rovercheck.checker.diagnosis.evidence import Recording
from rovercheck.checker.logs.errors import LogError
from rovercheck.checker.logs.log import open_log
from rovercheck.checker.logs.mapping import ColumnMap


@dataclass(frozen=True)
class LoggedRun:
    """A log as a recorded run of a board."""

    board: str
    run: Recording


def logged_run(path: Path, how: ColumnMap, system: str = "") -> LoggedRun:
    """A log as a recorded run, as far as it can be read.

    Raises ``LogError`` for a file that is no log at all; so does reading its blocks.
    """

    def blocks() -> Iterator[LogBlock]:
        with closing(open_log(path, how, system).blocks()) as found:
            first = next(found)
            yield first
            with suppress(LogError):  # what comes before what cannot be read tells enough
                yield from found

    log = open_log(path, how, system)
    with closing(log.blocks()) as found:
        next(found)
    layout = log.layout
    tolerance = {c.signal: c.tolerance for c in layout.stated.values() if c.tolerance is not None}
    run = Recording(path.name, layout.signals, log.start == "power-up", blocks, tolerance)
    return LoggedRun(layout.board, run)


__all__ = ["LoggedRun", "logged_run"]
