"""``rovercheck graph``: a chart as it is drawn, or the reachable graph of a system on some variables."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from checker.commands.check import evidence, results
from checker.commands.codes import Exit, UsageError
from checker.commands.graphing_offers import offered, projections
from checker.commands.output import err, out, write, wrote
from checker.commands.progress import Watch
from checker.commands.select import pick
from checker.commands.variant import Variant
from checker.decide import AUTO
from checker.engine import Limits
from checker.graph import MOST_NODES, StateGraph, drawable, with_trace
from checker.graphs.making import Made, made
from checker.graphs.suggesting import among, suggestions
from checker.render import Renderer, renderers
from checker.render.stategraph.findings import told
from checker.trace import Trace
from checker.verdict import Unknown
from properties.forms import Property, Reachable, Unbounded
from properties.reduce import reduce
from spec_model.lang.errors import ModelError
from spec_model.lang.lower import lower
from spec_model.lang.system import System, TransitionSystem
from spec_model.rover import charts_of


@dataclass(frozen=True)
class View:
    """What to show of a system: the variables, what to mark, and how much may be spent and drawn."""

    project: str | None = None
    trace: str | None = None
    bad: str | None = None
    most: int = MOST_NODES
    summary: bool = False
    limits: Limits = field(default_factory=Limits)

    @property
    def onto(self) -> tuple[str, ...]:
        """The names of the variables, each once."""
        return tuple(dict.fromkeys(filter(None, map(str.strip, (self.project or "").split(",")))))


def graph(name: str, view: View, format: str, variant: Variant, output: Path | None) -> Exit:
    """Draw what the name means: a chart, or a system's state graph; of a system alone say how to project."""
    by_name = variant.systems()
    drawn = charts_of(by_name)
    if view.project is not None:
        return _states(pick("system", name, by_name), view, format, variant, output)
    for option, given in (("--trace", view.trace), ("--bad", view.bad), ("--summary", view.summary)):
        if given:
            raise UsageError(f"{option} needs --project VAR,VAR. See: rovercheck graph {name}")
    if name in by_name and name not in drawn:
        return _offer(by_name[name], view.limits, output, _options(variant))
    chart = pick("chart or system", name, dict.fromkeys(by_name) | drawn)
    renderer = pick("chart format", format, renderers("statechart"))
    write(renderer.render(chart), output)
    wrote(output)
    return Exit.AS_EXPECTED


def _options(variant: Variant) -> str:
    return f" {variant.options}" if variant.options else ""


def _offer(system: System, limits: Limits, output: Path | None, options: str) -> Exit:
    with Watch(err, 1) as watch:
        found = suggestions(lower(system), limits, lambda line: watch.say(system.name, line))
    charts = "".join(f"rovercheck graph {c.name}{options} draws its chart.\n" for c in system.charts[:4])
    write(offered(system.name, found, options) + ("\n" + charts if charts else ""), output)
    return Exit.INCONCLUSIVE if found.cut else Exit.AS_EXPECTED


def _states(system: System, view: View, format: str, variant: Variant, output: Path | None) -> Exit:
    renderer = pick("graph format", format, renderers("graph"))
    if not view.onto:
        raise UsageError(f"--project names no variable. See what there is: rovercheck graph {system.name}")
    known = variant.properties() if view.trace or view.bad else {}
    by_name = variant.systems()
    trace = None
    if view.trace:
        trace = _trace(_about(system, pick("property", view.trace, known), by_name), by_name)
        if trace is None:
            return Exit.INCONCLUSIVE
    lowered, wanted, says = _monitored(system, pick("property", view.bad, known) if view.bad else None)
    with Watch(err, 1) as watch:
        found = made(lowered, view.onto, view.limits, lambda line: watch.say(system.name, line), wanted, says)
        shown = _shown(found, trace, renderer, view)
    if view.summary:
        write(told(shown, min(out.width, 100)), output)
    else:
        write(_picture(renderer, found, shown, view, _options(variant)), output)
        wrote(output)
        err.print(told(shown, min(err.width, 100)), markup=False, end="")
    return Exit.INCONCLUSIVE if shown.cut else Exit.AS_EXPECTED


def _about(system: System, prop: Property, by_name: Mapping[str, System] | None = None) -> Property:
    """The property, which must be about the system, or among others its runs may be those of this one."""
    shown_on = by_name[prop.on].concrete if by_name and prop.on in by_name else ""
    if system.name not in (prop.on, shown_on):
        raise UsageError(f"{prop.id} is about {prop.on}, not {system.name}: rovercheck graph {prop.on} …")
    return prop


def _monitored(system: System, prop: Property | None) -> tuple[TransitionSystem, tuple[str, ...], str]:
    """The system with the monitor of a property, the variable that is 1 where it is broken, and in words."""
    lowered = lower(system)
    if prop is None:
        return lowered, (), ""
    _about(system, prop)
    if isinstance(prop.form, Unbounded):
        raise UsageError(
            f"No single valuation breaks {prop.id}, but a run without end; use --trace {prop.id}."
        )
    question = reduce(lowered, [prop])
    word = "reached" if isinstance(prop.form, Reachable) else "broken"
    return question.system, (question.goals[0].var.name,), f"{prop.id} is {word}"


def _trace(prop: Property, systems: Mapping[str, System]) -> Trace | None:
    """The trace of the property; None if it is not known whether there is one.  Raises ``UsageError``."""
    [result] = results([prop], systems, AUTO, Limits())
    if isinstance(result.verdict, Unknown):
        err.print(f"{prop.id} is unknown: {evidence(result)}", markup=False)
        return None
    because = result.verdict.because
    if not isinstance(because, Trace):
        raise UsageError(f"{prop.id} is {result.verdict.word} and has no trace to show: {evidence(result)}.")
    return because


def _shown(found: Made, trace: Trace | None, renderer: Renderer, view: View) -> StateGraph:
    """The graph with all that the format shows."""
    ways = getattr(renderer, "WAYS", False) and not view.summary and len(found.graph.nodes) <= view.most
    graph = found.with_ways() if ways else found.graph
    return with_trace(graph, trace) if trace else graph


def _picture(renderer: Renderer, found: Made, graph: StateGraph, view: View, options: str) -> str | bytes:
    """What the renderer makes of it.  Raises ``UsageError`` that shows how to project a graph too large."""
    if not getattr(renderer, "PICTURE", False):
        return renderer.render(graph)
    try:
        drawable(graph, view.most)
    except ModelError as error:
        system = found.exploration.system
        places = [v.name for c in system.source.charts for v in c.locations] if system.source else []
        smaller = among(found.exploration.explored, places, view.most)
        more = f"Or draw as many with --max-nodes {len(graph.nodes)}."
        raise UsageError(
            "\n".join([f"{error} {more}", *projections(system.name, smaller, options)])
        ) from None
    picture: str | bytes = renderer.render(graph, **{"most": view.most})
    return picture
