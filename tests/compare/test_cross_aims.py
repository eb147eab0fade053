"""What the cross-check aims at: every boundary and timer of the charts, found in them and really drawn."""

from fractions import Fraction

import numpy as np
import pytest

from rovercheck.checker.compare.aims import aims
from rovercheck.checker.compare.beside import SteppedCharts, played, rerun
from rovercheck.checker.compare.environment import AROUND
from rovercheck.checker.compare.fixed_runs import fixed
from rovercheck.checker.compare.smaller import columns
from rovercheck.checker.compare.stimulus import SILENT, Every, InputBlock, Stimulus, StimulusPlayer, Toward
from rovercheck.checker.compare.strategy import ENVIRONMENTS
from rovercheck.checker.compare.values import nearest
from rovercheck.checker.testgen.scripts import blocks, script, unfolded
from rovercheck.checker.testgen.scripts import steps as steps_of
from rovercheck.spec_model.abstraction import Value, boards
from rovercheck.spec_model.abstraction.stamps import CLOCK
from rovercheck.spec_model.lang.expr import Temporal
from rovercheck.spec_model.lang.walk import nodes

BOARDS = ("board1", "board2")


def boundaries(board: str, signal: str) -> set[float]:
    found = aims(boards()[board]).boundaries
    return {float(b.value) for b in found if b.signal == signal and not b.datum and not b.source}


def test_boundaries_are_those_of_the_charts() -> None:
    assert boundaries("board1", "temperature_degC") == {-15, -5, 55, 60}
    assert boundaries("board1", "battery_pct") == {0, 15, 23, 25}
    assert boundaries("board1", "wheel_speed_rpm_FL") == {-2.5, 0, 2.5}
    assert {-0.5, 0} <= boundaries("board1", "y_norm")
    assert boundaries("board2", "d2") == {70, 100, 300}
    assert {-0.5, 0} <= boundaries("board2", "ay_norm")


def test_headings_are_aimed_at_relative_to_what_the_charts_hold() -> None:
    for board, signal, datum in (
        ("board1", "current_yaw", "targetAngle180"),
        ("board2", "yaw", "B2.targetAngle180"),
    ):
        found = {
            float(b.value) for b in aims(boards()[board]).boundaries if (b.signal, b.datum) == (signal, datum)
        }
        assert {0, 7.5, 352.5, 45, 315} <= found


def test_estimates_move_with_the_age() -> None:
    found = {b for b in aims(boards()["board1"]).boundaries if b.source == "batt_last_valid_ms"}
    assert {(b.steps, b.value) for b in found} >= {(25, Fraction("15.21")), (625, Fraction("20.25"))}


def test_lengths_are_those_of_the_charts() -> None:
    for board in BOARDS:
        which = boards()[board]
        spans = {
            n.span.ticks(20)
            for chart in which.system.charts
            for n in nodes(*chart.expressions)
            if isinstance(n, Temporal) and n.span is not None
        }
        assert spans and spans <= set(aims(which).timers)
    assert aims(boards()["board1"]).silences["last_valid_b2_ms"] == (6,)
    assert aims(boards()["board2"]).silences["imu_last_valid_ms"] == (10,)
    assert aims(boards()["board2"]).means == (2, 3, 5)


@pytest.mark.parametrize("board", BOARDS)
def test_every_boundary_is_met_at_it_and_on_both_sides(board: str) -> None:
    """In the fixed runs, whatever is drawn beside them."""
    env = ENVIRONMENTS[board]
    put: dict[str, set[float]] = {}
    for _, stimulus in fixed(env):
        for block in stimulus.blocks:
            for name, change in block.changes:
                if isinstance(change, bool | int | float):
                    put.setdefault(name, set()).add(float(change))
    for b in env.values.aims.boundaries:
        if not b.datum and not b.source:
            signal, value = env.values.signals[b.signal], float(b.value)
            assert value in put[b.signal]
            assert value <= signal.low or any(value - 1 <= v < value for v in put[b.signal])
            assert value >= signal.high or any(value < v <= value + 1 for v in put[b.signal])


@pytest.mark.parametrize("board", BOARDS)
def test_both_sides_of_every_boundary_have_several_values(board: str) -> None:
    """The nearest that firmware may tell apart, others close to it, and some far away."""
    env = ENVIRONMENTS[board]
    for b in env.values.aims.boundaries:
        if b.datum or b.source:
            continue
        signal, values = env.values.signals[b.signal], env.values.aimed[b.signal]
        below, above = [v for v in values if v < b.value], [v for v in values if v > b.value]
        sides: list[tuple[float, list[Value]]] = [(signal.low, below), (signal.high, above)]
        for end, side in sides:
            close = [v for v in side if abs(v - float(b.value)) <= 2]
            room = abs(end - float(b.value))
            assert len(close) >= (2 if room >= 2 else 1 if room else 0), (b, side)
            assert b.value == end or any(abs(v - end) < 1 for v in side)


