"""Obstacle chart of Board 2, non-degraded state: stop at 70 cm, deviate from a moving obstacle.

[spec §3.4.1, Figs 24-27] Two parallel states: Sonars watches the three distances and sends local
events; B2Decisions turns them into the output, a number from 0 to 4.
"""

from functools import cache

from rovercheck.spec_model.board2.heading import FREE, Heading
from rovercheck.spec_model.lang.action import assign, send
from rovercheck.spec_model.lang.chart import Chart, Junction, State, to
from rovercheck.spec_model.lang.expr import Var, any_of
from rovercheck.spec_model.lang.time import sec
from rovercheck.spec_model.lang.words import after, named
from rovercheck.spec_model.signals.board2 import (
    SONARS,
    B2Decision,
    in_range,
    isClose,
    number,
    objDetected,
    prevDEG_B1,
    stop,
    touching,
)

WINDOWS = ("timerSonar12", "timerSonar21", "timerSonar23", "timerSonar32")
"""The timers of the four ordered pairs of sonars, each with its window of 3 s."""

# One limit for the stop and for suspending the detection (E02); any of the three sonars counts (E27).
check_emergency_stop = named("check_emergency_stop(d1, d2, d3)", any_of(*(touching(d) for d in SONARS)))


@cache
def obstacles_n(heading: Heading = FREE) -> Chart:
    """The chart as drawn, with what it knows of the heading: one for all systems."""
    return Chart(
        "Obstacles",
        [
            State("Sonars", parallel=True, states=[distance_70, distance_gt70, timers]),
            _decisions(heading),
        ],
        parallel=True,
        text="Obstacles in the non-degraded state [spec §3.4.1, Figs 24-27]",
        local_to=heading.local_to,
    )


look = [assign(stop, check_emergency_stop)]

# [spec Fig 26]
distance_70 = State("distance_70", default="check_sonars_for_stopping", states=[
    State("check_sonars_for_stopping", entry=look, during=look, transitions=[
        to("check_sonars_for_moving_again", when=stop, do=[send("emergency", "B2Decisions")]),
    ]),
    State("check_sonars_for_moving_again", entry=look, during=look, transitions=[
        to("check_sonars_for_stopping", when=~stop, do=[send("safe", "B2Decisions")]),
    ]),
])  # fmt: skip


def _waiting(i: int, d: Var, is_close: Var, detected: Var) -> State:
    """Waiting_Si [spec Fig 27]: rising edge of the detection flag in range, falling edge at any exit (E17).

    It looks for no moving obstacle while there is a stop, and keeps its detection meanwhile (E18, E27).
    """
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


def _timer(pair: str, signal: str) -> State:
    """A window of 3 s that opens when the first sonar loses the obstacle and waits for the second.

    At 3 s the end of the window comes first (E14); the level of the second flag suffices (E15); a
    second loss does not restart the window (E16).
    """
    first, second = map(int, pair)
    return State(f"timerSonar{pair}", default="Waiting", states=[
        State("Waiting", transitions=[to("Fall1Detected", on=f"Fall{first}")]),
        State("Fall1Detected", transitions=[
            to("Waiting", when=after(3 * sec)),
            to("J1", when=objDetected[second - 1]),
        ]),
    ], junctions=[
        Junction("J1", [to("J2")]),
        Junction("J2", [to("J3", do=[send(signal, "B2Decisions")])]),
        Junction("J3", [to("Waiting")]),
    ])  # fmt: skip


# The four windows in the order of the figure, so that the leftmost signal comes first (E20).
timers = State("timers", parallel=True, states=[
    _timer("12", "moveToS1"),
    _timer("21", "moveToS2"),
    _timer("23", "moveToS2"),
    _timer("32", "moveToS3"),
])  # fmt: skip


def _decisions(heading: Heading) -> State:
    """B2Decisions [spec Fig 25]: straight on for the centre sonar (E05), a deviation has no time limit
    (E08) and ignores new signals (E19, E20), a stop ends by itself (E10)."""
    turn = heading.store_target
    return State("B2Decisions", default="Waiting", states=[
        State("Waiting", entry=[assign(B2Decision, number(0))], transitions=[
            to("InEmergency", on="emergency"),
            to("MoveToS3", on="moveToS3"),
            to("MoveToS1", on="moveToS1"),
            to("MoveToS2", on="moveToS2"),
        ]),
        State("InEmergency", entry=[assign(B2Decision, number(1))], transitions=[to("Waiting", on="safe")]),
        State("MoveToS1", entry=[assign(B2Decision, number(2)), *turn], transitions=[
            to("J2", on="emergency"),
            to("Waiting", when=heading.turned | prevDEG_B1),
        ]),
        State("MoveToS2", entry=[assign(B2Decision, number(3))], transitions=[
            to("J3", on="emergency"),
            to("Waiting", when=after(0.5 * sec) | prevDEG_B1),
        ]),
        State("MoveToS3", entry=[assign(B2Decision, number(4)), *turn], transitions=[
            to("J1", on="emergency"),
            to("Waiting", when=heading.turned | prevDEG_B1),
        ]),
    ], junctions=[
        Junction("J3", [to("J2")]),
        Junction("J2", [to("J1")]),
        Junction("J1", [to("InEmergency")]),
    ])  # fmt: skip


drawn_n = obstacles_n()
"""The chart as drawn."""
