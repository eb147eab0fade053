"""The columns of the logs have the names by which the checker knows the signals of the boards."""

from rovercheck.spec_model.abstraction import boards
from rovercheck.supervisor.bench.columns import inputs1, inputs2, outputs1, outputs2
from rovercheck.supervisor.board1 import Board1Inputs, Board1Outputs
from rovercheck.supervisor.board2.signals import Board2Inputs, Board2Outputs


def test_logs_hold_every_signal_of_a_board_and_no_other() -> None:
    board1, board2 = boards()["board1"], boards()["board2"]
    assert set(inputs1(Board1Inputs())) == {signal.name for signal in board1.inputs}
    assert set(inputs2(Board2Inputs())) == {signal.name for signal in board2.inputs}
    assert set(outputs1(Board1Outputs())) == {output.name for output in board1.outputs}
    assert set(outputs2(Board2Outputs())) == {output.name for output in board2.outputs}
