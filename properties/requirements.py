"""The requirement register: what the source document demands, and where it says so."""

import tomllib
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from rovercheck.spec_model.lang.errors import ModelError, did_you_mean


@dataclass(frozen=True)
class Requirement:
    """One normative sentence.  ``source`` is a section, table or figure of the source document.

    ``checkable`` is "yes", "structural" or "not modelled", perhaps with a remark; ``reason`` says of
    a sentence that no property covers why that is so, and where.
    """

    id: str
    text: str
    source: str
    bounds: str
    kind: str
    checkable: str
    reason: str = ""


PROMISES = (
    "B2-OBS-01", "B1-REF-06", "B1-REL-02", "B1-REL-04",
    "B2-OBS-04", "B1-EST-01", "B1-REF-03", "B1-REF-05", "B1-REL-03", "B2-ACT-01",
)  # fmt: skip
"""What the rover is trusted with: it stops for an obstacle, stands still when something is critical, hands
the motors over; then the same when it is degraded, what else stops it, and who may move it."""


@cache
def requirements() -> dict[str, Requirement]:
    """Every requirement by id, in document order."""
    table = tomllib.loads((Path(__file__).parent / "requirements.toml").read_text(encoding="utf-8"))
    return {id: Requirement(id, **row) for id, row in table.items()}


def requirement(id: str) -> Requirement:
    """The requirement of that id.  Raises ``ModelError`` offering near ids."""
    known = requirements()
    if id not in known:
        raise ModelError(f"There is no requirement {id!r}. {did_you_mean(id, known)}")
    return known[id]
