"""Several stamps that are taken otherwise at once: none of them alone may explain anything.

Two links that write into one record of intervals, one of which is a step late: with one of both most rows are
as wrong as before.  So it is counted how much is wrong, and the reading with which least is comes first.
"""

from collections.abc import Callable, Iterator, Sequence
from math import inf

from rovercheck.checker.conformance.cones import LogCone
from rovercheck.checker.diagnosis.change import ChartChange
from rovercheck.checker.diagnosis.hypotheses import stamp_changes
from rovercheck.checker.diagnosis.pieces import NOT_DECIDED, Wrong, differing
from rovercheck.checker.diagnosis.trial import TrialBench
from rovercheck.spec_model.abstraction.board import with_readings
from rovercheck.spec_model.lang.system import System

MOST_READINGS = 3
"""Readings that are put on top of each other."""

SHORT, WORST, RIGHT = 6, 3, 3
"""Runs that are looked at first: short ones that deviate, those in which most is wrong, some that conform."""

Found = tuple[list[ChartChange], list[Wrong], TrialBench]
"""Readings, what is wrong with them in each run, and the bench with them."""


class StampSearch:
    """Takes one reading after the other, each that with which least is wrong, while anything is."""

    def __init__(self, bench: TrialBench, cone: LogCone, system: System, base: Sequence[Wrong]) -> None:
        self._bench, self._cone, self._system, self._base = bench, cone, system, list(base)

    def found(self, over: Callable[[], bool]) -> Found:
        """What is found in a few runs, tried on all; where it is not enough, more runs are looked at."""
        some, made, bench, wrong = self._first_runs(), list[ChartChange](), self._bench, self._base
        while any(wrong):
            more = self._in_some(some, bench, MOST_READINGS - len(made), over)
            if not more or over():
                break
            made += more
            for change in more:
                bench = bench.with_reading(change.reading)
            every = self._wrong(bench, range(len(self._base)))
            wrong = [] if every is None else [every[n] for n in range(len(self._base))]
            some += sorted(set(range(len(wrong))) - set(some), key=lambda n: -_count(wrong[n]))[:WORST]
        return made, wrong, bench

    def _first_runs(self) -> list[int]:
        deviating = [n for n, wrong in enumerate(self._base) if wrong]
        short = sorted(deviating, key=lambda n: len(self._bench.runs[n]))[:SHORT]
        worst = sorted(deviating, key=lambda n: -_count(self._base[n]))[:WORST]
        right = [n for n, wrong in enumerate(self._base) if not wrong]
        right = sorted(right, key=lambda n: -len(self._bench.runs[n]))[:RIGHT]
        return list(dict.fromkeys((*short, *worst, *right)))

    def _in_some(
        self, runs: Sequence[int], bench: TrialBench, most: int, over: Callable[[], bool]
    ) -> list[ChartChange]:
        """The readings with which least is wrong in some runs."""
        made: list[ChartChange] = []
        now = self._wrong(bench, runs)
        least = 0 if now is None else sum(map(_count, now.values()))
        while least and len(made) < most:
            best: ChartChange | None = None
            for change in self._readings(bench):
                if over():
                    return []
                found = self._wrong(bench.with_reading(change.reading), runs, least)
                if found is not None:
                    least, best = sum(map(_count, found.values())), change
            if best is None:
                break
            made.append(best)
            bench = bench.with_reading(best.reading)
        return made

    def _readings(self, bench: TrialBench) -> Iterator[ChartChange]:
        board = with_readings(bench.evidence.group.board, bench.readings)
        only = frozenset({bench.evidence.name})
        names = {v.name for v in self._cone.system.inputs}
        for change in stamp_changes(board, self._system, only):
            if change.reading not in bench.readings and names.issuperset(change.inputs):
                yield change

    def _wrong(self, bench: TrialBench, runs: Sequence[int], least: float = inf) -> dict[int, Wrong] | None:
        """What is wrong in some runs, if it is less than this."""
        found: dict[int, Wrong] = {}
        count = 0
        for number in runs:
            rows: dict[int, frozenset[tuple[str, int]]] = {}
            for row, mismatch in bench.mismatches(self._cone, number):
                if mismatch is None and not rows and not self._base[number]:
                    break  # a conforming run that is left open: the judge of rows counts these
                rows[row] = NOT_DECIDED if mismatch is None else differing(mismatch)
                count += len(rows[row])
                if count >= least:
                    return None
            found[number] = rows
        return found


def _count(wrong: Wrong) -> int:
    return sum(map(len, wrong.values()))


__all__ = ["StampSearch"]
