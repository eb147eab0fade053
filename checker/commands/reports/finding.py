"""The page on a finding, which stands alone: what goes wrong, how bad, since when, why, repair, decision."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from html import escape

from rovercheck.checker.commands.report.data import decision
from rovercheck.checker.commands.reports.repairs import Proof, sections
from rovercheck.checker.commands.shared.dependencies import of_rover
from rovercheck.checker.commands.shared.property_text import formally
from rovercheck.checker.explain.explanation import unexplained
from rovercheck.checker.render import renderers
from rovercheck.checker.render.trace_markdown import reasons_table
from rovercheck.checker.render.verdict_text import evidence
from rovercheck.checker.results.trace import Trace
from rovercheck.checker.results.verdict import Unknown
from rovercheck.checker.verify.checked import CheckedProperty
from rovercheck.properties.expected import Expected
from rovercheck.properties.forms import Property
from rovercheck.properties.hazards import Hazard, gravest_of, hazards
from rovercheck.properties.requirements import requirements
from rovercheck.spec_model.rover import systems

RUN = "## Shortest counterexample"
LONG_RUN = "## A counterexample, not known to be a shortest one"
"""For runs whose length is not recorded."""

CAUSE = "## Cause: the inputs that determine the violation"
NOT_ASKED = "Not looked for in this version of the page."


def finding(compared: CheckedProperty, proved: Sequence[Proof], about: str) -> str:
    """The page; ``about`` is the system of the verdict, as the page names it."""
    prop, verdict = compared.result.property, compared.verdict
    assert not isinstance(verdict, Unknown)
    known = requirements()
    lines = [f"# {prop.id}: violated", "", compared.expected.effect or prop.text, "", "| | |", "|---|---|"]
    lines += [f"| {name} | {_cell(said)} |" for name, said in _summary(compared, proved) if said]
    lines += ["", "## Demanded", "", prop.text, ""]
    lines += ["\n>\n".join(f"> {escape(line, quote=False)}" for line in formally(prop)), ""]
    lines += [f"- {known[id].id} [{known[id].source}]: {known[id].text}" for id in prop.covers]
    lines += [f"- about {about}", f"- {evidence(compared.result)}", ""]
    lines += sections(prop.id, compared.expected, proved)
    if isinstance(verdict.because, Trace):
        lines += [LONG_RUN if compared.expected.depth is None else RUN, ""]
        lines += [f"![{prop.id} over time]({prop.id}.svg)", ""]
        shown = replace(verdict.because.focused(), necessary=None)
        lines += [_text(renderers("trace")["markdown"].render(shown)), *_cause(verdict.because)]
        names = dict.fromkeys(a.chart for t in verdict.because.ticks for a in t.transitions)
        lines += ["", "## Charts", "", *(f"- [{n}](../charts/{n}.svg)" for n in names)]
    return "\n".join(lines).rstrip() + "\n"


def _summary(compared: CheckedProperty, proved: Sequence[Proof]) -> Iterator[tuple[str, str]]:
    prop, entry = compared.result.property, compared.expected
    hazard = hazard_of(prop, entry)
    yield "how bad", f"**{hazard.severity}**, {hazard.id}: {hazard.text} {hazard.because}"
    yield "known since", str(entry.since or "")
    cause = f" The cause of {_link(entry.same_cause)} too." if entry.same_cause else ""
    yield "cause", f"{entry.because}{cause}"
    mended = ", ".join(f"[{p.repair.name}](#proposed-repair)" for p in proved if prop.id in p.repair.fixes)
    yield "repair", mended or f"none. {entry.no_repair}".strip()
    yield "decision", decision(entry)
    found = of_rover(prop, compared.result.system if compared.result.system in systems() else prop.on)
    yield "depends on interpretations", ", ".join(found.interpretations)
    yield "depends on assumptions", ", ".join(found.assumptions)


def hazard_of(prop: Property, entry: Expected) -> Hazard:
    """What may come of the violation of a property of the rover."""
    return gravest_of(prop.covers, hazards(), entry.hazard)


def headline(hazard: Hazard) -> str:
    """``Catastrophic: The rover runs into an obstacle.``"""
    return f"{hazard.severity.capitalize()}: {hazard.text}"


def line(prop: Property, entry: Expected, link: str) -> str:
    """A finding in a list of them: what goes wrong, and why."""
    return f"- {link} {entry.effect or prop.text} {entry.because}".rstrip()


def _link(id: str) -> str:
    return f"[{id}]({id}.md)"


def _cause(trace: Trace) -> list[str]:
    """The section on the cause of a violation; it stands apart, so as to be compared or not."""
    if why := unexplained(trace):
        return [CAUSE, "", f"Not looked for, as {why}."]
    return [CAUSE, "", *(reasons_table(trace.focused()) or [NOT_ASKED])]


def _cell(text: str) -> str:
    return text.replace("|", "\\|")


def _text(content: str | bytes) -> str:
    return content if isinstance(content, str) else content.decode()
