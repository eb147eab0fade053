"""Runs beside the charts with the changes that explain known deviations: what is left there is new.

What a part does otherwise may hide what else it does: where the charts as drawn explain nothing any more,
nobody knows in which state they would be.  With the changes of what is known they are followed on.
"""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace

from rovercheck.checker.compare.evidence_runs import EvidenceRuns
from rovercheck.checker.compare.run_follower import RecordedRun, RunFollower
from rovercheck.checker.conformance.deviations import Deviation, DeviationTally, WholeEvidence
from rovercheck.checker.conformance.follower import Behaviour, Situation
from rovercheck.checker.conformance.known import KnownCause, KnownDeviation
from rovercheck.checker.conformance.recording import LogBlock
from rovercheck.checker.conformance.tracker import UndecidedRow
from rovercheck.checker.diagnosis.known_causes import changed
from rovercheck.spec_model.abstraction import Board
from rovercheck.spec_model.lang.errors import ModelError

MOST_TRIED = 5
"""Runs for which it is tried whether they are explained without some of the changes, if none of them is."""

Covers = Callable[[Deviation], bool]


class KnownCharts:
    """The parts of a board with causes, and what is left of runs beside them.

    ``records`` are the known deviations, and ``knows`` says whether one is expected now.
    """

    def __init__(
        self,
        board: Board,
        causes: Iterable[KnownCause],
        records: Sequence[KnownDeviation],
        knows: Covers,
    ) -> None:
        self._knows = knows
        self._records = [one for one in records if one.board == board.name]
        self._parts = {one.part: _ChangedPart(board, one, self._left) for one in causes}
        self._tallies = {name: DeviationTally() for name in self._parts}
        self._dirty = set[str]()
        self.situations = set[Situation]()
        """What was put to the test, and was as the changed charts require."""

    @property
    def parts(self) -> frozenset[str]:
        """The parts with changes."""
        return frozenset(self._parts)

    def doubtful(self) -> list[tuple[KnownCause, KnownCause]]:
        """The causes that left something that is not known, and without changes that seem to be gone."""
        parts = [self._parts[name] for name in sorted(self._dirty)]
        return [(one.cause, one.present) for one in parts]

    def follower(self, part: str) -> RunFollower:
        """What follows a part with all changes."""
        return self._parts[part].follower

    def followed(
        self, run: RecordedRun, found: Behaviour
    ) -> tuple[tuple[UndecidedRow, ...], tuple[Deviation, ...]]:
        """What is undecided of a run, and the deviations that are left on top of what is known.

        ``found`` is what the charts as drawn say of it.
        """
        undecided, every = list(found.undecided), list[Deviation]()
        deviating = {scope.part for scope in found.tally.groups} | {one.part for one in undecided}
        for name in sorted(deviating & self.parts):
            part = self._parts[name]
            whole = part.behaviour(run.block)
            without = part.without_some(run.block, whole)
            if without is None:
                undecided = [one for one in undecided if one.part != name]
                undecided += [one for one in whole.undecided if one.part == name]
            every += self._note(name, whole, run.origin, without)
        return tuple(undecided), tuple(every)

    def recorded(self, runs: EvidenceRuns) -> dict[str, list[Deviation]]:
        """Runs of the implementation for which the causes were found; by their origins what each leaves."""
        left: dict[str, list[Deviation]] = {}
        for name, part in self._parts.items():
            for run, deviating in zip(runs.runs, runs.parts, strict=True):
                for block in run.blocks() if name in deviating else ():
                    left.setdefault(run.name, []).extend(self._note(name, part.behaviour(block), run.name))
        return {origin: some for origin, some in left.items() if some}

    def _note(
        self, name: str, whole: Behaviour, origin: str, without: Behaviour | None = None
    ) -> list[Deviation]:
        """What a run leaves beside all changes, or without some that are gone, which explains nothing new."""
        if any(self._parts[name].wrong(whole)):
            self._dirty.add(name)
        behaviour = without or whole
        own = _own(behaviour, name)
        self._tallies[name].add(own, behaviour.tally.evidence or WholeEvidence(), origin)
        self.situations |= {one for one in behaviour.situations if one[0] == name}
        return list(map(_on_top, own))

    def _left(self, one: Deviation) -> bool:
        """Whether a deviation on top of what is known is not known itself."""
        return not any(
            record.covers(_on_top(one)) or _whole(record, one)
            for record in self._records
            if record.scope.on_top
        )

    def told(self, found: Iterable[Deviation]) -> list[Deviation]:
        """What is to be told of the deviations from the charts as drawn, and those on top of what is known.

        In a part of which all changes explain all, nothing but the known deviates.  A new one on top is told
        where no other one of the part is new, and where it is not that changes are gone.
        """
        drawn = [one for one in found if not self._explained(one)]
        new = {one.scope.part for one in drawn if not self._knows(one)}
        more = (one for one in self.on_top() if self._knows(one) or one.scope.part not in new)
        return [*drawn, *more]

    def on_top(self) -> Iterator[Deviation]:
        """All deviations on top of what is known."""
        for tally in self._tallies.values():
            yield from map(_on_top, tally.deviations())

    def _explained(self, one: Deviation) -> bool:
        clean = one.scope.part in self.parts - self._dirty
        return clean and not any(record.covers(one) for record in self._records)


