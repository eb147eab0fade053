"""Truth tables in charts and as blocks, in both readings."""

from pathlib import Path
from typing import Literal

import pytest

from rovercheck.checker.drawn.faults import DrawnFault
from rovercheck.checker.drawn.interpret.diagram import ModelRunner
from rovercheck.checker.simulink.model import read_model
from rovercheck.checker.simulink.writer.charts import WrittenChart, WrittenTable
from rovercheck.checker.simulink.writer.packages import WrittenModel, packed
from rovercheck.spec_model.lang.errors import ModelError
from tests.drawn.charts import running
from tests.drawn.test_lowering import both

BANDS = WrittenTable(
    ["LOW: u < 0", "u > 5"], ["TF 1", "FT HIGH", "-- 3,1"], ["r = 1;", "HIGH:\nr = 2;", "r = 7;"]
)


def called(c: WrittenChart, table: WrittenTable = BANDS) -> None:
    """A chart that calls a table in every step."""
    function = c.truth_table("r = f(v)", table)
    c.data("v", "function input", "double", holder=function)
    c.data("r", "function output", "int8", holder=function)
    c.transition(None, c.state("A\nen, du: log = f(u);"))


@pytest.mark.parametrize("language", ["MATLAB", "C"])
def test_the_first_decision_that_fits_is_taken(tmp_path: Path, language: Literal["MATLAB", "C"]) -> None:
    """A table of which the file has no script was refused; actions are done in the order in which named."""
    table = WrittenTable(BANDS.conditions, BANDS.decisions, [*BANDS.actions[:2], "r = r + 7;"])
    runner = running(tmp_path, called, language=language)
    assert both(runner, [-3, 3, 9]) == [1, 1, 2]
    ordered = WrittenTable(table.conditions, ["TF 1", "FT HIGH", "-- 1;3"], table.actions)
    runner = running(tmp_path, lambda c: called(c, ordered), language=language)
    assert both(runner, [-3, 3, 9]) == [1, 8, 2]


def test_conditions_are_computed_once_and_before_any_action(tmp_path: Path) -> None:
    def draw(c: WrittenChart) -> None:
        c.data("n", "local", "int8")
        c.function("r = more()", script="function r = more()\nn = n + 1;\nr = n;\nend\n")
        table = WrittenTable(
            ["more() > 2", "u == 1"],
            ["TT 1", "TF 2", "FF 3", "-- 4"],
            [f"n = n + {x};" for x in (0, 0, 10, 20)],
        )
        c.truth_table("t", table)
        c.transition(None, c.state("A\ndu: t(); log = double(n);"))

    assert both(running(tmp_path, draw), [0, 0, 0, 1]) == [0, 11, 12, 13]


def test_an_action_may_be_done_at_first_and_one_at_last(tmp_path: Path) -> None:
    table = WrittenTable(
        ["v > 1"], ["T 2", "- 3"], ["INIT: r = 10;", "r = r + 1;", "r = r + 2;", "FINAL:\nr = r * 2;"]
    )
    assert both(running(tmp_path, lambda c: called(c, table)), [0, 5]) == [24, 22]


def test_a_table_without_a_decision_that_fits_does_nothing(tmp_path: Path) -> None:
    table = WrittenTable(["v > 1"], ["T 1"], ["r = 4;"])
    assert both(running(tmp_path, lambda c: called(c, table)), [0, 5]) == [0, 4]


@pytest.mark.parametrize(
    ("table", "told"),
    [
        (WrittenTable(["v > 1"], ["X 1"], ["r = 4;"]), "a decision has 'X': write T, F or -"),
        (WrittenTable(["v > 1"], ["T 5"], ["r = 4;"]), "a decision names the action 5, which is not there"),
        (WrittenTable(["v >"], ["T 1"], ["r = 4;"]), "the truth table r = f"),
    ],
)  # fmt: skip
def test_a_table_that_has_no_meaning_is_told(tmp_path: Path, table: WrittenTable, told: str) -> None:
    with pytest.raises(DrawnFault, match=told):
        running(tmp_path, lambda c: called(c, table))


def test_a_truth_table_may_be_a_block(tmp_path: Path) -> None:
    model = WrittenModel("one", step="0.1")
    port, end = model.root.inport("u", 1, OutDataTypeStr="double"), model.root.outport("log", 1)
    block, chart = model.root.chart("T", "Truth Table")
    chart.data("u", "input", "double")
    chart.data("r", "output", "double")
    chart.truth_table("truth_table_kernel()", BANDS)
    chart.transition(None, chart.junction(), "{truth_table_kernel();}")
    model.root.line(port, block)
    model.root.line(block, end)
    runner = ModelRunner(read_model(model.save(tmp_path / "one.slx")))
    assert both(runner, [-3, 3, 9]) == [1, 1, 2]


def test_a_table_with_cells_missing_is_told_with_its_line(tmp_path: Path) -> None:
    def draw(c: WrittenChart) -> None:
        called(c)

    running(tmp_path, draw)
    model = WrittenModel("one", step="0.1")
    _, chart = model.root.chart("C")
    called(chart)
    files = dict(model.files())
    part = next(name for name in files if "chart_" in name)
    files[part] = files[part].replace(b'Dimension="3*5"', b'Dimension="3*6"')
    packed(tmp_path / "two.slx", files)
    with pytest.raises(
        ModelError, match=r"line \d+: predicateArray has 15 cells, and its Dimension is '3\*6'"
    ):
        read_model(tmp_path / "two.slx")
