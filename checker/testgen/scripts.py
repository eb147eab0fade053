"""The inputs of a board without its clock: as tests are kept, shortened and told."""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass

from rovercheck.checker.board_tests.rows import Moment, at_rest, in_rows, moments
from rovercheck.checker.testgen.expected_outputs import under_test
from rovercheck.spec_model.abstraction import Board, Value
from rovercheck.spec_model.abstraction.stamps import CLOCK, NOW, since
from rovercheck.spec_model.lang.errors import ModelError

Script = tuple[Moment, ...]
"""The inputs of a test, step by step from power-up."""


@dataclass(frozen=True)
class Test:
    """A sequence of concrete inputs from power-up, one mapping a step, and the goals that it reaches."""

    name: str
    goals: tuple[str, ...]
    steps: tuple[Mapping[str, Value], ...]


def steps(
    board: Board, script: Sequence[Moment], start_ms: int | None = None
) -> tuple[dict[str, Value], ...]:
    """The concrete inputs of a script, in steps of the board; stamps are from its clock."""
    at, stamps, found = board.at_power_up(), stamps_of(board), []
    start = board.tick_ms if start_ms is None else start_ms
    for number, moment in enumerate(script):
        advance(at, stamps, (start + number * board.tick_ms) % CLOCK, moment)
        found.append(dict(at))
    return tuple(found)


def advance(inputs: dict[str, Value], stamps: Collection[str], now: int, moment: Moment) -> None:
    """Bring concrete inputs from those of a step to those of the next, in place."""
    inputs[NOW] = now
    for name, value in moment.items():
        if value is not None:
            inputs[name] = (now - int(value)) % CLOCK if name in stamps else value


def stamps_of(board: Board) -> frozenset[str]:
    """The names of the stamps of a board, its clock among them."""
    return frozenset(s.name for s in board.inputs if s.stamp)


def script(board: Board, given: Sequence[Mapping[str, Value]]) -> Script:
    """The script of concrete inputs.

    Raises ``ModelError`` for steps that are not as far apart as the board's: the charts count steps.
    """
    for number, at in enumerate(given):
        after = since(int(at[NOW]), int(given[0][NOW]))
        if after != board.tick_ms * number:
            raise ModelError(
                f"Step {number + 1} is at {at[NOW]} ms, {after} ms after the first; "
                f"steps are {board.tick_ms} ms apart, because the charts count them."
            )
    return tuple(moments(under_test(board).inputs, given))


def blocks(board: Board, script: Sequence[Moment]) -> list[tuple[int, Moment]]:
    """The script as steps in a row with equal inputs, and what changes from one such row to the next."""
    rows = in_rows(at_rest(under_test(board).inputs), {}, ((moment, {}) for moment in script))
    return [(count, changes) for count, changes, _ in rows]


def unfolded(board: Board, rows: Sequence[tuple[int, Moment]]) -> Script:
    """The script that the rows of ``blocks`` stand for."""
    found: list[Moment] = []
    at = at_rest(under_test(board).inputs)
    for count, changes in rows:
        at = {**at, **changes}
        found += [at] * count
    return tuple(found)
