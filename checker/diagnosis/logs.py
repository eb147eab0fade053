"""Logs as recorded runs: opened anew each time that their rows are asked for."""

from collections.abc import Iterator, Mapping
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path

from rovercheck.checker.conformance.recording import LogBlock, Recording
from rovercheck.checker.logs.errors import LogError
from rovercheck.checker.logs.log import open_log
from rovercheck.checker.logs.mapping import ColumnMap
from rovercheck.spec_model.abstraction import Board


@dataclass(frozen=True)
class LoggedRun:
    """A log as a recorded run of a board.

    ``ended`` holds why the file could not be read to its end, if so, once its blocks were read.
    """

    board: str
    run: Recording
    ended: list[str]


def logged_run(
    path: Path, how: ColumnMap, system: str = "", boards: Mapping[str, Board] | None = None
) -> LoggedRun:
    """A log as a recorded run, as far as it can be read.

    Raises ``LogError`` for a file that is no log at all; so does reading its blocks.
    """

    ended: list[str] = []

    def blocks() -> Iterator[LogBlock]:
        with closing(open_log(path, how, system, boards).blocks()) as found:
            yield next(found)
            try:
                yield from found
            except LogError as error:
                ended[:] = [str(error)]

    log = open_log(path, how, system, boards)
    with closing(log.blocks()) as found:
        next(found)
    layout = log.layout
    tolerance = {c.signal: c.tolerance for c in layout.stated.values() if c.tolerance is not None}
    run = Recording(path.name, layout.signals, log.start == "power-up", blocks, tolerance)
    return LoggedRun(layout.board, run, ended)


__all__ = ["LoggedRun", "logged_run"]
