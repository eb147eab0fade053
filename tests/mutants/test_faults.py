"""At least three faults in each chart, put there by hand; each changes the verdict of a named property."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache

import pytest

from checker.commands.check import length
from checker.decide import Task, decide
from checker.engine import Limits, quiet
from checker.trace import Trace
from checker.verdict import Verdict, Violated
from properties.catalogue import catalogue
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


FAULTS: dict[str, list[tuple[str, str, ChartEdit]]] = {
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
        ("relay not opened on entry", "PB1-11", _no_entry("B2_actuating")),
    ],
    "Safety_state": [
        ("degraded tested before critical", "PB1-16c", lambda c: swap(c, "Rover_Safe_State")),
        ("and instead of or", "PB1-16c", lambda c: guard(c, "Rover_Safe_State", 1, operator(Op.OR, Op.AND))),
        ("critical kept while degraded", "PB1-16f", lambda c: drop(c, "critical_1", 2)),
        ("degraded not announced", "PB1-16f", _no_entry("Rover_Degraded_State")),
        ("a repair: critical first", "PB1-16d", lambda c: swap(c, "Rover_Degraded_State")),
    ],
    "Motion_Supervision": [
        ("and instead of or", "PB1-18a",
         lambda c: guard(c, "Stato_marcia_rover", 1, operator(Op.OR, Op.AND))),
        ("turning kept in the brake", "PB1-22", _no_entry("In_frenata_di_emergenza", 2)),
        ("released while critical", "PB1-23d",
         lambda c: guard(c, "Procedura_emergency_stop", 1, operator(Op.AND, Op.OR))),
        ("1 s at rest becomes 0.5 s", "PB1-23d",
         lambda c: guard(c, "In_frenata_di_emergenza", 1, timer(0.5 * sec))),
    ],
    "Obstacles": [
        ("70 becomes 71", "PB2-03", lambda c: in_expressions(c, constant(70, 71))),
        ("stop is not recomputed", "PB2-02b", _no_during("check_sonars_for_stopping")),
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
        ("stop not announced", "PB2-12-chart", _no_entry("check_sonars_for_moving_again")),
    ],
}  # fmt: skip

CHART_FAULTS = [Fault(text, chart, killer, edit) for chart in FAULTS for text, killer, edit in FAULTS[chart]]


def _decided(killer: str, edit: Callable[[System], System]) -> Verdict:
    """The killer's verdict on its own system after the edit; an over-approximation is taken as it is."""
    prop = catalogue()[killer]
    changed = replace(edit(systems()[prop.on]), over=False)
    [result] = decide(Task(changed, (prop,)), systems(), "explicit", Limits(), quiet)
    return result.verdict


@cache
def _as_specified(killer: str) -> tuple[str, int | None]:
    verdict = _decided(killer, lambda system: system)
    return verdict.word, length(verdict)


def _notices(killer: str, edit: Callable[[System], System]) -> bool:
    """Whether the verdict, or the length of the counterexample, is another than without the edit."""
    verdict = _decided(killer, edit)
    assert verdict.word != "unknown"
    return (verdict.word, length(verdict)) != _as_specified(killer)


def _in_chart(fault: Fault) -> Callable[[System], System]:
    def change(part: Chart | Block) -> Chart | Block:
        assert isinstance(part, Chart)
        return fault.edit(part)

    return lambda system: in_system(system, fault.chart, change)


@pytest.mark.parametrize("fault", CHART_FAULTS, ids=lambda f: f"{f.chart}: {f.text}")
def test_a_fault_changes_a_verdict(fault: Fault) -> None:
    assert _notices(fault.killer, _in_chart(fault))


def test_every_chart_has_at_least_three_faults() -> None:
    assert {name for name in charts() if len(FAULTS.get(name, [])) < 3} == set()


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
    verdict = _decided(killer, _in_chart(fault))
    assert isinstance(verdict, Violated) and isinstance(verdict.because, Trace)
    fired = [str(a) for t in verdict.because.ticks for a in t.arrows]
    assert any(shown in a for a in fired), fired


BLOCK_FAULTS = [
    ("masks", "Fault_masks", "PB1-10a", operator(Op.EQ, Op.NE)),
    ("masks", "Fault_masks", "PB1-10b", constant(64, 32)),
    ("masks", "Fault_masks", "PB1-31a", constant(16, 8)),
]


@pytest.mark.parametrize(("system", "block", "killer", "change"), BLOCK_FAULTS, ids=lambda x: str(x)[:20])
def test_a_fault_in_a_block_changes_a_verdict(
    system: str, block: str, killer: str, change: Callable[[Expr], Expr]
) -> None:
    def edit(part: Chart | Block) -> Chart | Block:
        assert isinstance(part, Block)
        return in_block(part, change)

    assert catalogue()[killer].on == system
    assert _notices(killer, lambda s: in_system(s, block, edit))
