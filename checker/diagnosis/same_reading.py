"""One stamp is taken in one way: where parts were searched apart, a way that explains all of them is told.

Of ways that explain a part alone the nearest comes first, such as a counter of fewer bits; another part that
reads the same stamp may leave fewer of them.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace

from rovercheck.checker.conformance.deviations import Deviation
from rovercheck.checker.diagnosis.change import ChartChange
from rovercheck.checker.diagnosis.evidence import Evidence
from rovercheck.checker.diagnosis.known_causes import that_hold
from rovercheck.checker.diagnosis.part_causes import SearchedPart


def read_alike(
    evidence: Evidence, parts: Sequence[SearchedPart], deviations: Sequence[Deviation]
) -> list[SearchedPart]:
    """The parts, with one reading of each stamp where one explains as much in all that read it."""
    found = list(parts)
    for stamp in dict.fromkeys(c.at for part in found for c in _readings(part)):
        own = {n: c for n, part in enumerate(found) for c in _readings(part) if c.at == stamp}
        ways = {c.new: c for c in own.values()}
        for wanted in ways.values() if len(ways) > 1 else ():
            made = {n: _with(found[n], old, wanted) for n, old in own.items()}
            if all(_explains(evidence, found[n], one, deviations) for n, one in made.items()):
                found = [made.get(n, one) for n, one in enumerate(found)]
                break
    return found


def _readings(part: SearchedPart) -> Iterator[ChartChange]:
    return (c for c in part.changes if c.kind == "stamp" and c.reading is not None)


def _with(part: SearchedPart, old: ChartChange, wanted: ChartChange) -> SearchedPart:
    """The part with another way to take the stamp."""
    new = replace(wanted, chart=old.chart, inputs=old.inputs)
    causes = tuple(
        (replace(one, change=new) if one.change is not None and one.change.key == old.key else one, places)
        for one, places in part.causes
    )
    return replace(part, causes=causes, changes=tuple(new if c is old else c for c in part.changes))


def _explains(
    evidence: Evidence, before: SearchedPart, after: SearchedPart, deviations: Sequence[Deviation]
) -> bool:
    """Whether all is explained that was."""
    if after.changes == before.changes:
        return True
    asked = after.together(deviations)
    return len(that_hold(evidence, asked).deviations) == len(asked.deviations)


__all__ = ["read_alike"]
