"""``rovercheck graph``: a chart as it is drawn, or the reachable graph of a system on some variables."""

from collections.abc import Mapping
from pathlib import Path

from checker.commands.codes import Exit, UsageError
from checker.commands.output import err, write
from checker.commands.progress import Watch
from checker.commands.select import pick
from checker.explore import state_graph
from checker.render import renderers
from spec_model.lang.lower import lower
from spec_model.lang.system import System
from spec_model.rover import charts_of


def graph(
    name: str, project: str | None, format: str, by_name: Mapping[str, System], output: Path | None
) -> Exit:
    """Draw what the name means: with ``project`` a system's state graph, without it a chart."""
    drawn = charts_of(by_name)
    if project is not None:
        return _states(pick("system", name, by_name), project, format, output)
    if name in by_name and name not in drawn:
        raise UsageError(f"{name} is a system. {_how_to_project(by_name[name])}")
    known = drawn | dict.fromkeys(by_name)
    chart = pick("chart or system", name, known)
    renderer = pick("chart format", format, renderers("statechart"))
    write(renderer.render(chart), output)
    return Exit.AS_EXPECTED


def _states(system: System, project: str, format: str, output: Path | None) -> Exit:
    renderer = pick("graph format", format, renderers("graph"))
    onto = [part.strip() for part in project.split(",") if part.strip()]
    if not onto:
        raise UsageError(f"--project names no variable. {_how_to_project(system)}")
    with Watch(err, 1) as watch:
        found = state_graph(lower(system), onto, progress=lambda line: watch.say(system.name, line))
    write(renderer.render(found), output)
    return Exit.AS_EXPECTED


def _how_to_project(system: System) -> str:
    """What to write: the charts to draw, and a projection on locations."""
    places = [v.name for c in system.charts for v in c.locations] or list(system.written)
    names = ", ".join(c.name for c in system.charts)
    shown = f"Draw a chart of it ({names}), or its" if names else "Draw its"
    return f"{shown} state graph: rovercheck graph {system.name} --project {','.join(places[:2])}"
