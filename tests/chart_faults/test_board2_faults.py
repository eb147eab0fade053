"""Faults put by hand into the supervisor and the tasks of Board 2; each changes the verdict of a property."""

from dataclasses import replace
from fractions import Fraction

from benchmarks.faults.edits import BlockEdit, ChartEdit, no_during, no_entry
from rovercheck.spec_model.board2 import acquisition as acq
from rovercheck.spec_model.board2 import coherence as coh
from rovercheck.spec_model.lang.chart import Chart
from rovercheck.spec_model.lang.edit import (
    constant,
    drop,
    edit_transition,
    guard,
    in_expressions,
    instead,
    operator,
    timer,
)
from rovercheck.spec_model.lang.expr import FALSE, TRUE, member, var
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.time import ms, sec
from rovercheck.spec_model.lang.words import bit, maximum
from rovercheck.spec_model.signals import board2 as obstacles
from rovercheck.spec_model.signals import board2_supervisor as b2
from rovercheck.spec_model.signals.common import COMMAND, RX_STATUS
from tests.chart_faults.faults import (
    ChartFaults,
    expressions,
    forgotten,
    goes_to,
    in_blocks,
    in_charts,
    mistaken,
    reads,
    value,
)

since, pending = (var(f"{b2.BLE.name}_{what}", b2.COUNT) for what in ("since", "pending"))
degraded_for_critical = mistaken(member(RX_STATUS, "RX_DEGRADED"), for_=member(RX_STATUS, "RX_CRITICAL"))
normal_for_stop = mistaken(member(COMMAND, "CMD_NORMAL"), for_=member(COMMAND, "CMD_ESTOP"))


def _never_silent(chart: Chart) -> Chart:
    return guard(chart, "BLE.OK", 2, constant(120, 140))


CHARTS: dict[str, list[tuple[str, str, ChartEdit]]] = {
    "Monitors_2": [
        ("120 ms become 140 ms for the joystick", "PB2-19b", _never_silent),
        ("120 ms become 140 ms for the joystick, at once", "PB2-19i", _never_silent),
        ("120 ms become 100 ms for the joystick", "PB2-19m",
         lambda c: guard(c, "BLE.OK", 2, constant(120, 100))),
        ("150 ms become 160 ms for Board 1", "PB2-19h",
         lambda c: guard(c, "Board1Supervisor.OK", 2, constant(150, 160))),
        ("200 ms become 220 ms for the IMU", "PB2-19c", lambda c: guard(c, "IMU.OK", 2, constant(200, 220))),
        ("> 120 ms becomes >= 120 ms for the reception", "PB2-19e",
         lambda c: guard(c, "Rx.OK", 2, operator(Op.GT, Op.GE))),
        ("a slow source never falls silent", "PB2-19b", lambda c: drop(c, "BLE.DEG", 2)),
        ("1 s becomes 0.98 s", "PB2-19f", lambda c: guard(c, "Rx.CRIT", 1, timer(0.98 * sec))),
        ("2 s become 1 s for Board 1", "PB2-19g",
         lambda c: guard(c, "Board1Supervisor.CRIT", 1, timer(1 * sec))),
        ("critical is not announced", "PB2-19d", no_entry("Rx.CRIT")),
        ("no question while degraded", "REACH-B2-RX-DEG-OK", no_during("Rx.DEG")),
        ("no way back from degraded", "REACH-B2-RX-DEG-OK", lambda c: drop(c, "Rx.DEG", 1)),
        ("the mean of another source is read", "PB2-21k",
         lambda c: guard(c, "Board1Supervisor.OK", 1, reads(b2.IMU.deg, for_=b2.SUP.deg))),
        ("the age of another source is read", "PB2-21n",
         lambda c: guard(c, "Rx.OK", 2, reads(b2.BLE.age, for_=b2.RX.age))),
    ],
    "Twin_monitors_2": [
        ("120 ms become 140 ms for the joystick", "PB2-21l", _never_silent),
        ("silence is not noticed", "PB2-21n", lambda c: drop(c, "Rx.OK", 2)),
        ("1 s becomes 0.98 s", "PB2-21m", lambda c: guard(c, "IMU.CRIT", 1, timer(0.98 * sec))),
        ("degraded is not announced", "PB2-21k", no_entry("Board1Supervisor.DEG")),
    ],
    "Check_Board1": [
        ("and instead of or", "PB2-14a", lambda c: guard(c, "B1_actuating", 1, operator(Op.OR, Op.AND))),
        ("degraded reception instead of critical", "PB2-14b",
         lambda c: guard(c, "B1_actuating", 1, degraded_for_critical)),
        ("the request of Board 1 is not looked at", "PB2-14a",
         lambda c: guard(c, "B1_actuating", 1, instead(b2.b1_requests_switch.name, lambda _: FALSE))),
        ("3 s become 2.98 s", "PB2-15a", lambda c: guard(c, "B2_trying_to_actuate", 1, timer(2.98 * sec))),
        ("3 s become 3.02 s", "PB2-15b", lambda c: guard(c, "B2_trying_to_actuate", 1, timer(3.02 * sec))),
        ("> 3 s becomes >= 3 s", "PB2-15a",
         lambda c: guard(c, "B2_trying_to_actuate", 1, timer(strict=False))),
        ("the authorisation is not given", "PB2-14a", no_entry("B2_trying_to_actuate")),
        ("the authorisation is not withdrawn", "PB2-15b", no_entry("B1_actuating")),
    ],
    "Safety_state_2": [
        ("and instead of or", "PB2-17t",
         lambda c: guard(c, "Rover_Degraded_State", 1, operator(Op.OR, Op.AND))),
        ("critical for good", "PB2-17u", lambda c: drop(c, "Rover_Critical_State", 1)),
        ("left while one emergency lasts", "PB2-17t",
         lambda c: guard(c, "Rover_Critical_State", 1, operator(Op.OR, Op.AND))),
        ("critical is not announced", "PB2-17t", no_entry("Rover_Critical_State")),
    ],
    "ObstaclesDriving": [
        ("300 becomes 299", "PB2-13t", lambda c: in_expressions(c, constant(300, 299))),
        ("<= 300 becomes < 300", "PB2-13t", lambda c: in_expressions(c, operator(Op.LE, Op.LT))),
        ("stop not announced", "PB2-13t", no_entry("check_sonars_for_moving_again")),
        ("stop for good", "PB2-13u", lambda c: drop(c, "check_sonars_for_moving_again", 1)),
    ],
    "SonarTask": [
        ("20 ms become 21 ms", "PB2-27c", lambda c: guard(c, "Scanning", 2, timer(21 * ms))),
        ("20 ms become 19 ms", "PB2-27d", lambda c: guard(c, "Scanning", 2, timer(19 * ms))),
        ("the notification is not waited for", "REACH-SONAR-NOTIFIED", lambda c: drop(c, "Scanning", 1)),
        ("nothing published after 20 ms", "PB2-27d",
         lambda c: edit_transition(c, "Scanning", 2, lambda t: replace(t, do=()))),
        ("a missing echo counts as 70 cm", "PB2-27e", lambda c: in_expressions(c, constant(301, 70))),
        ("57 µs for each cm", "PB2-27g", lambda c: in_expressions(c, constant(58, 57))),
        ("the count survives the trigger", "PB2-26a", no_entry("Scanning", 3)),
        ("a flag survives the trigger", "PB2-26a", no_entry("Scanning", 1)),
    ],
}  # fmt: skip

