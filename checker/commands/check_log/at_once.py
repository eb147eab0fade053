"""The logs of a folder examined by several processes at once; what each says is as by itself."""

from collections.abc import Generator, Sequence
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path

from rovercheck.checker.commands.check_log import LogOptions
from rovercheck.checker.commands.check_log.request import LogRequest, request_of
from rovercheck.checker.commands.check_log.text import LogFault, Outcome
from rovercheck.checker.commands.shared.options import VariantOptions
from rovercheck.checker.process.isolate import Send
from rovercheck.checker.process.pool import Order, Pool

SMALL = 8 << 20
"""Bytes of all logs together up to which one process is done before others have begun."""


@dataclass(frozen=True)
class LogExaminer:
    """Examines logs in a child process, against the charts that the options mean."""

    asked: LogRequest

    @staticmethod
    def made(charts: VariantOptions, options: LogOptions, used: bool) -> "LogExaminer":
        """In the child; ``used``: whether known deviations are to be judged."""
        return LogExaminer(request_of(charts.variant(), options, used))

    def __call__(self, send: Send, path: Path) -> None:
        """Send what a log says, or why it says nothing."""
        send(self.asked.outcome(path))


def worth_it(logs: Sequence[Path], jobs: int) -> bool:
    """Whether several processes are done sooner than one."""
    try:
        return jobs > 1 and len(logs) > 1 and sum(log.stat().st_size for log in logs) > SMALL
    except OSError:  # which is said of that log
        return False


def at_once(
    logs: Sequence[Path], charts: VariantOptions, options: LogOptions, used: bool, jobs: int
) -> Generator[tuple[Path, Outcome], None, None]:
    """What each log says, as it is known.  Closing the iterator ends all processes.

    A log over which a process dies is a fault of its own; the others are examined.
    """
    pool = Pool(jobs, LogExaminer.made, (charts, options, used))
    told = set[int]()
    with closing(pool.run([Order((log,)) for log in logs])) as events:
        for event in events:
            if event.message is not None:
                told.add(event.number)
                yield logs[event.number], event.message
            elif event.failure is not None and event.number not in told:
                yield logs[event.number], LogFault(event.failure.replace("the solver process", "its process"))
