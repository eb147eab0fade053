"""At least three faults in each chart, put there by hand; each changes the verdict of a named property."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import pytest

from checker.commands.check import Compared
from checker.decide import Task, decide
from checker.engine import Limits, quiet
from checker.trace import Trace
from checker.verdict import Violated
from properties.catalogue import catalogue, expected
from spec_model.lang.chart import Block, Chart
from spec_model.lang.expr import Apply, Expr, Op
from spec_model.lang.system import System
from spec_model.lang.time import sec
from spec_model.rover import charts, systems
from tests.mutants.edit import (
    constant,
    drop,
    edit_state,
    entry,
    everywhere,
    guard,
    in_block,
    in_expressions,
    in_system,
    operator,
    swap,
    timer,
)

ChartEdit = Callable[[Chart], Chart]


@dataclass(frozen=True)
class Fault:
    """A slip in one chart, and the property that must notice it."""

    text: str
    chart: str
    killer: str
    edit: ChartEdit


def _no_entry(name: str, position: int = 0) -> ChartEdit:
    return lambda c: entry(c, name, lambda acts: (*acts[:position], *acts[position + 1 :]))


def _no_during(name: str) -> ChartEdit:
    return lambda c: edit_state(c, name, lambda s: replace(s, during=()))


def _forget_sonar(expr: Expr) -> Expr:
    """``a | b | c`` becomes ``a | b``."""

    def change(node: Expr) -> Expr:
        if isinstance(node, Apply) and node.op is Op.OR and len(node.args) == 3:
            return Apply(Op.OR, node.args[:2], node.sort)
        return node

    return everywhere(expr, change)


CHART_FAULTS = [
    Fault("60 becomes 61", "Monitor_temperature", "PB1-33a", lambda c: in_expressions(c, constant(60, 64))),
    Fault(
        "4 s become 3.98 s",
        "Monitor_temperature",
        "PB1-03",
        lambda c: guard(c, "decide", 1, timer(3.98 * sec)),
    ),
    Fault(
        "4 s become 4.02 s",
        "Monitor_temperature",
        "PB1-02a",
        lambda c: guard(c, "decide", 1, timer(4.02 * sec)),
    ),
    Fault("degraded tested before critical", "Monitor_temperature", "PB1-02a", lambda c: swap(c, "decide")),
    Fault(
        "stale above 65 becomes at least 65",
        "Monitor_temperature",
        "PB1-03",
        lambda c: guard(c, "decide", 1, constant(65, 64)),
    ),
    Fault(
        "< 23 becomes <= 23",
        "Monitor_battery",
        "PB1-05a",
        lambda c: guard(c, "decide", 2, operator(Op.LT, Op.LE)),
    ),
    Fault(
        "> 25 becomes >= 25",
        "Monitor_battery",
        "PB1-05b",
        lambda c: guard(c, "decide", 3, operator(Op.GT, Op.GE)),
    ),
    Fault(
        "5 s become 5.02 s", "Monitor_battery", "PB1-28a", lambda c: guard(c, "decide", 1, timer(5.02 * sec))
    ),
    Fault("degraded tested before critical", "Monitor_battery", "PB1-28a", lambda c: swap(c, "decide")),
    Fault(
        "120 ms become 140 ms",
        "Monitor_reception",
        "PB1-07a",
        lambda c: guard(c, "decide", 1, constant(120, 140)),
    ),
    Fault(
        "> 120 becomes >= 120",
        "Monitor_reception",
        "PB1-08a",
        lambda c: guard(c, "decide", 1, operator(Op.GT, Op.GE)),
    ),
    Fault("slow before silent", "Monitor_reception", "PB1-07a", lambda c: swap(c, "decide")),
    Fault(
        "120 ms become 140 ms",
        "Monitor_heartbeat",
        "PB1-07b",
        lambda c: guard(c, "decide", 1, constant(120, 140)),
    ),
    Fault(
        "> 120 becomes >= 120",
        "Monitor_heartbeat",
        "PB1-08b",
        lambda c: guard(c, "decide", 1, operator(Op.GT, Op.GE)),
    ),
    Fault("slow before silent", "Monitor_heartbeat", "PB1-07b", lambda c: swap(c, "decide")),
    *(
        fault
        for wheel in ("FL", "FR", "RL", "RR")
        for fault in (
            Fault(
                "or instead of and",
                f"Monitor_wheel_{wheel}",
                "PB1-06a",
                lambda c: guard(c, "decide", 1, operator(Op.AND, Op.OR)),
            ),
            Fault(
                "lost encoder forgotten", f"Monitor_wheel_{wheel}", "PB1-30a", lambda c: drop(c, "decide", 2)
            ),
            Fault("no way back to OK", f"Monitor_wheel_{wheel}", "PB1-06b", lambda c: drop(c, "decide", 3)),
        )
    ),
    Fault(
        "and instead of or", "Relay", "PB1-11", lambda c: guard(c, "B1_actuating", 1, operator(Op.OR, Op.AND))
    ),
    Fault(
        "> 3 s becomes >= 3 s", "Relay", "PB1-13a", lambda c: guard(c, "B2_actuating", 1, timer(strict=False))
    ),
    Fault("3 s become 3.02 s", "Relay", "PB1-14", lambda c: guard(c, "B2_actuating", 1, timer(3.02 * sec))),
    Fault("relay not opened on entry", "Relay", "PB1-11", _no_entry("B2_actuating")),
    Fault("no return", "Relay", "PB1-14", lambda c: drop(c, "B2_actuating", 1)),
    Fault(
        "degraded tested before critical", "Safety_state", "PB1-16a", lambda c: swap(c, "Rover_Safe_State")
    ),
    Fault("no arrow to critical", "Safety_state", "PB1-16a", lambda c: drop(c, "Rover_Safe_State", 1)),
    Fault("critical never left", "Safety_state", "PB1-16f", lambda c: drop(c, "Rover_Critical_State", 1)),
    Fault("degraded not announced", "Safety_state", "PB1-16b", _no_entry("Rover_Degraded_State")),
    Fault(
        "the fixed priorities of Rover_Degraded_State",
        "Safety_state",
        "PB1-16a",
        lambda c: swap(c, "Rover_Degraded_State"),
    ),
    Fault(
        "no brake on a critical state",
        "Motion_Supervision",
        "PB1-17a",
        lambda c: drop(c, "Stato_marcia_rover", 1),
    ),
    Fault("speed kept in the brake", "Motion_Supervision", "PB1-22", _no_entry("In_frenata_di_emergenza", 1)),
    Fault(
        "released while critical",
        "Motion_Supervision",
        "PB1-19",
        lambda c: guard(c, "Procedura_emergency_stop", 1, operator(Op.AND, Op.OR)),
    ),
    Fault(
        "1 s at rest becomes 0.5 s",
        "Motion_Supervision",
        "PB1-24",
        lambda c: guard(c, "In_frenata_di_emergenza", 1, timer(0.5 * sec)),
    ),
    Fault("70 becomes 71", "Obstacles", "PB2-03", lambda c: in_expressions(c, constant(70, 71))),
    Fault("stop is not recomputed", "Obstacles", "PB2-02b", _no_during("check_sonars_for_stopping")),
    Fault("only two sonars count", "Obstacles", "PB2-02b", lambda c: in_expressions(c, _forget_sonar)),
    Fault("no emergency from MoveToS1", "Obstacles", "PB2-02b", lambda c: drop(c, "MoveToS1", 1)),
    Fault("no way out of the emergency", "Obstacles", "PB2-03b-n2", lambda c: drop(c, "InEmergency", 1)),
    Fault(
        "0.5 s become 0.48 s",
        "Obstacles",
        "PB2-10-least",
        lambda c: guard(c, "MoveToS2", 2, timer(0.48 * sec)),
    ),
    Fault(
        "3 s become 3.02 s",
        "Obstacles",
        "PB2-05-12",
        lambda c: guard(c, "timerSonar12.Fall1Detected", 1, timer(3.02 * sec)),
    ),
    Fault(
        "confirmation before the end of the window",
        "Obstacles",
        "PB2-05-12",
        lambda c: swap(c, "timerSonar12.Fall1Detected"),
    ),
    Fault(
        "> 300 allowed", "ObstaclesDegraded", "PB2-12-chart", lambda c: in_expressions(c, constant(300, 299))
    ),
    Fault(
        "<= 300 becomes < 300",
        "ObstaclesDegraded",
        "PB2-12-chart",
        lambda c: in_expressions(c, operator(Op.LE, Op.LT)),
    ),
    Fault(
        "stop not announced", "ObstaclesDegraded", "PB2-12-chart", _no_entry("check_sonars_for_moving_again")
    ),
]


def _checked(killer: str, part: str, edit: Callable[[System], System]) -> Compared:
    """The killer's verdict on its system with the fault put in."""
    prop = catalogue()[killer]
    broken = replace(edit(systems()[prop.on]), over=False)
    [result] = decide(Task(broken, (prop,)), systems(), "explicit", Limits(), quiet)
    return Compared(result, expected(killer))


