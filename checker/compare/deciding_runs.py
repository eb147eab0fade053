"""Runs that are chosen once causes are found: what they are told as may be one of many that explain as much.

Runs that are drawn from the charts meet the boundaries of the charts.  Those of the charts with the causes
lie elsewhere, and only runs beside these tell a limit of 290 from one of 200, or a timer from an action that
is missing.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from rovercheck.checker.compare.beside import Run, played
from rovercheck.checker.compare.fixed_runs import fixed
from rovercheck.checker.compare.own_runs import covering
from rovercheck.checker.compare.strategy import environment
from rovercheck.checker.compare.tried_runs import Share
from rovercheck.spec_model.abstraction import Board

RANDOM = "random run for the causes"


@dataclass(frozen=True)
class DecidingRuns:
    """Runs of the charts with the causes found, and the ``parts`` of a board that these explain.

    ``board`` is that with the causes, ``others`` are boards with other changes in their place that explain as
    much; ``drawn`` is the one as drawn, whose fixed runs were tried.  ``examples`` are drawn at random.
    """

    drawn: Board
    board: Board
    others: Sequence[Board]
    parts: frozenset[str]
    examples: int
    seed: int

    def runs(self) -> Iterator[Run]:
        """What is fixed for these charts and was not tried before, then random runs."""
        env = replace(environment(self.board), also=tuple(self.others))
        for label, steps in covering(env) if self.board.model else ():
            yield f"{label}, for the causes", steps
        for label, stimulus in fixed(env, environment(self.drawn)):
            yield f"{label}, for the causes", played(env.board, env.fields, stimulus)
        drawn: list[Run] = []
        if self.examples:
            Share(self.examples, self.seed).each(env, lambda steps: drawn.append((RANDOM, steps)))
        yield from drawn


__all__ = ["DecidingRuns"]
