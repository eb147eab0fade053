"""``rovercheck mutate --json``: every mutant with its fate, as ``checker/schemas/mutate-1.json`` says."""

from collections import Counter

from rovercheck.checker.commands.mutate.results import MutationResults, One
from rovercheck.checker.commands.mutate.text import sketch
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.mutate.fate import Fate
from rovercheck.checker.mutate.observation import MutantDifference

SCHEMA = 1


def document(found: MutationResults, code: Exit) -> dict[str, object]:
    """All of it for machines."""
    by = Counter(judged.fate for _, _, judged in found.judged)
    return {
        "schema": f"rovercheck/mutate/{SCHEMA}",
        "complete": code is not Exit.INTERRUPTED,
        "exit": int(code),
        "systems": list(found.systems),
        "made": found.made,
        "chosen": found.chosen,
        "seed": found.seed,
        "counts": {fate.value: by[fate] for fate in Fate},
        "undecided": list(found.undecided),
        "mutants": [_row(one) for one in found.judged],
    }


def _row(one: One) -> dict[str, object]:
    system, mutant, judged = one
    return {
        "id": mutant.id,
        "operator": mutant.operator,
        "text": mutant.text,
        "place": None if mutant.place is None else str(mutant.place),
        "system": system,
        "fate": judged.fate.value,
        "killer": judged.killer or None,
        "killer_system": judged.on or None,
        "ticks": judged.ticks,
        "shortest": judged.shortest,
        "because": judged.why or None,
        "properties_decided": judged.asked,
        "properties_open": judged.open,
        "difference": None if judged.difference is None else _difference(judged.difference),
    }


def _difference(found: MutantDifference) -> dict[str, object]:
    return {
        "inputs": [dict(tick) for tick in found.inputs],
        "frozen": dict(found.frozen),
        "places": dict(found.places),
        "original": dict(found.original),
        "mutant": dict(found.mutant),
        "shortest": found.shortest,
        "allowed_by": found.allowed_by or None,
        "sketch": sketch(found),
    }


__all__ = ["document"]
