"""How long something lasted before a part deviated, and before it went on: times that a timer may have."""

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise

from rovercheck.checker.conformance.recording import Cells
from rovercheck.checker.diagnosis.evidence import PartEvidence

MOST, OWN = 40, 20
"""Durations that are tried, and how many of them since the part's own outputs changed."""
LONGEST = 700
"""Steps of the longest one that is looked for."""
USUAL = (5, 10, 25, 50, 100, 150, 200, 250)
CASES = 10
"""Cases of a run that are looked at."""


def durations(evidence: PartEvidence) -> list[int]:
    """In steps, the likeliest first: since outputs of the part last changed, as a state is entered then.

    A time that is shorter ends where the part begins to deviate.  Of a longer one the part deviates in the
    step in which the charts go on, and is followed from what it does: the time ends at its next change.
    """
    since, found = Counter[int](), Counter[int]()
    own = [o.var.name for o in evidence.cone.outputs]
    names = [*(v.name for v in evidence.cone.system.inputs), *own]
    for run in evidence.deviating:
        columns = [c for n in names if (c := run.columns.get(n)) and not _ages(c)]
        outputs = [c for n in own if (c := run.columns.get(n))]
        for case in run.cases(evidence.name)[:CASES]:
            for edge in (case.first, case.last + 1, _next_change(outputs, case.last + 1)):
                nearest = next(_changed_before(outputs, edge), None)
                since.update(() if nearest is None else _about(nearest))
                for back in _changed_before(columns, edge):
                    found.update(_about(back))
    some = _likely(since, OWN)
    rest = [n for n in _likely(found, MOST) if n not in some]
    return [*some, *rest[: MOST - len(some)], *USUAL]


def _about(steps: int) -> tuple[int, int, int]:
    return (steps - 1, steps, steps + 1)


def _likely(found: Counter[int], most: int) -> list[int]:
    return sorted(found, key=lambda n: (-found[n], n))[:most]


def _next_change(outputs: Iterable[Cells], row: int) -> int:
    """The first row, from one on, in which an output is another than before; 0 if there is none soon."""
    rows = (at for c in outputs for at in range(row, min(len(c), row + LONGEST)) if c[at] != c[at - 1])
    return min(rows, default=0)


def _changed_before(columns: Sequence[Cells], row: int) -> Iterator[int]:
    """How many rows before one some column is another than before that, the nearest first."""
    for back in range(1, min(row, LONGEST)):
        at = row - back
        if any(at < len(c) and c[at] != c[at - 1] for c in columns):
            yield back


def _ages(cells: Cells) -> bool:
    """Whether a column changes in most rows."""
    some = cells[:400]
    return sum(a != b for a, b in pairwise(some)) > len(some) / 4


__all__ = ["durations"]
