"""A trace as a table for the terminal: what changed, what fired, which part of the property is false."""

from collections.abc import Iterator
from io import StringIO

from rich.text import Text

from rovercheck.checker.io.console import UnmarkedConsole
from rovercheck.checker.render.hanging_indent import hanging
from rovercheck.checker.render.periods import folded
from rovercheck.checker.render.reasons import cause, meaning, reasons
from rovercheck.checker.render.story import (
    OMITTED,
    Conjunct,
    Repeats,
    StoryChange,
    StoryEvent,
    conjuncts,
    ending,
    heading,
    standstill,
    start_of,
    start_values,
)
from rovercheck.checker.results.format import Format, Option
from rovercheck.checker.results.trace import TakenTransition, Trace

FORMAT = Format(
    "table",
    "trace",
    ".txt",
    "table for the terminal: per tick only what changed and what fired",
    takes=frozenset({Option.WIDTH}),
)


INPUT, NEEDED = "in  ", "in* "
"""The marks of inputs, and of those that the end of the run needs."""
_STYLES = {False: "bold red", True: "dim"}


def render(trace: Trace, width: int = 80, color: bool = False) -> str:
    """The table as text of ``width`` columns, with ANSI colours if asked for."""
    out = StringIO()
    console = UnmarkedConsole(
        file=out, width=width, force_terminal=color, color_system="standard" if color else None,
        legacy_windows=False, _environ={},
    )  # fmt: skip
    for lead, shown in _parts(trace):
        for line in hanging(console, lead, shown):
            console.print(line, no_wrap=True, overflow="ignore", crop=False)
    return "\n".join(line.rstrip() for line in out.getvalue().splitlines()) + "\n"


Part = tuple[Text, Text]
"""A text, and what stands before its first line."""


def _parts(trace: Trace) -> Iterator[Part]:
    none = Text()
    if trace.property.because:
        yield none, Text(f"Why: {trace.property.because}")
    yield none, Text(heading(trace), style="bold")
    if chosen := start_values(trace):
        yield none, Text("fixed: " + ", ".join(f"{n} = {v}" for n, v in chosen))
    yield from _table(trace)
    if last := ending(trace):
        yield none, Text(last, style="bold")
    yield none, Text(OMITTED, style="dim")
    for part in conjuncts(trace):
        yield none, Text(f"{part.verdict}: {part.name or part.formula}", style=_STYLES[part.true])
        if not part.true:
            yield from ((Text("    "), Text(line)) for line in _explained(part))
    if said := meaning(trace):
        yield none, Text(cause(trace), style="bold")
        if trace.needed():
            yield from _reasons(trace)
        yield none, Text(said)


def _table(trace: Trace) -> Iterator[Part]:
    rows: list[tuple[str, str, list[Part]]] = [("tick", "ms", [_marked("what happened", "", "bold")])]
    for row in folded(trace):
        if isinstance(row, StoryEvent):
            rows.append((str(row.number), str(row.ms), list(_event(trace, row))))
        else:
            style = "bold" if isinstance(row, Repeats) else "dim"
            sign = "↻" if isinstance(row, Repeats) else "·"
            rows.append((sign, "", [_marked(row.what, style=style)]))
    wide, wider = (max(len(row[place]) for row in rows) for place in (0, 1))
    for tick, ms, lines in rows:
        before = Text(f"{tick:>{wide}}  {ms:>{wider}}  ", style="bold" if tick == "tick" else "")
        for mark, shown in lines:
            yield Text.assemble(before, mark), shown
            before = Text(" " * len(before))


def _event(trace: Trace, event: StoryEvent) -> Iterator[Part]:
    for needed in (True, False):
        given = [str(c) for c in event.changes if not c.old and c.needed is needed]
        if given:
            yield _marked(", ".join(given), NEEDED if needed else INPUT, "cyan")
    changed = [c for c in event.changes if c.old]
    yield from map(_changed, changed)
    yield from map(_fired, event.transitions)
    if not (event.changes or event.transitions):
        yield _marked(standstill(trace, event))


def _changed(change: StoryChange) -> Part:
    mark = (NEEDED if change.needed else INPUT) if change.is_input else "    "
    return _marked(str(change), mark, "cyan" if change.is_input else "")


def _fired(transition: TakenTransition) -> Part:
    label = f"  {transition.label}" if transition.label else ""
    return _marked(f"{transition.chart}: {start_of(transition)}{label}", "  ▸ ", "green")


def _marked(shown: str, mark: str = "    ", style: str = "") -> Part:
    return Text(mark, style=style), Text(shown, style=style)


def _reasons(trace: Trace) -> Iterator[Part]:
    found = list(reasons(trace, regular=True))
    wide, wider = max(len(one.when) for one in found), max(len(one.ms) for one in found)
    for one in found:
        yield Text(f"{NEEDED}{one.when:<{wide}}  {one.ms:>{wider}}  "), Text(one.what, style="cyan")


def _explained(part: Conjunct) -> list[str]:
    formula = [part.formula] if part.name else []
    values = [", ".join(f"{name} = {shown}" for name, shown in part.values)] if part.values else []
    return [*formula, *values]
