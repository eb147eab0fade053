"""What each block of a diagram gives, in both readings of a model."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import pytest

from rovercheck.checker.drawn.interpret.diagram import ModelRunner
from rovercheck.checker.drawn.lower.diagram import lowered_model
from rovercheck.checker.drawn.lower.run import LoweredRun
from rovercheck.checker.simulink.model import read_model
from rovercheck.checker.simulink.writer.packages import WrittenModel
from tests.drawn.two_readings import Row, compared
from tests.simulink.packages_by_hand import refused

Values = Mapping[str, object]


def outputs(model: WrittenModel, folder: Path, rows: Sequence[Row]) -> list[tuple[float, ...]]:
    """The outputs in each row, the same in both readings."""
    read = read_model(model.save(folder / "one.slx"))
    found = compared(read, rows)
    assert (found.rows, found.refused, found.fault) == (len(rows), "", "")
    runner, run = ModelRunner(read), LoweredRun(lowered_model(read, "one.slx"))
    lowered = [tuple(run.step(row).values()) for row in rows]
    assert lowered == [tuple(runner.step(row).values()) for row in rows]
    return lowered


def block(
    kind: str, values: Values, given: Sequence[float], folder: Path, type_: str = "int8"
) -> tuple[float, ...]:
    """What one block gives for values of a type."""
    model = WrittenModel("one")
    names = "abc"[: len(given)]
    made = model.root.block(kind, "block", {"in": len(given), "out": 1}, {}, **values)
    for number, name in enumerate(names, 1):
        model.root.line(model.root.inport(name, number, OutDataTypeStr=type_), f"{made}/{number}")
    model.root.line(made, model.root.outport("y", 1))
    return outputs(model, folder, [dict(zip(names, given, strict=True))])[0]


@pytest.mark.parametrize(
    ("kind", "values", "given", "expected"),
    [
        ("Logic", {}, (1, 0), 0), ("Logic", {"Operator": "OR"}, (1, 0), 1),
        ("Logic", {"Operator": "NAND"}, (1, 0), 1), ("Logic", {"Operator": "NOR"}, (1, 0), 0),
        ("Logic", {"Operator": "XOR"}, (1, 1), 0), ("Logic", {"Operator": "NXOR"}, (1, 1), 1),
        ("Logic", {"Operator": "NOT"}, (-3,), 0), ("Logic", {"Operator": "AND"}, (-3, 2), 1),
        ("RelationalOperator", {}, (4, 4), 1), ("RelationalOperator", {"Operator": "<"}, (4, 4), 0),
        ("RelationalOperator", {"Operator": "~="}, (4, 5), 1), ("Sum", {"Inputs": "-+"}, (2, 5), 3),
        ("Sum", {"Inputs": "|+|-"}, (2, 5), -3), ("Sum", {}, (100, 100), -56),
        ("Sum", {"SaturateOnIntegerOverflow": "on"}, (100, 100), 127), ("Sum", {"Inputs": "3"}, (1, 2, 3), 6),
        ("Sum", {"OutDataTypeStr": "uint8"}, (-1, 0), 255), ("Gain", {"Gain": "3"}, (5,), 15),
        ("Product", {}, (3, 5), 15),
        ("Product", {"Inputs": "/*"}, (1, 4), 4), ("Product", {"Inputs": "*/"}, (8, 4), 2),
        ("Switch", {}, (5, 0, 6), 5), ("Switch", {}, (5, -1, 6), 6),
        ("Switch", {"Criteria": "u2 > Threshold", "Threshold": "2"}, (5, 2, 6), 6),
        ("Switch", {"Criteria": "u2 >= Threshold", "Threshold": "2"}, (5, 2, 6), 5),
        ("Switch", {"Criteria": "u2 ~= 0"}, (5, -2, 6), 5), ("Switch", {"Criteria": "u2 ~= 0"}, (5, 0, 6), 6),
        ("MinMax", {}, (3, -4), -4), ("MinMax", {"Function": "max"}, (3, -4), 3),
        ("Saturate", {"LowerLimit": "-2", "UpperLimit": "3"}, (-9,), -2),
        ("Saturate", {"LowerLimit": "-2", "UpperLimit": "3"}, (9,), 3), ("Abs", {}, (-7,), 7),
        ("Abs", {}, (-128,), -128), ("Abs", {"SaturateOnIntegerOverflow": "on"}, (-128,), 127),
    ],
)  # fmt: skip
def test_a_block_gives_the_same_in_both_readings(
    tmp_path: Path, kind: str, values: Values, given: Sequence[float], expected: float
) -> None:
    assert block(kind, values, given, tmp_path) == (expected,)


@pytest.mark.parametrize(
    ("way", "down", "up"),
    [
        ("", -2, 1),
        ("Floor", -2, 1),
        ("Ceiling", -1, 2),
        ("Zero", -1, 1),
        ("Nearest", -1, 2),
        ("Round", -2, 2),
    ],
)
def test_a_conversion_rounds_as_it_says_and_down_if_it_says_nothing(
    tmp_path: Path, way: str, down: float, up: float
) -> None:
    model = WrittenModel("one")
    for number, value in enumerate(("-1.5", "1.5"), 1):
        constant = model.root.block("Constant", f"c{number}", {"out": 1}, {}, Value=value)
        values = {"OutDataTypeStr": "int8"} | ({"RndMeth": way} if way else {})
        made = model.root.block("DataTypeConversion", f"b{number}", {"in": 1, "out": 1}, {}, **values)
        model.root.line(constant, made)
        model.root.line(made, model.root.outport(f"y{number}", number))
    assert outputs(model, tmp_path, [{}]) == [(down, up)]


def test_a_constant_that_says_nothing_is_one(tmp_path: Path) -> None:
    model = WrittenModel("one")
    model.root.line(model.root.block("Constant", "c", {"out": 1}), model.root.outport("y", 1))
    assert outputs(model, tmp_path, [{}]) == [(1,)]


def test_what_a_mux_joins_a_demux_takes_apart_in_the_same_order(tmp_path: Path) -> None:
    model = WrittenModel("one")
    both = model.root.block("Mux", "m", {"in": 2, "out": 1})
    apart = model.root.block("Demux", "d", {"in": 1, "out": 2}, {}, Outputs="2")
    model.root.line(both, apart)
    for number, name in enumerate("ab", 1):
        model.root.line(model.root.inport(name, number, OutDataTypeStr="int8"), f"{both}/{number}")
        model.root.line(f"{apart}/{number}", model.root.outport(f"y{number}", number))
    assert outputs(model, tmp_path, [{"a": 3, "b": 4}]) == [(3, 4)]


def selecting(**values: object) -> WrittenModel:
    """Some elements of the vector (a, b, c), in two outputs."""
    model = WrittenModel("one")
    both = model.root.block("Mux", "m", {"in": 3, "out": 1})
    some = model.root.block("Selector", "s", {"in": 1, "out": 1}, {}, InputPortWidth="3", **values)
    apart = model.root.block("Demux", "d", {"in": 1, "out": 2}, {}, Outputs="2")
    model.root.line(both, some)
    model.root.line(some, apart)
    for number, name in enumerate("abc", 1):
        model.root.line(model.root.inport(name, number, OutDataTypeStr="int8"), f"{both}/{number}")
    for number in (1, 2):
        model.root.line(f"{apart}/{number}", model.root.outport(f"y{number}", number))
    return model


@pytest.mark.parametrize(
    ("values", "expected"),
    [({"Indices": "[3 1]"}, (5, 3)), ({"Indices": "[2,2]", "IndexMode": "Zero-based"}, (5, 5))],
)
def test_a_selector_gives_the_elements_that_it_names(
    tmp_path: Path, values: Values, expected: tuple[int, ...]
) -> None:
    assert outputs(selecting(**values), tmp_path, [{"a": 3, "b": 4, "c": 5}]) == [expected]


@pytest.mark.parametrize(
    ("values", "said"),
    [
        ({"Indices": "[1 4]"}, "s: it names an element that is not among the 3 of its input"),
        ({"Indices": "[0 1]"}, "s: it names an element that is not among the 3 of its input"),
        ({"IndexOptions": "Index vector (port)"}, "s: of Selector blocks those are known that name"),
    ],
)
def test_a_selector_without_a_meaning_is_refused_by_both_readings(
    tmp_path: Path, values: Values, said: str
) -> None:
    read = read_model(selecting(**values).save(tmp_path / "one.slx"))
    assert all(said in one for one in refused(read))


@pytest.mark.parametrize(
    ("kind", "ran"),
    [("rising", [0, 0, 1, 0, 1, 0]), ("falling", [0, 1, 0, 1, 0, 0]), ("either", [0, 1, 1, 1, 1, 0])],
)
def test_a_triggered_subsystem_runs_at_the_edges_that_it_names(
    tmp_path: Path, kind: str, ran: list[int]
) -> None:
    """A signal falls where it comes to 0, and in the first step it does neither."""
    model = WrittenModel("one")
    made, inside = model.root.subsystem("Sub", 0, 1, "trigger")
    inside.block("TriggerPort", "Trigger", {}, {}, **({} if kind == "rising" else {"TriggerType": kind}))
    counter, chart = inside.chart("Count")
    chart.data("n", "output", "uint8")
    chart.transition(None, chart.state("A\nen, du: n = n + 1;"))
    inside.line(counter, inside.outport("n", 1))
    model.root.line(model.root.inport("a", 1, OutDataTypeStr="int8"), f"{made}#trigger")
    model.root.line(made, model.root.outport("y", 1))
    found = [y for (y,) in outputs(model, tmp_path, [{"a": one} for one in (3, 0, 2, -1, 1, 1)])]
    assert [int(now > before) for before, now in zip([0, *found], found, strict=False)] == ran


def test_integers_are_divided_by_any_other(tmp_path: Path) -> None:
    """The exact quotients of all divisors have no common resolution that a number could have."""
    rows = [
        {"a": a, "b": b} for a, b in ((7, 2), (-7, 2), (7, -128), (-128, 127), (5, 0), (-128, -1), (1, 3))
    ]
    model = WrittenModel("one")
    made = model.root.block(
        "Product", "p", {"in": 2, "out": 1}, {}, Inputs="*/", SaturateOnIntegerOverflow="on", RndMeth="Round"
    )
    for number, name in enumerate("ab", 1):
        model.root.line(model.root.inport(name, number, OutDataTypeStr="int8"), f"{made}/{number}")
    model.root.line(made, model.root.outport("y", 1))
    assert outputs(model, tmp_path, rows) == [(4,), (-4,), (0,), (-1,), (127,), (127,), (0,)]
