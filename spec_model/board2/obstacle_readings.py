"""What the obstacle chart does beside its figures where a sentence is read in another way.

Under the default readings every part below is empty, and the chart is the one drawn.  Where the
document gives a choice no words, the choice here is a modelling choice, and its docstring says which.
"""

from collections.abc import Sequence

from rovercheck.spec_model.lang.action import Action, assign, when
from rovercheck.spec_model.lang.chart import Transition, to
from rovercheck.spec_model.lang.domain import chosen
from rovercheck.spec_model.lang.expr import TRUE, Expr, Var, all_of, any_of, flag, var
from rovercheck.spec_model.lang.time import tick
from rovercheck.spec_model.lang.words import after
from rovercheck.spec_model.readings import choose, under
from rovercheck.spec_model.signals.board2 import (
    B2Decision,
    d1,
    d2,
    d3,
    number,
    objDetected,
    prevDEG_B1,
    stop,
    touching,
    up_to_300,
)
from rovercheck.spec_model.signals.board2_motion import ay_norm, bx_norm, wheels_below_2_5

# --- the stop, and what it suspends (E02, E10, E18, E27) -------------------------------------------

block = flag("block", "a sonar measured less than 70 cm, which suspends the detection (E02 B70-BOTH)")
near_12 = flag("near_12", "S1 or S2 suspends the detection of their pair (E27 PAIR)")
near_23 = flag("near_23", "S2 or S3 suspends the detection of their pair (E27 PAIR)")


def suspends(d: Var) -> Expr:
    """So near that no moving obstacle is looked for: as for the stop, or nearer than 70 cm (E02)."""
    return choose("E02", {"B70-STOP": touching(d), "B70-BOTH": d < 70, "B70-LT": touching(d)})


edges = tuple(flag(f"edge{i}", f"S{i} begins to hold a detection in this step (E15 EDGE)") for i in (1, 2, 3))

look_further: Sequence[Action] = (
    when(under("E15", "EDGE"), [assign(edge, False) for edge in edges]),
    when(under("E02", "B70-BOTH"), [assign(block, any_of(*(suspends(d) for d in (d1, d2, d3))))]),
    when(under("E27", "PAIR"), [
        assign(near_12, suspends(d1) | suspends(d2)),
        assign(near_23, suspends(d2) | suspends(d3)),
    ]),
)  # fmt: skip
"""Computed together with ``stop``, before the detections."""

_any = choose("E02", {"B70-STOP": stop, "B70-BOTH": block, "B70-LT": stop})
_of_a_sonar = {1: near_12, 2: near_12 & near_23, 3: near_23}


def suspended(i: int) -> Expr:
    """Si looks for no moving obstacle: any sonar is near, or one in each pair that Si belongs to (E27)."""
    return choose("E27", {"ANY": _any, "PAIR": _of_a_sonar[i]})


def looks(i: int) -> Expr:
    """Si looks for a moving obstacle; CONTINUE does so during a stop too (E18)."""
    return choose("E18", {"FREEZE": ~suspended(i), "RESET": ~suspended(i), "CONTINUE": TRUE})


def forget_during_a_stop(i: int, detected: Var) -> Action:
    """RESET: a stop clears the detections; windows that are open run on (E18)."""
    return when(under("E18", "RESET") & suspended(i), [assign(detected, False)])


def pair_looks(pair: str) -> Expr:
    """The windows of a pair open and are confirmed; PAIR: only while neither of its sonars is near (E27)."""
    near = near_12 if pair in ("12", "21") else near_23
    return choose("E27", {"ANY": TRUE, "PAIR": ~near})


may_move_again = choose("E10", {
    "AUTO": TRUE,
    "LATCH-NEUTRAL": (bx_norm == 0) & (ay_norm == 0),
    "LATCH-STANDSTILL": wheels_below_2_5,
})  # fmt: skip
"""What lifts the stop beside the distances (E10)."""

# --- how an object is found and lost (E15, E17) ----------------------------------------------------------


def note_edge(i: int, detected: Var) -> Action:
    """Si is about to hold a detection."""
    return when(under("E15", "EDGE"), [assign(edges[i - 1], ~detected)])


def confirms(i: int, detected: Var) -> Expr:
    """Si confirms that the object has moved to it: it holds a detection, or begins to (E15)."""
    return choose("E15", {"LEVEL": detected, "EDGE": edges[i - 1]})


def beyond(i: int) -> Var:
    return flag(f"isBeyond{i}", f"S{i} measured no obstacle within the range (E17 LATERAL-ONLY)")


