"""A variant written from causes that were found: the charts as some implementation has them."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from rovercheck.checker.commands.shared.codes import UsageError
from rovercheck.checker.commands.shared.output import write
from rovercheck.checker.diagnosis.change import ChartChange
from rovercheck.checker.diagnosis.sentences import like
from rovercheck.checker.diagnosis.variant import WrittenChange, written


@dataclass(frozen=True)
class FoundVariant:
    """Changes of a board in the order in which they are made, and what was compared with them."""

    board: str
    changes: Sequence[ChartChange | WrittenChange]
    evidence: str


def write_variant(target: Path, found: Sequence[FoundVariant]) -> str:
    """Write the variant of the one board that has changes; what was done, in a sentence.

    Raises ``UsageError`` where two boards have some, and where the file cannot be written.
    """
    changed = [one for one in found if one.changes]
    if not changed:
        return f"No cause was found, and no variant is written to {target}."
    if len(changed) > 1:
        names = " and ".join(one.board for one in changed)
        raise UsageError(f"A variant is one of one board, and causes are in {names}; choose with --system.")
    [one] = changed
    said = [f"{c.chart} behaves {like(c)}." if isinstance(c, ChartChange) else "" for c in one.changes]
    write(written(one.board, one.changes, said, one.evidence), target)
    return f"The variant is in {target}."


__all__ = ["FoundVariant", "write_variant"]
