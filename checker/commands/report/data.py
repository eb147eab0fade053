"""From verdicts to the data of the review page, for the rover and for a user's own model alike."""

import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, fields, replace

from rovercheck.checker.certify.outcome import Accepted, Outcome, Rejected, Undecided
from rovercheck.checker.commands.check.further import noticing
from rovercheck.checker.commands.shared.property_text import formally
from rovercheck.checker.model import Model
from rovercheck.checker.render.review.model import (
    Covered,
    HazardRow,
    InterpretationRow,
    Remedy,
    RequirementRow,
    Review,
    ReviewAssumption,
    ReviewedProperty,
    ReviewOrigin,
    StateGraphView,
    SystemSummary,
)
from rovercheck.checker.render.verdict_text import evidence, recorded
from rovercheck.checker.results.trace import Trace
from rovercheck.checker.results.verdict import Exhausted, Unknown
from rovercheck.checker.system.cone import Dependencies
from rovercheck.checker.verify.checked import CheckedProperty, PremiseCase
from rovercheck.checker.verify.finding_order import order_of
from rovercheck.properties.coverage import RequirementCoverage, matrix
from rovercheck.properties.english import HOW_TO_READ
from rovercheck.properties.expected import Expected
from rovercheck.properties.forms import Form, Property, formulas
from rovercheck.spec_model.lang.chart import Chart
from rovercheck.spec_model.lang.expr import Expr, Named
from rovercheck.spec_model.lang.label import text
from rovercheck.spec_model.lang.system import System, charts_of
from rovercheck.spec_model.lang.walk import nodes


@dataclass(frozen=True)
class Extras:
    """What a model may have besides properties and systems.

    ``depends`` tells what a verdict depends on; ``premises`` are what came of asking whether the case occurs
    that a property speaks of.  ``graphs`` are the
    state graphs of systems, ``undrawn`` says of some why there is none.
    """

    interpretations: tuple[InterpretationRow, ...] = ()
    depends: Callable[[CheckedProperty], Dependencies] = lambda one: Dependencies(
        one.result.property.interpretations
    )
    repairs: tuple[Remedy, ...] = ()
    coverage: tuple[Covered, ...] = ()
    premises: Mapping[str, PremiseCase] = field(default_factory=dict)
    graphs: tuple[StateGraphView, ...] = ()
    undrawn: tuple[tuple[str, str], ...] = ()


def reviewed(
    model: Model, found: Sequence[CheckedProperty], origin: ReviewOrigin, extras: Extras, whole: bool = True
) -> Review:
    """All that the page shows.  ``whole``: no selection was made among the properties of the model."""
    shown = sorted(found, key=lambda c: (c.result.property.area, by_number(c.result.property.id)))
    order = order_of(model)
    places = order.places(shown)
    # by system, so that each is lowered once
    depends = {c.result.property.id: extras.depends(c) for c in sorted(shown, key=lambda c: c.result.system)}
    systems = concerned(shown, model)
    properties = [c.result.property for c in shown]
    decided = {p.id for p in properties}
    left = [p for id, p in model.properties.items() if id not in decided] if whole else []
    verdicts = {c.result.property.id: c.verdict.word for c in shown}
    verdicts |= {p.id: model.expected(p.id).verdict for p in left}
    checks = tuple(
        replace(
            checked(c, model, extras),
            severity=order.hazard(c).severity,
            hazard=order.hazard(c).id,
            place=places[c.result.property.id],
            interpretations=depends[c.result.property.id].interpretations,
            assumptions=depends[c.result.property.id].assumptions,
            besides=depends[c.result.property.id].besides,
        )
        for c in shown
    )
    read = {id for one in checks for id in one.interpretations}
    return Review(
        f"Review of {model.name}",
        f"What was checked of {model.name}, with which verdict and evidence, and how to check it again.",
        checks,
        origin,
        {s.name: about(s) for s in systems},
        drawn(systems, model),
        demands([*properties, *left], verdicts, model, whole),
        tuple(r for r in extras.interpretations if whole or r.id in read),
        assumed(systems),
        extras.repairs,
        extras.coverage,
        extras.graphs,
        extras.undrawn,
        HOW_TO_READ,
        tuple((p.id, f"only with --full; expected: {model.expected(p.id).verdict}") for p in left),
        {h.id: HazardRow(h.id, h.text, h.severity, h.because) for h in model.hazards.values()},
    )


def checked(compared: CheckedProperty, model: Model, extras: Extras) -> ReviewedProperty:
    """A property with its verdict, without what follows from the others or from its system."""
    prop, verdict, entry = compared.result.property, compared.verdict, compared.expected
    system = model.systems[prop.on]
    because = None if isinstance(verdict, Unknown) else verdict.because
    proof = compared.result.certificate
    on_record = entry.verdict == verdict.word
    case = extras.premises.get(prop.id)
    return ReviewedProperty(
        prop.id,
        prop.text,
        prop.area,
        verdict.word,
        compared.result.system,
        verdict.engine,
        evidence(compared.result),
        type(prop.form).__name__,
        formally(prop, system, ""),
        (*written(prop), *named(prop.form)),
        compared.result.in_part,
        recorded(entry),
        compared.as_expected,
        proved_again(proof),
        None if proof is None else isinstance(proof, Accepted),
        premise="" if case is None else case.said,
        vacuous=case is not None and case.occurs is False,
        because=entry.because if on_record else "",
        no_repair=entry.no_repair if on_record else "",
        cause=cause(prop.id, model.on_record),
        requirements=prop.covers,
        effect=entry.effect if on_record and not compared.variant else "",
        since=entry.since.isoformat() if on_record and entry.since else "",
        decision=decision(entry) if on_record and verdict.word != "proved" else "",
        accepted=on_record and entry.accepted is not None and not entry.accepted.expired,
        lapsed=compared.lapsed is not None,
        quiet=isinstance(because, Exhausted) and because.skipped,
        on=prop.on if prop.on != compared.result.system else "",
        again=again(prop.id, model.options),
        trace=because if isinstance(because, Trace) else None,
    )


