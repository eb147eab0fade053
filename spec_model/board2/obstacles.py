"""Obstacle chart of Board 2, non-degraded state: stop at 70 cm, deviate from a moving obstacle.

[seed §3.4.1, Figs 24-27] Two parallel states: Sonars watches the three distances and sends local
events; B2Decisions turns them into the output, a number from 0 to 4.  What other readings add to the
figures is in ``obstacle_readings``.
"""

from collections.abc import Sequence

from rovercheck.spec_model.board2.heading import FREE, Heading
from rovercheck.spec_model.board2.obstacle_readings import (
    another_signal,
    confirms,
    drop_side,
    empty_the_queue,
    forget_during_a_stop,
    forget_two,
    leave_the_queue,
    left,
    look_further,
    looks,
    may_move_again,
    measure_further,
    note_edge,
    note_side,
    opposite,
    pair_looks,
    queue,
    said_left,
    say_left,
    served,
    stop_for_two_is_over,
)
from rovercheck.spec_model.lang.action import Action, assign, send
from rovercheck.spec_model.lang.chart import Chart, Junction, State, to
from rovercheck.spec_model.lang.expr import FALSE, TRUE, Var, any_of
from rovercheck.spec_model.lang.time import sec
from rovercheck.spec_model.lang.words import after, named
from rovercheck.spec_model.readings import choose, under
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


def obstacles_n(heading: Heading = FREE) -> Chart:
    """The chart as drawn, with what it knows of the heading."""
    return Chart(
        "Obstacles",
        [
            State("Sonars", parallel=True, states=[distance_70, _distance_gt70(heading), _timers(heading)]),
            _decisions(heading),
        ],
        parallel=True,
        text="Obstacles in the non-degraded state [seed §3.4.1, Figs 24-27]",
        local_to=heading.local_to,
    )


look = [assign(stop, check_emergency_stop), *look_further]

distance_70 = State("distance_70", default="check_sonars_for_stopping", states=[
    State("check_sonars_for_stopping", entry=look, during=look, transitions=[
        to("check_sonars_for_moving_again", when=stop, do=[send("emergency", "B2Decisions")]),
    ]),
    State("check_sonars_for_moving_again", entry=look, during=look, transitions=[
        to("check_sonars_for_stopping", when=~stop & may_move_again, do=[send("safe", "B2Decisions")]),
    ]),
])  # fmt: skip


def _waiting(i: int, d: Var, is_close: Var, detected: Var, heading: Heading) -> State:
    """Waiting_Si: rising edge of the detection flag in range, falling edge at any exit (E17).

    It looks for no moving obstacle while there is a stop, and keeps its detection meanwhile (E18, E27).
    """
    WS = f"WS{i}"
    measure = [assign(is_close, in_range(d)), measure_further(i, d)]
    detect = [*heading.at_detection(i, detected), note_edge(i, detected), assign(detected, True)]
    return State(f"Waiting_S{i}", default=WS, states=[
        State(WS, entry=measure, during=[*measure, forget_during_a_stop(i, detected)], transitions=[
            to("J0", when=looks(i)),
        ]),
    ], junctions=[
        Junction("J0", [to("J1", when=is_close), to("J3", when=~is_close & detected & left(i))]),
        Junction("J1", [to("J2", do=detect)]),
        Junction("J2", [to(WS)]),
        Junction("J3", [to("J4", do=[assign(detected, False), send(f"Fall{i}", "timers")])]),
        Junction("J4", [to(WS)]),
    ])  # fmt: skip


def _distance_gt70(heading: Heading) -> State:
    return State("distance_gt70", parallel=True, states=[
        _waiting(*signals, heading)
        for signals in zip((1, 2, 3), SONARS, isClose, objDetected, strict=True)
    ])  # fmt: skip


