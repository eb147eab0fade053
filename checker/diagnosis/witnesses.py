"""What a change must get past before all runs are tried with it: the first cases of each deviation."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from itertools import islice

from rovercheck.checker.conformance.cones import LogCone
from rovercheck.checker.conformance.program import Known
from rovercheck.checker.diagnosis.cover import Witness
from rovercheck.checker.diagnosis.evidence import logged_of
from rovercheck.checker.diagnosis.pieces import Pieces, Wrong
from rovercheck.checker.diagnosis.trial import TrialBench

WITNESSES = 2
"""Runs in which a deviation comes first that a change must get past."""


def first_cases(
    bench: TrialBench,
    cone: LogCone,
    base: Sequence[Wrong],
    rows: Mapping[int, Pieces],
    left: Iterable[int],
) -> list[Witness]:
    """For each deviation that is left runs in which it is met early, what differs before being masked.

    Those which the part passes as it is would keep nothing out.
    """
    found: dict[int, list[Witness]] = {}
    for place in left:
        own: dict[int, set[int]] = {}
        for run, row in rows[place]:
            if row in base[bench.numbers[run]]:
                own.setdefault(bench.numbers[run], set()).add(row)
        for number, wrong in own.items():
            first = last = min(wrong)
            while last + 1 in wrong:
                last += 1
            before = [row for row in base[number] if row < first]
            found.setdefault(place, []).append(Witness(place, number, last, len(before)))
    chosen: list[Witness] = []
    for some in found.values():
        ordered = sorted(some, key=lambda w: w.rank)
        masked = (replace(w, masked=_masked(bench, cone, base, rows[w.place], w)) for w in ordered)
        failed = (w for w in masked if not bench.passes(cone, w.number, w.last, None, w.masked))
        chosen += islice(failed, WITNESSES)
    return sorted(chosen, key=lambda w: w.rank)


def _masked(
    bench: TrialBench, cone: LogCone, base: Sequence[Wrong], own: Pieces, one: Witness
) -> dict[int, Known]:
    """The outputs of the rows in which other deviations differ, without what differs by these."""
    run, names = bench.runs[one.number], [o.name for o in cone.outputs]
    logged = logged_of(cone, run)
    masked: dict[int, Known] = {}
    for row, pieces in base[one.number].items():
        wrong = {name for name, _ in pieces - own.get((id(run), row), frozenset())}
        if row <= one.last and wrong:
            values = zip(names, logged[row], strict=True)
            masked[row] = tuple(None if name in wrong else value for name, value in values)
    return masked


__all__ = ["first_cases"]
