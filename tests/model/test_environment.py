"""Ages of Board 1: where they stop growing no comparison of the charts can change any more."""

import pytest

from rovercheck.spec_model.ambiguity import fixed
from rovercheck.spec_model.environment.board1 import (
    battery_readings,
    heartbeat_clock,
    reception_clock,
    temperature_readings,
)
from rovercheck.spec_model.lang.change import formula_of
from rovercheck.spec_model.lang.chart import Block
from rovercheck.spec_model.lang.evaluate import evaluate
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.interpret import Interpreter
from rovercheck.spec_model.lang.system import in_order
from rovercheck.spec_model.rover import systems
from rovercheck.spec_model.signals.board1 import (
    batt_age,
    battery_pct,
    heartbeat_age,
    rx_age,
    temp_age,
    temperature_degC,
)

TEMPERATURE = ("temperature", temperature_readings, "stale_above_65")
BATTERY = ("battery", battery_readings, "stale_below_15")


@pytest.mark.parametrize(
    ("name", "block", "estimate", "value", "age", "last_ms", "slowest", "choices"),
    [
        (*TEMPERATURE, temperature_degC, temp_age, 81_020, -16, {}),
        (*TEMPERATURE, temperature_degC, temp_age, 81_520, -16, {"S09": "FROM-0.5"}),
        (*BATTERY, battery_pct, batt_age, 154_780, 80, {}),
        (*BATTERY, battery_pct, batt_age, 155_280, 80, {"S24": "FROM-0.5-INSTANT"}),
    ],
    ids=["temperature", "temperature from 0.5 s", "battery", "battery from 0.5 s"],
)
def test_an_age_stops_where_every_estimate_is_past_its_limit(
    name: str,
    block: Block,
    estimate: str,
    value: Var,
    age: Var,
    last_ms: int,
    slowest: int,
    choices: dict[str, str],
) -> None:
    interpretation, last = fixed(choices), age.domain.raw(last_ms)
    [chart] = systems(choices)[name].charts
    past = formula_of(chart, estimate)
    assert all(evaluate(past, {value.name: raw, age.name: last}) for raw in value.domain.values)
    assert not evaluate(past, {value.name: value.domain.raw(slowest), age.name: last - 1})
    board = Interpreter(in_order("board", *interpretation.components([block])))
    for _ in range(last + 2):
        board.step({name: 0 for name in board.system.inputs})
    assert board.data[age.name] == last


@pytest.mark.parametrize("age", [rx_age, heartbeat_age], ids=lambda age: age.name)
def test_the_age_of_a_link_stops_at_the_first_value_above_120_ms(age: Var) -> None:
    assert [age.domain.show(age.domain.high - 1), age.domain.show(age.domain.high)] == ["120", "140"]


def test_before_the_first_update_the_age_counts_from_power_up() -> None:
    clocks = Interpreter(in_order("clocks", reception_clock, heartbeat_clock))
    clocks.step({"rx_update": 0, "heartbeat_update": 1})
    assert rx_age.domain.show(clocks.data["rx_age"]) == "20"
    assert heartbeat_age.domain.show(clocks.data["heartbeat_age"]) == "0"


def test_a_reading_is_kept_until_the_next() -> None:
    board = Interpreter(in_order("board", *fixed({}).components([temperature_readings])))
    warm, cold = (temperature_degC.domain.raw(t) for t in (57, -6))
    for update, interpretation in [(1, warm), (0, cold), (0, cold)]:
        board.step({"temp_update": update, "temp_reading": interpretation})
    assert board.data["temperature_degC"] == warm
    assert temp_age.domain.show(board.data["temp_age"]) == "40"
