"""The random runs of a comparison, tried by other processes here, or by the workers of a cluster."""

from collections.abc import Generator, Iterable, Iterator, Sequence
from contextlib import closing, contextmanager
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory

from rovercheck.checker.adapters import carried, moved, start
from rovercheck.checker.adapters.implementation import ImplementationError
from rovercheck.checker.commands.shared.codes import UsageError
from rovercheck.checker.commands.shared.options import VariantOptions
from rovercheck.checker.compare.beside import ComparedStep
from rovercheck.checker.compare.search import Elsewhere, Enough
from rovercheck.checker.compare.strategy import environment
from rovercheck.checker.compare.tried_runs import RunsLost, RunTrier, Share, TriedRun
from rovercheck.checker.compare.variants import board_named
from rovercheck.checker.io.packed_files import PackedFiles, TooLarge
from rovercheck.checker.process.cluster import ClusterError, connected
from rovercheck.checker.process.isolate import Send
from rovercheck.checker.process.pool import Cluster, Jobs, Order, Pool

MOST_BYTES = 64 << 20
"""Bytes of an implementation that are sent to each worker."""


@dataclass(frozen=True)
class RunsOf:
    """What a process needs to know: which charts, which implementation, how much of its runs is wanted."""

    charts: VariantOptions
    system: str | None
    address: str
    failures: int
    always: bool


@dataclass(frozen=True)
class ShareTrier:
    """Tries the runs of shares in a child process."""

    asked: RunsOf
    folder: "TemporaryDirectory[str] | None" = None
    files: PackedFiles | None = None

    @staticmethod
    def made(asked: RunsOf, files: PackedFiles | None) -> "ShareTrier":
        """In the child; ``files``: the implementation, the model and the variant, if they were sent."""
        if files is None:
            return ShareTrier(asked)
        folder = TemporaryDirectory(prefix="rovercheck-")
        files.unpacked(Path(folder.name))

        def there(path: Path) -> Path:
            return files.place(path, Path(folder.name))

        charts = asked.charts
        charts = replace(
            charts,
            model=None if charts.model is None else there(charts.model),
            changes=None if charts.changes is None else there(charts.changes),
        )
        return ShareTrier(replace(asked, charts=charts, address=moved(asked.address, there)), folder, files)

    def __call__(self, send: Send, share: Share) -> None:
        """Send what comes of each run, in order; no more once the implementation has failed too often."""
        board = board_named(self.asked.charts.variant(), self.asked.system)
        try:
            implementation = start(self.asked.address, board)
        except ImplementationError as error:
            raise ImplementationError(self._named_here(str(error))) from error
        trier, failures = RunTrier(board, implementation, self.asked.always), 0

        def one(steps: list[ComparedStep]) -> None:
            nonlocal failures
            run = trier.tried("", steps)
            send(self._as_here(run))
            failures += run.failed is not None
            if failures >= self.asked.failures:
                raise Enough

        try:
            share.each(environment(board), one)
        except Enough:
            pass
        finally:
            implementation.close()

    def _as_here(self, run: TriedRun) -> TriedRun:
        """A run that failed, with files named as where they were sent from."""
        if run.failed is None:
            return run
        return replace(run, failed=replace(run.failed, because=self._named_here(run.failed.because)))

    def _named_here(self, text: str) -> str:
        if self.files is None or self.folder is None:
            return text
        return self.files.named_here(text, Path(self.folder.name))


def elsewhere(asked: RunsOf, jobs: Jobs) -> Elsewhere:
    """What tries the random runs of shares.

    Raises ``UsageError`` for what cannot be sent, and ``ClusterError`` where there is nobody to send it to.
    """
    files = None
    if isinstance(jobs, Cluster):
        files = _files(asked)
        with connected(jobs):
            pass
    pool = Pool(jobs, ShareTrier.made, (asked, files))
    return partial(_tried, pool, asked.address)


def _tried(pool: Pool, address: str, some: Sequence[Share]) -> Generator[TriedRun, None, None]:
    """What comes of the runs of some shares, in their order.  Closing the iterator ends all processes.

    Raises ``RunsLost`` where nobody tries them, or the implementation cannot be started there.
    """
    waiting: dict[int, list[TriedRun]] = {}
    ended, now = set[int](), 0
    with _told_of(address), closing(pool.run([Order((share,)) for share in some])) as events:
        for event in events:
            if event.message is not None:
                waiting.setdefault(event.number, []).append(event.message)
            if event.failure is not None:
                raise RunsLost(event.failure)
            if event.done:
                ended.add(event.number)
            while now < len(some):
                yield from waiting.pop(now, ())
                if now not in ended:
                    break
                now += 1


@contextmanager
def _told_of(address: str) -> Iterator[None]:
    try:
        yield
    except (RunsLost, ClusterError) as error:
        raise RunsLost(f"{address} could not be tried elsewhere: {error}") from error


def _files(asked: RunsOf) -> PackedFiles:
    try:
        own = carried(asked.address)
    except ImplementationError as error:
        raise UsageError(f"--scheduler: {error}") from error
    charts: Iterable[Path | None] = (asked.charts.model, asked.charts.changes)
    try:
        return PackedFiles.of([path for path in charts if path is not None], own, MOST_BYTES)
    except OSError as error:
        raise UsageError(f"{error.filename}: {error.strerror}. It must be readable to be sent.") from error
    except TooLarge as error:
        raise UsageError(
            f"{asked.address}: with what lies beside it, it is {error.size >> 20} MiB, and "
            f"{MOST_BYTES >> 20} MiB are sent at most; give it a folder of its own."
        ) from error


__all__ = ["RunsOf", "ShareTrier", "elsewhere"]