def _in_chart(fault: Fault) -> Callable[[System], System]:
    def change(part: Chart | Block) -> Chart | Block:
        assert isinstance(part, Chart)
        return fault.edit(part)

    return lambda system: in_system(system, fault.chart, change)


@pytest.mark.parametrize("fault", CHART_FAULTS, ids=lambda f: f"{f.chart}: {f.text}")
def test_a_fault_changes_a_verdict(fault: Fault) -> None:
    assert not _checked(fault.killer, fault.chart, _in_chart(fault)).as_expected


def test_every_chart_has_at_least_three_faults() -> None:
    counts = {name: sum(f.chart == name for f in CHART_FAULTS) for name in charts()}
    assert min(counts.values()) >= 3, counts


ARROWS = {
    "swapped priorities": ("Monitor_battery", "PB1-28a", "Monitor_battery: "),
    "70 becomes 71": ("Obstacles", "PB2-03", "Obstacles: "),
    "> becomes >= on a timer": ("Relay", "PB1-13a", "Relay: B2_actuating -> B1_actuating (arrow 1)"),
}


@pytest.mark.parametrize("name", ARROWS)
def test_the_counterexample_names_the_arrow(name: str) -> None:
    chart, killer, shown = ARROWS[name]
    texts = {
        "swapped priorities": "degraded tested before critical",
        "> becomes >= on a timer": "> 3 s becomes >= 3 s",
    }
    [fault] = [f for f in CHART_FAULTS if f.chart == chart and f.text == texts.get(name, name)]
    verdict = _checked(killer, chart, _in_chart(fault)).verdict
    assert isinstance(verdict, Violated) and isinstance(verdict.because, Trace)
    fired = [str(a) for t in verdict.because.ticks for a in t.arrows]
    assert any(shown in a for a in fired), fired


BLOCK_FAULTS = [
    ("masks", "Fault_masks", "PB1-10a", operator(Op.EQ, Op.NE)),
    ("masks", "Fault_masks", "PB1-10b", constant(64, 32)),
    ("masks", "Fault_masks", "PB1-31a", constant(8, 16)),
]


@pytest.mark.parametrize(("system", "block", "killer", "change"), BLOCK_FAULTS, ids=lambda x: str(x)[:20])
def test_a_fault_in_a_block_changes_a_verdict(
    system: str, block: str, killer: str, change: Callable[[Expr], Expr]
) -> None:
    def edit(part: Chart | Block) -> Chart | Block:
        assert isinstance(part, Block)
        return in_block(part, change)

    assert catalogue()[killer].on == system
    assert not _checked(killer, block, lambda s: in_system(s, block, edit)).as_expected
