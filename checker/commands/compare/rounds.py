"""Causes looked for again, with runs that were chosen for those found first."""

from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass, field, replace

from rovercheck.checker.compare.deciding_runs import DecidingRuns
from rovercheck.checker.conformance.deviations import Deviation
from rovercheck.checker.conformance.recording import Recording
from rovercheck.checker.diagnosis.causes import (
    CauseGroups,
    CauseSearch,
    DeviationCause,
    PartChanges,
    cause_groups,
)
from rovercheck.checker.diagnosis.evidence import Evidence, decoded_run
from rovercheck.checker.diagnosis.other_limits import narrowed, other_limits
from rovercheck.checker.diagnosis.variant import with_changes
from rovercheck.spec_model.abstraction import Board
from rovercheck.spec_model.lang.errors import ModelError

MOST = 4
"""How often runs are chosen: a limit is told to one digit more each time."""

MOST_EXAMPLES = 30
"""Random runs among those that are chosen."""

Keys = tuple[tuple[str, ...], ...]


@dataclass
class Rounds:
    """The searches so far; ``chosen`` is what deviates in runs chosen for the causes of the last one.

    ``unfit`` are the parts in which these runs show more than the causes explain, ``explained`` the runs in
    which they show no more.  ``further`` is what only such runs show, and has a cause of its own; what shares
    one with others is told as these.
    """

    unfit: frozenset[str] = frozenset()
    chosen: Sequence[Deviation] = ()
    explained: list[Recording] = field(default_factory=list)
    further: Sequence[Deviation] = ()
    _number: int = 0
    _tried: Keys = ()
    _last: CauseSearch | None = field(default=None, repr=False)

    def following(
        self, board: Board, made: Sequence[PartChanges], but: Collection[str], examples: int, seed: int
    ) -> DecidingRuns | None:
        """Runs for the changes of some parts, to be looked at in all of these ``but`` some.

        ``None`` where there are no changes, no others than those for which runs were tried, or enough.
        """
        changes = [change for part in made for change in part.changes]
        keys = tuple(change.key for change in changes)
        if not keys or keys == self._tried or self._number == MOST:
            return None
        try:
            changed = with_changes(board, keys)
        except ModelError:  # changes of several parts that do not fit together
            return None
        self._number, self._tried, self.unfit = self._number + 1, keys, frozenset()
        parts = frozenset(part.part for part in made) - frozenset(but)
        others = tuple(other_limits(board, changes))
        examples = min(examples, MOST_EXAMPLES)
        return DecidingRuns(board, changed, others, parts, examples, seed + self._number)

    def searched(
        self,
        evidence: Evidence,
        found: Sequence[Deviation],
        parts: Collection[str],
        seconds: float,
        progress: Callable[[str], None],
    ) -> CauseGroups:
        """The deviations by cause; after the first time only the parts that do not fit are searched."""
        told = {one.scope for one in found}
        every = [*found, *(one for one in self.chosen if one.scope not in told)]
        again = parts if self._last is None else self.unfit
        groups = cause_groups(evidence, every, again, seconds, progress, before=self._last)
        if self._last is not None and groups.search is not None:
            better = groups.search.but_for(self._last, told)
            if better is not groups.search:  # what explains these runs, too, explains less of the others
                groups = cause_groups(evidence, every, (), seconds, progress, before=better)
        self._last = groups.search
        causes = []
        self.further = []
        for cause in groups.causes:
            own = tuple(one for one in cause.deviations if one.scope in told)
            if not own and cause.change is None:
                continue
            self.further += [] if own else cause.deviations
            causes.append(replace(cause, deviations=own or cause.deviations))
        told |= {one.scope for one in self.further}
        kept = tuple(
            replace(part, deviations=tuple(one for one in part.deviations if one.scope in told))
            for part in groups.parts
        )
        return replace(groups, causes=tuple(causes), parts=kept)

    def narrowed(self, causes: Sequence[DeviationCause]) -> tuple[DeviationCause, ...]:
        """The causes; of a limit with the numbers that are left by all runs that it explains."""
        if self._last is None or not self.explained:
            return tuple(causes)
        parts = {found.part: part for part, found in self._last.parts}
        board = next(part.group.board for part in parts.values())
        runs = [decoded_run(board, run) for run in self.explained]
        return tuple(
            replace(one, change=narrowed(one.change, parts[one.part], runs))
            if one.change is not None and one.part in parts.keys() - self.unfit
            else one
            for one in causes
        )


__all__ = ["Rounds"]
