"""``rovercheck import --json``: what stands in a file of charts (``checker/schemas/import-1.json``)."""

from collections.abc import Sequence
from dataclasses import asdict
from typing import Any, Literal

from typing_extensions import TypedDict

from rovercheck.checker.commands.import_.lowering import LoweringReport
from rovercheck.checker.commands.import_.recorded import RecordingComparison
from rovercheck.checker.drawn.records import DrawnModel
from rovercheck.checker.drawn.refused import DrawingNote
from rovercheck.checker.results.exit_code import Exit


class ImportDocument(TypedDict):
    """What ``rovercheck import --json`` prints."""

    schema: Literal["rovercheck/import/1"]
    exit: Exit
    model: DrawnModel
    """What stands in the file, as it is written there."""
    notes: Sequence[DrawingNote]
    """What has no meaning here, or is read otherwise than it is drawn."""
    lowered: LoweringReport | None
    """Whether it can be checked, and as which system; null where something has no meaning here."""
    compared: RecordingComparison | None
    """With ``--compare``: the model beside a log."""


def document(
    model: DrawnModel,
    notes: Sequence[DrawingNote],
    lowered: LoweringReport | None,
    compared: RecordingComparison | None,
    code: Exit,
) -> dict[str, Any]:
    """A model as JSON; its fields are those of :class:`ImportDocument`."""
    return {
        "schema": "rovercheck/import/1",
        "exit": code,
        "model": asdict(model),
        "notes": [asdict(note) for note in notes],
        "lowered": None if lowered is None else asdict(lowered),
        "compared": None if compared is None else asdict(compared),
    }


__all__ = ["ImportDocument", "document"]
