"""Faults put by hand into the supervisor and the tasks of Board 2; each changes the verdict of a property."""

import pytest

from spec_model.board2 import acquisition as acq
from spec_model.board2 import coherence as coh
from spec_model.lang.action import Action
from spec_model.lang.edit import (
    arrow,
    constant,
    drop,
    entry,
    guard,
    in_expressions,
    operator,
    swap,
    timer,
)
from spec_model.lang.expr import FALSE, TRUE, Expr, Op, member
from spec_model.lang.time import ms, sec
from spec_model.lang.words import bit
from spec_model.signals import board2_motion as motion
from spec_model.signals import board2_supervisor as b2
from spec_model.signals.common import COMMAND, RX_STATUS
from tests.mutants.faults import (
    BlockEdit,
    ChartEdit,
    Fault,
    expressions,
    forgotten,
    goes_to,
    in_blocks,
    in_charts,
    mistaken,
    no_during,
    no_entry,
    noticed,
    reads,
    value,
)

degraded_for_critical = mistaken(member(RX_STATUS, "RX_DEGRADED"), for_=member(RX_STATUS, "RX_CRITICAL"))
normal_for_stop = mistaken(member(COMMAND, "CMD_NORMAL"), for_=member(COMMAND, "CMD_ESTOP"))


def _always(result: Expr) -> BlockEdit:
    return value(b2.is_motion_consistent, lambda _: result)


CHARTS: dict[str, list[tuple[str, str, ChartEdit]]] = {
    "Monitors_2": [
        ("120 ms become 140 ms for the joystick", "PB2-19b", lambda c: guard(c, "BLE.OK", 2, constant(120, 140))),
        ("200 ms become 220 ms for the IMU", "PB2-19c", lambda c: guard(c, "IMU.OK", 2, constant(200, 220))),
        ("> 120 ms becomes >= 120 ms for the reception", "PB2-19e",
         lambda c: guard(c, "Rx.OK", 2, operator(Op.GT, Op.GE))),
        ("a slow source never falls silent", "PB2-19b", lambda c: drop(c, "BLE.DEG", 2)),
        ("silence tested before recovery", "PB2-20e", lambda c: swap(c, "BLE.DEG")),
        ("1 s becomes 0.98 s", "PB2-19f", lambda c: guard(c, "Rx.CRIT", 1, timer(0.98 * sec))),
        ("2 s become 1 s for Board 1", "PB2-19g",
         lambda c: guard(c, "Board1Supervisor.CRIT", 1, timer(1 * sec))),
        ("critical is not announced", "PB2-19d", no_entry("Rx.CRIT")),
        ("no question while degraded", "PB2-21h", no_during("Rx.DEG")),
        ("no way back from degraded", "REACH-B2-RX-DEG-OK", lambda c: drop(c, "Rx.DEG", 1)),
        ("the mean of another source is read", "PB2-21k",
         lambda c: guard(c, "Board1Supervisor.OK", 1, reads(b2.IMU.deg, for_=b2.SUP.deg))),
        ("the age of another source is read", "PB2-21n",
         lambda c: guard(c, "Rx.OK", 2, reads(b2.BLE.age, for_=b2.RX.age))),
    ],
    "Twin_monitors_2": [
        ("120 ms become 140 ms for the joystick", "PB2-21l", lambda c: guard(c, "BLE.OK", 2, constant(120, 140))),
        ("silence is not noticed", "PB2-21n", lambda c: drop(c, "Rx.OK", 2)),
        ("1 s becomes 0.98 s", "PB2-21m", lambda c: guard(c, "IMU.CRIT", 1, timer(0.98 * sec))),
        ("degraded is not announced", "PB2-21k", no_entry("Board1Supervisor.DEG")),
    ],
    "Check_Board1": [
        ("and instead of or", "PB2-14a", lambda c: guard(c, "B1_actuating", 1, operator(Op.OR, Op.AND))),
        ("degraded reception instead of critical", "PB2-14b",
         lambda c: guard(c, "B1_actuating", 1, degraded_for_critical)),
        ("the status of Board 1 as seen by the reception", "PB2-14a",
         lambda c: guard(c, "B1_actuating", 1, reads(b2.b1_requests_switch, for_=b2.b1_requests_switch))),
        ("3 s become 2.98 s", "PB2-15a", lambda c: guard(c, "B2_trying_to_actuate", 1, timer(2.98 * sec))),
        ("3 s become 3.02 s", "PB2-15b", lambda c: guard(c, "B2_trying_to_actuate", 1, timer(3.02 * sec))),
        ("> 3 s becomes >= 3 s", "PB2-15a", lambda c: guard(c, "B2_trying_to_actuate", 1, timer(strict=False))),
        ("the authorisation is not given", "PB2-14a", no_entry("B2_trying_to_actuate")),
        ("the authorisation is not withdrawn", "PB2-15b", no_entry("B1_actuating")),
    ],
    "Safety_state_2": [
        ("and instead of or", "PB2-17t",
         lambda c: guard(c, "Rover_Degraded_State", 1, operator(Op.OR, Op.AND))),
        ("critical for good", "PB2-17u", lambda c: drop(c, "Rover_Critical_State", 1)),
        ("left while one emergency lasts", "PB2-17s",
         lambda c: guard(c, "Rover_Critical_State", 1, operator(Op.OR, Op.AND))),
        ("critical is not announced", "PB2-17t", no_entry("Rover_Critical_State")),
    ],
    "ObstaclesDriving": [
        ("300 becomes 299", "PB2-13t", lambda c: in_expressions(c, constant(300, 299))),
        ("<= 300 becomes < 300", "PB2-13t", lambda c: in_expressions(c, operator(Op.LE, Op.LT))),
        ("stop not announced", "PB2-13t", no_entry("check_sonars_for_moving_again")),
        ("stop for good", "REACH2-NORMALE", lambda c: drop(c, "check_sonars_for_moving_again", 1)),
    ],
    "SonarTask": [
        ("20 ms become 21 ms", "PB2-27c", lambda c: guard(c, "Scanning", 2, timer(21 * ms))),
        ("20 ms become 19 ms", "PB2-27d", lambda c: guard(c, "Scanning", 2, timer(19 * ms))),
        ("the notification is not waited for", "REACH-SONAR-NOTIFIED", lambda c: drop(c, "Scanning", 1)),
        ("nothing published after 20 ms", "PB2-27d",
         lambda c: arrow(c, "Scanning", 2, lambda t: t.__class__(t.target, t.guard))),
        ("a missing echo counts as 70 cm", "PB2-27e", lambda c: in_expressions(c, constant(301, 70))),
        ("the count survives the trigger", "PB2-26a", no_entry("Scanning", 3)),
        ("a flag survives the trigger", "PB2-26a", no_entry("Scanning", 1)),
    ],
}  # fmt: skip

