"""Obstacle chart of Board 2, non-degraded state: stop at 70 cm, deviate from a moving obstacle.

[seed §3.4.1, Figs 24-27] Two parallel states: Sonars watches the three distances and sends local
events; B2Decisions turns them into the output, a number from 0 to 4.
"""

from collections.abc import Collection

from spec_model.board2.heading import FREE, Heading
from spec_model.lang.action import assign, send
from spec_model.lang.chart import Chart, Junction, State, to
from spec_model.lang.expr import Expr, Var, any_of, flag
from spec_model.lang.time import Span, sec, tick
from spec_model.lang.words import after, named
from spec_model.signals.board2 import (
    SONARS,
    B2Decision,
    d1,
    d2,
    d3,
    in_range,
    isClose,
    obj1Detected,
    obj2Detected,
    obj3Detected,
    objDetected,
    prevDEG_B1,
    stop,
)

WINDOWS = ("timerSonar12", "timerSonar21", "timerSonar23", "timerSonar32")
"""The timers of the four ordered pairs of sonars, each with its window of 3 s."""

TIMED = (*WINDOWS, "MoveToS2")
"""The states whose stay is bounded by a timer."""

# One limit for the stop and for suspending the detection (E02); any of the three sonars counts (E27).
check_emergency_stop = named("check_emergency_stop(d1, d2, d3)", any_of(d1 <= 70, d2 <= 70, d3 <= 70))


def obstacles_n(timed: Collection[str] = TIMED, heading: Heading = FREE) -> Chart:
    """The chart.  States outside ``timed`` may end their stay in any step after the step of entry.

    With all of ``timed`` the chart is the one drawn.  Each name left out replaces a counter of up to
    150 ticks by a free input and only adds runs: what is proved then holds for the chart as drawn.
    """
    stay = {name: _stay(name, name in timed) for name in TIMED}
    return Chart(
        "Obstacles",
        [
            State("Sonars", parallel=True, states=[distance_70, distance_gt70, _timers(stay)]),
            _decisions(stay["MoveToS2"], heading),
        ],
        parallel=True,
        text="Obstacles in the non-degraded state [seed §3.4.1, Figs 24-27]",
        local_to=heading.local_to,
    )


def _stay(name: str, timed: bool) -> Expr:
    length: Span = 0.5 * sec if name == "MoveToS2" else 3 * sec
    if timed:
        return after(length)
    # Not in the step of entry: a state entered and tested again in one step has a counter of 0.
    return named(f"after({length})", flag(f"{name}_over", f"the stay of {name} may end") & after(1 * tick))


look = [assign(stop, check_emergency_stop)]

distance_70 = State("distance_70", default="check_sonars_for_stopping", states=[
    State("check_sonars_for_stopping", entry=look, during=look, transitions=[
        to("check_sonars_for_moving_again", when=stop, do=[send("emergency", "B2Decisions")]),
    ]),
    State("check_sonars_for_moving_again", entry=look, during=look, transitions=[
        to("check_sonars_for_stopping", when=~stop, do=[send("safe", "B2Decisions")]),
    ]),
])  # fmt: skip


def _waiting(i: int, d: Var, is_close: Var, detected: Var) -> State:
    """Waiting_Si: rising edge of the detection flag in range, falling edge at any exit (E17, E18)."""
    WS = f"WS{i}"
    measure = [assign(is_close, in_range(d))]
    return State(f"Waiting_S{i}", default=WS, states=[
        State(WS, entry=measure, during=measure, transitions=[to("J0", when=~stop)]),
    ], junctions=[
        Junction("J0", [to("J1", when=is_close), to("J3", when=~is_close & detected)]),
        Junction("J1", [to("J2", do=[assign(detected, True)])]),
        Junction("J2", [to(WS)]),
        Junction("J3", [to("J4", do=[assign(detected, False), send(f"Fall{i}", "timers")])]),
        Junction("J4", [to(WS)]),
    ])  # fmt: skip


distance_gt70 = State("distance_gt70", parallel=True, states=[
    _waiting(*signals) for signals in zip((1, 2, 3), SONARS, isClose, objDetected, strict=True)
])  # fmt: skip


def _timer(name: str, fall: str, confirming: Var, signal: str, window_over: Expr) -> State:
    """A window of 3 s that opens when the first sonar loses the obstacle and waits for the second.

    At 3 s the end of the window comes first (E14); the level of the second flag suffices (E15); a
    second loss does not restart the window (E16).
    """
    return State(name, default="Waiting", states=[
        State("Waiting", transitions=[to("Fall1Detected", on=fall)]),
        State("Fall1Detected", transitions=[
            to("Waiting", when=window_over),
            to("J1", when=confirming),
        ]),
    ], junctions=[
        Junction("J1", [to("J2")]),
        Junction("J2", [to("J3", do=[send(signal, "B2Decisions")])]),
        Junction("J3", [to("Waiting")]),
    ])  # fmt: skip


def _timers(stay: dict[str, Expr]) -> State:
    """The four windows in the order of the figure, so that the leftmost signal comes first (E20)."""
    return State("timers", parallel=True, states=[
        _timer("timerSonar12", "Fall1", obj2Detected, "moveToS1", stay["timerSonar12"]),
        _timer("timerSonar21", "Fall2", obj1Detected, "moveToS2", stay["timerSonar21"]),
        _timer("timerSonar23", "Fall2", obj3Detected, "moveToS2", stay["timerSonar23"]),
        _timer("timerSonar32", "Fall3", obj2Detected, "moveToS3", stay["timerSonar32"]),
    ])  # fmt: skip


def _decisions(stay_S2: Expr, heading: Heading) -> State:
    """B2Decisions [seed Fig 25]: straight on for the centre sonar (E05), a deviation has no time limit
    (E08) and ignores new signals (E19), a stop ends by itself (E10)."""
    over = heading.turned | prevDEG_B1
    return State("B2Decisions", default="Waiting", states=[
        State("Waiting", entry=[assign(B2Decision, 0)], transitions=[
            to("InEmergency", on="emergency"),
            to("MoveToS3", on="moveToS3"),
            to("MoveToS1", on="moveToS1"),
            to("MoveToS2", on="moveToS2"),
        ]),
        State("InEmergency", entry=[assign(B2Decision, 1)], transitions=[to("Waiting", on="safe")]),
        State("MoveToS1", entry=[assign(B2Decision, 2), *heading.store_target], transitions=[
            to("J2", on="emergency"),
            to("Waiting", when=over),
        ]),
        State("MoveToS2", entry=[assign(B2Decision, 3)], transitions=[
            to("J3", on="emergency"),
            to("Waiting", when=stay_S2 | prevDEG_B1),
        ]),
        State("MoveToS3", entry=[assign(B2Decision, 4), *heading.store_target], transitions=[
            to("J1", on="emergency"),
            to("Waiting", when=over),
        ]),
    ], junctions=[
        Junction("J3", [to("J2")]),
        Junction("J2", [to("J1")]),
        Junction("J1", [to("InEmergency")]),
    ])  # fmt: skip
