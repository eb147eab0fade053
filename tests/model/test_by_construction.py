"""What the document demands of the structure: who writes what, which states there are, what a frame holds.

Each test is named after its requirement; reasons in `properties/requirements.toml` rest on them.
All are about the default interpretations.
"""

from collections.abc import Iterator

import pytest

from rovercheck.checker.system.slice import sliced
from rovercheck.spec_model.board1 import REFERENCES, SUPERVISOR, monitors
from rovercheck.spec_model.board1.masks import COMPONENTS
from rovercheck.spec_model.board2.acquisition import axis_x, axis_y, ble_task, button1, button2
from rovercheck.spec_model.board2.obstacles import WINDOWS
from rovercheck.spec_model.environment.board1 import received_payload
from rovercheck.spec_model.lang.action import Send, each_action
from rovercheck.spec_model.lang.chart import State, Transition, parts
from rovercheck.spec_model.lang.domain import Num
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.interpret import Interpreter
from rovercheck.spec_model.lang.lower import lower
from rovercheck.spec_model.lang.system import in_order
from rovercheck.spec_model.rover import systems
from rovercheck.spec_model.signals import board1 as b1
from rovercheck.spec_model.signals.board2 import SONARS
from rovercheck.spec_model.signals.common import FAULT_MASK

BOARD1 = {p.name: p for p in parts(systems()["board1"].components)}
[OBSTACLES] = systems()["obstacles_n"].charts


def writers(*written: Var) -> set[str]:
    """The charts and blocks of Board 1 that write one of the variables."""
    return {name for name, p in BOARD1.items() if any(v.name in p.written for v in written)}


def read_by(part: str) -> set[str]:
    """The data that a chart or block of Board 1 reads and does not write."""
    return set(BOARD1[part].read) - set(BOARD1[part].written)


# --- Board 1 -------------------------------------------------------------------------------------


def test_B1_GEN_01_only_the_last_block_writes_the_references() -> None:
    assert writers(b1.v_ref, b1.omega_ref) <= {p.name for p in parts([REFERENCES])}
    assert SUPERVISOR[-1] is REFERENCES


def test_B1_GEN_02_there_is_a_monitor_for_each_source_of_anomalies() -> None:
    wheels = [f"Monitor_wheel_{w}" for w in ("FL", "FR", "RL", "RR")]
    others = ["Monitor_temperature", "Monitor_battery", "Monitor_heartbeat", "Monitor_reception"]
    assert sorted(p.name for p in parts(monitors())) == sorted(wheels + others)


def test_B1_GEN_03_one_block_makes_both_masks_from_the_statuses() -> None:
    assert writers(b1.critical_mask, b1.degraded_mask) == {"Fault_masks"}
    assert read_by("Fault_masks") == {status.name for status, _, _ in COMPONENTS}


def test_B1_GEN_04_the_relay_alone_decides_from_two_statuses() -> None:
    assert writers(b1.give_b2_actuation) == {"Relay"}
    assert read_by("Relay") == {"rx_status", "b2_sup_status"}


def test_B1_GEN_06_fault_detection_has_five_kinds_of_outputs() -> None:
    kinds = [b1.temp_status, b1.batt_status, b1.b2_sup_status, b1.rx_status, *b1.wheel_status.values()]
    found = {p.name for p in parts(monitors())}
    detected = {n for name in found for n in BOARD1[name].written}
    assert {n for name in BOARD1.keys() - found for n in read_by(name) & detected} == {k.name for k in kinds}


@pytest.mark.parametrize("arrives", [False, True])
def test_B1_COM_02_received_data_change_only_when_a_frame_arrives(arrives: bool) -> None:
    board = Interpreter(in_order("board", received_payload))
    high = {b1.sent(v).name: v.domain.high for v in received_payload.written.values()}
    before = {name: board.data[name] for name in received_payload.written}
    board.step({"rx_update": int(arrives), **high})
    after = {name: board.data[name] for name in received_payload.written}
    assert after == ({n: v.domain.high for n, v in received_payload.written.items()} if arrives else before)


def test_B2_COM_04_a_frame_has_the_fields_of_the_document() -> None:
    fields = [b1.cmd, b1.x_norm, b1.y_norm, b1.current_yaw, b1.is_motion_consistent]
    assert {v.name for v in (*fields, b1.crit_mask_b2, b1.degr_mask_b2)} <= set(received_payload.written)