BLOCKS: dict[str, list[tuple[str, str, BlockEdit]]] = {
    "esp.note": [
        ("the latest stamp is forgotten", "PB2-21j", forgotten(b2.BLE.age)),
    ],
    "Fault_masks_2": [
        ("bit 3 is set as bit 2", "PB1-10d", expressions(constant(8, 4))),
        ("the masks are exchanged", "PB1-10e", goes_to(b2.critical_mask, for_=b2.degraded_mask)),
        ("the IMU's status for the joystick's", "PB1-10d", expressions(reads(b2.imu_status, for_=b2.esp_status))),
        ("unequal instead of equal", "PB1-10f", expressions(operator(Op.EQ, Op.NE))),
        ("degraded reception sets the critical bit", "PB1-10d", value(b2.critical_mask, degraded_for_critical)),
    ],
    "Process_masks": [
        ("bit 7 becomes bit 6", "PB2-14e", value(b2.b1_requests_switch, constant(7, 6))),
        ("bit 0 stops no more", "PB2-14e", value(b2.b1_emergency, constant(0, 1))),
        ("a critical IMU is no emergency", "PB2-17r", value(b2.b2_emergency, lambda _: bit(b2.critical_mask, 0))),
        ("degraded instead of critical", "PB2-17r",
         value(b2.b2_emergency, reads(b2.degraded_mask, for_=b2.critical_mask))),
        ("request and emergency exchanged", "PB2-14e", goes_to(b2.b1_requests_switch, for_=b2.b1_emergency)),
    ],
    "Obstacle_command": [
        ("6 becomes 5", "PB2-13t", expressions(constant(6, 5))),
        ("unequal instead of equal", "PB2-13s", expressions(operator(Op.EQ, Op.NE))),
        ("no stop", "PB2-13t", expressions(normal_for_stop)),
        ("always a stop", "REACH2-NORMALE", value(b2.cmd, lambda _: member(COMMAND, "CMD_ESTOP"))),
        ("no command", "REACH-B2-DRIVING-STOP", forgotten(b2.cmd)),
    ],
    "Coherence.rotation": [
        ("5° become 7°", "REACH-COH-LONG", value(coh.differs, constant(5, 7))),
        (">= 1° becomes > 1°", "REACH-COH-SHORT", value(coh.hit, operator(Op.GE, Op.GT))),
        ("the long window compared with the short", "REACH-COH-LONG",
         value(coh.differs, reads(coh.imu_short, for_=coh.imu_long))),
    ],
    "Coherence.short": [
        ("eight hits become seven", "PB2-28d", value(coh.short_result, constant(8, 7))),
        ("eight hits become nine", "PB2-28e", value(coh.short_result, constant(8, 9))),
        ("result also between the windows", "PB2-28d",
         value(coh.short_result, reads(coh.started, for_=coh.short_ends))),
        ("hits are not remembered", "REACH-COH-SHORT", forgotten(coh.ring)),
        ("the window goes on", "REACH-COH-SHORT", forgotten(coh.short_open)),
    ],
    "Coherence.long": [
        ("any long window", "PB2-28c", value(coh.long_result, operator(Op.AND, Op.OR))),
        ("the difference is not looked at", "PB2-28c",
         value(coh.long_result, reads(coh.long_ends, for_=coh.differs))),
        ("3 s become 2.98 s", "REACH-COH-LONG", expressions(constant(150, 149))),
    ],
    "Coherence.result": [
        ("or instead of and", "PB2-28a", expressions(operator(Op.AND, Op.OR))),
        ("short windows only", "PB2-28a", value(b2.is_motion_consistent, lambda _: coh.short_result)),
        ("long windows only", "PB2-28e", value(b2.is_motion_consistent, lambda _: coh.long_result)),
        ("never consistent", "PB2-28f", _always(FALSE)),
    ],
    "Coherence.clear": [
        ("the long window is not cleared", "PB2-28b", forgotten(coh.imu_long)),
        ("the short window is not cleared", "REACH-COH-SHORT", forgotten(coh.imu_short)),
        ("the long window cleared with the short", "REACH-COH-LONG",
         expressions(reads(coh.short_ends, for_=coh.long_ends))),
    ],
    "Coherence.stamps": [
        ("the IMU stamp is forgotten", "REACH-COH-SHORT", forgotten(coh.imu_gap)),
        ("the IMU stamp is forgotten for long", "REACH-COH-LONG", forgotten(coh.long_gap)),
        ("never started", "REACH-COH-LONG", forgotten(coh.started)),
    ],
    "Actuation": [
        ("4 rpm become 5 rpm", "PB2-16o", expressions(constant(4, 5))),
        ("4 rpm become 3 rpm", "PB2-18m", expressions(constant(4, 3))),
        ("the old speed is ramped on", "PB2-16p", value(b2.was_autorized, lambda _: TRUE)),
        ("speeds before the driver is initialised", "PB2-16p",
         value(b2.sends_speeds, reads(b2.autorized_to_send_command, for_=b2.driver_initialised))),
        ("speeds without authorisation", "PB2-16m", value(b2.sends_speeds, operator(Op.AND, Op.OR))),
        ("the stop pin keeps its level", "PB2-16q", forgotten(b2.stop_pin)),
        ("the left side for the right", "PB2-18m", goes_to(b2.left_rpm, for_=b2.right_rpm)),
        ("references that do not stop", "PB2-18m",
         expressions(reads(motion.omega_ref_actuation, for_=motion.v_ref_actuation))),
    ],
    "BleTask": [
        ("an incomplete read counts", "PB2-24", expressions(reads(acq.raw_btn1, for_=acq.complete))),
        ("a dead zone of a twentieth", "PB2-24b", expressions(constant(0.1, 0.05))),
        ("every read is a valid one", "PB2-25a", expressions(lambda e: TRUE if e is acq.complete else e)),
        ("the last-valid instant is forgotten", "PB2-25b", forgotten(acq.last_valid)),
        ("the last-run instant is forgotten", "PB2-25c", forgotten(acq.last_run)),
    ],
    "SonarCallbacks": [
        ("every edge counts", "PB2-26d", value(acq.count, constant(1, 2))),
        ("channel 3 for channel 2", "PB2-26c", goes_to(acq.flags[2], for_=acq.flags[1])),
        ("two channels suffice", "PB2-27b", value(acq.notified, constant(3, 2))),
        ("no notification", "PB2-27a", value(acq.notified, lambda _: FALSE)),
        ("the width is not captured", "REACH-SONAR-NOTIFIED", forgotten(acq.captured[0])),
    ],
    "SonarPeriod": [
        ("published for ever", "PB2-27e", forgotten(acq.published)),
        ("60 ms become 59 ms", "PB2-27c", expressions(constant(60, 59))),
    ],
}  # fmt: skip

CHART_FAULTS, BLOCK_FAULTS = in_charts(CHARTS), in_blocks(BLOCKS)


@pytest.mark.parametrize("fault", [*CHART_FAULTS, *BLOCK_FAULTS], ids=str)
def test_a_fault_changes_a_verdict(fault: Fault) -> None:
    assert noticed(fault)
