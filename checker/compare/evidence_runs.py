"""The runs that deviate, as what is known of an implementation when causes are looked for."""

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass, field

from rovercheck.checker.compare.run_follower import RecordedRun, recorded_run
from rovercheck.checker.conformance.deviations import DeviationScope
from rovercheck.checker.conformance.recording import Recording
from rovercheck.spec_model.abstraction import Board

MOST_STEPS = 150_000
"""Steps of runs that are kept for it; beyond, a run is kept only for a deviation that few others show."""

FEW = 3
"""Runs of one deviation that are kept in any case."""


@dataclass
class EvidenceRuns:
    """Runs as recordings, each with the parts that deviate or are undecided, and which of all runs it is.

    ``of`` is how many deviated.
    """

    runs: list[Recording] = field(default_factory=list)
    parts: list[frozenset[str]] = field(default_factory=list)
    numbers: list[int] = field(default_factory=list)
    of: int = 0
    _steps: int = 0
    _shown: Counter[DeviationScope] = field(default_factory=Counter)

    def add(
        self,
        number: int,
        run: RecordedRun,
        scopes: Iterable[DeviationScope],
        undecided: Iterable[str] = (),
    ) -> None:
        """Keep a run with these deviations and parts that are not decided, or not."""
        self.of += 1
        told = set(scopes)
        if self._steps + len(run.steps) > MOST_STEPS and all(self._shown[s] >= FEW for s in told):
            return
        self._shown.update(told)
        self._steps += len(run.steps)
        self.runs.append(run.recording)
        self.parts.append(frozenset([*(one.part for one in told), *undecided]))
        self.numbers.append(number)

    def choose(self, number: int, run: RecordedRun) -> None:
        """Keep a run that was chosen for causes and shows more than they explain."""
        self.of += 1
        self.runs.append(run.recording)
        self.parts.append(frozenset())
        self.numbers.append(number)

    def run(self, board: Board, origin: str) -> tuple[int, RecordedRun]:
        """A run that is kept, with its number; what the charts do in it is computed anew."""
        place = next(n for n, run in enumerate(self.runs) if run.name == origin)
        [block] = self.runs[place].blocks()
        return self.numbers[place], recorded_run(board, origin, block)


__all__ = ["EvidenceRuns"]
