"""The review page: one HTML file with every verdict, its evidence and how to get it again.

It needs no network and no program but a browser.  Without scripts its texts can still be read, except
what proofs rest on; pictures and decisions need them.
"""

import re
from collections.abc import Collection, Iterable, Iterator, Mapping
from importlib.resources import files
from itertools import groupby
from typing import Any, NamedTuple
from urllib.parse import quote

from markupsafe import Markup

from rovercheck.checker.render import renderers
from rovercheck.checker.render.page import Part, data, page, templates
from rovercheck.checker.render.reasons import determining
from rovercheck.checker.render.review import traces
from rovercheck.checker.render.review.cover import (
    decision_state,
    hazard_totals,
    identity,
    open_points,
    state_totals,
    worst,
)
from rovercheck.checker.render.review.fragments import PackedFragments
from rovercheck.checker.render.review.model import PROVED, HazardRow, Review, ReviewedProperty, StateGraphView
from rovercheck.checker.render.statechart_svg import size
from rovercheck.checker.render.stategraph import fragment as stategraph
from rovercheck.checker.render.story import ending, false_parts, heading
from rovercheck.checker.results.trace import Trace
from rovercheck.spec_model.lang.chart import Chart

TEMPLATES = templates("review")
SIGNS = {"proved": "✓", "violated": "✗", "unknown": "?"}
STATES = {
    "open": "not covered",
    "reached": "only reached",
    "stated": "only stated",
    "reason": "with a reason",
    "violated": "violated",
    "unknown": "unknown",
    "proved": "proved",
}
"""What the matrix says of a requirement."""
SEVERITIES = ("catastrophic", "critical", "marginal", "unrated", "negligible")
"""The gravest first, by which tables are sorted."""
SECTIONS = {
    "summary": "Summary",
    "findings": "Findings",
    "requirements": "Requirements",
    "properties": "Properties",
    "repairs": "Proposed repairs",
    "charts": "Charts",
    "graphs": "State graphs",
    "readings": "Interpretations",
    "systems": "Systems",
    "limits": "What is not covered",
    "making": "How to reproduce",
}
"""The sections in their order, with their headings."""
SCRIPTS = ("decisions.js", "review.js", "tables.js")
GALLERY = "*"
"""The name of the fragment with the pictures of charts that all players share."""


def render(review: Review) -> str:
    """The page as HTML text; the same data give the same page."""
    found = {p.id: p.trace for p in review.properties if p.trace is not None}
    runs = traces.shared(found, review.charts.values())
    told = {p.id: traces.story(runs[p.id]) for p in review.findings if p.id in runs}
    shown = dict(
        review=review,
        groups=grouped(review.findings, review.hazards),
        areas=[(area, list(of)) for area, of in groupby(review.properties, key=_area)],
        by_id={p.id: p for p in review.properties},
        repairs=_by_property(review),
        told={id: part.body for id, part in told.items()},
        heading=heading,
        ending=ending,
        false_parts=false_parts,
        determining=determining,
        gallery=GALLERY,
        runs=runs,
        signs=SIGNS,
        states=STATES,
        sign=sign,
        link=link,
        title_of=title_of,
        inside=inside,
        drawn_in=drawn_in,
        **_first_pages(review),
    )
    body = TEMPLATES.get_template("review.html").render(shown)
    graph_styles = stategraph.STYLES if review.graphs else ()
    styles = dict.fromkeys((*(text for part in told.values() for text in part.styles), *graph_styles))
    parts = [Part(Markup(body), (*styles, own("review.css")), tuple(map(own, SCRIPTS)))]
    packed = _pictures(runs, told, review.graphs)
    about = vars(TEMPLATES.get_template("property.html").make_module(shown))["about"]
    for one in review.properties:
        if not one.finding:
            packed.add(inside(one.id), [Part(about(one))])
    picture = TEMPLATES.get_template("chart.html")
    for name, chart in review.charts.items():
        drawn = picture.render(name=name, width=size(chart)[0], image=_image(chart))
        packed.add(drawn_in(name), [Part(Markup(drawn))])
    return page(review.title, [*parts, *packed.parts()])


def _first_pages(review: Review) -> dict[str, Any]:
    """What the cover, the summary and the table of findings show."""
    there = {
        "findings": review.findings,
        "requirements": review.demands,
        "repairs": review.repairs,
        "charts": review.charts,
        "graphs": review.graphs,
        "readings": review.interpretations,
    }
    kept = {"page": identity(review), "saved": "", "reviewer": review.origin.reviewer, "decisions": {}}
    return {
        "worst": worst(review),
        "hazards": hazard_totals(review),
        "open": open_points(review),
        "totals": list(state_totals(review, STATES)),
        "severities": SEVERITIES,
        "decision_state": decision_state,
        "contents": [(name, words) for name, words in SECTIONS.items() if there.get(name, True)],
        "kept": data(kept, "decisions-kept"),
        "accept": " ".join(filter(None, ("rovercheck accept --from decisions.json", review.origin.options))),
    }


