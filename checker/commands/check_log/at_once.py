"""The logs of a folder examined by several processes at once, here or on the workers of a cluster.

What each says is as by itself.
"""

from collections.abc import Generator, Iterator, Sequence
from contextlib import closing
from dataclasses import dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory

from rovercheck.checker.commands.check_log import LogOptions
from rovercheck.checker.commands.check_log.request import LogRequest, request_of
from rovercheck.checker.commands.check_log.text import LogFault, Outcome
from rovercheck.checker.commands.shared.options import VariantOptions
from rovercheck.checker.io.packed_files import PackedFiles
from rovercheck.checker.logs import LogError
from rovercheck.checker.process.isolate import Send
from rovercheck.checker.process.pool import Cluster, Jobs, Order, Pool

TOGETHER = 8
"""Logs that one job of a cluster examines: each job reads the charts anew."""
ROUND = 256 << 20
"""Bytes of logs that are sent at a time."""
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


@dataclass(frozen=True)
class SentLogExaminer:
    """Examines logs that come as bytes, on another machine, in a folder that is gone with the process."""

    asked: LogRequest
    folder: "TemporaryDirectory[str]"

    @staticmethod
    def made(
        files: PackedFiles, charts: VariantOptions, options: LogOptions, used: bool
    ) -> "SentLogExaminer":
        """In the child: the model, the map and the variant are those that were sent."""
        folder = TemporaryDirectory(prefix="rovercheck-")
        files.unpacked(Path(folder.name))

        def there(path: Path | None) -> Path | None:
            return None if path is None else files.place(path, Path(folder.name))

        charts = replace(charts, model=there(charts.model), changes=there(charts.changes))
        options = replace(options, map_file=there(options.map_file))
        return SentLogExaminer(request_of(charts.variant(), options, used), folder)

    def __call__(self, send: Send, name: str, data: bytes) -> None:
        """Send what a log says, or why it says nothing."""
        path = Path(self.folder.name) / "log" / name
        path.parent.mkdir(exist_ok=True)
        path.write_bytes(data)
        send(self.asked.outcome(path))
        path.unlink()


def worth_it(logs: Sequence[Path], jobs: Jobs) -> bool:
    """Whether several processes are done sooner than one."""
    if isinstance(jobs, Cluster):
        return True
    try:
        return jobs > 1 and len(logs) > 1 and sum(log.stat().st_size for log in logs) > SMALL
    except OSError:  # which is said of that log
        return False


def at_once(
    logs: Sequence[Path], charts: VariantOptions, options: LogOptions, used: bool, jobs: Jobs
) -> Generator[tuple[Path, Outcome], None, None]:
    """What each log says, as it is known.  Closing the iterator ends all processes.

    A log over which a process dies is a fault of its own; the others are examined.  To a cluster they are
    sent, and what cannot be read is said here.  Raises ``ClusterError``.
    """
    if isinstance(jobs, Cluster):
        wanted = [path for path in (charts.model, charts.changes, options.map_file) if path is not None]
        bare = replace(options, scheduler=None, known=None, write_known=None)
        pool = Pool(jobs, SentLogExaminer.made, (PackedFiles.of(wanted), charts, bare, used))
        for some in _rounds(logs):
            yield from _sent(pool, some)
    else:
        pool = Pool(jobs, LogExaminer.made, (charts, options, used))
        yield from _heard(pool, logs, [Order((log,)) for log in logs])


def _rounds(logs: Sequence[Path]) -> Iterator[list[Path]]:
    """The logs in order, so many at a time as may be held in memory."""
    some, size = list[Path](), 0
    for log in logs:
        bytes_ = log.stat().st_size if log.exists() else 0
        if some and size + bytes_ > ROUND:
            yield some
            some, size = [], 0
        some.append(log)
        size += bytes_
    if some:
        yield some


def _sent(pool: Pool, logs: Sequence[Path]) -> Iterator[tuple[Path, Outcome]]:
    found: dict[Path, bytes] = {}
    for log in logs:
        try:
            found[log] = log.read_bytes()
        except OSError as error:
            yield log, LogError(f"cannot be read: {error.strerror}.")
    orders = [Order((log.name, data), kind=n // TOGETHER) for n, (log, data) in enumerate(found.items())]
    yield from _heard(pool, [*found], orders)


def _heard(pool: Pool, logs: Sequence[Path], orders: Sequence[Order]) -> Iterator[tuple[Path, Outcome]]:
    told = set[int]()
    with closing(pool.run(orders)) as events:
        for event in events:
            if event.message is not None:
                told.add(event.number)
                yield logs[event.number], event.message
            elif event.failure is not None and event.number not in told:
                yield logs[event.number], LogFault(event.failure.replace("the solver process", "its process"))