BLOCKS: dict[str, list[tuple[str, str, BlockEdit]]] = {
    "TranslateDecision": [
        ("the selection inverted", "PB2-12-command",
         value(obstacles.B2Dec, instead(obstacles.DEG_B1.name, lambda degraded: ~degraded))),
        ("no stop in the non-degraded state", "PB2-02e", value(obstacles.command, constant(1, 3))),
        ("left and right exchanged", "PB2-11c", value(obstacles.command, constant(2, 4))),
    ],
    "esp.note": [
        ("the time since the stamp is not counted", "PB2-21f", forgotten(since)),
        ("a gap one tick too short", "PB2-21f", value(pending, constant(1, 0))),
        ("a gap one tick too long", "PB2-21j", value(pending, constant(1, 2))),
    ],
    "Fault_masks_2": [
        ("bit 3 is set as bit 2", "PB1-10d", expressions(constant(8, 4))),
        ("the masks are exchanged", "PB1-10e", goes_to(b2.critical_mask, for_=b2.degraded_mask)),
        ("bit 1 is set as bit 0", "PB1-10e", value(b2.degraded_mask, constant(2, 1))),
        ("unequal instead of equal", "PB1-10f", expressions(operator(Op.EQ, Op.NE))),
        ("degraded reception sets the critical bit", "PB1-10d",
         value(b2.critical_mask, degraded_for_critical)),
    ],
    "Process_masks": [
        ("bit 7 becomes bit 6", "PB2-14e", value(b2.b1_requests_switch, constant(7, 6))),
        ("bit 0 stops no more", "PB2-14e", value(b2.b1_emergency, constant(0, 1))),
        ("a critical IMU is no emergency", "PB2-17r",
         value(b2.b2_emergency, lambda _: bit(b2.critical_mask, 0))),
        ("degraded instead of critical", "PB2-17r",
         value(b2.b2_emergency, reads(b2.degraded_mask, for_=b2.critical_mask))),
        ("request and emergency exchanged", "PB2-14e", goes_to(b2.b1_requests_switch, for_=b2.b1_emergency)),
    ],
    "Obstacle_command": [
        ("6 becomes 5", "PB2-13t", expressions(constant(6, 5))),
        ("unequal instead of equal", "PB2-13t", expressions(operator(Op.EQ, Op.NE))),
        ("no stop", "PB2-13t", expressions(normal_for_stop)),
        ("always a stop", "PB2-13u", value(b2.cmd, lambda _: member(COMMAND, "CMD_ESTOP"))),
        ("no command", "PB2-13t", forgotten(b2.cmd)),
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
        ("a window that begins too late", "REACH-COH-SHORT", value(coh.short_open, constant(0, 1))),
    ],
    "Coherence.long": [
        ("any long window", "PB2-28c", value(coh.long_result, operator(Op.AND, Op.OR))),
        ("result also between the windows", "PB2-28c",
         value(coh.long_result, reads(coh.started, for_=coh.long_ends))),
        ("3 s become 2.98 s", "REACH-COH-LONG", expressions(constant(150, 149))),
    ],
    "Coherence.result": [
        ("or instead of and", "PB2-28a", expressions(operator(Op.AND, Op.OR))),
        ("short windows only", "PB2-28a", value(b2.is_motion_consistent, lambda _: coh.short_result)),
        ("long windows only", "PB2-28e", value(b2.is_motion_consistent, lambda _: coh.long_result)),
    ],
    "Coherence.clear": [
        ("the short window is not cleared", "PB2-28g", forgotten(coh.imu_short)),
        ("the short window cleared with the long", "PB2-28g",
         expressions(reads(coh.long_ends, for_=coh.short_ends))),
        ("the long window cleared with the short", "REACH-COH-LONG",
         expressions(reads(coh.short_ends, for_=coh.long_ends))),
    ],
    "Coherence.stamps": [
        ("the gap of an IMU stamp counts twice", "REACH-COH-SHORT", value(coh.imu_gap, constant(0, 1))),
        ("it counts twice in long windows", "REACH-COH-LONG", value(coh.long_gap, constant(0, 1))),
        ("never started", "REACH-COH-LONG", forgotten(coh.started)),
    ],
    "Actuation": [
        ("4 rpm become 5 rpm", "PB2-16o", expressions(constant(4, 5))),
        ("4 rpm become 3 rpm", "PB2-18m", expressions(constant(4, 3))),
        ("the old speed is ramped on", "PB2-16p", value(b2.was_autorized, lambda _: TRUE)),
        ("speeds before the driver is initialised", "PB2-16p",
         value(b2.sends_speeds, reads(b2.autorized_to_send_command, for_=b2.driver_initialised))),
        ("speeds without authorisation", "PB2-16m", value(b2.sends_speeds, operator(Op.AND, Op.OR))),
        ("the stop pin inverted", "PB2-16q", value(b2.stop_pin, lambda stop: ~stop)),
        ("half of the limit", "PB2-16r", expressions(constant(80, 40))),
        ("the sides exchanged", "PB2-16s", value(b2.left_rpm, reads(b2.right_rpm, for_=b2.left_rpm))),
        ("the left side for the right", "PB2-16r", goes_to(b2.left_rpm, for_=b2.right_rpm)),
    ],
    "BleTask": [
        ("an incomplete read counts", "PB2-24",
         expressions(instead(acq.complete.name, lambda complete: complete | acq.raw_btn1))),
        ("a dead zone of a twentieth", "PB2-24b", expressions(constant(Fraction(1, 10), Fraction(26, 510)))),
        ("every read sets the last-valid instant", "PB2-25a", goes_to(acq.last_valid, for_=acq.last_run)),
        ("the last-valid instant is forgotten", "PB2-25b", forgotten(acq.last_valid)),
        ("the buttons are exchanged", "PB2-24c", goes_to(acq.button2, for_=acq.button1)),
        ("an axis is inverted", "PB2-24c", value(acq.axis_x, lambda x: 0 - x)),
        ("the last-run instant is forgotten", "PB2-25c", forgotten(acq.last_run)),
    ],
    "SonarCallbacks": [
        ("every edge counts", "PB2-26d", value(acq.count, constant(1, 2))),
        ("channel 3 for channel 2", "PB2-26c", goes_to(acq.flags[2], for_=acq.flags[1])),
        ("two channels suffice", "PB2-27b", value(acq.notified, constant(3, 2))),
        ("no notification", "PB2-27a", value(acq.notified, lambda _: FALSE)),
        ("the longer of two pulses", "PB2-26e", value(acq.captured[0], lambda w: maximum(w, acq.width[1]))),
    ],
    "SonarPeriod": [
        ("published for ever", "PB2-27e", forgotten(acq.published)),
        ("60 ms become 59 ms", "PB2-27f", expressions(constant(60, 59))),
        ("no trigger", "REACH-SONAR-NOTIFIED", forgotten(acq.phase)),
    ],
}  # fmt: skip

FAULTS = [*in_charts(CHARTS), *in_blocks(BLOCKS)]


class TestBoard2(ChartFaults):
    FAULTS = FAULTS
