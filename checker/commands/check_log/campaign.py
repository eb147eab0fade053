"""The logs of a folder as a campaign: deviations over all of them, beside those that are known."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

from rovercheck.checker.commands.shared.known import KnownBook
from rovercheck.checker.conformance.deviations import Deviation, DeviationTally, joins
from rovercheck.checker.conformance.known import Judged, KnownDeviation, KnownJudgement, shows
from rovercheck.checker.diagnosis.causes import CauseGroups, by_itself
from rovercheck.checker.logs import LogResult


@dataclass(frozen=True)
class LogCampaign:
    """What was found in logs, by board."""

    logs: Sequence[LogResult]
    book: KnownBook = field(default_factory=lambda: KnownBook({}, ""))
    causes: dict[str, CauseGroups] = field(default_factory=dict)
    """Of each board its deviations by cause, where causes were looked for."""

    def groups(self, board: str) -> CauseGroups:
        """The deviations of a board, each by itself where nobody looked for causes."""
        return self.causes.get(board) or by_itself(self.deviations[board])

    @cached_property
    def tallies(self) -> Mapping[str, DeviationTally]:
        """The deviations of each board over all its logs."""
        found: dict[str, DeviationTally] = {}
        for log in self.logs:
            tally, own = found.setdefault(log.layout.board, DeviationTally()), log.behaviour.tally
            if own.evidence is not None:
                tally.add(own.groups.values(), own.evidence, log.name)
        return found

    @cached_property
    def deviations(self) -> Mapping[str, tuple[Deviation, ...]]:
        """The same, what explains most first."""
        return {board: tally.deviations() for board, tally in self.tallies.items()}

    @cached_property
    def judgements(self) -> Mapping[str, KnownJudgement]:
        """What is to be said of them, by board."""
        return {board: self._judged(board) for board in self.deviations}

    def _judged(self, board: str) -> KnownJudgement:
        of_board = [log.behaviour for log in self.logs if log.layout.board == board]
        situations = frozenset(one for b in of_board for one in b.situations)
        compared = {name for b in of_board for name in b.compared}

        def shown_by(known: KnownDeviation) -> bool:
            drawn = not known.scope.on_top  # logs are not followed beside the causes of known deviations
            return drawn and shows(self.book.boards[board], known.scope, situations, compared)

        return self.book.judged(board, self.deviations[board], shown_by)

    def of(self, log: LogResult, deviation: Deviation) -> Judged:
        """What is to be said of a deviation of one log, of which other logs may show more."""
        board = log.layout.board
        found = self.judgements[board].found
        if deviation.scope in found:
            return found[deviation.scope]
        words = [self._of_group(board, one) for one in _groups(log, deviation)]
        worst = next((one for one in words if one.word != "known"), None)
        return worst or next(iter(words), Judged("new", deviation.scope.id(board)))

    def _of_group(self, board: str, group: Deviation) -> Judged:
        """Of one that was joined with others, or is so over all logs."""
        found = self.judgements[board].found
        whole = [
            d.scope
            for d in self.deviations[board]
            if d.scope == group.scope or joins(d, group.scope, group.outputs)
        ]
        return found[whole[0]] if whole else Judged("new", group.scope.id(board))

    def unknown(self, log: LogResult) -> int:
        """How many deviations of a log are not known."""
        return sum(self.of(log, one).word != "known" for one in log.behaviour.deviations)


def _groups(log: LogResult, deviation: Deviation) -> list[Deviation]:
    """The groups of a log that a deviation joins."""
    return [one for one in log.behaviour.tally.groups.values() if joins(deviation, one.scope, one.outputs)]