def _timer(pair: str, signal: str, do: Sequence[Action], heading: Heading) -> State:
    """A window of 3 s that opens when the first sonar loses the obstacle and waits for the second.

    At 3 s the end of the window comes first (E14); the level of the second flag suffices (E15); a
    second loss does not restart the window (E16).
    """
    i, looking = int(pair[0]), pair_looks(pair)
    fall, opening = f"Fall{i}", heading.at_fall(i, pair)
    over = after(3 * sec)
    confirmed = confirms(int(pair[1]), objDetected[int(pair[1]) - 1])
    return State(f"timerSonar{pair}", default="Waiting", states=[
        State("Waiting", transitions=[to("Fall1Detected", on=fall, when=looking, do=opening)]),
        State("Fall1Detected", transitions=[
            to("Fall1Detected", on=fall, when=under("E16", "RESTART") & looking, do=opening),
            to("Waiting", when=under("E14", "EXCL") & over),
            to("J1", when=confirmed & looking),
            to("Waiting", when=under("E14", "INCL") & over),
        ]),
    ], junctions=[
        Junction("J1", [to("J2")]),
        Junction("J2", [to("J3", do=[*heading.at_signal(pair), queue(signal), *do])]),
        Junction("J3", [to("Waiting")]),
    ])  # fmt: skip


def _timers(heading: Heading) -> State:
    """The four windows in the order of the figure, so that the leftmost signal comes first (E20)."""
    to_S1, to_S2, to_S3 = (send(f"moveToS{i}", "B2Decisions") for i in (1, 2, 3))
    return State("timers", parallel=True, states=[
        _timer("12", "moveToS1", [to_S1], heading),
        _timer("21", "moveToS2", [*say_left, to_S2, *said_left], heading),
        _timer("23", "moveToS2", [to_S2], heading),
        _timer("32", "moveToS3", [to_S3], heading),
    ])  # fmt: skip


def _decisions(heading: Heading) -> State:
    """B2Decisions [seed Fig 25]: straight on for the centre sonar (E05), a deviation has no time limit
    (E08) and ignores new signals (E19, E20), a stop ends by itself (E10)."""
    too_long = choose("E08", {"NO-TIMEOUT": FALSE, "BOUNDED": after(10 * sec)})
    # LITERAL-45: toward a sonar at 0 degrees there is nothing to turn.
    half_a_second = after(0.5 * sec)
    straight = choose("E05", {
        "CENTRE-STRAIGHT": half_a_second,
        "CENTRE-HOLD": half_a_second,
        "LITERAL-45": TRUE,
        "OPPOSITE": half_a_second,
    })  # fmt: skip
    turn = [*heading.store_target, *empty_the_queue]
    return State("B2Decisions", default="Waiting", states=[
        State("Waiting", entry=[assign(B2Decision, number(0))], transitions=[
            to("InEmergency", on="emergency"),
            to("MoveToS3", on="moveToS3"),
            to("MoveToS1", on="moveToS1"),
            *opposite(),
            to("MoveToS2", on="moveToS2"),
            *served,
        ]),
        State("InEmergency", entry=[assign(B2Decision, number(1)), *empty_the_queue], transitions=[
            to("Waiting", on="safe"),
            stop_for_two_is_over,
        ], exit=forget_two),
        State("MoveToS1", entry=[assign(B2Decision, number(2)), *turn], during=heading.follow, transitions=[
            to("J2", on="emergency"),
            *another_signal("MoveToS1"),
            to("Waiting", when=heading.turned | prevDEG_B1 | too_long, do=leave_the_queue),
        ], exit=heading.forget),
        State("MoveToS2", entry=[assign(B2Decision, number(3)), *note_side, *empty_the_queue], transitions=[
            to("J3", on="emergency"),
            *another_signal("MoveToS2"),
            to("Waiting", when=straight | prevDEG_B1, do=leave_the_queue),
        ], exit=drop_side),
        State("MoveToS3", entry=[assign(B2Decision, number(4)), *turn], during=heading.follow, transitions=[
            to("J1", on="emergency"),
            *another_signal("MoveToS3"),
            to("Waiting", when=heading.turned | prevDEG_B1 | too_long, do=leave_the_queue),
        ], exit=heading.forget),
    ], junctions=[
        Junction("J3", [to("J2")]),
        Junction("J2", [to("J1")]),
        Junction("J1", [to("InEmergency")]),
    ])  # fmt: skip


drawn_n = obstacles_n()
"""The chart as drawn."""
