"""What ``rovercheck explore`` shows: a tick, and what changed since another."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from rich.console import Console
from rich.table import Table
from rich.text import Text

from rovercheck.checker.commands.shared.tables import laid
from rovercheck.checker.explore.by_hand.session import Session
from rovercheck.checker.explore.by_hand.simulation import HandSimulation
from rovercheck.checker.render.limits import timer
from rovercheck.checker.render.story import (
    TIMER,
    Quiet,
    StoryChange,
    StoryEvent,
    of_model,
    rows,
    start_of,
    value,
)
from rovercheck.checker.results.trace import TakenTransition, Trace
from rovercheck.checker.verify.runs.replay import transition_of
from rovercheck.spec_model.lang.chart import Chart, Path
from rovercheck.spec_model.lang.evaluate import evaluate

MOST = 24
"""Outputs up to which all are shown unasked."""
MOST_ROWS = 20
"""Events and quiet stretches of one command that are shown: the last ones."""
BAR = 20
"""Columns of the bar of a timer."""


def show(console: Console, session: Session, everything: bool = False) -> None:
    """The tick that is looked at: states, transitions, inputs, outputs, timers."""
    sim = session.simulation
    trace = sim.trace(max(sim.at, 1))
    grid = _grid()
    _row(grid, "charts", [where(chart, sim.state()) for chart in sim.system.charts], "bold")
    _row(grid, "fired", [_transition(a) for a in map(transition_of, sim.fired())], "green")
    _row(grid, "frozen", [listed(trace, sim.frozen)] if sim.frozen else [])
    _row(grid, "inputs", [_inputs(session, trace)], "cyan")
    _row(grid, "values", [_outputs(sim, trace, everything)])
    _row(grid, "timers", list(timers(trace, sim.state())), "yellow")
    _row(grid, "watch", list(_watched(session, trace)))
    laid(console, grid)


def _grid() -> Table:
    grid = Table.grid(padding=(0, 1))
    grid.add_column(no_wrap=True, style="dim", width=7)
    grid.add_column(ratio=1)
    return grid


def _row(grid: Table, title: str, lines: Sequence[str], style: str = "") -> None:
    for i, line in enumerate(filter(None, lines)):
        grid.add_row("" if i else title, Text(line, style=style))


def where(chart: Chart, at: Mapping[str, int]) -> str:
    """The states in which a chart is."""
    return f"{chart.name}: {', '.join('.'.join(p) for p in active(chart, at)) or 'not entered yet'}"


def active(chart: Chart, at: Mapping[str, int]) -> Iterator[Path]:
    """The innermost active states of a chart, in the order in which they execute."""
    states = [p for p in chart.states if p and evaluate(chart.active_path(p), at)]
    return (p for p in states if not any(q[: len(p)] == p and q != p for q in states))


def _transition(transition: TakenTransition) -> str:
    return (
        f"▸ {transition.chart}: {start_of(transition)}{f'  {transition.label}' if transition.label else ''}"
    )


def listed(trace: Trace, values: Mapping[str, int]) -> str:
    """Values by name, as a trace shows them."""
    return ", ".join(f"{n} = {value(trace, n, raw)}" for n, raw in values.items())


def _inputs(session: Session, trace: Trace) -> str:
    """The inputs of the tick, or those that stand for the first; free ones are marked."""
    sim = session.simulation
    given = sim.given() or session.standing
    shown = (
        f"{n} = {value(trace, n, raw)}{' (free)' if n in session.free else ''}" for n, raw in given.items()
    )
    return ", ".join(shown)


def _outputs(sim: HandSimulation, trace: Trace, everything: bool) -> str:
    """Data that charts and blocks write; of many only those that are not as at the start."""
    state, before = sim.state(), sim.before
    places = {v.name for c in sim.system.charts for v in (*c.locations, c.entered)}
    plain = {
        n: raw
        for n, raw in state.items()
        if n not in places and n not in sim.frozen and of_model(trace, n) and not TIMER.search(n)
    }
    if everything or len(plain) <= MOST:
        return listed(trace, plain)
    changed = {n: raw for n, raw in plain.items() if raw != before[n]}
    rest = f"{len(plain) - len(changed)} as at the start (show all)"
    return ", ".join(filter(None, [listed(trace, changed), rest]))


def timers(trace: Trace, at: Mapping[str, int], only: str = "") -> Iterator[str]:
    """Timers that run, with the limit they are compared with and how much of it is over."""
    for name, raw in at.items():
        known = timer(trace, name) if TIMER.search(name) and name.startswith(only) and raw else None
        if known is not None:
            done = min(BAR, BAR * raw // max(1, trace.system.variables[name].domain.high))
            yield f"{name} {known.shown(raw)} of {known.limit}  {'█' * done}{'░' * (BAR - done)}"


def _watched(session: Session, trace: Trace) -> Iterator[str]:
    at = {**session.standing, **session.simulation.state(), **session.simulation.given()}
    for name in session.watched:
        yield f"{name} = {value(trace, name, at[name])}"


def changes(console: Console, session: Session, first: int) -> None:
    """What happened from tick ``first`` to the one that is looked at, in the words of a trace."""
    trace = session.simulation.trace(first)
    grid = Table.grid(padding=(0, 1))
    grid.add_column(justify="right", no_wrap=True, width=5)
    grid.add_column(no_wrap=True, width=2)
    grid.add_column(ratio=1)
    found = list(rows(trace))
    if len(found) > MOST_ROWS:
        left = len(found) - MOST_ROWS
        console.print(
            f"{left} rows before these are not shown; goto TICK and save FILE show all.", style="dim"
        )
    for row in found[-MOST_ROWS:]:
        if isinstance(row, Quiet):
            row = replace(row, first=row.first + first - 1, last=row.last + first - 1)
            grid.add_row("·", "", Text(row.what, style="dim"))
        elif isinstance(row, StoryEvent):
            _event(grid, _unrepeated(row, session) if row.number == first else row)
    for line in _watched(session, trace):
        grid.add_row("", "=", Text(line, style="bold"))
    laid(console, grid)


def _unrepeated(event: StoryEvent, session: Session) -> StoryEvent:
    """The event without transitions that keep their state as in the tick before."""
    before = set(map(transition_of, session.simulation.fired(event.number - 1)))
    return replace(
        event, transitions=tuple(a for a in event.transitions if a.source != a.target or a not in before)
    )


def _event(grid: Table, event: StoryEvent) -> None:
    given = [c for c in event.changes if not c.old]
    lines = [("in", Text(", ".join(map(str, given)), style="cyan"))] if given else []
    lines += [_change(c) for c in event.changes if c.old]
    lines += [(" ▸", Text(_transition(a)[2:], style="green")) for a in event.transitions]
    for i, (mark, line) in enumerate(lines or [("", Text("nothing changes", style="dim"))]):
        grid.add_row("" if i else str(event.number), mark, line)


def _change(change: StoryChange) -> tuple[str, Text]:
    return ("in" if change.is_input else "", Text(str(change), style="cyan" if change.is_input else ""))
