"""What a verdict is compared with: an entry of a baseline, and the table of them."""

from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass
from datetime import date, datetime
from typing import Any, Literal

from rovercheck.spec_model.lang.errors import ModelError, did_you_mean

VerdictWord = Literal["proved", "violated", "unknown"]

EXCEPTIONS = ("violated", "unknown")
FIELDS: dict[str, type] = {
    "verdict": str, "depth": int, "because": str, "no_repair": str, "no_fault": str,
    "effect": str, "hazard": str, "same_cause": str, "since": date, "accepted": dict,
}  # fmt: skip
KINDS: dict[type, str] = {
    str: "text", int: "whole number", date: "date such as 2026-03-01, without quotes", dict: "table",
}  # fmt: skip
ACCEPTED = "accepted"
"""The table, below an entry, of who lives with the finding."""
ACCEPTANCE: dict[str, type] = {"because": str, "owner": str, "on": date, "until": date}


@dataclass(frozen=True)
class Acceptance:
    """That somebody lives with a finding, and why.

    ``owner`` answers for it, ``on`` is when it was decided, ``until`` the last day on which it holds; without
    one it holds for good.
    """

    because: str
    owner: str = ""
    on: date | None = None
    until: date | None = None

    @property
    def expired(self) -> bool:
        """Whether its last day is over, by the clock of this machine."""
        return self.until is not None and self.until < date.today()

    @property
    def term(self) -> str:
        """``by A. Rossi until 2027-03-01``; empty if neither is said."""
        by = f"by {self.owner}" if self.owner else ""
        return " ".join(filter(None, (by, f"until {self.until}" if self.until else "")))


@dataclass(frozen=True)
class Expected:
    """An expected verdict: ``depth`` is the length in ticks of the shortest counterexample.

    ``because`` names the transition or sentence that causes it, ``same_cause`` another finding that has this
    cause too; ``no_repair`` says why no change of a chart is proposed, where none is; ``no_fault`` why a
    proof need not notice any fault of the charts.  ``effect`` is what goes wrong, in one sentence; ``hazard``
    what may come of it, where it is not the gravest hazard of the requirements that are broken.  ``since`` is
    when the finding became known, ``accepted`` who lives with it: it is open as long as nobody does.
    """

    verdict: VerdictWord = "proved"
    depth: int | None = None
    because: str = ""
    no_repair: str = ""
    no_fault: str = ""
    effect: str = ""
    hazard: str = ""
    same_cause: str = ""
    since: date | None = None
    accepted: Acceptance | None = None

    @property
    def expired(self) -> Acceptance | None:
        """The acceptance, if its last day is over."""
        return self.accepted if self.accepted is not None and self.accepted.expired else None


def on_record(
    table: Mapping[str, Any], known: Collection[str], file: str, hazards: Collection[str] = ()
) -> dict[str, Expected]:
    """The verdicts that a baseline file states of the properties ``known``.

    Raises ``ModelError`` with a line for each entry that names no property or hazard, has no reason or says
    something else.
    """
    faults = [f"{file}{fault}" for id, row in table.items() for fault in _entry_faults(id, row, known)]
    if not faults:
        faults = [f"{file}{fault}" for id in table for fault in _links(id, table, hazards)]
    if faults:
        raise ModelError("\n".join(faults))
    return {id: _entry(row) for id, row in table.items()}


def _entry(row: Mapping[str, Any]) -> Expected:
    accepted = row.get(ACCEPTED)
    return Expected(**{**row, ACCEPTED: None if accepted is None else Acceptance(**accepted)})


def _entry_faults(id: str, row: Any, known: Collection[str]) -> Iterator[str]:
    if id not in known:
        yield f" lists {id!r}, which is no property. {did_you_mean(id, known)}"
    if not isinstance(row, dict) or not (_excused(row) or _exception(row)):
        yield f": {id} needs because = and verdict = 'violated' or 'unknown', or no_fault = alone."
        return
    yield from _kind_faults(id, row, FIELDS)
    accepted = row.get(ACCEPTED)
    if isinstance(accepted, dict):
        yield from _kind_faults(f"{id}, {ACCEPTED},", accepted, ACCEPTANCE)
        because = accepted.get("because", "")
        if isinstance(because, str) and not because.strip():
            yield f": {id} is accepted without a reason; write because = in its table .{ACCEPTED}."


def _kind_faults(id: str, row: Mapping[str, Any], fields: Mapping[str, type]) -> Iterator[str]:
    for name, value in row.items():
        if name not in fields:
            yield f": {id} has no {name!r}. {did_you_mean(name, fields)}"
        elif type(value) is not fields[name]:
            shown = str(value) if isinstance(value, date | datetime) else repr(value)
            yield f": {id} has {name} = {shown}; write a {KINDS[fields[name]]}."


def _links(id: str, table: Mapping[str, Any], hazards: Collection[str]) -> Iterator[str]:
    """What an entry names that is not there."""
    row = table[id]
    hazard, cause = row.get("hazard", ""), row.get("same_cause", "")
    if hazard and not hazards:
        yield f": {id} names the hazard {hazard!r}, and there is none; write hazards.toml beside the model."
    elif hazard and hazard not in hazards:
        yield f": {id} names {hazard!r}, no hazard. {did_you_mean(hazard, hazards)}"
    if cause and (cause not in table or cause == id):
        near = did_you_mean(cause, table.keys() - {id})
        yield f": {id} names {cause!r} as the finding with the same cause, which is no other entry. {near}"


def _exception(row: Mapping[str, Any]) -> bool:
    """Whether a verdict other than "proved" is expected, with its reason or that of who accepts it."""
    return bool(row.get("because") or row.get(ACCEPTED)) and row.get("verdict") in EXCEPTIONS


def _excused(row: Mapping[str, Any]) -> bool:
    """Whether a proof is expected that notices no fault."""
    return row.keys() == {"no_fault"} and bool(row["no_fault"])