def inside(id: str) -> str:
    """The name of the fragment that tells what the proof of a property rests on."""
    return f"body {id}"


def own(name: str) -> str:
    """The text of a file beside this one: a style sheet or a script."""
    return files(__name__).joinpath(name).read_text(encoding="utf-8")


def sign(prop: ReviewedProperty) -> str:
    """One character for a verdict."""
    return "≈" if prop.in_part else SIGNS[prop.verdict]


def link(kind: str, name: str) -> str:
    """The address within the page of a thing of a kind; of a property, the plain id."""
    return "#" + quote(f"{kind}-{name}" if kind else name)


def title_of(area: str) -> str:
    """``board2_motion`` as a heading: ``Board 2 motion``."""
    return re.sub(r"(?<=[a-z])(?=\d)", " ", area.replace("_", " ")).capitalize()


def _area(prop: ReviewedProperty) -> str:
    return prop.area or prop.system


class Group(NamedTuple):
    """A heading with what is to be said below it, and the findings, those with the same cause together."""

    title: str
    says: str
    causes: list[tuple[str, list[ReviewedProperty]]]


def grouped(findings: Iterable[ReviewedProperty], hazards: Mapping[str, HazardRow]) -> list[Group]:
    """What is not as expected first, then hazard by hazard; findings with one cause are together.

    Findings come in their order, the gravest first.  Where no hazards are known, they are grouped by area.
    """
    shown = list(findings)
    surprising = [p for p in shown if not p.as_expected]
    known = [p for p in shown if p.as_expected]
    groups = [Group("Not as expected", "", [("", [p]) for p in surprising])] if surprising else []
    if not hazards:
        by_area: dict[str, list[ReviewedProperty]] = {}
        for one in known:
            by_area.setdefault(_area(one), []).append(one)
        return [*groups, *(Group(title_of(area), "", list(_causes(of))) for area, of in by_area.items())]
    for id, members in groupby(known, key=lambda one: one.hazard):
        groups.append(_of_hazard(hazards.get(id), members))
    return groups


def _of_hazard(hazard: HazardRow | None, members: Iterable[ReviewedProperty]) -> Group:
    causes = list(_causes(members))
    if hazard is None:
        return Group("Unrated", "No hazard names what is broken.", causes)
    said = f"{hazard.id}, {hazard.severity}. {hazard.because}"
    return Group(f"{hazard.severity.capitalize()}: {hazard.text}", said, causes)


def _causes(findings: Iterable[ReviewedProperty]) -> Iterator[tuple[str, list[ReviewedProperty]]]:
    by: dict[str, list[ReviewedProperty]] = {}
    for one in findings:
        by.setdefault(one.cause or one.id, []).append(one)
    yield from by.items()


def _by_property(review: Review) -> Mapping[str, list[Any]]:
    found: dict[str, list[Any]] = {}
    for one in review.repairs:
        for id, *_ in one.proofs:
            found.setdefault(id, []).append(one)
    return found


def drawn_in(name: str) -> str:
    """The name of the fragment with the picture of a chart."""
    return f"chart {name}"


def _pictures(
    runs: Mapping[str, Trace], told: Collection[str], graphs: Iterable[StateGraphView]
) -> PackedFragments:
    """The moving pictures of traces, kept for when they are asked for; charts lie there once.

    So do the stories that are not ``told`` in the page itself.
    """
    packed = PackedFragments()
    for id, trace in runs.items():
        packed.add(id, [*traces.moving(trace), *([] if id in told else [traces.story(trace)])])
    if runs:
        packed.add(GALLERY, [traces.pictures(list(runs.values()))])
    for one in graphs:
        picture = Part(Markup(one.picture), stategraph.STYLES, stategraph.SCRIPTS)
        packed.add(f"graph {one.system}", [picture])
    return packed


def _image(chart: Chart) -> Markup:
    """The picture of a chart as an address that holds it, written for an attribute in double quotes."""
    drawn = renderers("statechart")["svg"].render(chart)
    text = drawn if isinstance(drawn, str) else drawn.decode()
    single = text.strip().replace("'", "&apos;").replace('"', "'")
    return Markup("data:image/svg+xml," + quote(single, safe=" /:=;,'()@!$*+?-_.~[]{}|"))


__all__ = ["PROVED", "Review", "render"]
