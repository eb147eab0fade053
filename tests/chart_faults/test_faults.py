"""At least three faults in each chart, put there by hand; each changes the verdict of a named property."""

from collections import Counter
from itertools import chain

import pytest

from benchmarks.faults.edits import BlockEdit, ChartEdit, no_during, no_entry
from rovercheck.checker.results.trace import Trace
from rovercheck.checker.results.verdict import Violated
from rovercheck.spec_model.lang.edit import (
    constant,
    drop,
    everywhere,
    guard,
    in_expressions,
    operator,
    swap,
    timer,
)
from rovercheck.spec_model.lang.expr import Apply, Expr
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.time import sec
from rovercheck.spec_model.rover import charts
from rovercheck.spec_model.signals import board1 as b1
from tests.chart_faults import test_board2_faults, test_composition_faults, test_motion_faults
from tests.chart_faults.faults import (
    ChartFaults,
    expressions,
    goes_to,
    in_blocks,
    in_charts,
    value,
    with_fault,
)


def _forget_sonar(expr: Expr) -> Expr:
    """``a | b | c`` becomes ``a | b``."""

    def change(node: Expr) -> Expr:
        if isinstance(node, Apply) and node.op is Op.OR and len(node.args) == 3:
            return Apply(Op.OR, node.args[:2], node.sort)
        return node

    return everywhere(expr, change)


CHARTS: dict[str, list[tuple[str, str, ChartEdit]]] = {
    "Monitor_temperature": [
        ("60 becomes 64", "PB1-02a", lambda c: in_expressions(c, constant(60, 64))),
        ("4 s become 3.98 s", "PB1-03", lambda c: guard(c, "decide", 1, timer(3.98 * sec))),
        ("4 s become 4.02 s", "PB1-02a", lambda c: guard(c, "decide", 1, timer(4.02 * sec))),
        ("degraded tested before critical", "PB1-02a", lambda c: swap(c, "decide")),
        ("stale above 65 becomes above 64", "PB1-03", lambda c: guard(c, "decide", 1, constant(65, 64))),
    ],
    "Monitor_battery": [
        ("< 23 becomes <= 23", "PB1-05a", lambda c: guard(c, "decide", 2, operator(Op.LT, Op.LE))),
        ("> 25 becomes >= 25", "PB1-05b", lambda c: guard(c, "decide", 3, operator(Op.GT, Op.GE))),
        ("5 s become 5.02 s", "PB1-28a", lambda c: guard(c, "decide", 1, timer(5.02 * sec))),
        ("degraded tested before critical", "PB1-28a", lambda c: swap(c, "decide")),
    ],
    "Monitor_reception": [
        ("120 ms become 140 ms", "PB1-07a", lambda c: guard(c, "decide", 1, constant(120, 140))),
        ("> 120 becomes >= 120", "PB1-08a", lambda c: guard(c, "decide", 1, operator(Op.GT, Op.GE))),
        ("slow tested before silent", "PB1-07a", lambda c: swap(c, "decide")),
    ],
    "Monitor_heartbeat": [
        ("120 ms become 140 ms", "PB1-07b", lambda c: guard(c, "decide", 1, constant(120, 140))),
        ("> 120 becomes >= 120", "PB1-08b", lambda c: guard(c, "decide", 1, operator(Op.GT, Op.GE))),
        ("slow tested before silent", "PB1-07b", lambda c: swap(c, "decide")),
    ],
    **{
        f"Monitor_wheel_{wheel}": [
            ("or instead of and", f"PB1-06a-{wheel}",
             lambda c: guard(c, "decide", 1, operator(Op.AND, Op.OR))),
            ("lost encoder forgotten", f"PB1-30a-{wheel}", lambda c: drop(c, "decide", 2)),
            ("no way back to OK", f"PB1-06b-{wheel}", lambda c: drop(c, "decide", 3)),
        ]
        for wheel in ("FL", "FR", "RL", "RR")
    },
    "Relay": [
        ("and instead of or", "PB1-11", lambda c: guard(c, "B1_actuating", 1, operator(Op.OR, Op.AND))),
        ("> 3 s becomes >= 3 s", "PB1-13a", lambda c: guard(c, "B2_actuating", 1, timer(strict=False))),
        ("3 s become 3.02 s", "PB1-14", lambda c: guard(c, "B2_actuating", 1, timer(3.02 * sec))),
        ("relay not opened on entry", "PB1-11", no_entry("B2_actuating")),
    ],
    "Safety_state": [
        ("degraded tested before critical", "PB1-16c", lambda c: swap(c, "Rover_Safe_State")),
        ("and instead of or", "PB1-16c", lambda c: guard(c, "Rover_Safe_State", 1, operator(Op.OR, Op.AND))),
        ("critical kept while degraded", "PB1-16f", lambda c: drop(c, "critical_1", 2)),
        ("degraded not announced", "PB1-16f", no_entry("Rover_Degraded_State")),
        ("a repair: critical first", "PB1-16d", lambda c: swap(c, "Rover_Degraded_State")),
    ],
    "Motion_Supervision": [
        ("and instead of or", "PB1-18a",
         lambda c: guard(c, "Stato_marcia_rover", 1, operator(Op.OR, Op.AND))),
        ("turning kept in the brake", "PB1-22", no_entry("In_frenata_di_emergenza", 2)),
        ("released while critical", "PB1-23d",
         lambda c: guard(c, "Procedura_emergency_stop", 1, operator(Op.AND, Op.OR))),
        ("1 s at rest becomes 0.5 s", "PB1-24b",
         lambda c: guard(c, "In_frenata_di_emergenza", 1, timer(0.5 * sec))),
    ],
    "Obstacles": [
        ("70 becomes 71", "PB2-03", lambda c: in_expressions(c, constant(70, 71))),
        ("above 100 becomes above 70", "PB2-05c", lambda c: in_expressions(c, constant(100, 70))),
        ("up to 300 becomes below 300", "PB2-05c", lambda c: in_expressions(c, constant(300, 299))),
        ("stop is not recomputed", "PB2-02b", no_during("check_sonars_for_stopping")),
        ("only two sonars count", "PB2-02b", lambda c: in_expressions(c, _forget_sonar)),
        ("no emergency from MoveToS1", "PB2-02b", lambda c: drop(c, "MoveToS1", 1)),
        ("0.5 s become 0.48 s", "PB2-10-least", lambda c: guard(c, "MoveToS2", 2, timer(0.48 * sec))),
        ("3 s become 3.02 s", "PB2-05-12",
         lambda c: guard(c, "timerSonar12.Fall1Detected", 1, timer(3.02 * sec))),
        ("confirmation tested before the end of the window", "PB2-05-12",
         lambda c: swap(c, "timerSonar12.Fall1Detected")),
    ],
    "ObstaclesDegraded": [
        ("300 becomes 299", "PB2-12-chart", lambda c: in_expressions(c, constant(300, 299))),
        ("<= 300 becomes < 300", "PB2-12-chart", lambda c: in_expressions(c, operator(Op.LE, Op.LT))),
        ("stop not announced", "PB2-12-chart", no_entry("check_sonars_for_moving_again")),
    ],
}  # fmt: skip

