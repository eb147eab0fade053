"""What a long command is doing: one line on a terminal, a line every ten seconds in a log."""

from time import monotonic
from types import TracebackType

from rich.console import Console
from rich.status import Status

from checker.commands.silence import silent

PAUSE = 10.0
"""Seconds between two lines in a log."""
NARROW = 20
"""Columns that the line takes at least, however narrow the terminal says it is."""


class Watch:
    """Shows what each search under way is doing, unless ``quiet``; ``with`` it around the work."""

    def __init__(self, console: Console, total: int, quiet: bool = False) -> None:
        self._console = console
        self._quiet = quiet or silent()
        self._total = total
        self._done = 0
        self._doing: dict[str, str] = {}
        self._last = monotonic()
        self._status: Status | None = (
            Status("starting", console=console) if console.is_terminal and not self._quiet else None
        )

    def __enter__(self) -> "Watch":
        if self._status:
            self._status.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self._status:
            self._status.stop()

    def say(self, task: str, line: str) -> None:
        """A sign of life from a task."""
        self._doing[task] = line
        self._show()

    def finished(self, task: str) -> None:
        """A task is over."""
        self._doing.pop(task, None)
        self._done += 1
        self._show()

    def _show(self) -> None:
        if self._status:
            self._status.update(self.line(max(NARROW, self._console.width - 4)))
        elif not self._quiet and monotonic() - self._last >= PAUSE:
            self._last = monotonic()
            self._console.print(self.line(), markup=False)

    def line(self, width: int | None = None) -> str:
        """How many searches are done, and what the others do, each with its share of the width."""
        head = f"{self._done}/{self._total} searches done"
        if width is None:
            return " | ".join([head, *(f"{task}: {doing}" for task, doing in self._doing.items())])
        room = (width - len(head)) // max(1, len(self._doing)) - len(" | ")
        parts = (f"{task}: {doing}"[: max(0, room)] for task, doing in self._doing.items())
        return " | ".join([head, *parts])[:width]
