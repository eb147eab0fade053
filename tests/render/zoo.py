"""Toy charts, graphs and traces that every renderer must be able to show."""

from rovercheck.checker.explore.graphs.projection import project
from rovercheck.checker.results.graph import StateGraph, with_trace
from rovercheck.checker.results.trace import TakenTransition, Tick, Trace
from rovercheck.spec_model.lang.action import assign, send, when
from rovercheck.spec_model.lang.chart import Chart, Junction, State, to
from rovercheck.spec_model.lang.domain import enumeration, fixed, integer
from rovercheck.spec_model.lang.expr import Var, flag, var
from rovercheck.spec_model.lang.time import sec
from rovercheck.spec_model.lang.words import after, duration, named, rising
from tests.render.tabulated import tabulated
from tests.traces import trace_of

level = var("level", integer(0, 300), 0, "how high <it> stands & more")
speed = var("speed", fixed(-1, 1, 0.1, "m/s"))
alarm = flag("alarm")
mode = var("mode", enumeration("Mode", ["SAFE", "CRITICAL"]))
high = named("too_high", (level > 200) & ~alarm)

relay = Chart(
    "Relay",
    [
        State("Ours", entry=[assign(alarm, False)], transitions=[to("Theirs", when=level >= 100)]),
        State(
            "Theirs",
            entry=[assign(alarm, True)],
            transitions=[to("Ours", when=duration(level < 5) > 3 * sec)],
        ),
    ],
    default="Ours",
    text="Two states & one duration, so that < and > need care.",
)  # fmt: skip

monitor = Chart(
    "Monitor",
    [
        State(name, entry=[assign(mode, value)], transitions=[to("decide")])
        for name, value in (("OK", "SAFE"), ("DEG", "SAFE"), ("CRIT", "CRITICAL"))
    ],
    junctions=[
        Junction("decide", [to("CRIT", when=high), to("DEG", when=level > 100), to("OK", when=level < 90)])
    ],
    default=[to("decide"), to("OK")],
    text="Three states around one decision.",
)  # fmt: skip

nested = Chart(
    "Nested",
    [
        State(
            "Run",
            entry=[assign(speed, 0)],
            during=[when(alarm, [assign(speed, 0)], [when(high, [assign(speed, -1)], [assign(speed, 1)])])],
            exit=[assign(alarm, False)],
            default="Slow",
            states=[
                State("Slow", transitions=[to("Fast", when=level > 3), to("Deep", when=level == 7)]),
                State("Fast", default="Deep", states=[State("Deep"), State("Deeper")],
                      transitions=[to("Slow", when=alarm), to("Fast", when=level == 9)]),
            ],
            transitions=[
                to("Stop.Brake", when=high | (level == 299), do=[assign(alarm, True), assign(speed, 0)])
            ],
        ),
        State(
            "Stop",
            states=[State("Brake", transitions=[to("Rest", when=after(1 * sec))]), State("Rest")],
            transitions=[to("Run", when=~alarm, then=[assign(speed, 1)])],
        ),
    ],
    default="Run",
)  # fmt: skip


def region(name: str) -> State:
    return State(name, default="Idle", states=[
        State("Idle", transitions=[to("Busy", on=f"go{name}")]),
        State("Busy", transitions=[to("J1", when=level > 2), to("Idle", when=after(3 * sec))]),
    ], junctions=[
        Junction("J1", [to("J2", do=[send("stop", "Main"), assign(alarm, True)])]),
        Junction("J2", [to("Idle")]),
    ])  # fmt: skip


parallel = Chart(
    "Parallel",
    [State("Parts", parallel=True, states=[region(f"R{i}") for i in range(4)]), region("Main")],
    parallel=True,
)

wide = Chart(
    "Wide",
    [
        State("Hub", transitions=[to(f"S{i}", when=(level == i) & (speed > 0) & ~alarm) for i in range(9)]),
        *(
            State(f"S{i}", transitions=[to("Hub", when=alarm), to(f"S{(i + 4) % 9}", when=high)])
            for i in range(9)
        ),
    ],
    default="Hub",
)  # fmt: skip

flat_parallel = Chart(
    "Flat",
    [State("A", default="A1", states=[State("A1"), State("A2")]), State("B")],
    parallel=True,
)

single = Chart(
    "Single",
    [State("Only", transitions=[to("Only", when=level > 1, do=[assign(alarm, True)])])],
    default="Only",
)

