"""The file of a variant that the command line names: which board it changes, and how."""

from collections.abc import Mapping
from pathlib import Path

from rovercheck.checker.commands.shared.codes import UsageError
from rovercheck.checker.compare.variants import of_model, varied
from rovercheck.checker.diagnosis.changed_charts import ChartChanges
from rovercheck.checker.diagnosis.variant import BoardVariant, VariantError, read_variant
from rovercheck.checker.model.variant import Variant
from rovercheck.spec_model.abstraction import Board
from rovercheck.spec_model.lang.errors import ModelError, did_you_mean


def read_changes(file: Path, variant: Variant) -> ChartChanges:
    """The changes in a file, each of which there is on the board as the variant has it.

    Raises ``UsageError`` for a file without meaning, or that of another model.
    """
    try:
        return changes_of(file, read_variant(file), variant)
    except VariantError as error:
        raise UsageError(str(error)) from error


def changes_of(file: Path, written: BoardVariant, variant: Variant) -> ChartChanges:
    """Changes as they are written.  Raises ``VariantError`` where they do not fit."""
    found = ChartChanges(file, written, _board(file, written.board, variant))
    found.applied(found.board)
    return found


def _board(file: Path, name: str, variant: Variant) -> Board:
    if variant.own is not None:
        try:
            return of_model(variant.own, name)
        except ModelError as error:
            raise VariantError(f"{file}: {error}") from error
    boards: Mapping[str, Board] = varied(variant.choices, variant.repair)
    if name not in boards:
        raise VariantError(f"{file}: there is no board {name!r}. {did_you_mean(name, boards)}")
    return boards[name]


__all__ = ["changes_of", "read_changes"]
