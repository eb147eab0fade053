"""``rovercheck requirements``: every requirement with the properties that cover it and their verdicts."""

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from rovercheck.checker.commands.check.further import noticing
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.commands.shared.output import out
from rovercheck.checker.commands.shared.tables import listed
from rovercheck.checker.commands.shared.verdicts import results
from rovercheck.checker.io.printable import json_text
from rovercheck.checker.model.kept_invariants import invariants_of
from rovercheck.checker.model.load import load
from rovercheck.checker.model.rover import rover
from rovercheck.checker.verify.checked import CheckedProperty, worst
from rovercheck.checker.verify.searches import SearchSettings
from rovercheck.properties.coverage import RequirementCoverage, matrix
from rovercheck.properties.forms import Property, Reachable
from rovercheck.properties.hazards import Hazard, gravest_of

EXPECTED = "Verdicts are those that the baseline expects; --check decides them now."
DECIDED = "Verdicts were decided now."
REACHED = (
    "A requirement is covered by a property that demands something; "
    "one whose properties only say that a state can be reached is not covered."
)
NOTICED = (
    "Nor is one that is only stated: a property that covers it must kill a mutant of the charts "
    "(kills.json), or something wrong with them as they are."
)

SAID = ("violated", "unknown", "proved", "not reached by", "reached by")
"""How the properties of a row are grouped, in this order."""

NOTHING = "neither a property nor a reason"

BAR = "\\|"
"""How a cell of a Markdown table holds a bar."""

Verdicts = Mapping[str, str]
"""The word of the verdict of each property, by id."""


def requirements(decide: bool, as_json: bool, path: Path | None = None) -> Exit:
    """Print the matrix of the rover, or of the model at a path.

    Exit code 1 if a requirement has neither a property that covers it nor a reason.
    """
    model = rover() if path is None else load(path)
    stated, hazards = model.stated(), model.hazards

    def rank(prop: Property) -> int:
        return gravest_of(prop.covers, hazards, model.expected(prop.id).hazard).severity.rank

    rows = matrix(sorted(stated.values(), key=rank), model.requirements, noticing(model))
    if not decide:
        verdicts = {id: model.expected(id).verdict for id in stated}
        return show(rows, verdicts, EXPECTED, as_json, hazards)
    found = [
        CheckedProperty(r, model.expected(r.property.id))
        for r in results(
            list(stated.values()), model.systems, SearchSettings(invariants=invariants_of(model))
        )
    ]
    code = show(rows, words(found), DECIDED, as_json, hazards)
    return code if code != Exit.AS_EXPECTED else worst(found)


def words(found: Sequence[CheckedProperty]) -> Verdicts:
    return {c.result.property.id: c.verdict.word for c in found}


def show(
    rows: Sequence[RequirementCoverage],
    verdicts: Verdicts,
    origin: str,
    as_json: bool,
    hazards: Mapping[str, Hazard] | None = None,
) -> Exit:
    """Print the matrix as a table or as JSON; with the severity of breaking each, if there are hazards."""
    code = Exit.FAILED if any(row.open for row in rows) else Exit.AS_EXPECTED
    if as_json:
        from rovercheck.checker.commands.requirements.document import document

        print(json_text(document(rows, verdicts, origin, code, hazards or {}), ascii=True))
        return code
    severity = [(gravest_of([row.requirement.id], hazards).severity,) if hazards else () for row in rows]
    listed(
        (
            "requirement",
            "state",
            *(("severity",) if hazards else ()),
            "properties, or the reason why none covers it",
        ),
        [
            (row.requirement.id, row.state(verdicts), *bad, because(row, verdicts))
            for row, bad in zip(rows, severity, strict=True)
        ],
    )
    out.print()
    for line in (*counts(rows, verdicts), *_meaning(rows), origin):
        out.print(line, markup=False)
    return code


def _meaning(rows: Sequence[RequirementCoverage]) -> tuple[str, ...]:
    """What covered means."""
    return (REACHED, NOTICED) if any(row.noticing is not None for row in rows) else (REACHED,)


def because(row: RequirementCoverage, verdicts: Verdicts, name: Callable[[str], str] = str) -> str:
    """What speaks for a requirement: its properties, the worst verdicts first, or a reason.

    Of the properties whose verdict is the state of the row only the names are said.
    """
    by: dict[str, list[str]] = {}
    for prop in row.properties:
        by.setdefault(_phrase(prop, verdicts[prop.id]), []).append(name(prop.id))
    state = row.state(verdicts)
    groups = [f"{'' if said == state else said} {', '.join(by[said])}".strip() for said in SAID if said in by]
    return "; ".join(filter(None, (row.requirement.reason.removesuffix("."), *groups))) or NOTHING


def _phrase(prop: Property, verdict: str) -> str:
    if isinstance(prop.form, Reachable):
        return {"proved": "reached by", "violated": "not reached by"}.get(verdict, verdict)
    return verdict


def counts(rows: Sequence[RequirementCoverage], verdicts: Verdicts) -> tuple[str, ...]:
    """How many requirements are in each state, and which are open."""
    states = [row.state(verdicts) for row in rows]
    covered = sum(row.covered for row in rows)
    worse = [f"{states.count(w)} by some {w} property" for w in ("violated", "unknown") if w in states]
    shares = "; ".join((f"{states.count('proved')} by proved properties only", *worse))
    opened = [row.requirement.id for row in rows if row.open]
    first = (
        f"{len(rows)} requirements: {covered} covered ({shares}), {states.count('reason')} with a reason "
        f"instead ({_kinds_of_reasons(rows)}){_only_stated(states)}, {len(opened)} open."
    )
    return (first, f"Open: {', '.join(opened)}.") if opened else (first,)


def _only_stated(states: Sequence[str]) -> str:
    return f", {states.count('stated')} only stated" if "stated" in states else ""


def _kinds_of_reasons(rows: Sequence[RequirementCoverage]) -> str:
    kinds = [row.requirement.reason.partition(":")[0] for row in rows if row.requirement.reason]
    return ", ".join(f"{kinds.count(kind)} {kind}" for kind in dict.fromkeys(kinds)) or "none given"


# --- the page of the reports ---------------------------------------------------------------------


def page(found: Sequence[CheckedProperty]) -> str:
    """The matrix in Markdown, from the verdicts found."""
    rows = matrix((c.result.property for c in found), noticing=noticing(rover()))
    verdicts = words(found)
    lines = ["# Requirements", ""]
    for said in (*counts(rows, verdicts), *_meaning(rows)):
        lines += [said, ""]
    lines += ["| requirement | source | text | state | properties, or the reason why none covers it |"]
    lines += ["|---|---|---|---|---|"]
    for row in rows:
        item = row.requirement
        linked = because(row, verdicts, lambda id: _linked(id, verdicts[id]))
        cells = (item.id, item.source, item.text, row.state(verdicts), linked)
        lines.append(f"| {' | '.join(cell.replace('|', BAR) for cell in cells)} |")
    return "\n".join(lines) + "\n"


def _linked(id: str, verdict: str) -> str:
    return f"[{id}](findings/{id}.md)" if verdict == "violated" else id
