"""The requirement register: what the source document demands, and where it says so."""

import tomllib
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from spec_model.lang.errors import ModelError, did_you_mean


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