@dataclass
class _ChangedPart:
    """One part with the changes of its cause; ``gone`` are places of those that seem not to be there now."""

    board: Board
    cause: KnownCause
    left: Covers
    gone: frozenset[int] = frozenset()
    tried: int = 0
    failed: bool = False
    """Whether some run is explained neither by all changes nor without some of them."""

    def __post_init__(self) -> None:
        self._followers: dict[frozenset[int], RunFollower | None] = {}

    @property
    def follower(self) -> RunFollower:
        found = self._without(frozenset())
        assert found is not None, "all changes fit: they were made when the file was read"
        return found

    @property
    def present(self) -> KnownCause:
        """The cause without changes that are gone, if with that every run is explained."""
        return self.cause if self.failed else self._but(self.gone)

    def _but(self, gone: frozenset[int]) -> KnownCause:
        changes = enumerate(self.cause.changes)
        return replace(self.cause, changes=tuple(change for n, change in changes if n not in gone))

    def behaviour(self, block: LogBlock) -> Behaviour:
        """What a run is beside all changes."""
        return self.follower.followed(block)

    def without_some(self, block: LogBlock, whole: Behaviour) -> Behaviour | None:
        """What a run is without changes of which it shows that they are gone; ``None``: it does not."""
        if not any(self.wrong(whole)):
            return None
        follower = self._without(self.gone)
        best = whole if not self.gone or follower is None else follower.followed(block)
        fewest, gone = self.wrong(best), self.gone
        if self.tried >= MOST_TRIED and any(fewest):
            self.failed = True
            return None
        better = True
        while better and any(fewest):
            better = False
            for place in range(len(self.cause.changes)):
                follower = self._without(gone ^ {place})
                other = None if follower is None else follower.followed(block)
                if other is not None and self.wrong(other) < fewest:
                    fewest, best, gone, better = self.wrong(other), other, gone ^ {place}, True
        if any(fewest):
            self.tried, self.failed = self.tried + 1, True
            return None
        self.gone = gone
        return best

    def wrong(self, behaviour: Behaviour) -> tuple[int, int]:
        """Steps that differ otherwise than is known, and whether something is not decided."""
        steps = sum(one.count for one in _own(behaviour, self.cause.part) if self.left(one))
        return steps, any(one.part == self.cause.part for one in behaviour.undecided)

    def _without(self, gone: frozenset[int]) -> RunFollower | None:
        """A follower of the part without some changes, where the others fit the charts by themselves."""
        if gone not in self._followers:
            try:
                board = changed(self.board, self._but(gone))
            except ModelError:
                self._followers[gone] = None
            else:
                self._followers[gone] = RunFollower(board, True, self.cause.part)
        return self._followers[gone]


def _own(behaviour: Behaviour, part: str) -> list[Deviation]:
    return [one for scope, one in behaviour.tally.groups.items() if scope.part == part]


def _on_top(one: Deviation) -> Deviation:
    return replace(one, scope=replace(one.scope, on_top=True))


def _whole(record: KnownDeviation, one: Deviation) -> bool:
    """Whether it may be a part of one that only all runs together show."""
    late = record.scope.kind == "late" and record.scope.part == one.scope.part
    return late and one.kind == "late" and set(one.outputs) <= set(record.scope.outputs)


__all__ = ["KnownCharts"]
