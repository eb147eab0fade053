"""Concrete measurements and stamps as inputs of the charts, and back."""

from collections.abc import Iterator
from fractions import Fraction
from random import Random
from typing import cast

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rovercheck.checker.adapters.python import start
from rovercheck.spec_model.abstraction import Board, boards
from rovercheck.spec_model.abstraction.stamps import CLOCK, MeanOfTen, Stamp, Updates, age, since
from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Block
from rovercheck.spec_model.lang.domain import Num, fixed
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.evaluate import evaluate
from rovercheck.spec_model.lang.expr import Var, var
from rovercheck.spec_model.lang.interpret import Interpreter
from rovercheck.spec_model.lang.lower import lower
from rovercheck.spec_model.lang.system import in_order
from rovercheck.spec_model.rover import systems

NAMES = ("board1", "board2")
FEW = 3


def held(inputs: dict[str, Var], random: Random, ticks: int) -> Iterator[dict[str, int]]:
    """Inputs that each keep their value for a while, arriving data nearly always."""
    values, left = {}, dict.fromkeys(inputs, 0)
    for _ in range(ticks):
        for name, datum in inputs.items():
            if left[name] == 0:
                usual = name.endswith("update") and random.random() < 0.7
                values[name] = 1 if usual else random.choice(list(datum.domain.values))
                left[name] = random.choice([1, 1, 2, 5, 7, 50, 150])
            left[name] -= 1
        yield dict(values)


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("seed", range(FEW))
def test_a_run_of_the_model_becomes_a_run_of_the_charts_alone(name: str, seed: int) -> None:
    """From a run with environment to stamps and floats, and from these to the same outputs."""
    model, board = Interpreter(systems()[name]), boards()[name]
    charts = Interpreter(board.system, measured=True)
    writer, reader = board.writer(), board.reader()
    for inputs in held(model.system.inputs, Random(seed), 400):
        if not evaluate(model.system.assume, {**model.valuation(), **inputs}):
            continue
        model.step(inputs)
        charts.step(reader.step(writer.step(model.valuation())))
        assert board.expected(charts.data) == board.expected(model.data)


@pytest.mark.parametrize("name", NAMES)
def test_every_input_of_the_charts_is_read(name: str) -> None:
    board = boards()[name]
    assert board.reader().step(at_first(board)).keys() == board.system.inputs.keys()


@pytest.mark.parametrize("name", NAMES)
def test_the_charts_can_be_lowered(name: str) -> None:
    """Not so while ranges were found by looking at every value of a domain: one has 2**40."""
    assert lower(boards()[name].system).step


@pytest.mark.parametrize("name", NAMES)
def test_names_are_those_of_the_document(name: str) -> None:
    board = boards()[name]
    inputs, outputs = [s.name for s in board.inputs], [o.name for o in board.outputs]
    assert len({*inputs}) == len(inputs) and len({*outputs}) == len(outputs)
    assert all("." not in each for each in (*inputs, *outputs))


@pytest.mark.parametrize("name", NAMES)
def test_firmware_may_hold_every_representative(name: str) -> None:
    for signal in boards()[name].inputs:
        if isinstance(signal.domain.sort, Num) and not signal.stamp:
            resolution = signal.domain.sort.resolution
            ends = (signal.domain.low * resolution, signal.domain.high * resolution)
            assert signal.low <= ends[0] and ends[1] <= signal.high, signal.name


def at_first(board: Board) -> dict[str, bool | int | float]:
    return {**board.at_power_up(), "now_ms": 20}


def test_a_number_between_representatives_is_itself() -> None:
    board = boards()["board1"]
    read = board.reader().step({**at_first(board), "temperature_degC": 54.25, "now_ms": 25})
    assert read["temperature_degC"] == Fraction(217, 4)
    assert read["temp_age"] == Fraction(5, 4)


