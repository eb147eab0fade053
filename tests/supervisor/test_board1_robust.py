"""Board 1 where the document is silent: broken measurements, nothing received, a clock that wraps."""

from math import inf, isfinite, nan

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rovercheck.supervisor.board1 import Board1, Board1Inputs
from rovercheck.supervisor.link.payloads import FromBoard2
from rovercheck.supervisor.timing import CLOCK
from rovercheck.supervisor.types import Level
from rovercheck.supervisor.types import SupervisorCommand as COMMAND
from tests.supervisor.board1_bench import Bench, lose_link, references


def test_nothing_received_since_power_up():
    board = Board1()
    outs = [board.step(Board1Inputs(now_ms=now)) for now in range(20, 6020, 20)]
    assert [out.give_b2_actuation for out in outs[:7]] == [False] * 6 + [True]
    assert all(out.give_b2_actuation for out in outs[6:])
    assert outs[0].degraded_mask == 2 and outs[24].critical_mask == 2 + 4 + 128
    assert all(references(out) == (0, 0) for out in outs)


@pytest.mark.parametrize("field", ["temperature_degc", "battery_pct"])
def test_a_measurement_that_is_no_number_becomes_critical(field):
    bench = Bench().set(y_norm=1.0)
    assert bench.step(2).v_ref == 1.0
    assert bench.set(**{field: nan}).step().v_ref == 0.5
    out = bench.step(260)
    assert out.actuate_emergency_stop and out.v_ref == 0


@pytest.mark.parametrize("value", [nan, inf, -inf])
def test_a_joystick_axis_that_is_no_number_is_centred(value):
    bench = Bench().set(x_norm=0.5, y_norm=1.0)
    bench.step(3)
    assert references(bench.set(x_norm=value, y_norm=value).step()) == (0, 0)


def test_a_collision_still_stops_when_the_joystick_breaks():
    bench = Bench().set(y_norm=1.0)
    bench.step(3)
    assert bench.set(y_norm=nan, command=COMMAND.CMD_ESTOP).step().actuate_emergency_stop


def test_wheels_that_are_no_number_do_not_stand():
    bench = Bench().set(critical_mask=1, wheel_speed_rpm=(0.0, nan, 0.0, 0.0))
    bench.step(100)
    assert bench.set(critical_mask=0).step(100).actuate_emergency_stop


def test_the_clock_may_wrap():
    steady, wrapping = Bench(1020), Bench(CLOCK - 1000)
    for bench in (steady, wrapping):
        bench.set(temperature_degc=70.0, y_norm=1.0)
    for _ in range(220):
        assert steady.step() == wrapping.step()
    assert steady.step().statuses.temp_status is Level.CRITICAL
    lose_link(steady), lose_link(wrapping)
    assert steady.step() == wrapping.step()


def test_reset_is_power_up():
    bench = Bench().set(y_norm=1.0, temperature_degc=57.0)
    bench.step(10)
    lose_link(bench)
    bench.board.reset()
    assert bench.board.step(Board1Inputs(now_ms=20)) == Board1().step(Board1Inputs(now_ms=20))
    assert bench.board.step(Board1Inputs(now_ms=40)).v_ref == 0


ANY = st.floats()
PAYLOADS = st.builds(
    FromBoard2,
    command=st.sampled_from(COMMAND),
    critical_mask=st.integers(0, 255),
    degraded_mask=st.integers(0, 255),
    is_motion_consistent=st.booleans(),
    yaw=ANY,
    x_norm=ANY,
    y_norm=ANY,
    btn1=st.booleans(),
    btn2=st.booleans(),
)
STAMPS = st.integers(0, CLOCK - 1)
INPUTS = st.builds(
    Board1Inputs,
    STAMPS,
    STAMPS,
    STAMPS,
    PAYLOADS,
    ANY,
    ANY,
    STAMPS,
    STAMPS,
    st.tuples(ANY, ANY, ANY, ANY),
    st.tuples(*[st.booleans()] * 4),
)


@given(st.lists(INPUTS, max_size=12))
def test_outputs_stay_in_range_whatever_comes_in(sequence):
    board = Board1()
    for inputs in sequence:
        out = board.step(inputs)
        assert isfinite(out.v_ref) and abs(out.v_ref) <= 1
        assert isfinite(out.omega_ref) and abs(out.omega_ref) <= 1
        assert 0 <= out.critical_mask <= 255 and 0 <= out.degraded_mask <= 255
        assert not out.critical_mask & out.degraded_mask
        assert isfinite(out.angle_err) and isfinite(out.target_angle)
        assert not (out.actuate_emergency_stop and references(out) != (0, 0))
