"""The commands of ``rovercheck explore`` that look at a tick."""

from collections.abc import Mapping

from checker.commands.explore.explorer import Commands, Explorer
from checker.commands.explore.text import show
from checker.commands.explore.why import why
from checker.commands.explore.words import split
from checker.explore.by_hand.written import RefusedInput, variable
from spec_model.lang.chart import Chart
from spec_model.lang.errors import did_you_mean


def _show(explorer: Explorer, rest: str) -> None:
    if rest not in ("", "all"):
        for name in split(rest):
            _told(explorer, name)
        return
    show(explorer.console, explorer.session, rest == "all")


def _told(explorer: Explorer, name: str) -> None:
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
    "show": ("show [all|NAME ...]", _show, "states, arrows, inputs, values and timers of this tick"),
    "why": ("why [CHART ...]", _why, "which guards were true and which false in this tick"),
    "watch": ("watch NAME ...", _watch, "show these values after every command that moves"),
}
