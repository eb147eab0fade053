"""Obstacle chart of Board 2, non-degraded state, under other interpretations.

Its ranges and stop (E01 to E03, E10, E18, E27), how an object is found (E14 to E17), which way it went
(E05, E31), how a deviation ends (E08) and signals beside each other (E19, E20).  Where the document gives a
choice no words, the choice here is a modelling choice, and its text says which.
"""

from collections.abc import Callable
from functools import partial

from rovercheck.spec_model.interpretations import Alternative, Change, alternative
from rovercheck.spec_model.interpretations.heading import PAIRS
from rovercheck.spec_model.lang.action import Action, Send, assign, when
from rovercheck.spec_model.lang.change import (
    assigned,
    before,
    doing,
    formulas,
    guard_of,
    guards,
    in_state,
    inside,
    then,
    transition_of,
)
from rovercheck.spec_model.lang.chart import Chart, Transition, to
from rovercheck.spec_model.lang.domain import chosen
from rovercheck.spec_model.lang.edit import also, arrows, swap
from rovercheck.spec_model.lang.expr import TRUE, Apply, Expr, Var, all_of, any_of, flag, var
from rovercheck.spec_model.lang.time import sec, tick
from rovercheck.spec_model.lang.words import after
from rovercheck.spec_model.signals.board2 import (
    SONARS,
    B2Decision,
    d1,
    d2,
    d3,
    number,
    objDetected,
    prevDEG_B1,
    stop,
    touching,
)
from rovercheck.spec_model.signals.board2_motion import ay_norm, bx_norm, wheels_below_2_5

CHART = "Obstacles"
STOPPING, MOVING_AGAIN = "check_sonars_for_stopping", "check_sonars_for_moving_again"
NUMBERS = (1, 2, 3)


def each(changes: Callable[[int], Change]) -> tuple[Change, ...]:
    """The same for every sonar."""
    return tuple(map(changes, NUMBERS))


def look_further(*actions: Action) -> tuple[Change, ...]:
    """Computed together with ``stop``, before the detections."""
    return tuple(in_state(s, entry=then(*actions), during=then(*actions)) for s in (STOPPING, MOVING_AGAIN))


# --- ranges and stop (E01 to E03, E10) -------------------------------------------------------------------


def limits(*pairs: tuple[Callable[[Var], Expr], Callable[[Var], Expr]]) -> Change:
    """Other limits of the three distances."""
    return formulas(*((old(d), new(d)) for old, new in pairs for d in SONARS))


block = flag("block", "a sonar measured less than 70 cm, which suspends the detection (E02 B70-BOTH)")

# --- what suspends the detection (E02, E18, E27) -----------------------------------------------------------

near_12 = flag("near_12", "S1 or S2 suspends the detection of their pair (E27 PAIR)")
near_23 = flag("near_23", "S2 or S3 suspends the detection of their pair (E27 PAIR)")
NEAR = {1: near_12, 2: near_12 & near_23, 3: near_23}
"""A sonar is near in each pair that Si belongs to."""


def suspended_by(old: Expr, condition: Callable[[int], Expr]) -> tuple[Change, ...]:
    """Si looks for no moving obstacle, where it did not for ``old``."""
    return each(lambda i: guards(f"WS{i}", "J0", inside(old, condition(i))))


def pair_looks(pair: str) -> tuple[Change, ...]:
    """The windows of a pair open and are confirmed only while neither of its sonars is near."""
    far = ~(near_12 if pair in ("12", "21") else near_23)
    window = f"timerSonar{pair}"
    ends = (("Waiting", "Fall1Detected"), ("Fall1Detected", "Fall1Detected"), ("Fall1Detected", "J1"))
    return tuple(guards(f"{window}.{source}", target, lambda g: _and(g, far)) for source, target in ends)


def _and(guard: Expr, more: Expr) -> Expr:
    return more if guard is TRUE else all_of(guard, more)


def forget_during_a_stop(i: int) -> Change:
    def change(chart: Chart) -> Chart:
        looks = guard_of(chart, f"WS{i}", "J0")
        assert isinstance(looks, Apply)
        forget = when(looks.args[0], [assign(objDetected[i - 1], False)])
        return in_state(f"WS{i}", during=then(forget))(chart)

    return change


# --- how an object is found and lost (E14 to E17) ----------------------------------------------------------

edges = tuple(flag(f"edge{i}", f"S{i} begins to hold a detection in this step (E15 EDGE)") for i in NUMBERS)


def confirmed_by_an_edge(pair: str) -> Change:
    second = int(pair[1]) - 1
    return guards(f"timerSonar{pair}.Fall1Detected", "J1", inside(objDetected[second], edges[second]))


def restart(pair: str) -> Change:
    """A second fall opens the window again."""

    def change(chart: Chart) -> Chart:
        window = f"timerSonar{pair}"
        opening = transition_of(chart, f"{window}.Waiting", "Fall1Detected")
        return also(chart, f"{window}.Fall1Detected", opening, first=True)

    return change


