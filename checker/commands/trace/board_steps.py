"""A run of the model as steps of the boards' firmware, for tests that any supervisor can be given."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

from rovercheck.checker.compare.beside import SteppedCharts
from rovercheck.checker.results.board_test import BoardStep, BoardTest
from rovercheck.checker.results.trace import Tick, Trace
from rovercheck.checker.testgen.expected_outputs import under_test
from rovercheck.spec_model.abstraction import Board, boards
from rovercheck.spec_model.abstraction.board import in_steps_of
from rovercheck.spec_model.lang.chart import parts
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.system import TICK_MS, System

ASK = "The run can be looked at in any other format."


def concrete(trace: Trace, system: System, among: Mapping[str, Board] | None = None) -> Trace:
    """The trace with the steps of each board on which it happens just so, power-up included.

    ``among``: the boards, where their charts are changed as those of the system are.

    The charts of the whole board are run on the concrete inputs, and all that the property depends on must
    be as in the trace.  Raises ``ModelError`` when there is no such board, and says why.
    """
    if system.tick_ms != TICK_MS:
        raise ModelError(
            f"{trace.system.name} advances by {system.tick_ms} ms and lets every task start at any phase; a "
            f"supervisor is executed every {TICK_MS} ms, so this run cannot be given to one. {ASK}"
        )
    if system.elapsed is not None:
        raise ModelError(
            f"{trace.system.name} has steps that last unlike times; a supervisor is given steps of "
            f"{TICK_MS} ms, so this run cannot be given to one. {ASK}"
        )
    runs, reasons = [], []
    for board in (boards() if among is None else among).values():
        if _parts(board.system) & _parts(system):
            try:
                runs.append(_run(board, trace, system))
            except ModelError as error:
                reasons.append(str(error))
    if not runs:
        raise ModelError(" ".join(reasons) or _foreign(trace, system))
    return replace(trace, concrete=tuple(runs))


def _parts(system: System) -> set[str]:
    return {part.name for part in parts(system.components)}


def _foreign(trace: Trace, system: System) -> str:
    found = ", ".join(sorted(_parts(system)))
    return (
        f"{trace.system.name} executes no chart and no block of a board (only {found}), so there is no "
        f"supervisor to give this run to. {ASK}"
    )


def _run(board: Board, trace: Trace, system: System) -> BoardTest:
    """The run on one board.  Raises ``ModelError`` where its charts do something else."""
    writer, charts, names = board.writer(), SteppedCharts(board), _shared(board, trace)
    steps = []
    for tick in trace.ticks:
        inputs = writer.step(in_steps_of(board, system, {**tick.inputs, **tick.after}))
        steps.append(BoardStep(inputs, charts.step(inputs).expected))
        _same(board, trace, tick, names, charts.valuation())
    return BoardTest(under_test(board), trace.property.id or trace.system.name, tuple(steps))


def _same(board: Board, trace: Trace, tick: Tick, names: Sequence[str], valuation: Mapping[str, int]) -> None:
    for name in names:
        there, here = tick.after.get(name), valuation[name]
        if there is not None and there != here:
            raise ModelError(
                f"This is a run of {trace.system.name}, not of {board.name}: in tick {tick.number} {name} is "
                f"{trace.show(name, there)} there, and {trace.show(name, here)} when the charts of the whole "
                f"board run on the measurements and messages that the run gives it. {ASK}"
            )


def _shared(board: Board, trace: Trace) -> list[str]:
    """What the property depends on and the board computes.  Raises ``ModelError`` if that is nothing."""
    known = {**board.system.written, **{v.name: v for c in board.system.charts for v in c.locations}}
    names = sorted(trace.property.relevant & known.keys() & trace.system.variables.keys())
    found = [n for n in names if trace.system.variables[n].domain == known[n].domain]
    if not found:
        raise ModelError(f"Nothing of what {trace.property.id} depends on is computed by {board.name}. {ASK}")
    return found
