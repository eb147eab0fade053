"""Traces that every data format must cope with: a loop, a witness, odd names, thousands of ticks."""

from dataclasses import replace
from functools import cache

from rovercheck.checker.results.board_test import BoardStep, BoardTest, BoardUnderTest, SignalKind, StepSignal
from rovercheck.checker.results.trace import Needed, TakenTransition, Tick, Trace
from rovercheck.spec_model.lang.domain import enumeration, integer
from rovercheck.spec_model.lang.expr import flag, var
from rovercheck.spec_model.lang.place import Place
from tests.render import zoo
from tests.render.zoo import long_trace, relay
from tests.traces import changed, trace_of

HERE = Place("models/relay & co.py", 7)


def told(trace: Trace) -> Trace:
    """The trace with all that a property and charts add, its transitions in a file with an odd name."""
    ticks = tuple(
        replace(t, transitions=tuple(replace(a, place=Place(HERE.file, 10 + a.order)) for a in t.transitions))
        for t in trace.ticks
    )
    return changed(
        trace, ticks=ticks, id="TOY-1", text="It stays safe.", place=HERE, statecharts={"Relay": relay}
    )


def lasso() -> Trace:
    """Comes back to what was after tick 2."""
    return replace(told(long_trace(3)), loop=2)


def witness() -> Trace:
    return changed(told(long_trace(1)), false_parts=())


def odd() -> Trace:
    """Names that are no identifiers, that collide once they are made some, and text full of marks."""
    place = var("Ätze.Ort", enumeration("O", ["so la", "né", "a,b", "$end"]))
    word = flag("previous(x > 3)")
    again = flag("previous(x < 3)")
    count = var("#count", integer(-5, 5, "°C"))
    table = {v.name: v for v in (place, word, again, count)}
    at = {v.name: v.init for v in (place, word, again)}
    transition = TakenTransition('Ätze "<&>"', "so la", "a,b", 'go [x > "3" && "%::*/" != \x1b\x00]', 1)
    tick = Tick(1, {"#count": -3}, {**at, "Ätze.Ort": 3, "previous(x > 3)": 1}, (transition,))
    text = 'Nothing, 100% "of" it: <b>&\n::error::\\ */ is """so""" ]]> ≤ é 日\x85$end\r.'
    return trace_of("sys/tem: 1", 20, table, ("#count",), at, (tick,), (word,), id='"ODD"/1%\n', text=text)


@cache
def huge(ticks: int = 5_000) -> Trace:
    """Something happens in every tick, and never three times in a row: levels by the Thue-Morse sequence."""
    at = {"Relay": 1}
    transition = TakenTransition("Relay", "Ours", "Theirs", "[level >= 100]", 1)
    made = tuple(
        Tick(k, {"level": 100 * (k.bit_count() % 2)}, {"Relay": 1 + k.bit_count() % 2}, (transition,))
        for k in range(1, ticks + 1)
    )
    table = {n: v for n, v in zoo.TRACES["long"].system.variables.items() if n in ("Relay", "level")}
    return told(trace_of("huge", 20, table, ("level",), at, made, (flag("never"),)))


def needed() -> Trace:
    return changed(told(long_trace(2)), needed=(Needed(2, "level", frozenset({100, 101})),))


TRACES = {**zoo.TRACES, "lasso": lasso(), "witness": witness(), "odd": odd(), "needed": needed()}


TOY = BoardUnderTest(
    name="toy",
    inputs=(
        StepSignal("now_ms", SignalKind.CLOCK, 0, "start of the step"),
        StepSignal("seen_ms", SignalKind.STAMP, 0, "when the level was measured"),
        StepSignal("level", SignalKind.NUMBER, 0.0),
        StepSignal("on", SignalKind.BOOL, False),
    ),
    outputs=(
        StepSignal("lit", SignalKind.BOOL, False),
        StepSignal("age", SignalKind.WHOLE, 0, "ms since the level was measured"),
    ),
    implementation="python:nowhere:Lamp",
)

LAMP = BoardTest(
    TOY,
    "TOY-1",
    (
        BoardStep({"now_ms": 20, "seen_ms": 15, "level": 0.5, "on": True}, {"lit": True, "age": 5}),
        BoardStep({"now_ms": 40, "seen_ms": 35, "level": 0.5, "on": True}, {"lit": True, "age": 5}),
        BoardStep({"now_ms": 60, "seen_ms": 35, "level": 0.5, "on": True}, {"lit": True, "age": 25}),
        BoardStep({"now_ms": 80, "seen_ms": 35, "level": 0.25, "on": True}, {"age": 45}),
        BoardStep({"now_ms": 100, "seen_ms": 100, "level": 0.25, "on": False}, {"lit": False, "age": 0}),
    ),
)
"""A lamp that is lit while it is on and the level high, and forgets the level in the fourth step."""

LATE = replace(
    LAMP,
    name="TOY-2",
    steps=tuple(
        replace(s, inputs={n: (v - 60) % 2**32 if n.endswith("_ms") else v for n, v in s.inputs.items()})
        for s in LAMP.steps
    ),
)
"""The same while the clock begins again: its third step is at 0 ms."""

CONCRETE = {
    "one": replace(told(long_trace(1)), concrete=(LAMP,)),
    "two": replace(told(long_trace(1)), concrete=(LAMP, replace(LAMP, board=replace(TOY, name="other")))),
    "late": replace(told(long_trace(1)), concrete=(LAMP, LATE)),
    "odd": replace(odd(), concrete=(replace(LAMP, name=odd().property.id, goals=(odd().property.text,)),)),
    "unknown": told(long_trace(1)),
}