@pytest.mark.parametrize(
    ("signal", "boundary"), [("temperature_degC", "60"), ("temperature_degC", "-5"), ("battery_pct", "15"),
                             ("wheel_speed_rpm_FL", "2.5"), ("y_norm", "-0.5"), ("x_norm", "0.1")],
)  # fmt: skip
def test_the_nearest_values_are_neighbours_in_single_precision(signal: str, boundary: str) -> None:
    at = Fraction(boundary)
    below, above = (float(v) for v in nearest(ENVIRONMENTS["board1"].values.signals[signal], at))
    assert below < at < above
    assert below == float(np.float32(below)) and above == float(np.float32(above))
    between = np.nextafter(np.float32(below), np.float32(np.inf))
    assert between == above or np.nextafter(between, np.float32(np.inf)) == above


def test_next_to_zero_nothing_vanishes_that_is_multiplied() -> None:
    below, above = nearest(ENVIRONMENTS["board1"].values.signals["y_norm"], Fraction(0))
    assert -1e-6 < below < 0 < above < 1e-6 and np.float32(above) * np.float32(above) > 0


def test_firmware_that_holds_whole_numbers_or_eighths_has_no_nearer_ones() -> None:
    assert list(nearest(ENVIRONMENTS["board2"].values.signals["d2"], Fraction(70))) == []
    assert list(nearest(ENVIRONMENTS["board2"].values.signals["yaw"], Fraction(45))) == []


def test_ages_are_tried_a_millisecond_to_either_side_of_their_limit() -> None:
    env = ENVIRONMENTS["board1"]
    lags = {lag for rhythm in env.lags for lag in rhythm.lags_ms}
    for stamp, limits in env.values.aims.silences.items():
        ages = {lag + 20 * k for lag in lags for k in range(max(env.silences(stamp)) + 1)}
        assert {20 * n + d for n in limits for d in (-20, -1, 0, 1, 20)} <= ages


@pytest.mark.parametrize("board", BOARDS)
def test_lengths_and_distances_are_drawn_around_every_aim(board: str) -> None:
    env = ENVIRONMENTS[board]
    for n in env.values.aims.timers:
        assert {n + d for d in AROUND} <= set(env.timers)
    for stamp, limits in env.values.aims.silences.items():
        assert {n + d for n in limits for d in AROUND} <= set(env.silences(stamp))
    for b in env.values.aims.boundaries:
        if b.datum:
            offsets = {t.offset for name, t in env.values.relative if (name, t.datum) == (b.signal, b.datum)}
            assert {float(b.value) + d for d in (-0.125, 0, 0.125)} <= offsets


def test_fields_change_with_their_stamp_only() -> None:
    env = ENVIRONMENTS["board2"]
    stimulus = Stimulus((
        InputBlock(2, (("ble_last_valid_ms", Every((2,))), ("ay_norm", 1))),
        InputBlock(2, (("ay_norm", -1), ("crit_mask_b1", 4))),
        InputBlock(1, (("ble_last_valid_ms", SILENT), ("ay_norm", 0))),
    ))  # fmt: skip
    seen = [(s.inputs["ble_last_valid_ms"], s.inputs["ay_norm"], s.inputs["crit_mask_b1"])
            for s in played(env.board, env.fields, stimulus)]  # fmt: skip
    assert seen == [(20, 1, 0), (20, 1, 0), (60, -1, 0), (60, -1, 0), (60, -1, 0)]


def test_a_heading_follows_what_the_charts_hold() -> None:
    env = ENVIRONMENTS["board1"]
    back = (("y_norm", -1), ("current_yaw", 90))
    toward = (("current_yaw", Toward("targetAngle180", -45.0)),)
    steps = played(
        env.board, env.fields, Stimulus((InputBlock(2, (*env.at_rest, *back)), InputBlock(1, toward)))
    )
    assert steps[-1].inputs["current_yaw"] == 225 and steps[-1].expected["angle_err"] == 45


def test_the_clock_may_wrap() -> None:
    env = ENVIRONMENTS["board2"]
    stimulus = Stimulus((InputBlock(3, env.at_rest),), CLOCK - 40)
    charts = SteppedCharts(env.board)
    nows = [
        inputs["now_ms"]
        for inputs in _stepping(StimulusPlayer(env.board, env.fields, charts), stimulus, charts)
    ]
    assert nows == [CLOCK - 40, CLOCK - 20, 0]


def _stepping(player: StimulusPlayer, stimulus: Stimulus, charts: SteppedCharts):
    for inputs in player.steps(stimulus):
        charts.step(inputs)
        yield inputs


@pytest.mark.parametrize("board", BOARDS)
def test_columns_and_held_blocks_give_the_same_inputs(board: str) -> None:
    env = ENVIRONMENTS[board]
    label, stimulus = max(fixed(env), key=lambda run: run[0] == "silences" and len(run[1]) < 400)
    steps = played(env.board, env.fields, stimulus)
    inputs = [step.inputs for step in steps]
    taken_apart = columns(env.board, inputs)
    assert taken_apart.inputs(env.board) == inputs, label
    rows = blocks(env.board, script(env.board, inputs))
    assert list(steps_of(env.board, unfolded(env.board, rows), int(inputs[0]["now_ms"]))) == inputs
    assert len(rows) < len(inputs)
    assert rerun(env.board, inputs[:20]) == steps[:20]
