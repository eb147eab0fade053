"""What a jitter of the period does: steps of 19 to 21 ms, ages that grow by them, frames that jitter too.

The supervisors and the transmit tasks have a period of 20 ms [spec §1.2]; here each period lasts 19, 20 or
21 ms, as it comes.  Timers of states count executed steps all the same (`after`, `duration`); ages, intervals
and what a monitor of Table 2 holds for seconds are differences of time stamps, to the ms.
"""

from dataclasses import replace

from rovercheck.spec_model.environment.milliseconds import clock
from rovercheck.spec_model.intervals import Arrivals, any_mean, interval_record
from rovercheck.spec_model.lang.action import Action, assign, when
from rovercheck.spec_model.lang.chart import Block
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.expr import FALSE, TRUE, Var, const, flag, var
from rovercheck.spec_model.lang.system import Note
from rovercheck.spec_model.lang.words import minimum
from rovercheck.spec_model.signals import board1 as b1
from rovercheck.spec_model.signals import board1_fine as fine

PERIOD = integer(19, 21, "ms")
"""A period of 20 ms with a jitter of 1 ms either way."""
LAG = integer(0, 20, "ms")
"""From an arrival to the step that sees it, less than a step."""

step_ms = var("step_ms", PERIOD, 20, "time since the step before, of the first step since power-up")

JITTER = Note(
    "A step lasts 19, 20 or 21 ms, each as it comes: the period of 20 ms with a jitter of 1 ms either way.",
    brief="steps of 19 to 21 ms",
)
STAMPED = Note(
    "An update carries the time of the step that sees it, the first step that after power-up.",
    brief="stamps on the steps",
)

# --- arrivals at any ms ---------------------------------------------------------------------------------

rx_lag = var("rx_lag", LAG, doc="from the latest update to the step that sees it")
rx = Arrivals("rx", b1.rx_update, rx_lag, step=step_ms)
earlier_than_the_step = rx_lag < step_ms
"""An arrival is seen by the first step after it."""

reception_clock = clock("Board2_Data.age", b1.rx_update, rx_lag, fine.rx_age_ms, step_ms)
reception_any_mean = Block(
    "rx.any_intervals",
    any_mean(rx, b1.rx_mean_slow),
    text="Over-approximation: the mean is arbitrary unless all ten intervals lie on one side of 40 ms.",
)

# --- arrivals at the steps ------------------------------------------------------------------------------

at_a_step = replace(rx, lag=None)
frames_clock = clock("Board2_Data.age", b1.rx_update, const(0, "ms"), fine.rx_age_ms, step_ms)
frames_mean = Block("rx.any_intervals", any_mean(at_a_step, b1.rx_mean_slow), text=reception_any_mean.text)
counting = Arrivals("heartbeat", b1.rx_update, step=step_ms)
heartbeats_clock = clock("Heartbeat.age", b1.rx_update, const(0, "ms"), fine.heartbeat_age_ms, step_ms)
heartbeats_mean = Block(
    "heartbeat.any_intervals", any_mean(counting, b1.heartbeat_mean_slow), text=reception_any_mean.text
)

# --- frames of a transmit task that jitters too ---------------------------------------------------------

MOST_LOST = 6
until_sent = var("until_sent_ms", integer(-20, 21, "ms"), 1, "from the step to the next frame")
in_a_row = var("lost_in_a_row", integer(0, MOST_LOST), doc="frames lost since the last one that came")
intact = [flag(f"{n}_intact", f"the {n} frame before the step is not lost") for n in ("first", "second")]
_after = [var(f"after_{n}_ms", PERIOD, 20, f"from the {n} frame to the next") for n in ("first", "second")]
frame_lag = var("frame_lag", LAG, doc="from the latest frame that came to the step that sees it")
sent = replace(rx, lag=frame_lag)


def transmission(update: Var, lag: Var) -> Block:
    """The frames of the other board, seen as updates with a lag.

    Two of them may come in one step, which can be longer than the time between them.
    """

    def frame(period: Var, whole: Var) -> Action:
        came = [assign(update, TRUE), assign(lag, -until_sent), assign(in_a_row, 0)]
        lost = [assign(in_a_row, minimum(in_a_row + 1, MOST_LOST))]
        return when(until_sent <= 0, [when(whole, came, lost), assign(until_sent, until_sent + period)])

    return Block(
        "Transmission",
        [
            assign(until_sent, until_sent - step_ms),
            assign(update, FALSE),
            *(frame(period, whole) for period, whole in zip(_after, intact, strict=True)),
        ],
        text="The other board sends a frame every 19 to 21 ms, the first one 1 ms after power-up.",
    )


sent_clock = clock("Board2_Data.age", b1.rx_update, frame_lag, fine.rx_age_ms, step_ms)
sent_record = Block("rx.intervals", interval_record(sent), text="The mean of ten intervals, to the ms.")
