"""Tests as people write them: the inputs of a board step by step, and what changes between steps."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from rovercheck.checker.results.board_steps import Cells, in_rows
from rovercheck.spec_model.abstraction import Board, Value
from rovercheck.spec_model.abstraction.stamps import NOW
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.system import TICK_MS

Moment = Mapping[str, Value]
"""The inputs of one step without the clock; of a stamp, whether its datum is new in this step."""

Script = tuple[Moment, ...]
"""The inputs of a test, step by step from power-up."""


@dataclass(frozen=True)
class Test:
    """A sequence of concrete inputs from power-up, one mapping a step, and the goals that it reaches."""

    name: str
    goals: tuple[str, ...]
    steps: tuple[Mapping[str, Value], ...]


def steps(board: Board, script: Sequence[Moment]) -> tuple[dict[str, Value], ...]:
    """The concrete inputs of a script: a step every 20 ms, stamps from the clock."""
    found: list[dict[str, Value]] = []
    stamps = {s.name: s.initial for s in board.inputs if s.stamp}
    for number, moment in enumerate(script, start=1):
        now = number * TICK_MS
        stamps |= {name: now for name in stamps if moment.get(name)}
        stamps[NOW] = now
        found.append({s.name: stamps[s.name] if s.stamp else moment[s.name] for s in board.inputs})
    return tuple(found)


def script(board: Board, given: Sequence[Mapping[str, Value]]) -> Script:
    """The script of concrete inputs.

    Raises ``ModelError`` for a clock that does not start at 20 ms and advance by 20 ms, and for a stamp that
    is neither that of its step nor the one before.
    """
    return tuple(_script(board, given))


def _script(board: Board, given: Sequence[Mapping[str, Value]]) -> Iterator[Moment]:
    before: Mapping[str, Value] = board.at_power_up()
    for number, inputs in enumerate(given, start=1):
        now = inputs[NOW]
        if now != number * TICK_MS:
            raise ModelError(f"step {number} is at {now} ms; in a test step k is at {TICK_MS} k ms.")
        moment = dict(inputs)
        for signal in board.inputs:
            if signal.stamp:
                moment[signal.name] = inputs[signal.name] == now
                if not moment[signal.name] and inputs[signal.name] != before[signal.name]:
                    raise ModelError(f"step {number}: {signal.name} is neither {now} ms nor as before.")
        del moment[NOW]
        yield moment
        before = inputs


# --- held blocks: how tests are kept -------------------------------------------------------------------


def blocks(board: Board, moments: Sequence[Moment]) -> list[tuple[int, Moment]]:
    """The script as steps in a row with equal inputs, and what changes from one such row to the next."""
    nothing: Cells = {}
    rows = in_rows(_at_rest(board), nothing, ((moment, nothing) for moment in moments))
    return [(count, changes) for count, changes, _ in rows]


def unfolded(board: Board, rows: Sequence[tuple[int, Mapping[str, Value]]]) -> Script:
    """The script that the rows of ``blocks`` stand for."""
    found: list[Moment] = []
    at: dict[str, Value] = dict(_at_rest(board))
    for count, changes in rows:
        at = {**at, **changes}
        found += [at] * count
    return tuple(found)


def _at_rest(board: Board) -> Moment:
    return {s.name: False if s.stamp else s.initial for s in board.inputs if s.name != NOW}