def beyond(i: int) -> Var:
    return flag(f"isBeyond{i}", f"S{i} measured no obstacle within the range (E17 LATERAL-ONLY)")


def lost_beyond(i: int) -> tuple[Change, ...]:
    """An object is lost at the far end of the range only."""
    measure = assign(beyond(i), ~(SONARS[i - 1] <= 300))
    return (
        in_state(f"WS{i}", entry=then(measure), during=then(measure)),
        guards(f"Waiting_S{i}.J0", "J3", lambda lost: lost & beyond(i)),
    )


# --- which way the object before the centre sonar went (E05, E31) -----------------------------------

signalled_left = flag("signalled_left", "the signal being sent is that of pair 21: the object went left")
moved_left = flag("moved_left", "MoveToS2 was entered for pair 21: the object went from S2 to S1")


def around_the_signal(do: tuple[Action, ...]) -> tuple[Action, ...]:
    found: list[Action] = []
    for action in do:
        said = [assign(signalled_left, True), action, assign(signalled_left, False)]
        found += said if isinstance(action, Send) else [action]
    return tuple(found)


say_left = doing("timerSonar21.J2", "J3", around_the_signal)
note, forget = assign(moved_left, signalled_left), assign(moved_left, False)
remember_left = (say_left, in_state("MoveToS2", entry=then(note), exit=then(forget)))


def opposite(found: list[Transition]) -> list[Transition]:
    """Away from the second sonar, by 45 degrees as toward the sonar on the other side."""
    turned: list[Transition] = []
    for arrow in found:
        if arrow.event == "moveToS2" and arrow.target == "MoveToS2":
            guard = TRUE if arrow.guard is None else arrow.guard
            turned.append(to("MoveToS3", on="moveToS2", when=_and(guard, signalled_left)))
            turned.append(to("MoveToS1", on="moveToS2", when=_and(guard, ~signalled_left)))
        turned.append(arrow)
    return turned


# --- a signal beside another one (E19, E20) ---------------------------------------------------------

SIGNALS = {"moveToS1": "MoveToS1", "moveToS2": "MoveToS2", "moveToS3": "MoveToS3"}
"""Each signal with the state it leads to; the order is from left to right."""
MOVES = tuple(SIGNALS.values())
DECISION = {"moveToS1": 2, "moveToS2": 3, "moveToS3": 4}
LATER = after(1 * tick)

queued = var("queued", chosen([0, 2, 3, 4]), doc="decision whose signal waits for the end of another (E19)")
two_signals = flag("two_signals", "two signals in one step stopped the rover (E20 STOP)")


def another_signal(follows: Callable[[str, str], Transition | None]) -> tuple[Change, ...]:
    """Transitions of each deviation for a signal after its own, tested after that of an emergency."""

    def changed(state: str) -> Change:
        more = [arrow for signal in SIGNALS if (arrow := follows(state, signal)) is not None]
        return lambda chart: arrows(chart, state, lambda found: [found[0], *more, *found[1:]])

    return tuple(map(changed, MOVES))


def preempt(state: str, signal: str) -> Transition:
    return to(SIGNALS[signal], on=signal, when=LATER)


def farther_right(state: str, signal: str) -> Transition | None:
    right = MOVES.index(SIGNALS[signal]) > MOVES.index(state)
    return to(SIGNALS[signal], on=signal, when=~LATER) if right else None


def stop_for_two(state: str, signal: str) -> Transition:
    return to("InEmergency", on=signal, when=~LATER, do=[assign(two_signals, True)])


two_are_over = to("Waiting", when=all_of(two_signals, *(~detected for detected in objDetected)))
"""The stop for two signals lasts until no sonar holds a detection."""


def wait_in_the_queue(pair: str, signal: str) -> Change:
    """The first signal during a deviation waits; later ones are lost."""
    deviating = any_of(*(B2Decision == number(n) for n in DECISION.values()))
    wait = when(deviating & (queued == 0), [assign(queued, DECISION[signal])])
    return doing(f"timerSonar{pair}.J2", "J3", before(wait))


queue = (
    *map(wait_in_the_queue, PAIRS, ("moveToS1", "moveToS2", "moveToS2", "moveToS3")),
    *(in_state(state, entry=then(assign(queued, 0))) for state in ("InEmergency", *MOVES)),
    # what waits is served after the deviation, but not after a change to the degraded state
    *(doing(state, "Waiting", before(when(prevDEG_B1, [assign(queued, 0)]))) for state in MOVES),
    lambda chart: also(
        chart,
        "B2Decisions.Waiting",
        *(to(state, when=queued == DECISION[signal]) for signal, state in SIGNALS.items()),
    ),
)

# --- the alternatives --------------------------------------------------------------------------------------