def again(id: str, options: str) -> str:
    """The commands that decide a property again and show its run."""
    return "; ".join(" ".join(filter(None, ("rovercheck", verb, id, options))) for verb in ("check", "trace"))


def cause(id: str, known: Mapping[str, Expected]) -> str:
    """The finding that is said to have the same cause as this one, and so on to the first."""
    seen = [id]
    while (one := known.get(seen[-1], Expected()).same_cause) and one not in seen:
        seen.append(one)
    return seen[-1]


def decision(entry: Expected) -> str:
    """What was decided about a finding, in a line."""
    one = entry.accepted
    if one is None:
        return "open: nobody has accepted it"
    said = " ".join(filter(None, ("accepted", one.term)))
    return f"{said}{', which is over' if one.expired else ''}: {one.because}"


def proved_again(outcome: Outcome | None) -> str:
    """What came of checking the proof, in words; empty where nothing was to be checked."""
    match outcome:
        case None:
            return ""
        case Accepted(how):
            return f"accepted: {how}"
        case Rejected(obligation, shown):
            return f"REJECTED at {obligation}: {shown}"
        case Undecided(reason):
            return f"not certified: {reason}"


def written(prop: Property) -> Iterator[tuple[str, str]]:
    """The parts of the form with their names, as formulas are written on transitions."""
    for part in fields(prop.form):
        value = getattr(prop.form, part.name)
        shown = [_part(one) for one in (value if isinstance(value, tuple) else (value,)) if one is not None]
        if shown:
            yield part.name.rstrip("_"), "; ".join(shown)
    if prop.from_tick > 1:
        yield "from", f"tick {prop.from_tick} on"


def _part(value: object) -> str:
    return text(value) if isinstance(value, Expr) else str(value)


def named(form: Form) -> Iterator[tuple[str, str]]:
    """What the names in the formulas stand for."""
    found = (n for formula in formulas(form) for n in nodes(formula) if isinstance(n, Named))
    yield from {n.name: (f"{n.name} =", text(n, unfold=True)) for n in found}.values()


def about(system: System) -> SystemSummary:
    """What a reader needs to know of a system."""
    return SystemSummary(
        system.name,
        system.text,
        system.tick_ms,
        tuple(c.name for c in system.charts),
        system.notes,
        tuple(a.id for a in system.assumptions),
        system.over,
        system.under,
        system.concrete,
    )


def assumed(systems: Iterable[System]) -> tuple[ReviewAssumption, ...]:
    """The assumptions about the environment, each with the systems that make it."""
    holders: dict[tuple[str, str], list[str]] = {}
    for system in systems:
        for one in system.assumptions:
            holders.setdefault((one.id, one.text), []).append(system.name)
    return tuple(ReviewAssumption(id, said, tuple(names)) for (id, said), names in holders.items())


def drawn(shown: Iterable[System], model: Model) -> dict[str, Chart]:
    """The charts of some systems, whole where the model has them so: one may execute a region alone."""
    whole, own = charts_of(model.systems), charts_of({s.name: s for s in shown})
    return {n: whole[n] if c.states.keys() <= whole[n].states.keys() else c for n, c in own.items()}


def demands(
    properties: Sequence[Property], verdicts: Mapping[str, str], model: Model, whole: bool
) -> tuple[RequirementRow, ...]:
    """The rows of the requirement matrix, uncovered ones first and then the worst verdicts.

    ``whole``: all requirements; otherwise only those that one of the properties names.
    """
    if not model.requirements:
        return ()
    rows = (row for row in matrix(properties, model.requirements, noticing(model)) if whole or row.properties)
    made = (_demand(row, row.state(verdicts)) for row in rows)
    return tuple(sorted(made, key=lambda d: ORDER.index(d.state)))


ORDER = ("open", "reached", "stated", "reason", "violated", "unknown", "proved")
"""What a reviewer wants to see first."""


def _demand(row: RequirementCoverage, state: str) -> RequirementRow:
    item = row.requirement
    ids = tuple(p.id for p in row.properties)
    return RequirementRow(item.id, item.text, item.source, state, item.reason, ids, row.covered)


def concerned(results: Iterable[CheckedProperty], model: Model) -> list[System]:
    """The systems that the verdicts are about, in the order of the model."""
    names = {c.result.property.on for c in results} | {c.result.system for c in results}
    with_runs = {model.systems[n].concrete for n in names if n in model.systems}
    return [s for name, s in model.systems.items() if name in names | with_runs]


def by_number(id: str) -> tuple[object, ...]:
    """Sorts ids as people do: PB1-2 before PB1-15."""
    return tuple(
        (0, int(part), "") if part.isdigit() else (1, 0, part) for part in re.split(r"(\d+)", id) if part
    )