BLOCKS: dict[str, list[tuple[str, str, BlockEdit]]] = {
    "Fault_masks": [
        ("unequal instead of equal", "PB1-10a", expressions(operator(Op.EQ, Op.NE))),
        ("bit 6 is set as bit 5", "PB1-10b", expressions(constant(64, 32))),
        ("bit 4 is set as bit 3", "PB1-31a", expressions(constant(16, 8))),
    ],
    "Own_causes": [
        ("the masks exchanged", "PB1-10g", goes_to(b1.b1_critical, for_=b1.b1_degraded)),
        ("bit 0 is no cause", "PB1-10g", value(b1.b1_critical, constant(0, 1))),
    ],
    "Process_B2_masks": [
        ("bit 1 becomes bit 2", "PB1-16h", value(b1.b2_critical, constant(1, 2))),
        ("bit 3 is no degraded cause", "PB1-16h", value(b1.b2_degraded, constant(3, 2))),
    ],
}  # fmt: skip

FAULTS = [*in_charts(CHARTS), *in_blocks(BLOCKS)]


class TestCharts(ChartFaults):
    FAULTS = FAULTS


def test_every_chart_has_at_least_three_faults() -> None:
    others = (test_motion_faults, test_board2_faults, test_composition_faults)
    count = Counter(fault.part for fault in chain(FAULTS, *(module.FAULTS for module in others)))
    assert {name for name in charts() if count[name] < 3} == set()


TRANSITIONS = {
    "Monitor_battery: degraded tested before critical": "Monitor_battery: ",
    "Obstacles: 70 becomes 71": "Obstacles: ",
    "Relay: > 3 s becomes >= 3 s": "Relay: B2_actuating -> B1_actuating (transition 1)",
}


@pytest.mark.parametrize("name", TRANSITIONS)
def test_the_counterexample_names_the_transition(name: str) -> None:
    [fault] = [f for f in FAULTS if str(f) == name]
    verdict = with_fault(fault)
    assert isinstance(verdict, Violated) and isinstance(verdict.because, Trace)
    fired = [str(a) for t in verdict.because.ticks for a in t.transitions]
    assert any(TRANSITIONS[name] in a for a in fired), fired
