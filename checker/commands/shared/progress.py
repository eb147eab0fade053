"""What a long command is doing: one line on a terminal, a line every ten seconds in a log."""

from time import monotonic
from types import TracebackType
from typing import Self

from rich.console import Console, ConsoleOptions, RenderResult
from rich.live import Live
from rich.spinner import Spinner
from rich.text import Text

from rovercheck.checker.commands.shared.output import err, movable, out, share_a_terminal
from rovercheck.checker.commands.shared.silence import silent

PAUSE = 10.0
"""Seconds between two lines in a log."""
NARROW = 20
"""Columns that the line takes at least, however narrow the terminal says it is."""
SPARE = 6
"""Columns left free on the right, where a terminal shows ``^C``, and for the spinner on the left."""


class ProgressLine:
    """One line on what is under way, unless ``quiet``; ``with`` it around the work.

    On a terminal it stands below all that is printed meanwhile, results too where they go to the same
    terminal, and is gone at the end, however that comes.
    """

    def __init__(self, console: Console = err, quiet: bool = False) -> None:
        self._console = console
        self._quiet = quiet or silent()
        self._text = "starting"
        self._last = monotonic()
        self._spinner = Spinner("dots", Text(self._text), style="status.spinner")
        self._live: Live | None = None
        self._shared = False

    def __enter__(self) -> Self:
        if self._quiet or not movable(self._console):
            return self
        self._shared = self._console is err and share_a_terminal()
        self._live = Live(
            _OneLine(self._spinner),
            console=self._console,
            transient=True,
            refresh_per_second=10,
            redirect_stdout=self._shared,  # else what is printed into a file would go to the terminal
        )
        if self._shared:
            out.push_render_hook(self._live)
        try:
            self._live.start(refresh=True)
        except BaseException:  # Ctrl-C, too
            self._end()
            raise
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._end()

    def _end(self) -> None:
        try:
            if self._live is not None:
                self._live.stop()
        finally:
            self._live = None
            if self._shared:
                out.pop_render_hook()
                self._shared = False

    def show(self, text: str) -> None:
        """Say this from now on."""
        self._text = text
        self._shown()

    def line(self, width: int | None = None) -> str:
        """What is said, in so many columns."""
        return self._text

    def _shown(self) -> None:
        if self._live:
            self._spinner.update(text=Text(self.line(max(NARROW, self._console.width - SPARE))))
        elif not self._quiet and monotonic() - self._last >= PAUSE:
            self._last = monotonic()
            self._console.print(self.line(), markup=False)


class _OneLine:
    """A renderable that never takes more than one line, also where the terminal was made narrower."""

    def __init__(self, spinner: Spinner) -> None:
        self._spinner = spinner

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        width = max(1, options.max_width - SPARE + 2)
        cut = options.update(width=width, no_wrap=True, overflow="ellipsis")
        yield from console.render(self._spinner, cut)


class Watch(ProgressLine):
    """Shows how many searches of a ``total`` are done, and what each search under way is doing."""

    def __init__(self, console: Console, total: int = 0, quiet: bool = False) -> None:
        super().__init__(console, quiet)
        self.total = total
        self._done = 0
        self._doing: dict[str, str] = {}

    def say(self, task: str, line: str) -> None:
        """A sign of life from a task."""
        self._doing[task] = line
        self._shown()

    def finished(self, task: str) -> None:
        """A task is over."""
        self._doing.pop(task, None)
        self._done += 1
        self._shown()

    def line(self, width: int | None = None) -> str:
        """How many searches are done, and what the others do, each with its share of the width."""
        head = f"{self._done}/{self.total} searches done"
        if width is None:
            return " | ".join([head, *(f"{task}: {doing}" for task, doing in self._doing.items())])
        room = (width - len(head)) // max(1, len(self._doing)) - len(" | ")
        parts = (f"{task}: {doing}"[: max(0, room)] for task, doing in self._doing.items())
        return " | ".join([head, *parts])[:width]
