"""``rovercheck diff --format json``: what changed, for machines (``checker/schemas/diff-1.json``)."""

from collections.abc import Mapping, Sequence
from typing import Literal

from typing_extensions import TypedDict

from rovercheck.checker.commands.check.document import VerdictRow
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.commands.shared.told import Word
from rovercheck.checker.io.document import Count, Text

How = Literal["worse", "better", "other run", "new", "gone"]
RANK: Mapping[str, int] = {"violated": 0, "unknown": 1, "proved": 2}
"""Verdicts, the worst first."""


class VerdictChange(TypedDict):
    """A property whose verdict is another one than before."""

    id: Text
    text: str
    """The property in words."""
    how: How
    before: Word | None
    """Null of a property that is new."""
    after: Word | None
    """Null of a property that is gone."""
    ticks_before: Count | None
    """The length of the run, if the verdict rests on one."""
    ticks_after: Count | None
    evidence: str
    """What the verdict rests on, the later one where there is one."""


class DiffDocument(TypedDict):
    """What ``rovercheck diff --format json`` prints."""

    schema: Literal["rovercheck/diff/1"]
    before: str
    """The commit compared with."""
    after: str
    """The commit that is compared; empty for the working tree."""
    same: Count
    """How many properties have the same verdict as before."""
    changes: list[VerdictChange]
    """The worse ones first."""
    run: str
    """The shortest run that was not there before, as text; empty if there is none."""
    exit: Exit


ORDER: Sequence[How] = ("worse", "gone", "better", "other run", "new")


def changes(before: Sequence[VerdictRow], after: Sequence[VerdictRow]) -> list[VerdictChange]:
    """What changed between two checks, the worse first."""
    old, new = {row["id"]: row for row in before}, {row["id"]: row for row in after}
    found = [one for id in {**old, **new} if (one := _change(old.get(id), new.get(id))) is not None]
    return sorted(found, key=lambda one: (ORDER.index(one["how"]), one["ticks_after"] or 0, one["id"]))


def _change(old: VerdictRow | None, new: VerdictRow | None) -> VerdictChange | None:
    how = _how(old, new)
    shown = new or old
    if how is None or shown is None:
        return None
    return {
        "id": shown["id"],
        "text": shown["text"],
        "how": how,
        "before": None if old is None else old["verdict"],
        "after": None if new is None else new["verdict"],
        "ticks_before": None if old is None else old["ticks"],
        "ticks_after": None if new is None else new["ticks"],
        "evidence": shown["evidence"],
    }


def _how(old: VerdictRow | None, new: VerdictRow | None) -> How | None:
    """How a verdict changed; None if it did not."""
    if old is None:
        return "new"
    if new is None:
        return "gone"
    if old["verdict"] != new["verdict"]:
        return "worse" if RANK[new["verdict"]] < RANK[old["verdict"]] else "better"
    if old["in_part"] != new["in_part"]:
        return "worse" if new["in_part"] else "better"
    return "other run" if old["ticks"] != new["ticks"] else None


def code(found: Sequence[VerdictChange]) -> Exit:
    """1 if something is worse, or gone."""
    worse = any(one["how"] in ("worse", "gone") for one in found)
    return Exit.FAILED if worse or any(_violated(one) for one in found) else Exit.AS_EXPECTED


def _violated(one: VerdictChange) -> bool:
    return one["how"] == "new" and one["after"] == "violated"
