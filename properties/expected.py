"""What a verdict is compared with: an entry of a baseline, and the table of them."""

from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass
from typing import Any, Literal

from rovercheck.spec_model.lang.errors import ModelError, did_you_mean

VerdictWord = Literal["proved", "violated", "unknown"]

EXCEPTIONS = ("violated", "unknown")
FIELDS: dict[str, type] = {"verdict": str, "depth": int, "because": str, "no_repair": str, "no_fault": str}
KINDS: dict[type, str] = {str: "text", int: "whole number"}


@dataclass(frozen=True)
class Expected:
    """An expected verdict: ``depth`` is the length in ticks of the shortest counterexample.

    ``because`` names the transition or sentence that causes it; ``no_repair`` says why no change of a chart
    is proposed, where none is; ``no_fault`` why a proof need not notice any fault of the charts.
    """

    verdict: VerdictWord = "proved"
    depth: int | None = None
    because: str = ""
    no_repair: str = ""
    no_fault: str = ""


def on_record(table: Mapping[str, Any], known: Collection[str], file: str) -> dict[str, Expected]:
    """The verdicts that a baseline file states of the properties ``known``.

    Raises ``ModelError`` with a line for each entry that names no property, has no reason or says
    something else.
    """
    faults = [f"{file}{fault}" for id, row in table.items() for fault in _entry_faults(id, row, known)]
    if faults:
        raise ModelError("\n".join(faults))
    return {id: Expected(**row) for id, row in table.items()}


def _entry_faults(id: str, row: Any, known: Collection[str]) -> Iterator[str]:
    if id not in known:
        yield f" lists {id!r}, which is no property. {did_you_mean(id, known)}"
    if not isinstance(row, dict) or not (_excused(row) or _exception(row)):
        yield f": {id} needs because = and verdict = 'violated' or 'unknown', or no_fault = alone."
        return
    for name, value in row.items():
        if name not in FIELDS:
            yield f": {id} has no {name!r}. {did_you_mean(name, FIELDS)}"
        elif type(value) is not FIELDS[name]:
            yield f": {id} has {name} = {value!r}; write a {KINDS[FIELDS[name]]}."


def _exception(row: Mapping[str, Any]) -> bool:
    """Whether a verdict other than "proved" is expected, with its reason."""
    return bool(row.get("because")) and row.get("verdict") in EXCEPTIONS


def _excused(row: Mapping[str, Any]) -> bool:
    """Whether a proof is expected that notices no fault."""
    return row.keys() == {"no_fault"} and bool(row["no_fault"])
