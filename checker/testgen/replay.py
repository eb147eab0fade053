"""What a test does: the outputs that the charts require, and the goals that it reaches."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from rovercheck.checker.system.instrument.goals import Watched
from rovercheck.spec_model.abstraction import Board, Value
from rovercheck.spec_model.lang.interpret import Interpreter


@dataclass(frozen=True)
class ReplayedStep:
    """One step: its inputs, the outputs required (those left open are missing), the goals reached in it."""

    inputs: Mapping[str, Value]
    outputs: Mapping[str, Value]
    reached: frozenset[str]


class CoverPlayer:
    """A board at power-up whose charts tell which goals they reach."""

    def __init__(self, board: Board, watched: Watched) -> None:
        self._board = board
        self._goals = tuple((g.id, g.flag.name) for g in watched.goals)
        self._reader = board.reader()
        self._charts = Interpreter(watched.system, measured=True)

    @property
    def data(self) -> Mapping[str, int]:
        return self._charts.data

    def step(self, inputs: Mapping[str, Value]) -> frozenset[str]:
        """The goals reached in a step with these concrete inputs."""
        self._charts.step(self._reader.step(inputs))
        at = self._charts.data
        return frozenset(id for id, flag in self._goals if at[flag])

    def outputs(self) -> dict[str, Value]:
        """What the charts require after the step."""
        return self._board.expected(self._charts.data)


def played(board: Board, watched: Watched, steps: Sequence[Mapping[str, Value]]) -> Iterator[ReplayedStep]:
    """Every step of a test, run on the interpreter from power-up."""
    player = CoverPlayer(board, watched)
    for inputs in steps:
        reached = player.step(inputs)
        yield ReplayedStep(inputs, player.outputs(), reached)


def first_reached(board: Board, watched: Watched, steps: Sequence[Mapping[str, Value]]) -> dict[str, int]:
    """The first step, from 1, in which each goal is reached."""
    found: dict[str, int] = {}
    player = CoverPlayer(board, watched)
    for number, inputs in enumerate(steps, start=1):
        for id in player.step(inputs):
            found.setdefault(id, number)
    return found