combo = Chart(
    "Combo",
    [
        State("Start", transitions=[to("Step2", when=rising(level) & (speed == 0))]),
        State(
            "Toggle",
            states=[
                State("Step2", transitions=[
                    to("Step3", when=rising(level)),
                    to("late", when=after(1 * sec)),
                ]),
                State("Step3", transitions=[
                    to("Start", when=rising(level), do=[assign(alarm, ~alarm)]),
                    to("late", when=after(1 * sec)),
                ]),
            ],
            junctions=[Junction("late", [to("Start")])],
            transitions=[to("Start", when=(speed > 0) | (speed < 0))],
        ),
    ],
    default=to("Start", do=[assign(alarm, False)]),
    text="Transitions into and out of a composite, through a junction inside it.",
)  # fmt: skip

crossing = Chart("Crossing", [
    State("A", default="X", states=[
        State("X", transitions=[to("Y", when=alarm), to("C.Z", when=high), to("A", when=level == 5)]),
        State("B", states=[State("Y", transitions=[to("B", when=level == 1)])]),
    ], transitions=[to("B.Y", when=level == 2)]),
    State("C", states=[State("Z", transitions=[to("X", when=alarm)])]),
], default="A")  # fmt: skip
"""Transitions across several borders, from a state to one around it, from a composite to one inside it."""

CHARTS = {c.name: c for c in (relay, monitor, nested, parallel, wide, flat_parallel, single, combo, crossing)}

ticks_left = var("Relay.Theirs.duration1", integer(0, 151))
relay_place = relay.location()
VARIABLES = {v.name: v for v in (relay_place, level, speed, alarm, mode, ticks_left)}


def _tick(
    number: int, before: dict[str, int], *transitions: TakenTransition, timer: int = 0, **changed: int
) -> Tick:
    now = before | changed | {ticks_left.name: timer}
    inputs = {"level": now.pop("level")}
    return Tick(number, inputs, now, transitions)


def long_trace(quiet: int = 150) -> Trace:
    """A change in tick 1, one in tick 2, a timer that counts for ``quiet`` ticks, and an end."""
    at = {v.name: v.init for v in VARIABLES.values() if v is not level}
    start = TakenTransition("Relay", "", "Ours", "", 0)
    there = TakenTransition("Relay", "Ours", "Theirs", "[level >= 100]", 1)
    back = TakenTransition("Relay", "Theirs", "Ours", "[duration(level < 5) > 3 s]", 1)
    ticks = [_tick(1, at, start, level=0, Relay=1)]
    ticks.append(_tick(2, at, there, level=100, Relay=2, alarm=1, speed=-5))
    for k in range(quiet):
        ticks.append(_tick(3 + k, at, level=0, Relay=2, alarm=1, speed=-5, timer=k + 1))
    ticks.append(_tick(3 + quiet, at, back, level=0, Relay=1, mode=1))
    parts = (named("never_critical", mode == "SAFE"), (speed > 0) | alarm)
    return trace_of("toy", 20, VARIABLES, ("level",), at, tuple(ticks), parts)


def short_trace() -> Trace:
    at = {v.name: v.init for v in VARIABLES.values() if v is not level}
    return trace_of("toy", 20, VARIABLES, ("level",), at, (_tick(1, at, level=3),))


TRACES = {
    "long": long_trace(),
    "short": short_trace(),
    "empty": trace_of("toy", 20, VARIABLES, ("level",), {}, ()),
}


def _graph() -> StateGraph:
    """Four states of (mode, alarm); the projection on mode hides that alarm must come first."""
    loud = {(0, 1), (1, 2)}
    steps = [((0, 0), [(0, 0), (0, 1)]), ((0, 1), [(1, 1), (0, 1)]), ((1, 1), [(1, 1)])]
    explored = tabulated([mode, alarm], [(0, 0)], steps)
    return project("toy", explored, ["mode"], lambda *ends: f"level = {250 if ends in loud else 0}")


def ring(size: int) -> StateGraph:
    """A ring of ``size`` nodes, which is exact."""
    place = Var("place", integer(0, size), 0)
    explored = tabulated([place], [(0,)], [((i,), [((i + 1) % size,)]) for i in range(size)])
    return project("ring <&>", explored, ["place"], lambda source, _: f"level = {source % 300}")


GRAPHS = {"toy": _graph(), "ring": ring(12), "marked": with_trace(_graph(), long_trace())}