ALTERNATIVES: tuple[Alternative, ...] = (
    alternative("E08", "BOUNDED", "A deviation ends after 10 s.", CHART,
        *(guards(turn, "Waiting", lambda over: over | after(10 * sec)) for turn in ("MoveToS1", "MoveToS3"))),
    alternative("E10", "LATCH-NEUTRAL", "The stop ends with the stick at rest.", CHART,
        guards(MOVING_AGAIN, STOPPING, lambda far: far & (bx_norm == 0) & (ay_norm == 0))),
    alternative("E10", "LATCH-STANDSTILL", "The stop ends at rest.", CHART,
        guards(MOVING_AGAIN, STOPPING, lambda far: far & wheels_below_2_5)),
    alternative("E14", "INCL", "A window confirmed at its end counts.", CHART,
        *(partial(swap, name=f"timerSonar{pair}.Fall1Detected") for pair in PAIRS)),
    alternative("E15", "EDGE", "The second sonar must begin to detect.", CHART,
        *look_further(*(assign(edge, False) for edge in edges)),
        *each(lambda i: doing(f"Waiting_S{i}.J1", "J2", before(assign(edges[i - 1], ~objDetected[i - 1])))),
        *map(confirmed_by_an_edge, PAIRS)),
    alternative("E16", "RESTART", "A second fall opens the window again.", CHART, *map(restart, PAIRS)),
    alternative("E17", "LATERAL-ONLY", "An object that comes nearer is not lost.", CHART,
        *(change for i in NUMBERS for change in lost_beyond(i))),
    alternative("E27", "PAIR", "A sonar that is near suspends the pairs it belongs to.", CHART,
        *look_further(
            assign(near_12, touching(d1) | touching(d2)),
            assign(near_23, touching(d2) | touching(d3)),
        ),
        *suspended_by(stop, lambda i: NEAR[i]),
        *(change for pair in PAIRS for change in pair_looks(pair))),
    alternative("E02", "B70-BOTH", "The detection is suspended below 70 cm, the rover stops at 70 cm.", CHART,
        *look_further(assign(block, any_of(*(d < 70 for d in SONARS)))),
        *suspended_by(stop, lambda i: block),
        assigned(near_12, lambda _: (d1 < 70) | (d2 < 70)),
        assigned(near_23, lambda _: (d2 < 70) | (d3 < 70))),
    alternative("E18", "RESET", "A stop clears the detections; windows that are open run on.", CHART,
        *each(forget_during_a_stop)),
    alternative("E18", "CONTINUE", "The detection goes on during a stop.", CHART,
        *each(lambda i: guards(f"WS{i}", "J0", lambda _: TRUE))),
    alternative("E01", "GAP-STOP", "The rover stops up to 100 cm.", CHART,
        limits((lambda d: d <= 70, lambda d: d <= 100))),
    alternative("E01", "GAP-MOVING", "Moving obstacles are looked for from 70 cm on.", CHART,
        limits((lambda d: d > 100, lambda d: d > 70))),
    alternative("E02", "B70-LT", "The rover stops below 70 cm.", CHART,
        limits((lambda d: d <= 70, lambda d: d < 70))),
    alternative("E03", "OPEN", "300 cm is out of range.", CHART,
        limits((lambda d: d <= 300, lambda d: d < 300))),
    alternative("E03", "CLOSED", "100 cm is in range.", CHART,
        limits((lambda d: d > 100, lambda d: d >= 100))),
    alternative("E03", "UNBOUNDED", "Everything above 100 cm is in range.", CHART,
        limits((lambda d: d <= 300, lambda d: TRUE))),
    alternative("E05", "CENTRE-HOLD", "The side to which the object goes is remembered.", CHART,
        *remember_left),
    alternative("E31", "AVOID-BY-PAIR", "The side to which the object goes is remembered.", CHART,
        *remember_left),
    alternative("E05", "LITERAL-45", "Toward a sonar at 0 degrees there is nothing to turn.", CHART,
        guards("MoveToS2", "Waiting", inside(after(0.5 * sec), TRUE))),
    alternative("E19", "PREEMPT", "A later signal replaces the deviation.", CHART, *another_signal(preempt)),
    alternative("E19", "QUEUE", "A signal during a deviation waits.", CHART, *queue),
    alternative("E20", "RIGHT-FIRST", "Of two signals in a step the right one counts.", CHART,
        *another_signal(farther_right)),
    alternative("E20", "STOP", "Two signals in a step stop the rover.", CHART,
        *another_signal(stop_for_two),
        lambda chart: also(chart, "InEmergency", two_are_over),
        in_state("InEmergency", exit=then(assign(two_signals, False)))),
    alternative("E05", "OPPOSITE", "The rover turns away from the second sonar.", CHART,
        say_left,
        *(partial(arrows, name=state, change=opposite) for state in ("B2Decisions.Waiting", *MOVES))),
)  # fmt: skip
"""Those that bring transitions before those that change them."""
