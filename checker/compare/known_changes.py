"""What a search asks of the changes that explain what an implementation does otherwise."""

from collections.abc import Mapping, Sequence
from typing import Protocol

from rovercheck.checker.compare.deciding_runs import DecidingRuns
from rovercheck.checker.compare.run_follower import RecordedRun, RunFollower
from rovercheck.checker.conformance.deviations import Deviation
from rovercheck.checker.conformance.follower import Behaviour
from rovercheck.checker.conformance.recording import Recording
from rovercheck.checker.conformance.tracker import UndecidedRow


class KnownChanges(Protocol):
    """The charts with the changes that explain what is known, and what runs are beside them."""

    def followed(
        self, run: RecordedRun, found: Behaviour
    ) -> tuple[tuple[UndecidedRow, ...], tuple[Deviation, ...]]:
        """What is undecided of a run, and what deviates on top of what is known."""

    def told(self, found: Sequence[Deviation]) -> Sequence[Deviation]:
        """What is to be told of deviations from the charts as drawn, and those on top of what is known.

        Once causes were looked for, also those on top of these.
        """

    def follower(self, part: str) -> RunFollower:
        """What follows a part with the changes on top of which it deviates."""

    @property
    def left(self) -> Mapping[str, Sequence[Deviation]]:
        """Of runs kept as evidence, by their origins, what deviates on top of the causes found."""

    def deciding(self, examples: int, seed: int) -> DecidingRuns | None:
        """More runs, in which the causes found may turn out to be others; ``None``: no more are wanted."""

    def shown(
        self, parts: frozenset[str], deviations: Sequence[Deviation], explained: Sequence[Recording]
    ) -> None:
        """Takes the parts in which such runs show what the causes do not explain, and what deviates there.

        ``explained`` are the runs of which the causes explain all.
        """

    def further(self) -> Sequence[Deviation]:
        """What deviates in such runs alone, and has a cause of its own."""


__all__ = ["KnownChanges"]
