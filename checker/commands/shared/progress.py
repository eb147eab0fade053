"""What a long command is doing: one line on a terminal, a line every ten seconds in a log."""

import re
from collections.abc import Mapping, Sequence
from time import monotonic
from types import TracebackType
from typing import Self

from rich.console import Console, ConsoleOptions, RenderResult
from rich.live import Live
from rich.spinner import Spinner
from rich.text import Text

from rovercheck.checker.commands.shared.output import err, movable, out, share_a_terminal
from rovercheck.checker.commands.shared.silence import silent, talkative
from rovercheck.checker.store.times import seconds_left

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


def lasting(seconds: float) -> str:
    """``12 s``, ``1 min 20 s``, ``2 h 5 min``.

    >>> lasting(80.4), lasting(7500)
    ('1 min 20 s', '2 h 5 min')
    """
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    if hours:
        return f"{hours} h {minutes} min"
    return f"{minutes} min {rest} s" if minutes else f"{rest} s"


class Watch(ProgressLine):
    """Shows how many of a ``total`` are done, for how long that has taken, and what is under way.

    ``of`` is what is counted, where that is more than one thing.
    """

    def __init__(self, console: Console, total: int = 0, quiet: bool = False, of: str = "") -> None:
        super().__init__(console, quiet)
        self.total = total
        self._of = of
        self._done = 0
        self._began = monotonic()
        self._doing: dict[str, str] = {}

    def say(self, task: str, line: str) -> None:
        """A sign of life from a task."""
        self._doing[task] = line
        self._shown()

    def finished(self, task: str) -> None:
        """A task is over."""
        self.over(task)
        self.counted()

    def over(self, task: str) -> None:
        """Nothing is under way any more for a task."""
        self._doing.pop(task, None)
        self._shown()

    def counted(self) -> None:
        """One more of the total is done."""
        self._done += 1
        self._shown()

    def left(self) -> float | None:
        """The seconds that it will still take, where that can be told."""
        return None

    def line(self, width: int | None = None) -> str:
        """How many are done, and what is done for the others, each with its share of the width."""
        head = self._head()
        if width is None:
            return " | ".join([head, *(f"{task}: {doing}" for task, doing in self._doing.items())])
        room = (width - len(head)) // max(1, len(self._doing)) - len(" | ")
        parts = (f"{task}: {doing}"[: max(0, room)] for task, doing in self._doing.items() if room > 0)
        return " | ".join([head, *parts])[:width]

    def _head(self) -> str:
        """``128 of 695 properties, 1 min 20 s so far, about 3 min left``."""
        counts = f"{self._done} of {self.total:,}{' ' * bool(self._of)}{self._of}, " if self.total > 1 else ""
        left = self.left()
        still = f", about {lasting(left)} left" if left is not None and left >= 1 else ""
        return f"{counts}{lasting(monotonic() - self._began)} so far{still}"


class SearchWatch(Watch):
    """Shows how many properties are decided, and how long the others will take if that is known.

    ``plan`` has the titles of the searches there are, ``known`` the seconds that they took before.
    """

    def __init__(self, console: Console, total: int, quiet: bool, known: Mapping[str, float], jobs: int):
        super().__init__(console, total, quiet, "properties")
        self.took: dict[str, float] = {}
        self._known, self._jobs = known, jobs
        self._left: set[str] = set()
        self._starts: dict[str, float] = {}

    def plan(self, titles: Sequence[str]) -> None:
        """These searches are to be made."""
        self._left = set(titles)

    def say(self, task: str, line: str) -> None:
        self._starts.setdefault(task, monotonic())
        super().say(task, line if talkative() else in_plain_words(line))

    def over(self, task: str) -> None:
        if task in self._starts:
            self.took[task] = monotonic() - self._starts.pop(task)
        self._left.discard(task)
        super().over(task)

    def left(self) -> float | None:
        now = monotonic()
        spent = {
            task: self._known[task] - (now - at) for task, at in self._starts.items() if task in self._known
        }
        known = {**self._known, **{task: max(0.0, seconds) for task, seconds in spent.items()}}
        return seconds_left(self._left, known, self._jobs)


def in_plain_words(line: str) -> str:
    """What an engine says, in the words of who waits for it.

    >>> in_plain_words("bmc: depth 24, 4 goals open"), in_plain_words("lowering relay")
    ('searching, 24 ticks deep', 'preparing')
    """
    if "certifying" in line:
        return "checking a proof again"
    if "compiling" in line:
        return "compiling"
    if line.startswith(("lowering", "slicing")) or line.startswith("reading"):
        return "preparing"
    depth = re.search(r"depth (\d+(?:,\d{3})*)", line)
    return f"searching, {depth[1]} ticks deep" if depth and depth[1] != "0" else "searching"
