"""``rovercheck graph``: a chart as it is drawn, or the reachable graph of a system on some variables."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from shlex import quote

from rovercheck.checker.commands.shared.codes import Exit, UsageError
from rovercheck.checker.commands.shared.output import err, out, text_width, wrapped, write, wrote
from rovercheck.checker.commands.shared.progress import Watch
from rovercheck.checker.commands.shared.select import pick
from rovercheck.checker.commands.shared.text_wrap import whole
from rovercheck.checker.commands.shared.verdicts import results
from rovercheck.checker.engines import Limits
from rovercheck.checker.explore.graphs.construction import BuiltGraph, made
from rovercheck.checker.explore.graphs.suggestions import Offer, Suggestions, among, suggestions
from rovercheck.checker.model import names_of
from rovercheck.checker.model.variant import Variant
from rovercheck.checker.render import Renderer, renderers
from rovercheck.checker.render.stategraph.findings import findings_text
from rovercheck.checker.render.verdict_text import evidence
from rovercheck.checker.results.format import Need, Option
from rovercheck.checker.results.graph import MOST_NODES, StateGraph, drawable, with_trace
from rovercheck.checker.results.trace import Trace
from rovercheck.checker.results.verdict import Unknown
from rovercheck.properties.forms import Property, Reachable, Unbounded
from rovercheck.properties.reduce import reduce
from rovercheck.spec_model.lang.chart import Chart
from rovercheck.spec_model.lang.errors import ModelError, did_you_mean
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.lower import lower
from rovercheck.spec_model.lang.system import System, TransitionSystem, charts_of

# --- how to project ------------------------------------------------------------------------------------

NAMED = 14
"""Variables that are listed one by one."""


def offered(system: str, found: Suggestions, options: str = "") -> str:
    """What can be projected on, as lines of text; ``options`` is what each command needs besides."""
    at_least = "at least " if found.cut else ""
    lines = [f"{system}: {at_least}{found.valuations:,} reachable states of the variables below."]
    if found.cut:
        lines.append(f"The exploration is cut, so all counts are lower bounds: {found.cut}.")
    wide = max((len(r.var.name) for r in found.variables[:NAMED]), default=0)
    lines += ["", f"{'variable':<{wide}}  values reached"]
    for one in found.variables[:NAMED]:
        lines.append(f"{one.var.name:<{wide}}  {one.values} of {len(one.var.domain)}{_doc(one.var, wide)}")
    if len(found.variables) > NAMED:
        lines.append(f"and {len(found.variables) - NAMED} more")
    return "\n".join([*lines, *projections(system, found, options), ""])


def projections(system: str, found: Suggestions, options: str = "") -> list[str]:
    """The projections that are worth a look, each with the command to type."""
    if not found.offers:
        return ["", "No projection on few variables has more than one node and few enough."]
    rows = [(f"{o.nodes:,}", _runs(o, found), ",".join(o.names)) for o in found.offers]
    lines = ["", "nodes  paths that are runs  command"]
    for nodes, runs, names in rows:
        command = whole(f"rovercheck graph {system} --project {names}{options}")
        lines.append(f"{nodes:>5}  {runs:<19}  {command}")
    return lines


def _runs(offer: Offer, found: Suggestions) -> str:
    """Which paths of a projection are runs of the system."""
    return "not known" if found.cut else "some" if offer.mixed else "all"


def _doc(var: Var, wide: int) -> str:
    """What the variable is, where that fits into a line of a terminal."""
    doc = var.doc.split("\n")[0]
    fits = wide + len("  00 of 00") + 4 + len(doc) <= text_width()
    return f"    {doc}" if doc and fits and not doc.startswith("active state of") else ""


DEFAULT = "svg"


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


def graph(name: str, view: View, format: str | None, variant: Variant, output: Path | None) -> Exit:
    """Draw what the name means: a chart, or a system's state graph; of a system alone say how to project.

    Without a format, it is the one that the name of the output says.
    """
    by_name = variant.systems()
    drawn = charts_of(by_name)
    if view.project is not None:
        return _states(pick("system", name, by_name), view, format, variant, output)
    for option, given in (("--trace", view.trace), ("--bad", view.bad), ("--summary", view.summary)):
        if given:
            raise UsageError(f"{option} needs --project VAR,VAR. See: {_command(name)}")
    if name in by_name and name not in drawn:
        return _offer(by_name[name], view.limits, output, _options(variant))
    if name not in drawn:
        raise UsageError(_instead(name, by_name, drawn, _options(variant)))
    chart = drawn[name]
    renderer = _renderer("chart format", format, renderers("statechart"), output)
    write(renderer.render(chart), output)
    wrote(output)
    return Exit.AS_EXPECTED


def _renderer(kind: str, format: str | None, known: Mapping[str, Renderer], output: Path | None) -> Renderer:
    """The renderer that is asked for.  Raises ``UsageError`` where the output is named otherwise.

    An output without suffix, such as ``/dev/stdout``, says nothing.
    """
    wanted = pick(kind, format, known) if format is not None else None
    suffix = output.suffix.lower() if output is not None else ""
    said = next((r for r in known.values() if r.FORMAT.suffix == suffix), None)
    if said is None and suffix and wanted is None:
        of = ", ".join(sorted(r.FORMAT.suffix for r in known.values()))
        raise UsageError(f"{whole(output)} is of no {kind}: these are {of}. Choose one, or say --format.")
    if wanted is not None and said is not None and wanted.FORMAT.name != said.FORMAT.name:
        raise UsageError(
            f"--format {wanted.FORMAT.name} and {whole(output)} say two things. Name a file "
            f"with {wanted.FORMAT.suffix}, or leave --format out for {said.FORMAT.name}."
        )
    return wanted or said or known[DEFAULT]


def _instead(name: str, systems: Mapping[str, System], charts: Mapping[str, Chart], options: str) -> str:
    """Where something is that is neither a chart nor a system: a state, or what a system remembers."""
    path = tuple(name.split("."))
    inside = [
        chart.name
        for chart in charts.values()
        for wanted in (path, path[1:] if path[0] == chart.name else path)
        if wanted and any(known[-len(wanted) :] == wanted for known in chart.states)
    ]
    inside = list(dict.fromkeys(inside))
    if inside:
        named = "a state of the chart" if len(inside) == 1 else "a state of the charts"
        draws = f"{_command(inside[0], options)} draws {'it' if len(inside) == 1 else 'the first'}."
        return f"{name!r} is {named} {', '.join(inside)}; {draws}"
    having = [s for s in systems.values() if name in names_of(s)]
    if having:
        first = having[0]
        names = ", ".join(s.name for s in having[:4]) + (" and others" if len(having) > 4 else "")
        kind = "an input" if name in first.inputs else "data"
        more = "" if name in first.inputs else f" --project {quote(name)}"
        return f"{name!r} is {kind} of {names}: {_command(first.name, options, more)}"
    return f"There is no chart or system {name!r}. {did_you_mean(name, {**systems, **charts})}"


def _command(name: str, *options: str) -> str:
    return whole(f"rovercheck graph {name}{''.join(options)}")


def _options(variant: Variant) -> str:
    return f" {variant.options}" if variant.options else ""


def _offer(system: System, limits: Limits, output: Path | None, options: str) -> Exit:
    with Watch(err, 1) as watch:
        found = suggestions(lower(system), limits, lambda line: watch.say(system.name, line))
    charts = "".join(f"{_command(c.name, options)} draws its chart.\n" for c in system.charts[:4])
    findings_text = offered(system.name, found, options) + ("\n" + charts if charts else "")
    write(wrapped(findings_text), None)
    if output is not None:
        raise UsageError(
            f"Nothing is written to {whole(output)}: a state graph needs --project, as in the commands above."
        )
    return Exit.INCONCLUSIVE if found.cut else Exit.AS_EXPECTED


def _states(system: System, view: View, format: str | None, variant: Variant, output: Path | None) -> Exit:
    named = None if view.summary else output  # a summary is text, whatever its file is called
    renderer = _renderer("graph format", format, renderers("graph"), named)
    if not view.onto:
        raise UsageError(f"--project names no variable. See what there is: {_command(system.name)}")
    known = variant.properties() if view.trace or view.bad else {}
    by_name = variant.systems()
    trace = None
    if view.trace:
        run_of = variant.asked(pick("property", view.trace, known))
        trace = _trace(_about(system, run_of, by_name), by_name)
        if trace is None:
            return Exit.INCONCLUSIVE
    bad = variant.asked(pick("property", view.bad, known)) if view.bad else None
    lowered, wanted, says = _monitored(system, bad)
    with Watch(err, 1) as watch:
        found = made(lowered, view.onto, view.limits, lambda line: watch.say(system.name, line), wanted, says)
        shown = _shown(found, trace, renderer, view)
    if view.summary:
        write(findings_text(shown, min(out.width, 100)), output)
    else:
        write(_picture(renderer, found, shown, view, _options(variant)), output)
        wrote(output)
        err.print(findings_text(shown, min(err.width, 100)), markup=False, end="")
    return Exit.INCONCLUSIVE if shown.cut else Exit.AS_EXPECTED


def _about(system: System, prop: Property, by_name: Mapping[str, System] | None = None) -> Property:
    """The property, which must be about the system, or among others its runs may be those of this one."""
    shown_on = by_name[prop.on].concrete if by_name and prop.on in by_name else ""
    if system.name not in (prop.on, shown_on):
        raise UsageError(f"{prop.id} is about {prop.on}, not {system.name}: {_command(prop.on)} …")
    return prop


def _monitored(system: System, prop: Property | None) -> tuple[TransitionSystem, tuple[str, ...], str]:
    """The system with the monitor of a property, the variable that is 1 where it is broken, and in words."""
    lowered = lower(system)
    if prop is None:
        return lowered, (), ""
    _about(system, prop)
    if isinstance(prop.form, Unbounded):
        raise UsageError(f"No single state breaks {prop.id}, but a run without end; use --trace {prop.id}.")
    question = reduce(lowered, [prop])
    word = "reached" if isinstance(prop.form, Reachable) else "broken"
    return question.system, (question.goals[0].var.name,), f"{prop.id} is {word}"


def _trace(prop: Property, systems: Mapping[str, System]) -> Trace | None:
    """The trace of the property; None if it is not known whether there is one.  Raises ``UsageError``."""
    [result] = results([prop], systems)
    if isinstance(result.verdict, Unknown):
        err.print(f"{prop.id} is unknown: {evidence(result)}", markup=False)
        return None
    because = result.verdict.because
    if not isinstance(because, Trace):
        raise UsageError(f"{prop.id} is {result.verdict.word} and has no trace to show: {evidence(result)}.")
    return because


def _shown(found: BuiltGraph, trace: Trace | None, renderer: Renderer, view: View) -> StateGraph:
    """The graph with all that the format shows."""
    needed = Need.STATE_RUNS in renderer.FORMAT.needs and not view.summary
    few = len(found.graph.nodes) <= view.most
    graph = found.with_ways() if needed and few else found.graph
    return with_trace(graph, trace) if trace else graph


def _picture(
    renderer: Renderer, found: BuiltGraph, graph: StateGraph, view: View, options: str
) -> str | bytes:
    """What the renderer makes of it.  Raises ``UsageError`` that shows how to project a graph too large."""
    if Option.MOST not in renderer.FORMAT.takes:
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
