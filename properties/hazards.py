"""Hazards: what may come of a requirement that is broken, and how bad that would be."""

import tomllib
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from functools import cache
from pathlib import Path
from typing import Any

from rovercheck.properties.requirements import requirements
from rovercheck.spec_model.lang.errors import ModelError, did_you_mean


class Severity(StrEnum):
    """How bad it is if it happens, the gravest first: the words of MIL-STD-882E, and one where nobody said.

    What is ``unrated`` stands before what was rated negligible: nobody has said that it does no harm.
    """

    CATASTROPHIC = "catastrophic"
    CRITICAL = "critical"
    MARGINAL = "marginal"
    UNRATED = "unrated"
    NEGLIGIBLE = "negligible"

    @property
    def rank(self) -> int:
        """0 for the gravest."""
        return list(Severity).index(self)


RATED = tuple(word for word in Severity if word is not Severity.UNRATED)
"""What a hazard may be."""


@dataclass(frozen=True)
class Hazard:
    """What may come of breaking one of the ``requirements``; ``because`` says what the severity rests on."""

    id: str
    text: str
    severity: Severity
    because: str
    requirements: tuple[str, ...]


UNRATED = Hazard("", "No hazard names what is broken.", Severity.UNRATED, "", ())
"""What stands in the place of a hazard for requirements that none names."""

FIELDS = ("text", "severity", "because", "requirements")


@cache
def hazards() -> dict[str, Hazard]:
    """The hazards of the rover by id, the gravest first.  Raises ``ModelError`` for a faulty file."""
    table = tomllib.loads((Path(__file__).parent / "hazards.toml").read_text(encoding="utf-8"))
    return hazards_in(table, requirements(), "hazards.toml")


def hazards_in(table: Mapping[str, Any], known: Collection[str] | None, file: str) -> dict[str, Hazard]:
    """The hazards that a file states, the gravest first, those of one severity in its order.

    ``known`` are the ids of the requirements, None if they are not known.  Raises ``ModelError`` with a line
    for each fault.
    """
    faults = [f"{file}: {id} {fault}" for id, row in table.items() for fault in _faults(row, known)]
    if faults:
        raise ModelError("\n".join(dict.fromkeys(faults)))
    found = (
        Hazard(id, row["text"], Severity(row["severity"]), row["because"], tuple(row["requirements"]))
        for id, row in table.items()
    )
    return {one.id: one for one in sorted(found, key=lambda one: one.severity.rank)}


def _faults(row: Any, known: Collection[str] | None) -> Iterator[str]:
    if not isinstance(row, Mapping):
        yield f"is {row!r}; write a table with {', '.join(FIELDS)}."
        return
    for name in row:
        if name not in FIELDS:
            yield f"has no {name!r}. {did_you_mean(name, FIELDS)}"
    for name in ("text", "because"):
        if not isinstance(row.get(name), str) or not row[name].strip():
            yield f"has {name} = {row.get(name, '')!r}; write a sentence."
    if row.get("severity") not in RATED:
        yield f"has severity = {row.get('severity', '')!r}; write {_one_of(RATED)}."
    listed = row.get("requirements")
    if not isinstance(listed, list) or not listed or not all(isinstance(id, str) for id in listed):
        yield f"has requirements = {listed!r}; write the ids of one at least, in a list."
        return
    for id in listed:
        if known is not None and id not in known:
            yield f"names {id!r}, no requirement. {did_you_mean(id, known)}"
        elif listed.count(id) > 1:
            yield f"names {id} twice; delete one."


def _one_of(words: Sequence[str]) -> str:
    return f"{', '.join(words[:-1])} or {words[-1]}"


def gravest_of(covered: Iterable[str], known: Mapping[str, Hazard], named: str = "") -> Hazard:
    """The hazard of breaking one of some requirements: the one ``named``, else the gravest of them.

    ``known`` is in the order of ``hazards_in``.  ``UNRATED`` if there is none, as where no hazard is known.
    """
    if named in known:
        return known[named]
    ids = set(covered)
    return next((one for one in known.values() if not ids.isdisjoint(one.requirements)), UNRATED)