def measure_further(i: int, d: Var) -> Action:
    """Computed together with ``isClose``."""
    return when(under("E17", "LATERAL-ONLY"), [assign(beyond(i), ~up_to_300(d))])


def left(i: int) -> Expr:
    """An object out of range was lost; LATERAL-ONLY: not while it is still there, nearer (E17)."""
    return choose("E17", {"ANY-EXIT": TRUE, "LATERAL-ONLY": beyond(i)})


# --- which way the object before the centre sonar went (E05, E31) -----------------------------------

signalled_left = flag("signalled_left", "the signal being sent is that of pair 21: the object went left")
moved_left = flag("moved_left", "MoveToS2 was entered for pair 21: the object went from S2 to S1")

_inhibits = under("E05", "CENTRE-HOLD") | under("E31", "AVOID-BY-PAIR")
_by_pair = under("E05", "OPPOSITE") | _inhibits

say_left: Sequence[Action] = (when(_by_pair, [assign(signalled_left, True)]),)
said_left: Sequence[Action] = (when(_by_pair, [assign(signalled_left, False)]),)
note_side: Sequence[Action] = (when(_inhibits, [assign(moved_left, signalled_left)]),)
drop_side: Sequence[Action] = (when(_inhibits, [assign(moved_left, False)]),)


def opposite(condition: Expr = TRUE) -> list[Transition]:
    """OPPOSITE: away from the second sonar, by 45 degrees as toward the sonar on the other side (E05)."""
    turns = under("E05", "OPPOSITE") & condition
    return [
        to("MoveToS3", on="moveToS2", when=turns & signalled_left),
        to("MoveToS1", on="moveToS2", when=turns & ~signalled_left),
    ]


# --- a signal beside another one (E19, E20) ---------------------------------------------------------

SIGNALS = {"moveToS1": "MoveToS1", "moveToS2": "MoveToS2", "moveToS3": "MoveToS3"}
"""Each signal with the state it leads to; the order is from left to right."""

queued = var("queued", chosen([0, 2, 3, 4]), doc="decision whose signal waits for the end of another (E19)")
two_signals = flag("two_signals", "two signals in one step stopped the rover (E20 STOP)")

_queues = under("E19", "QUEUE")
_DECISION = {"moveToS1": 2, "moveToS2": 3, "moveToS3": 4}


def queue(signal: str) -> Action:
    """QUEUE: the first signal during a deviation waits; later ones are lost (E19)."""
    deviating = any_of(*(B2Decision == number(n) for n in _DECISION.values()))
    return when(_queues & deviating & (queued == 0), [assign(queued, _DECISION[signal])])


served: Sequence[Transition] = [
    to(state, when=all_of(_queues, queued == _DECISION[signal])) for signal, state in SIGNALS.items()
]
"""From Waiting: the signal that waits (E19 QUEUE)."""

empty_the_queue: Sequence[Action] = (when(_queues, [assign(queued, 0)]),)

leave_the_queue: Sequence[Action] = (when(_queues & prevDEG_B1, [assign(queued, 0)]),)
"""A deviation ends: the signal that waits is served next, but not after a change to the degraded state."""


def another_signal(state: str) -> list[Transition]:
    """Arrows of a deviation for a signal after its own: none, or those of E19 and E20.

    PREEMPT: a signal in a later step.  RIGHT-FIRST: one of a sonar farther right in the same step.
    STOP: any other one in the same step.
    """
    later, order = after(1 * tick), list(SIGNALS.values())
    found: list[Transition] = []
    for signal, target in SIGNALS.items():
        preempts = under("E19", "PREEMPT") & later
        if order.index(target) > order.index(state):
            preempts = preempts | (under("E20", "RIGHT-FIRST") & ~later)
        found += opposite(preempts) if signal == "moveToS2" else []
        found += [to(target, on=signal, when=preempts), _stop_for_two(signal, ~later)]
    return found


def _stop_for_two(signal: str, same_step: Expr) -> Transition:
    two = under("E20", "STOP") & same_step
    return to("InEmergency", on=signal, when=two, do=[assign(two_signals, True)])


stop_for_two_is_over = to(
    "Waiting", when=all_of(under("E20", "STOP"), two_signals, *(~detected for detected in objDetected))
)
"""The stop for two signals lasts until no sonar holds a detection (E20 STOP)."""

forget_two: Sequence[Action] = (when(under("E20", "STOP"), [assign(two_signals, False)]),)
