"""The whole of Board 2: first step, authorisation and return, stops, and any input at all."""

from dataclasses import replace
from math import isfinite, nan
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rovercheck.supervisor.board2.actuation import DRIVER_TIMEOUT_MS, Actuated
from rovercheck.supervisor.board2.board import Board2
from rovercheck.supervisor.board2.decision import Decision
from rovercheck.supervisor.board2.signals import Board2Inputs, Board2Outputs, FromBoard1, Statuses
from rovercheck.supervisor.timing import CLOCK
from rovercheck.supervisor.types import Level, SafetyState, SupervisorCommand
from tests.supervisor.board2_bench import B1_RECEPTION, STAMPS, Bench

LINK = {"last_valid_b1_ms", "b1_data_last_valid_ms"}
NORMAL = Statuses()


def test_the_first_step_enters_every_initial_state() -> None:
    inputs = Board2Inputs(now_ms=1_000, payload=FromBoard1(critical_mask=0xFF))
    outputs = Board2().step(inputs)
    assert outputs == Board2Outputs(
        b2_dec=Decision.DEGRADED_MOVE,
        is_motion_consistent=True,
        deg_b1=True,
        b1_requests_switch=True,
        b1_emergency=True,
    )


def test_nothing_is_read_since_power_up() -> None:
    bench = Bench(stale=set(STAMPS))
    masks = [bench.step().critical_mask for _ in range(11)]
    assert masks == [0] * 6 + [0b0101, 0b1101, 0b1101, 0b1101, 0b1111]  # after 120, 150 and 200 ms
    assert bench.step().rover_safety_state is SafetyState.SAFETY_CRITICAL


def test_the_first_authorised_step_moves_nothing_and_ignores_masks_and_obstacles() -> None:
    bench = Bench()
    bench.step()
    payload = bench.masks(critical=0xFF)
    outputs = bench.step(payload=payload, y_norm=1.0, dist_cm=(60.0, 60.0, 60.0))
    assert outputs.autorized_to_send_command
    assert outputs.rover_safety_state is SafetyState.SAFETY_DEGRADED
    assert outputs.cmd is SupervisorCommand.CMD_NORMAL
    assert outputs.v_ref_actuation == 0 and not outputs.actuate_emergency_stop
    assert outputs.actuated == Actuated(stop_pin=True, driver_timeout_ms=DRIVER_TIMEOUT_MS)
    outputs = bench.step()
    assert outputs.rover_safety_state is SafetyState.SAFETY_CRITICAL
    assert outputs.cmd is SupervisorCommand.CMD_ESTOP and outputs.actuate_emergency_stop


def test_an_authorised_board_drives_at_half_speed() -> None:
    bench = Bench()
    bench.authorise()
    outputs = bench.step(y_norm=1.0, x_norm=-0.5)
    assert (outputs.v_ref_actuation, outputs.omega_ref_actuation) == (0.5, -0.25)
    assert outputs.current_action is SupervisorCommand.CMD_NORMAL
    assert outputs.actuated.motors is not None and not outputs.actuated.stop_pin


def test_the_decision_for_board_1_knows_of_the_authorisation_one_step_later() -> None:
    bench = Bench(stale=LINK)
    history = [bench.step() for _ in range(9)]
    authorised = [outputs.autorized_to_send_command for outputs in history]
    assert authorised == [False] * 6 + [True] * 3
    assert [outputs.deg_b1 for outputs in history] == [False] + authorised[:-1]


@pytest.mark.parametrize(("critical", "degraded"), ((1, 0), (0, 1), (0, 128), (4, 0)))
def test_any_mask_of_board_1_selects_the_degraded_decision(critical: int, degraded: int) -> None:
    bench = Bench()
    bench.step(3, dist_cm=(301.0, 200.0, 301.0))
    outputs = bench.step(payload=bench.masks(critical, degraded))
    assert outputs.b2_dec is Decision.DEGRADED_STOP
    assert outputs.command is SupervisorCommand.CMD_ESTOP
    assert outputs.autorized_to_send_command is (critical == 4)


def test_a_lost_authorisation_freezes_what_the_next_one_resumes() -> None:
    bench = Bench()
    bench.authorise()
    bench.step(y_norm=-0.6)
    turning = bench.step()
    assert turning.current_action is SupervisorCommand.CMD_ROTATE_180
    assert turning.omega_ref_actuation == 0.5
    last = bench.step(151, payload=bench.masks(), y_norm=0.0)
    assert last.autorized_to_send_command
    lost = bench.step(yaw=180.0)
    assert not lost.autorized_to_send_command and lost.actuated.motors is None
    assert lost.omega_ref_actuation == 0.5
    frozen = bench.step(20, x_norm=1.0, dist_cm=(60.0, 301.0, 301.0), yaw=90.0)
    assert frozen.omega_ref_actuation == 0.5
    assert frozen.current_action is SupervisorCommand.CMD_ROTATE_180
    assert frozen.cmd is SupervisorCommand.CMD_NORMAL
    back = bench.step(payload=bench.masks(critical=B1_RECEPTION), yaw=180.0)
    assert back.current_action is SupervisorCommand.CMD_ROTATE_180
    assert back.cmd is SupervisorCommand.CMD_ESTOP
    done = bench.step()
    assert done.current_action is SupervisorCommand.CMD_NORMAL  # the target of before: 180 degrees


