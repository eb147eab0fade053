"""What the links may do to Board 1 when updates come at any ms: ages to the ms, and the records of intervals.

A stamp is the time of the arrival, not of the step that sees it, so that an age is the lag at an
update and grows by 20 ms in every other step.  Time 0 is power-up with all stamps 0, and the first
step is at 20 ms.
"""

from dataclasses import replace
from functools import cache

from rovercheck.spec_model.ambiguity import under
from rovercheck.spec_model.intervals import STEP, Arrivals, any_mean
from rovercheck.spec_model.lang.action import Action, assign, when
from rovercheck.spec_model.lang.chart import Block
from rovercheck.spec_model.lang.expr import Expr, Var, const
from rovercheck.spec_model.lang.system import Note
from rovercheck.spec_model.lang.words import minimum
from rovercheck.spec_model.records import window_of
from rovercheck.spec_model.signals import board1 as b1
from rovercheck.spec_model.signals import board1_fine as fine

CONSTANT_PHASE = Note(
    "A frame or datum is stamped 0 to 19 ms before the step that sees it, always as many for one source (no "
    "jitter); an alive counter with the step that sees it change.",
    brief="constant phases",
)

rx = Arrivals("rx", b1.rx_update, fine.rx_lag, fine.rx_first_lag)
heartbeat = Arrivals("heartbeat", b1.heartbeat_update, fine.heartbeat_lag, fine.heartbeat_first_lag)
counted_heartbeat = replace(heartbeat, moves=b1.heartbeat_moves)


def clock(name: str, update: Var, lag: Expr, age: Var, step: Expr = STEP) -> Block:
    """The age of a time stamp that an update sets to ``lag`` before the step, which lasts ``step``."""
    older = minimum(age + step, const(age.domain.high, "ms"))
    return Block(
        name, [when(update, [assign(age, lag)], [assign(age, older)])], text=f"Time since {update.name}."
    )


def reception_at(phase: Var) -> Block:
    """The age of the last frame where each comes so long before a step."""
    return clock("Board2_Data.age", b1.rx_update, phase, fine.rx_age_ms)


reception_clock = clock("Board2_Data.age", b1.rx_update, fine.rx_lag, fine.rx_age_ms)
heartbeat_clock = clock("Heartbeat.age", b1.heartbeat_update, fine.heartbeat_lag, fine.heartbeat_age_ms)


@cache
def reception_record() -> Block:
    """The exact mean of the intervals between frames."""
    return window_of(rx)


@cache
def heartbeat_record() -> Block:
    """The exact mean of the intervals between heartbeats."""
    return window_of(counted_heartbeat)


def _any(arrivals: Arrivals, do: list[Action]) -> Block:
    text = "Over-approximation: the mean is arbitrary unless all ten intervals lie on one side of 40 ms."
    return Block(f"{arrivals.name}.any_intervals", do, text=text)


reception_any_mean = _any(rx, any_mean(rx, b1.rx_mean_slow))
heartbeat_any_mean = _any(
    heartbeat,
    [
        when(
            under("S40", "COUNT-DELTA"),
            any_mean(counted_heartbeat, b1.heartbeat_mean_slow),
            any_mean(heartbeat, b1.heartbeat_mean_slow),
        )
    ],
)
