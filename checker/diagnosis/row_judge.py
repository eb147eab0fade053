"""What is wrong with a changed part, run by run, and which deviations are explained by it."""

from collections.abc import Iterable, Iterator, Mapping, Sequence

from rovercheck.checker.conformance.cones import LogCone
from rovercheck.checker.diagnosis.pieces import NOT_DECIDED, Pieces, Wrong, differing
from rovercheck.checker.diagnosis.trial import Parameter, TrialBench

LIKELY = 3
"""Conforming runs that have contradicted most changes, with which a change is tried first."""

OPEN = 10
"""Of so many conforming runs one may be left open by a change, such as one in which columns are lost."""


class RowJudge:
    """Says what is wrong with changed parts; ``rows`` are those of each deviation, by its place.

    Runs that contradict often are looked at first.
    """

    def __init__(self, rows: Mapping[int, Pieces]) -> None:
        self._rows = rows
        self._contradictions: dict[int, int] = {}

    def of_rows(self, rows: Mapping[int, Pieces]) -> "RowJudge":
        """The same for deviations of other rows; what contradicts often still does."""
        made = RowJudge(rows)
        made._contradictions = self._contradictions
        return made

    def mostly_right(self, bench: TrialBench, base: Sequence[Wrong], cone: LogCone) -> list[Wrong] | None:
        """What is wrong with a changed part in each run; ``None`` if something is earlier than before."""
        found: list[Wrong] = [{} for _ in base]
        left_open = 0
        for number in self._order(base):
            before = base[number]
            if not before:
                holds = bench.holds(cone, number)
                left_open += holds is None
                wrong = holds is False or left_open > _conforming(base) // OPEN
            else:
                found[number] = dict(_rows_of(bench, cone, number, None, before))
                wrong = min(found[number], default=len(bench.runs[number])) < min(before)
            if wrong:
                self._contradictions[number] = self._contradictions.get(number, 0) + 1
                return None
        return found

    def all_right(
        self,
        bench: TrialBench,
        base: Sequence[Wrong],
        cone: LogCone,
        parameter: Parameter | None,
        concerned: frozenset[int],
    ) -> list[Wrong] | None:
        """What is wrong with a changed part in each run.

        ``None`` if something is that was right before, or if none of those concerned is explained.  A number
        that is left open is not known in steps that were not recorded: with it more may be open.
        """
        found: list[Wrong] = [{} for _ in base]
        left, left_open = concerned, 0
        for number in self._order(base):
            before = base[number]
            if not before:
                holds = bench.holds(cone, number, parameter)
                left_open += holds is None
                too_many = parameter is None and left_open > _conforming(base) // OPEN
                wrong = holds is False or too_many
            else:
                rows = _within(bench, cone, number, parameter, before)
                wrong = rows is None
                found[number] = rows or {}
                left = frozenset(n for n in left if not self._is_wrong(n, bench, number, found[number]))
            if wrong:
                self._contradictions[number] = self._contradictions.get(number, 0) + 1
            if wrong or not left:
                return None
        return found

    def explained(self, places: frozenset[int], bench: TrialBench, wrong: Sequence[Wrong]) -> frozenset[int]:
        """The deviations of which all rows that count are right, as far as they are their own."""
        return frozenset(
            place
            for place in self.decided(places, bench)
            if not any(self._is_wrong(place, bench, number, rows) for number, rows in enumerate(wrong))
        )

    def decided(self, places: Iterable[int], bench: TrialBench) -> frozenset[int]:
        """The deviations of which some row counts."""
        return frozenset(place for place in places if bench.decides(self._rows[place]))

    def _is_wrong(self, place: int, bench: TrialBench, number: int, wrong: Wrong) -> bool:
        """Whether some row of a deviation that counts is wrong in a run, as far as it is its own."""
        run, end = id(bench.runs[number]), bench.end(number)
        own = self._rows[place]
        return any(row < end and pieces & own.get((run, row), frozenset()) for row, pieces in wrong.items())

    def _order(self, base: Sequence[Wrong]) -> list[int]:
        """Some conforming runs that contradict often, all that deviate, and the other ones."""
        every = sorted(range(len(base)), key=lambda n: -self._contradictions.get(n, 0))
        conforming = [n for n in every if not base[n]]
        deviating = [n for n in every if base[n]]
        return [*conforming[:LIKELY], *deviating, *conforming[LIKELY:]]


def _conforming(base: Sequence[Wrong]) -> int:
    return sum(not wrong for wrong in base)


def _within(
    bench: TrialBench, cone: LogCone, number: int, parameter: Parameter | None, base: Wrong
) -> Wrong | None:
    """The rows of a run that are wrong with a changed part; ``None`` if one is that was right before.

    Nor may it leave such a row open, unless the part does not decide that run to its end without it, either.
    """
    may_be_open = parameter is not None or not bench.decided(number)
    found: dict[int, frozenset[tuple[str, int]]] = {}
    for row, wrong in _rows_of(bench, cone, number, parameter, base):
        if row in base:
            found[row] = wrong
        elif wrong is not NOT_DECIDED or not may_be_open:
            return None
    return found


def _rows_of(
    bench: TrialBench, cone: LogCone, number: int, parameter: Parameter | None, base: Wrong
) -> Iterator[tuple[int, frozenset[tuple[str, int]]]]:
    """The rows that are wrong with a changed part; one that is not decided is as wrong as before."""
    for row, mismatch in bench.mismatches(cone, number, parameter):
        yield row, base.get(row, NOT_DECIDED) if mismatch is None else differing(mismatch)
    yield from ((row, wrong) for row, wrong in base.items() if row >= bench.end(number))


__all__ = ["RowJudge"]
