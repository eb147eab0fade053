"""The deviations of a comparison by cause, before the first of each is told in full."""

from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace

from rovercheck.checker.commands.compare.rounds import Rounds
from rovercheck.checker.compare.deciding_runs import DecidingRuns
from rovercheck.checker.compare.evidence_runs import EvidenceRuns
from rovercheck.checker.compare.result import CompareResult
from rovercheck.checker.compare.run_follower import RecordedRun, RunFollower
from rovercheck.checker.conformance.deviations import Deviation, DeviationScope
from rovercheck.checker.conformance.follower import Behaviour
from rovercheck.checker.conformance.known import KnownCause, KnownDeviation
from rovercheck.checker.conformance.recording import Recording
from rovercheck.checker.conformance.tracker import UndecidedRow
from rovercheck.checker.diagnosis.causes import (
    CauseGroups,
    DeviationCause,
    PartChanges,
    by_itself,
    cause_groups,
    followed,
    split,
)
from rovercheck.checker.diagnosis.evidence import Evidence, EvidenceCollector
from rovercheck.checker.diagnosis.known_causes import changed, no_longer_explained, that_hold
from rovercheck.checker.diagnosis.known_charts import KnownCharts
from rovercheck.spec_model.abstraction import Board


@dataclass
class CauseGrouping:
    """Looks for the causes of one board, for so many ``seconds`` in each part.

    ``asked``: in every part with a deviation that is not known, or in none; ``None``: where there are
    several.  Known deviations are told apart from the others of their cause: those that ``knows`` says are,
    unless what explained them, which is among ``causes``, does so no longer.

    Where the causes found explain a part, runs are followed on beside them, and what deviates there is told,
    too, by its own cause: it may show in no other place.  ``left`` says of which runs, by their origins, and
    ``on_top`` are those that are left beside the charts with all causes that were found now.
    """

    board: Board
    seconds: float
    asked: bool | None
    knows: Callable[[Deviation], bool]
    records: Sequence[KnownDeviation] = ()
    causes: Sequence[KnownCause] = ()
    groups: CauseGroups | None = None
    unexplained: frozenset[DeviationScope] = field(default_factory=frozenset)
    charts: KnownCharts | None = None
    on_top: list[Deviation] = field(default_factory=list)
    collector: EvidenceCollector = field(init=False)
    left: Mapping[str, Sequence[Deviation]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.collector = EvidenceCollector(self.board)
        self._rounds = Rounds()
        self._behind: list[Deviation] = []
        self._found: KnownCharts | None = None
        if self.causes:
            self.charts = KnownCharts(self.board, self.causes, self.records, self.known)

    def leading(
        self, found: Sequence[Deviation], runs: EvidenceRuns, progress: Callable[[str], None]
    ) -> list[Deviation]:
        """The first deviation of each group; what ends the search early leaves each by itself."""
        drawn = [one for one in found if not one.scope.on_top]
        groups = self._grouped(drawn, runs, progress)
        more = [] if self.charts is None else [one for one in self.charts.told(drawn) if one.scope.on_top]
        self.groups = replace(groups, causes=(*groups.causes, *by_itself(more).causes))
        if self.asked and groups.parts:
            self._follow_on(runs, progress)
        return [cause.first for cause in self.groups.causes]

    def followed(
        self, run: RecordedRun, found: Behaviour
    ) -> tuple[tuple[UndecidedRow, ...], tuple[Deviation, ...]]:
        """What is undecided of a run, and what deviates on top of what is known."""
        return (found.undecided, ()) if self.charts is None else self.charts.followed(run, found)

    def told(self, found: Sequence[Deviation]) -> Sequence[Deviation]:
        """All deviations to be told, of ``found`` from the charts as drawn."""
        own = found if self.charts is None else self.charts.told(found)
        return [*own, *self._behind]

    def follower(self, part: str) -> RunFollower:
        """What follows a part with the changes on top of which it deviates."""
        charts = self._found if any(one.scope.part == part for one in self._behind) else self.charts
        assert charts is not None, "it has causes"
        return charts.follower(part)

    def deciding(self, examples: int, seed: int) -> DecidingRuns | None:
        """Runs in which the causes found may turn out to be others; ``None``: no more are wanted."""
        if not self.asked or self.groups is None:
            return None
        explained = {one.scope for part in self.groups.parts for one in part.deviations}
        every = [one for cause in self.groups.causes for one in cause.deviations]
        open_parts = {one.scope.part for one in every if one.scope not in explained}
        made = [one for one in self.groups.parts if one.changes and one.deviations]
        return self._rounds.following(self.board, made, open_parts, examples, seed)

    def shown(
        self, parts: frozenset[str], deviations: Sequence[Deviation], explained: Sequence[Recording]
    ) -> None:
        """Takes what such runs show that the causes do not explain, and those of which they explain all."""
        self._rounds.unfit, self._rounds.chosen = parts, deviations
        self._rounds.explained += explained

    @property
    def unfit(self) -> tuple[str, ...]:
        """The parts in which such runs show more than the causes explain in the end."""
        return tuple(sorted(self._rounds.unfit))

    def further(self) -> Sequence[Deviation]:
        """What deviates in such runs alone, and has a cause of its own."""
        return self._rounds.further

    def _grouped(
        self, found: Sequence[Deviation], runs: EvidenceRuns, progress: Callable[[str], None]
    ) -> CauseGroups:
        """The deviations from the charts as drawn by cause."""
        if self.groups is None:  # what was found before is kept, should this be interrupted
            self.groups = by_itself(found)
        evidence = None
        doubtful = [] if self.charts is None else self.charts.doubtful()
        if any(self.knows(one) and one.scope.part in {c.part for c, _ in doubtful} for one in found):
            evidence = followed(self.board, runs.runs, progress, self.collector)
            whole, present = (
                {one.scope for one in no_longer_explained(evidence, found, self.records, causes)}
                for causes in zip(*doubtful, strict=True)
            )
            self.unexplained = frozenset(whole & present)
            self.groups = replace(self.groups, left_out=runs.of - len(runs.runs))
        parts = self._parts(found)
        if parts:
            evidence = evidence or followed(self.board, runs.runs, progress, self.collector)
            groups = self._rounds.searched(evidence, found, parts, self.seconds, progress)
            left_out = runs.of - len(runs.runs)
            made = _that_hold(evidence, groups.parts) if self.asked else groups.parts
            causes = split(groups.causes, self.known)
            self.groups = replace(groups, causes=causes, left_out=left_out, parts=tuple(made))
        return self.groups

    def _follow_on(self, runs: EvidenceRuns, progress: Callable[[str], None]) -> None:
        """Follow the runs beside the causes found, and look for those of what deviates there."""
        assert self.groups is not None
        made = self.groups.parts
        self._found, left = self._beside(runs, made)
        self.on_top = list(self._found.on_top())
        explained = {one.scope for part in made for one in part.deviations}
        drawn = [one for cause in self.groups.causes for one in cause.deviations if not one.scope.on_top]
        open_parts = {one.scope.part for one in drawn if one.scope not in explained}
        self._behind = [one for one in self.on_top if one.scope.part not in open_parts]
        if not self._behind:
            return
        scopes = {one.scope for one in self._behind}
        self.left = {
            origin: own for origin, some in left.items() if (own := [d for d in some if d.scope in scopes])
        }
        parts = {one.scope.part for one in self._behind}
        board = self.board
        for cause in self._causes(one for one in made if one.part in parts):
            board = changed(board, cause)
        evidence = followed(board, runs.runs, progress)
        groups = cause_groups(evidence, [_plain(one) for one in self._behind], parts, self.seconds, progress)
        places = {_plain(one).scope: one for one in self._behind}
        causes = [_of(one, places) for one in groups.causes]
        more = {one.part: one for one in _that_hold(evidence, groups.parts)}
        every = tuple(
            replace(one, changes=(*one.changes, *more[one.part].changes)) if one.part in more else one
            for one in made
        )
        self.groups = replace(
            self.groups,
            causes=(*self.groups.causes, *causes),
            cut=(*self.groups.cut, *groups.cut),
            parts=every,
        )
        if more:
            self.on_top = list(self._beside(runs, every)[0].on_top())

    def _causes(self, made: Iterable[PartChanges]) -> list[KnownCause]:
        return [
            KnownCause(self.board.name, one.part, tuple(change.key for change in one.changes), ())
            for one in made
            if one.changes and one.deviations
        ]

    def _beside(
        self, runs: EvidenceRuns, made: Iterable[PartChanges]
    ) -> tuple[KnownCharts, Mapping[str, Sequence[Deviation]]]:
        """The charts with the causes found, and what is left of each run beside them."""
        charts = KnownCharts(self.board, self._causes(made), (), self.known)
        return charts, charts.recorded(runs)

    def known(self, one: Deviation) -> bool:
        """Whether a deviation is known, and explained as before."""
        return self.knows(one) and one.scope not in self.unexplained

    def of(self, result: CompareResult) -> CauseGroups:
        """The groups of a result, of which deviations may be told as in a smaller run."""
        if self.groups is None:  # interrupted
            return by_itself(result.deviations)
        own = {one.scope for cause in self.groups.causes for one in cause.deviations}
        rest = by_itself(one for one in result.deviations if one.scope not in own)
        causes = self._rounds.narrowed(self.groups.causes)
        return replace(self.groups, causes=(*causes, *rest.causes), unfit=self.unfit)

    def _parts(self, found: Sequence[Deviation]) -> list[str]:
        ways = Counter(one.scope.part for one in found)
        new = {one.scope.part for one in found if not self.known(one)}
        if self.asked is False:
            return []
        return [part for part in ways if part and part in new and (self.asked or ways[part] > 1)]


def _plain(one: Deviation) -> Deviation:
    return replace(one, scope=replace(one.scope, on_top=False))


def _of(cause: DeviationCause, places: Mapping[DeviationScope, Deviation]) -> DeviationCause:
    """A cause with the deviations as they are told."""
    return replace(cause, deviations=tuple(places[one.scope] for one in cause.deviations))


def _that_hold(evidence: Evidence, found: Sequence[PartChanges]) -> list[PartChanges]:
    """The changes of each part that explain most when they are made anew.

    A part that was searched in runs of several columns has changes of each of them: all together are tried,
    and each by itself.
    """
    made: list[PartChanges] = []
    for part in dict.fromkeys(one.part for one in found):
        own = [one for one in found if one.part == part]
        if len(own) > 1:
            changes = {change.key: change for one in own for change in one.changes}
            every = tuple(deviation for one in own for deviation in one.deviations)
            own.insert(0, PartChanges(part, tuple(changes.values()), every))
        made.append(max((that_hold(evidence, one) for one in own), key=lambda one: len(one.deviations)))
    return made
