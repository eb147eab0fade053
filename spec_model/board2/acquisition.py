"""How two tasks of Board 2 get their data: the sonar scan [spec §1.3.1, Fig 8] and the joystick read [Fig 9].

Both are checked alone; the supervisor meets arbitrary sonar and joystick data.  The sonar task runs on
ticks of 1 ms.  Its notification counts only while the task waits for it: one that comes later, with an
echo after the 20 ms, is lost.  The joystick task runs once per tick of 20 ms; its clock starts again
every 320 ms, which no comparison of a time stamp with the present can notice.
"""

from fractions import Fraction

from rovercheck.spec_model.lang.action import Action, assign, when
from rovercheck.spec_model.lang.chart import Block, Chart, State, to
from rovercheck.spec_model.lang.domain import boolean, chosen, fixed, integer
from rovercheck.spec_model.lang.expr import FALSE, TRUE, Expr, Var, any_of, const, flag, ite, var
from rovercheck.spec_model.lang.time import ms
from rovercheck.spec_model.lang.words import absolute, after, maximum, minimum, modulo, named, quotient

# --- sonar ---------------------------------------------------------------------------------------

CHANNELS = (1, 2, 3)
PERIOD = 60
"""Time from trigger to trigger, in ms."""

WIDTH = chosen([4060, 4117, 4118, 17400, 17458], "µs")
"""Pulses of 70, 70, 71, 300 and 301 cm, the second as long as 70 cm can be."""

both_edges = tuple(flag(f"both_edges{i}", f"channel {i} captures its second edge now") for i in CHANNELS)
width = tuple(var(f"width{i}", WIDTH, doc=f"length of the pulse that channel {i} captures") for i in CHANNELS)
captured = tuple(var(f"captured{i}", WIDTH, doc=f"length of the pulse of channel {i}") for i in CHANNELS)
flags = tuple(flag(f"flag{i}", f"channel {i} has captured both edges since the trigger") for i in CHANNELS)
count = var("sonar_count", integer(0, 3), doc="channels with both edges")
notified = flag("sonar_notified", "a callback of this tick found the count at 3")
distance = tuple(var(f"dist_cm{i}", integer(0, 344, "cm"), doc=f"published distance {i}") for i in CHANNELS)
published = flag("sonar_published", "the snapshot is published in this tick")
phase = var("sonar_phase", integer(0, PERIOD - 1), PERIOD - 2, "ms since the trigger was due")


callbacks = Block("SonarCallbacks", [
    *(
        when(edges & ~seen, [assign(seen, TRUE), assign(pulse, length), assign(count, minimum(count + 1, 3))])
        for edges, seen, pulse, length in zip(both_edges, flags, captured, width, strict=True)
    ),
    assign(notified, any_of(*both_edges) & (count >= 3)),
], text="The callbacks of the channels [spec Fig 8], in order")  # fmt: skip

period = Block("SonarPeriod", [
    assign(phase, modulo(phase + 1, PERIOD)),
    assign(published, FALSE),
], text="The task runs every 60 ms")  # fmt: skip

NO_ECHO = 301


def centimetres(pulse: Var) -> Expr:
    """58 µs for each cm, rounded down."""
    return quotient(pulse, 58) * const(1, "cm/µs")


publish: list[Action] = [
    *(  # without an echo the sonar counts as free (E13)
        assign(d, ite(seen, centimetres(pulse), const(NO_ECHO, "cm")))
        for d, seen, pulse in zip(distance, flags, captured, strict=True)
    ),
    assign(published, TRUE),
]
start = [*(assign(seen, FALSE) for seen in flags), assign(count, 0)]

sonar_task = Chart("SonarTask", [
    State("Idle", transitions=[to("Scanning", when=named("60 ms are over", phase == 0))]),
    State("Scanning", entry=start, transitions=[
        to("Idle", when=notified, do=publish),
        to("Idle", when=after(20 * ms), do=publish),
    ]),
], default="Idle", text="One scan: trigger, wait for the notification or 20 ms, publish")  # fmt: skip

SONAR = (period, callbacks, sonar_task)

# --- joystick ------------------------------------------------------------------------------------

CLOCK = 16
"""Ticks after which the modelled clock starts again."""

RAW = chosen([0, 229, 230, 255, 280, 281, 383, 510, 511])
"""Readings of an axis: both sides of the dead zone, of its middle and of the upper end."""
AXIS = fixed(-1, 1, Fraction(1, 255))

complete = flag("ble_complete", "the read of this execution is complete")
ticks = var("ble_now", integer(0, CLOCK - 1), doc="time of the execution, in ticks modulo 16")
raw_x = var("raw_x", RAW, doc="turning axis as read")
raw_y = var("raw_y", RAW, doc="speed axis as read")
raw_btn1, raw_btn2 = flag("raw_btn1", "button 1 as read"), flag("raw_btn2", "button 2 as read")

last_valid = var("ble_last_valid", ticks.domain, doc="data_last_valid_ms, in ticks modulo 16")
last_run = var("ble_last_run", ticks.domain, doc="task_last_run_ms, in ticks modulo 16")
axis_x = var("ble_x", AXIS, 0, "turning axis, published")
axis_y = var("ble_y", AXIS, 0, "speed axis, published")
button1 = var("ble_btn1", boolean, False, "button 1, published")
button2 = var("ble_btn2", boolean, False, "button 2, published")


def axis(raw: Var) -> Expr:
    """(raw - 255)/255, 0 below a magnitude of 0.1, limited to [-1;1]."""
    scaled = (raw - 255) * const(Fraction(1, 255))
    return ite(absolute(scaled) < const(Fraction(1, 10)), 0, maximum(minimum(scaled, 1), -1))


ble_task = Block("BleTask", [
    assign(ticks, modulo(ticks + 1, CLOCK)),
    when(complete, [
        assign(last_valid, ticks),
        assign(axis_x, axis(raw_x)),
        assign(axis_y, axis(raw_y)),
        assign(button1, raw_btn1),
        assign(button2, raw_btn2),
    ]),
    assign(last_run, ticks),
], text="An incomplete read keeps the old data (E28)")  # fmt: skip
