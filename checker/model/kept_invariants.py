"""Inductive invariants kept beside the expected verdicts: what a proof found once is only shown again.

A file of them is no evidence.  Its formulas are tried; those that are no invariant of the charts as they are
now are dropped, and what the others do not show is searched for.
"""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from rovercheck.checker.model import Model
from rovercheck.checker.model.kept_runs import INVARIANTS, ROVER, contents, file_of, lines
from rovercheck.checker.results.verdict import Inductive
from rovercheck.checker.system.formula_json import Tree, size, written

Invariants = Mapping[str, tuple[Tree, ...]]
"""By the id of a property the conjuncts of its proof, as ``checker.system.formula_json`` writes formulas."""

MOST_NODES = 100_000
"""Operators, variables and numbers of the formulas of one proof that is kept."""


def read(file: Path) -> Invariants:
    """The invariants in a file, none if there is no file.

    Raises ``ModelError`` for a file that holds something else.
    """
    return contents(file, INVARIANTS, INVARIANTS, _invariants)


def invariants_of(model: Model) -> Invariants:
    """The invariants on record for a model.  Raises ``ModelError`` as ``read`` does."""
    return read(file_of(model, INVARIANTS))


def invariants_of_rover() -> Invariants:
    """The invariants on record for the rover.  Raises ``ModelError`` as ``read`` does."""
    return read(ROVER / f"{INVARIANTS}.json")


def text(recorded: Invariants) -> str:
    """The invariants as JSON, those of a property a line."""
    return lines(INVARIANTS, INVARIANTS, {id: list(trees) for id, trees in recorded.items()})


def row(invariant: Inductive) -> tuple[Tree, ...] | None:
    """What is kept of an invariant; None where its formulas are too large."""
    large = sum(map(size, invariant.conjuncts)) > MOST_NODES
    return None if large else tuple(map(written, invariant.conjuncts))


def _invariants(rows: Any) -> dict[str, tuple[Tree, ...]]:
    wrong = [id for id, trees in rows.items() if not isinstance(trees, list)]
    if wrong:
        raise ValueError(f"{wrong[0]} has {str(rows[wrong[0]])[:40]}, no list of formulas")
    return {id: tuple(trees) for id, trees in rows.items()}
