"""What a long command is doing: one line on a terminal, a line every ten seconds in a log."""

from threading import Event, Lock
from time import monotonic
from types import TracebackType

from rich.console import Console
from rich.status import Status


class Stopped(Exception):
    """The user interrupted; work still under way stops at its next sign of life."""


class Watch:
    """Collects the progress of several tasks and shows it; ``with`` it around the work."""

    def __init__(self, console: Console, total: int) -> None:
        self._console = console
        self._total = total
        self._done = 0
        self._lines: dict[str, str] = {}
        self._lock = Lock()
        self._stop = Event()
        self._last = monotonic()
        self._status: Status | None = Status("starting", console=console) if console.is_terminal else None

    def __enter__(self) -> "Watch":
        if self._status:
            self._status.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._stop.set()
        if self._status:
            self._status.stop()

    def say(self, task: str, line: str) -> None:
        """A sign of life from a task.  Raises ``Stopped`` once the user has interrupted."""
        if self._stop.is_set():
            raise Stopped
        with self._lock:
            self._lines[task] = line
            self._show()

    def finished(self, task: str) -> None:
        with self._lock:
            self._lines.pop(task, None)
            self._done += 1
            self._show()

    def _show(self) -> None:
        line = f"{self._done}/{self._total} searches done"
        if self._lines:
            task, doing = next(iter(self._lines.items()))
            line += f" | {task}: {doing}"
        if self._status:
            self._status.update(line[: max(20, self._console.width - 4)])
        elif monotonic() - self._last >= 10:
            self._last = monotonic()
            self._console.print(line)
