"""The commands of ``rovercheck explore`` that look at a tick."""

from collections.abc import Mapping, Sequence

from rich.console import Console
from rich.table import Table
from rich.text import Text

from rovercheck.checker.commands.explore.explorer import Commands, Explorer
from rovercheck.checker.commands.explore.text import listed, show, timers, where
from rovercheck.checker.commands.explore.words import split
from rovercheck.checker.commands.shared.tables import beside, laid
from rovercheck.checker.explore.by_hand.session import Session
from rovercheck.checker.explore.by_hand.simulation import TestedTransition
from rovercheck.checker.explore.by_hand.value_syntax import RefusedInput, variable
from rovercheck.checker.results.trace import Trace
from rovercheck.spec_model.lang.chart import Chart, Transition
from rovercheck.spec_model.lang.errors import did_you_mean
from rovercheck.spec_model.lang.expr import Temporal
from rovercheck.spec_model.lang.label import text
from rovercheck.spec_model.lang.walk import nodes, variables

# --- why transitions were not taken -------------------------------------------------------------------------


def why(console: Console, session: Session, charts: Sequence[str]) -> None:
    """Every transition of these charts tested in the tick, with what was true and false of its guard."""
    sim = session.simulation
    if not sim.at:
        console.print("Nothing was tested before the first tick; write step first.")
        return
    trace, at = sim.trace(sim.at), {**sim.state(), **sim.given()}
    tested = sim.tested()
    for chart in (c for c in sim.system.charts if c.name in charts):
        own = [t for t in tested if t.chart == chart.name]
        place = where(chart, sim.state())
        tested_here = place if own else f"{place}: no transition was tested in this tick"
        beside(console, Text(), Text(tested_here, style="bold"))
        for one in own:
            beside(console, *_test(chart, one))
            if one.conjuncts:
                laid(console, _conjuncts(one, trace, at))


def _test(chart: Chart, one: TestedTransition) -> tuple[Text, Text]:
    through = next((j.name for j in chart.junctions.values() if _has(j.transitions, one.segment)), "")
    start = through or (".".join(one.source) if one.source else "default")
    event = f" on {one.segment.event}" if one.segment.event else ""
    mark, style = ("✓", "green") if one.valid else ("✗", "")
    indent = "    " if through else "  "
    shown = Text(f"{start} → {one.segment.target}{event}", style=style)
    return Text(f"{indent}{mark} ", style=style), shown


def _has(transitions: Sequence[Transition], wanted: Transition) -> bool:
    return any(transition is wanted for transition in transitions)


def _conjuncts(one: TestedTransition, trace: Trace, at: Mapping[str, int]) -> Table:
    grid = Table.grid(padding=(0, 1))
    grid.add_column(width=6)
    grid.add_column(width=5)
    grid.add_column(ratio=1)
    for part, true in one.conjuncts:
        known = {n: at[n] for n in variables(part) if n in at}
        values = listed(trace, known)
        shown = text(part, unfold=True)
        said = f"{shown}   ({values})" if values and values.replace(" = ", " == ") != shown else shown
        grid.add_row("", Text("true" if true else "false", style="green" if true else "red"), said)
        if one.source and any(isinstance(n, Temporal) for n in nodes(part)):
            for line in timers(trace, at, f"{one.chart}.{'.'.join(one.source)}."):
                grid.add_row("", "", Text(f"now {line}", style="yellow"))
    return grid


def _show(explorer: Explorer, rest: str) -> None:
    if rest not in ("", "all"):
        for name in split(rest):
            _describe(explorer, name)
        return
    show(explorer.console, explorer.session, rest == "all")


def _describe(explorer: Explorer, name: str) -> None:
    sim = explorer.session.simulation
    var = variable(name, sim.variables, "variable")
    at = {**explorer.session.standing, **sim.state(), **sim.given()}
    doc = f"; {var.doc}" if var.doc else ""
    explorer.say(f"{name} = {var.domain.show(at[name])}, {var.domain}{doc}")


def _why(explorer: Explorer, rest: str) -> None:
    charts = explorer.session.names.charts
    why(explorer.console, explorer.session, [_chart(name, charts) for name in split(rest)] or list(charts))


def _chart(name: str, charts: Mapping[str, Chart]) -> str:
    if name not in charts:
        raise RefusedInput(f"There is no chart {name!r}. {did_you_mean(name, charts)}")
    return name


def _watch(explorer: Explorer, rest: str) -> None:
    session = explorer.session
    for name in split(rest):
        variable(name, session.simulation.variables, "variable")
        session.watched += [name] if name not in session.watched else []
    explorer.say(f"Watched: {', '.join(session.watched) or 'nothing'}")


COMMANDS: Commands = {
    "show": ("show [all|NAME ...]", _show, "states, transitions, inputs, values and timers of this tick"),
    "why": ("why [CHART ...]", _why, "which guards were true and which false in this tick"),
    "watch": ("watch NAME ...", _watch, "show these values after every command that moves"),
}