def test_button_edges_and_times_stand_still_without_authorisation() -> None:
    bench = Bench()
    bench.authorise()
    for button in ("btn1", "btn1", "btn2"):
        bench.step(**{button: True})
        bench.step(**{button: False})
    bench.step(152, payload=bench.masks())
    bench.step(btn2=True)
    outputs = bench.step(payload=bench.masks(critical=B1_RECEPTION))
    assert outputs.autorized_to_send_command and not outputs.backward_enabled  # over one second counted


def test_braking_with_a_critical_link_ends_after_two_seconds() -> None:
    bench = Bench(stale=LINK)
    bench.inputs = replace(bench.inputs, payload=bench.wheels(60.0))
    bench.step(8, y_norm=1.0)
    outputs = bench.step(dist_cm=(301.0, 300.0, 301.0))
    assert outputs.current_action is SupervisorCommand.CMD_ESTOP
    actions = [bench.step() for _ in range(101)]
    assert all(outputs.actuate_emergency_stop for outputs in actions[:100])
    assert [outputs.current_action for outputs in actions[98:]] == [
        SupervisorCommand.CMD_ESTOP,
        SupervisorCommand.CMD_STOP,
        SupervisorCommand.CMD_NORMAL,
    ]


def test_only_authorised_steps_count_for_the_two_seconds() -> None:
    bench = Bench()
    bench.authorise()
    bench.step(120, payload=bench.wheels(60.0), y_norm=1.0)
    bench.step(100, payload=bench.masks(), dist_cm=(301.0, 301.0, 301.0))
    braking = bench.step(dist_cm=(300.0, 301.0, 301.0))
    assert braking.current_action is SupervisorCommand.CMD_ESTOP
    autorized = [bench.step().autorized_to_send_command for _ in range(80)]
    assert autorized == [True] * 50 + [False] * 30
    bench.stale = LINK
    history = [bench.step() for _ in range(6 + 49)]
    assert [outputs.autorized_to_send_command for outputs in history[:7]] == [False] * 6 + [True]
    assert history[-1].current_action is SupervisorCommand.CMD_ESTOP
    assert bench.step().current_action is SupervisorCommand.CMD_STOP


def test_a_restored_link_returns_the_motors_151_steps_after_it_is_sound() -> None:
    bench = Bench(stale=LINK)
    bench.step(20)
    bench.stale = set()
    sound = 0
    while bench.step().statuses != NORMAL:
        sound += 1
        assert sound < 300
    assert all(bench.step().autorized_to_send_command for _ in range(150))
    assert not bench.step().autorized_to_send_command


def test_reset_is_a_new_power_up() -> None:
    bench = Bench(stale=LINK)
    bench.step(20, y_norm=1.0)
    bench.board.reset()
    inputs = Board2Inputs(now_ms=20)
    assert bench.board.step(inputs) == Board2().step(inputs)


def test_the_wrap_of_the_clock_changes_nothing() -> None:
    early, late = Bench(now_ms=2_000), Bench(now_ms=CLOCK - 500)
    for stale in (set(), LINK, set(), {"ble_last_valid_ms"}, set()):
        early.stale = late.stale = stale
        for _ in range(10):
            assert early.step(y_norm=0.8) == late.step(y_norm=0.8)


@pytest.mark.parametrize("name", ("yaw", "gz_dps", "x_norm", "y_norm"))
def test_nonsense_does_not_move_an_authorised_rover_for_long(name: str) -> None:
    bench = Bench()
    bench.authorise()
    bench.step(y_norm=1.0, x_norm=1.0)
    outputs = bench.step(12, **{name: nan})
    assert outputs.v_ref_actuation == outputs.omega_ref_actuation == 0
    assert outputs.actuate_emergency_stop


ANY = st.floats(width=32) | st.sampled_from((0.0, 1.0, -1.0, 60.0, 200.0, nan))
DISTANCES = st.tuples(ANY, ANY, ANY)
PAYLOADS = st.builds(
    FromBoard1,
    wheel_speed_rpm=st.tuples(ANY, ANY, ANY, ANY),
    critical_mask=st.sampled_from((0, 0, 4, 0xFF)),
    degraded_mask=st.integers(0, 0xFF),
)
BLOCKS = st.fixed_dictionaries(
    {
        "payload": PAYLOADS,
        "dist_cm": DISTANCES,
        "yaw": ANY,
        "gz_dps": ANY,
        "x_norm": ANY,
        "y_norm": ANY,
        "btn1": st.booleans(),
        "btn2": st.booleans(),
    }
)


@given(st.lists(st.tuples(st.integers(1, 60), st.sets(st.sampled_from(STAMPS)), BLOCKS), max_size=6))
def test_whatever_is_read_the_references_stay_in_their_range(
    blocks: list[tuple[int, set[str], dict[str, Any]]],
) -> None:
    bench = Bench()
    for steps, stale, changes in blocks:
        bench.stale = stale
        for _ in range(steps):
            outputs = bench.step(**changes)
            for reference in (outputs.v_ref_actuation, outputs.omega_ref_actuation):
                assert isfinite(reference) and abs(reference) <= 0.5
            assert outputs.critical_mask & outputs.degraded_mask == 0
            assert not outputs.actuate_emergency_stop or outputs.v_ref_actuation == 0
            assert outputs.statuses.rx_status is not Level.CRITICAL or outputs.critical_mask & 4