def test_what_is_computed_from_a_measurement_may_lie_beyond_the_last_representative() -> None:
    """A half turn from a heading of 1.25 degrees is 178.75 long, and the grid of headings ends at 177.5."""
    angle = var("angle", fixed(-180, "177.5", "2.5", "°"))
    system = in_order("angles", Block("follow", [assign(angle, var("measured", angle.domain))]))
    charts = Interpreter(system, measured=True)
    charts.step({"measured": cast(int, Fraction(715, 10))})
    assert charts.data["angle"] == Fraction(715, 10)
    with pytest.raises(ModelError, match="leaves its domain"):
        charts.step({"measured": 72})


def test_a_decimal_on_a_limit_is_the_limit() -> None:
    """0.4 is 2/5, not the binary fraction next to it."""
    signal = next(s for s in boards()["board1"].inputs if s.name == "y_norm")
    assert signal.raw(0.4) == 4


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        ("temperature_degC", float("nan"), "no finite number"),
        ("battery_pct", 101.0, "outside 0..100"),
        ("cmd", 8, "outside SupervisorCommand_t"),
        ("btn1", 0.5, "outside boolean"),
    ],
)
def test_what_the_charts_give_no_meaning_to(name: str, value: float, message: str) -> None:
    board = boards()["board1"]
    with pytest.raises(ModelError, match=message):
        board.reader().step({**at_first(board), name: value})


@pytest.mark.parametrize("seed", range(FEW))
def test_stamps_of_board_2_may_lie_between_its_steps(seed: int) -> None:
    """Each source has a phase of its own, and is silent for a while now and then."""
    random, board = Random(seed), boards()["board2"]
    charts, firmware = (
        Interpreter(board.system, measured=True),
        start("rovercheck.supervisor.board2.board:Board2", board, isolated=False),
    )
    reader, inputs = board.reader(), board.at_power_up()
    phases = {s.name: random.randrange(20) for s in board.inputs if s.stamp} | {"last_valid_b1_ms": 0}
    for now in range(20, 12_000, 20):
        inputs["now_ms"] = now
        for name, phase in phases.items():
            if name != "now_ms" and random.random() < (0.3 if now // 2000 % 3 == 1 else 0.95):
                inputs[name] = now - phase
        charts.step(reader.step(inputs))
        shown = firmware.step(inputs)
        assert board.expected(charts.data) == {
            n: v for n, v in shown.items() if n in board.expected(charts.data)
        }, now


def test_a_reading_that_only_the_model_can_follow() -> None:
    with pytest.raises(ModelError, match="S34"):
        boards({"S34": "PARTIAL"})


def test_other_readings_change_the_charts() -> None:
    assert boards({"S43": "AND"})["board1"].system is not boards()["board1"].system


def test_values_are_shown_as_people_write_them() -> None:
    shown = {s.name: s for s in boards()["board1"].inputs}
    assert shown["cmd"].show(6) == "CMD_STOP"
    assert shown["btn1"].show(1) == "true"
    assert shown["cmd"].show(9) == "9"
    assert shown["y_norm"].show(0.5) == "0.5"
    assert shown["y_norm"].show(float("inf")) == "inf"


# --- stamps ---------------------------------------------------------------------------------------


@given(st.integers(0, CLOCK - 1), st.integers(0, CLOCK - 1))
def test_time_since_a_stamp_survives_one_wrap(then: int, passed: int) -> None:
    assert since((then + passed) % CLOCK, then) == passed


def test_an_age_between_two_steps_is_a_fraction() -> None:
    assert age(100, 60) == 2
    assert age(100, 75) == Fraction(5, 4)


def test_an_update_is_a_changed_stamp() -> None:
    updates = Updates()
    assert [updates.step(s) for s in (0, 20, 20, 60)] == [None, 0, None, 20]


@pytest.mark.parametrize(("interval", "slow"), [(40, False), (41, True)])
def test_ten_intervals_make_a_mean(interval: int, slow: bool) -> None:
    mean = MeanOfTen(40)
    said = [mean.step(interval * i) for i in range(1, 13)]
    assert said == [False] * 10 + [slow] * 2


def test_a_stamp_stays_where_the_age_stops_growing() -> None:
    stamp = Stamp()
    assert [stamp.step(20 * i, ticks, 3) for i, ticks in enumerate((0, 1, 2, 3, 3, 0), 5)] == [
        100,
        100,
        100,
        100,
        100,
        200,
    ]
