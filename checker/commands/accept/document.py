"""Decisions on findings, which ``rovercheck accept --from`` reads (``checker/schemas/decisions-1.json``)."""

import json
from collections.abc import Iterator, Mapping
from datetime import date
from pathlib import Path
from typing import Any, Literal, NotRequired, cast

from typing_extensions import TypedDict

from rovercheck.checker.commands.shared.codes import UsageError
from rovercheck.checker.commands.shared.text_wrap import whole
from rovercheck.checker.io.document import Text
from rovercheck.spec_model.lang.errors import did_you_mean

SCHEMA = "rovercheck/decisions/1"


class DecisionRecord(TypedDict):
    """What somebody decided about a finding."""

    id: Text
    """The property."""
    decision: Literal["accepted", "open"]
    """Open takes an acceptance back."""
    because: NotRequired[str]
    """Why it is accepted; it may be left out of what is open."""
    owner: NotRequired[str]
    """Who answers for it."""
    until: NotRequired[str]
    """The last day on which it is accepted, such as 2027-03-01; for good if it is left out or empty."""


class DecisionsDocument(TypedDict):
    """What ``rovercheck accept --from`` reads."""

    schema: Literal["rovercheck/decisions/1"]
    decisions: list[DecisionRecord]


def read(file: Path) -> list[DecisionRecord]:
    """The decisions of a file.  Raises ``UsageError`` with a line for each fault."""
    try:
        found: Any = json.loads(file.read_bytes())
    except (ValueError, RecursionError) as error:
        raise UsageError(f"{whole(file)} is no JSON: {error}.") from error
    except OSError as error:
        raise UsageError(f"{whole(file)} cannot be read: {error.strerror}.") from error
    if not isinstance(found, dict) or found.get("schema") != SCHEMA:
        said = found.get("schema") if isinstance(found, dict) else None
        raise UsageError(
            f'{whole(file)} holds no decisions: "schema" is {said!r}; the first line of one is '
            f'{{"schema": "{SCHEMA}", "decisions": [...]}}.'
        )
    rows = found.get("decisions")
    if not isinstance(rows, list) or not rows or found.keys() != {"schema", "decisions"}:
        raise UsageError(
            f'{whole(file)}: write one decision at least, in a list "decisions", and nothing else.'
        )
    faults = [
        f"{whole(file)}, decision {n}: {fault}" for n, row in enumerate(rows, 1) for fault in _faults(row)
    ]
    if faults:
        raise UsageError("\n".join(faults))
    return [cast(DecisionRecord, row) for row in rows]


def _faults(row: Any) -> Iterator[str]:
    if not isinstance(row, Mapping):
        yield f"{row!r} is no object with an id and a decision."
        return
    known = (*DecisionRecord.__required_keys__, *DecisionRecord.__optional_keys__)
    for name, value in row.items():
        if name not in known:
            yield f"there is no {name!r}. {did_you_mean(name, known)}"
        elif not isinstance(value, str):
            yield f"{name} is {value!r}; write a text."
    if not row.get("id"):
        yield "it names no property; write its id."
    if row.get("decision") not in ("accepted", "open"):
        yield f'decision is {row.get("decision")!r}; write "accepted" or "open".'
    until = row.get("until")
    if until and isinstance(until, str):
        try:
            date.fromisoformat(until)
        except ValueError:
            yield f"until is {until!r}, no day; write it as 2027-03-01."


__all__ = ["DecisionRecord", "DecisionsDocument", "read"]
