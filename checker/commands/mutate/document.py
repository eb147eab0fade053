"""``rovercheck mutate --json``: every mutant with its fate (``checker/schemas/mutate-1.json``)."""

from collections import Counter
from typing import Annotated, Literal

from annotated_types import MinLen
from typing_extensions import TypedDict

from rovercheck.checker.commands.mutate.results import MutationResults, One
from rovercheck.checker.commands.mutate.text import sketch
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.io.document import Count, Text
from rovercheck.checker.mutate.fate import Fate
from rovercheck.checker.mutate.observation import AllowedBy, MutantDifference


class TellingRun(TypedDict):
    """A run after whose last tick the mutant is seen to differ; all values as people read them."""

    inputs: Annotated[list[dict[str, str]], MinLen(1)]
    frozen: dict[str, str]
    places: dict[str, str]
    """The state of each chart before the last tick."""
    original: dict[str, str]
    """What differs after the last tick, in the original."""
    mutant: dict[str, str]
    shortest: bool
    allowed_by: AllowedBy | None
    """Only this one allows the inputs of the last tick."""
    sketch: str
    """What a property could demand, in words."""


class MutantRow(TypedDict):
    """A mutant and what becomes of it."""

    id: Text
    operator: Text
    text: str
    """The fault in words."""
    place: str | None
    """File and line."""
    system: str
    """The system that the fault was put into first."""
    fate: Fate
    killer: str | None
    """The id of the property, or in parentheses why the commands refuse the mutant."""
    killer_system: str | None
    ticks: int | None
    """Of the run that kills it."""
    shortest: bool
    """No shorter run of the killer kills it."""
    because: str | None
    """The proof, or the reason of what is not known."""
    properties_decided: Count
    properties_open: Count
    difference: TellingRun | None


class MutateDocument(TypedDict):
    """What ``rovercheck mutate --json`` prints."""

    schema: Literal["rovercheck/mutate/1"]
    complete: bool
    """False after an interruption: this is what was found so far."""
    exit: Exit
    systems: list[str]
    """The systems named, else those that faults are put into."""
    made: Count
    """All mutants of the systems."""
    chosen: Count
    """Those that were to be judged: fewer with --sample."""
    seed: int | None
    """The seed of --sample."""
    counts: dict[Fate, Count]
    """How many mutants have each fate."""
    undecided: list[str]
    """Properties that are not decided of the original, and were not asked."""
    mutants: list[MutantRow]


def document(found: MutationResults, code: Exit) -> MutateDocument:
    """All of it for machines."""
    by = Counter(judged.fate for _, _, judged in found.judged)
    return {
        "schema": "rovercheck/mutate/1",
        "complete": code is not Exit.INTERRUPTED,
        "exit": code,
        "systems": list(found.systems),
        "made": found.made,
        "chosen": found.chosen,
        "seed": found.seed,
        "counts": {fate: by[fate] for fate in Fate},
        "undecided": list(found.undecided),
        "mutants": [_row(one) for one in found.judged],
    }


def _row(one: One) -> MutantRow:
    system, mutant, judged = one
    return {
        "id": mutant.id,
        "operator": mutant.operator,
        "text": mutant.text,
        "place": None if mutant.place is None else str(mutant.place),
        "system": system,
        "fate": judged.fate,
        "killer": judged.killer or None,
        "killer_system": judged.on or None,
        "ticks": judged.ticks,
        "shortest": judged.shortest,
        "because": judged.why or None,
        "properties_decided": judged.asked,
        "properties_open": judged.open,
        "difference": None if judged.difference is None else _difference(judged.difference),
    }


def _difference(found: MutantDifference) -> TellingRun:
    return {
        "inputs": [dict(tick) for tick in found.inputs],
        "frozen": dict(found.frozen),
        "places": dict(found.places),
        "original": dict(found.original),
        "mutant": dict(found.mutant),
        "shortest": found.shortest,
        "allowed_by": found.allowed_by,
        "sketch": sketch(found),
    }


__all__ = ["document"]