def test_B2_COM_07_a_mask_has_8_bits() -> None:
    assert (FAULT_MASK.low, FAULT_MASK.high, FAULT_MASK.dense) == (0, 2**8 - 1, True)
    assert {v.domain for v in (b1.critical_mask, b1.degraded_mask)} == {FAULT_MASK}


@pytest.mark.parametrize("mask", [b1.crit_mask_b2, b1.degr_mask_b2], ids=lambda mask: mask.name)
def test_B1_IN_04_a_mask_of_board_2_fits_into_8_bits(mask: Var) -> None:
    assert isinstance(mask.sort, Num) and set(mask.domain.values) <= set(FAULT_MASK.values)


def test_B2_BLE_04_two_axes_and_two_buttons_are_published() -> None:
    assert {v.name for v in (axis_x, axis_y, button1, button2)} <= set(ble_task.written)


# --- the obstacle chart of Board 2 ---------------------------------------------------------------


def below(*path: str) -> State:
    return OBSTACLES.states[path]


def names(state: State) -> tuple[str, ...]:
    return tuple(s.name for s in state.states)


def transitions(*path: str) -> Iterator[Transition]:
    """Every segment inside a state, its own included, default transitions not."""
    for place, state in OBSTACLES.states.items():
        if place[: len(path)] == path:
            yield from state.transitions
            for junction in state.junctions:
                yield from junction.transitions


def sent(*path: str) -> set[str]:
    """The events that transitions inside a state send to B2Decisions."""
    actions = [a for t in transitions(*path) for a in each_action([*t.do, *t.then])]
    return {a.event for a in actions if isinstance(a, Send) and a.receiver == "B2Decisions"}


def test_B2_OBS_06_the_transitions_of_B2Decisions_wait_for_events_of_Sonars() -> None:
    waited_for = {t.event for t in transitions("B2Decisions") if t.event}
    assert waited_for == sent("Sonars") == {"emergency", "safe", "moveToS1", "moveToS2", "moveToS3"}
    unprompted = [s.name for s in below("B2Decisions").states for t in s.transitions if t.event is None]
    assert unprompted == ["MoveToS1", "MoveToS2", "MoveToS3"], "a deviation ends by itself"


def test_B2_OBS_10_Sonars_contains_three_parallel_states() -> None:
    assert below("Sonars").parallel
    assert names(below("Sonars")) == ("distance_70", "distance_gt70", "timers")


def test_B2_OBS_13_there_is_a_timer_for_each_ordered_pair() -> None:
    assert names(below("Sonars", "timers")) == WINDOWS == tuple(f"timerSonar{p}" for p in (12, 21, 23, 32))


def test_B2_OBS_14_distance_gt70_has_a_parallel_state_for_each_sonar() -> None:
    assert below("Sonars", "distance_gt70").parallel
    assert len(names(below("Sonars", "distance_gt70"))) == len(SONARS) == 3


def _depends_on(system: str, name: str) -> set[str]:
    """What the value of a variable can depend on, inputs included."""
    whole = lower(systems()[system])
    part = sliced(whole, [whole.var(name)])
    return {v.name for v in (*part.variables, *part.inputs)}


@pytest.mark.parametrize(("status", "foreign"), [("rx_status", "heartbeat"), ("b2_sup_status", "rx")])
def test_PB1_09_each_link_status_depends_on_its_own_stamps_only(status: str, foreign: str) -> None:
    found = _depends_on("relay_links", status)
    assert f"{'rx' if foreign == 'heartbeat' else 'heartbeat'}_age" in found
    coupled = {"rx_update", "heartbeat_update"}  # a new heartbeat comes in a frame
    assert {n for n in found if n.startswith(f"{foreign}_")} <= coupled


@pytest.mark.parametrize("wheel", b1.WHEELS)
def test_PB1_31b_the_status_of_a_wheel_depends_on_no_other_wheel(wheel: str) -> None:
    found = _depends_on("board1", f"wheel_status_{wheel}")
    assert f"hasNoFeedback_{wheel}" in found
    assert not {f"hasNoFeedback_{other}" for other in b1.WHEELS if other != wheel} & found
