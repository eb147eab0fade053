"""What Board 1 does on the bench, in a closed loop, is what its charts require."""

from pathlib import Path

import pytest

from rovercheck.spec_model.abstraction import boards
from rovercheck.spec_model.lang.interpret import Interpreter
from rovercheck.supervisor.bench import loads, simulate
from rovercheck.supervisor.bench.columns import inputs1, outputs1

EXAMPLES = Path(__file__).parents[2] / "examples" / "scenarios"
NEAR = 1e-9


@pytest.mark.parametrize("name", ["crossing", "link_loss"])
def test_every_step_is_that_of_the_charts(name: str) -> None:
    record = simulate(loads((EXAMPLES / f"{name}.toml").read_text(encoding="utf-8")))
    board = boards()["board1"]
    charts, reader = Interpreter(board.system, measured=True), board.reader()
    for step in record.board1:
        charts.step(reader.step(inputs1(step.inputs)))
        made = outputs1(step.outputs)
        expected = board.expected(charts.valuation())
        assert {n: made[n] for n in expected if abs(made[n] - expected[n]) > NEAR} == {}, step.time_us
