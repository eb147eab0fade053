"""What sensors, link and clock may do to Board 1: time stamps as ages, and the ten-interval records.

Blocks that run before the charts.  Nothing is assumed of the inputs but what the interface says: a
datum changes only together with its time stamp [seed Fig 13, §2.4].  An age is `now_ms` minus the
stamp, on the 20 ms grid: an update seen in a step carries the time of that step.  Time 0 is
power-up with all stamps 0, and the first step is at 20 ms.

An age stops growing at a value that stands for all larger ones, because no comparison of the charts
can change beyond it:

* links: 140 ms, the first age above 120 ms [seed Table 2];
* temperature: 81 020 ms, where even the coldest reading, -16 °C, is assumed above 65 °C (1 °C/s);
* battery: 154 780 ms, where even a charge of 80 % is assumed below 15 % (0.42 %/s).
"""

from collections.abc import Sequence

from spec_model.lang.action import Action, assign, when
from spec_model.lang.chart import Block
from spec_model.lang.domain import integer
from spec_model.lang.expr import Expr, Var, all_of, const, flag, implies, ite, var
from spec_model.lang.words import bit, minimum, modulo
from spec_model.signals import board1 as b1

INTERVALS = 10
"""The moving mean is over the last ten intervals [seed Table 2]."""

LONG = 21
"""Intervals are counted in ticks of 20 ms; 21 (420 ms) stands for all longer ones, for with nine
other positive intervals the sum exceeds 400 ms already."""


def _grow(age: Var) -> Action:
    return assign(age, minimum(age + const(20, "ms"), const(age.domain.high * 20, "ms")))


def clock(name: str, update: Var, age: Var) -> Block:
    """The age of a time stamp that is set to `now_ms` by an update."""
    return Block(name, [when(update, [assign(age, 0)], [_grow(age)])], text=f"Time since {update.name}.")


def measurement(name: str, update: Var, reading: Var, value: Var, age: Var) -> Block:
    """A datum of a snapshot with its age: an update replaces the value."""
    return Block(
        name,
        [when(update, [assign(value, reading), assign(age, 0)], [_grow(age)])],
        text=f"{value.name} keeps the last valid reading.",
    )


temperature_readings = measurement(
    "Board_Health.temperature", b1.temp_update, b1.temp_reading, b1.temperature_degC, b1.temp_age
)
battery_readings = measurement(
    "Board_Health.battery", b1.batt_update, b1.batt_reading, b1.battery_pct, b1.batt_age
)
reception_clock = clock("Board2_Data.age", b1.rx_update, b1.rx_age)
heartbeat_clock = clock("Heartbeat.age", b1.heartbeat_update, b1.heartbeat_age)

heartbeat_travels_in_frames = implies(b1.heartbeat_update, b1.rx_update)
"""A new heartbeat can only come with an accepted frame, which carries it."""


def _count_updates(name: str) -> tuple[Var, Action]:
    seen = var(f"{name}_updates", b1.UPDATES, doc="updates so far; eleven make ten intervals")
    return seen, assign(seen, minimum(seen + 1, INTERVALS + 1))


def slow_record(name: str, update: Var, *, exact: bool = True) -> Block:
    """``<name>_slow``: the mean of the last ten closed update intervals exceeds 40 ms.

    The first update after power-up closes no interval (S66), before ten intervals exist the answer
    is no (S34), and the open interval does not count (S35).  With ``exact=False`` the intervals are
    forgotten: at each update from the eleventh on the free input ``<name>_mean_slow`` is the answer,
    which allows every run of the exact record and more.
    """
    slow = flag(f"{name}_slow")
    return _record_of_intervals(name, update, slow) if exact else _record_forgotten(name, update, slow)


def _record_of_intervals(name: str, update: Var, slow: Var) -> Block:
    units = integer(0, LONG)
    gap = var(f"{name}_gap", units, doc="ticks since the latest update")
    last = [var(f"{name}_interval{i}", units, doc=f"interval {i}, the latest first") for i in range(1, 11)]
    updates, one_more = _count_updates(name)
    shift = [assign(older, newer) for newer, older in zip(reversed(last[:-1]), reversed(last), strict=False)]
    total: Expr = last[0]
    for interval in last[1:]:
        total = total + interval
    at_update = [
        when(updates >= 1, [*shift, assign(last[0], gap)]),
        one_more,
        assign(slow, (updates == INTERVALS + 1) & (total > 20)),
        assign(gap, 0),
    ]
    return Block(
        f"{name}.intervals",
        [assign(gap, minimum(gap + 1, LONG)), when(update, at_update)],
        text="Mean of the last ten update intervals; 20 ticks are 400 ms [seed Table 2].",
    )


def _record_forgotten(name: str, update: Var, slow: Var) -> Block:
    updates, one_more = _count_updates(name)
    answer = flag(f"{name}_mean_slow")
    return Block(
        f"{name}.any_intervals",
        [when(update, [one_more, when(updates == INTERVALS + 1, [assign(slow, answer)])])],
        text="Over-approximation: the mean of the last ten intervals is arbitrary.",
    )


def arrival_window(name: str, update: Var) -> Block:
    """The same ``<name>_slow`` from the arrivals of the last 400 ms, exact and with fewer valuations.

    The sum of ten successive intervals is the time from the eleventh last update to the last one.
    So the mean exceeds 40 ms iff fewer than ten earlier updates lie within the last 400 ms.
    """
    slow = flag(f"{name}_slow")
    window = Var(f"{name}_arrivals", integer(0, 2**20 - 1), 0, "bit i: an update i+1 ticks ago", hidden=True)
    updates, one_more = _count_updates(name)
    recent = _count([bit(window, i) for i in range(20)])
    at_update = [one_more, assign(slow, (updates == INTERVALS + 1) & (recent < INTERVALS))]
    arrived = ite(update, const(1), const(0))
    return Block(
        f"{name}.arrivals",
        [when(update, at_update), assign(window, modulo(window * 2 + arrived, 2**20))],
        text="Fewer than eleven updates within 400 ms: the mean interval exceeds 40 ms [seed Table 2].",
    )


def _count(conditions: Sequence[Expr]) -> Expr:
    """How many of the conditions are true."""
    ones: list[Expr] = [ite(c, const(1), const(0)) for c in conditions]
    while len(ones) > 1:
        ones = [a + b for a, b in zip(ones[::2], ones[1::2], strict=False)] + ones[len(ones) & ~1 :]
    return ones[0]


_PAYLOAD = (b1.cmd, b1.x_norm, b1.y_norm, b1.is_motion_consistent, b1.crit_mask_b2, b1.degr_mask_b2)

received_payload = Block(
    "Board2_Data.payload",
    [when(b1.rx_update, [assign(field, b1.sent(field)) for field in _PAYLOAD])],
    text="An accepted frame replaces the payload; it is kept while frames are missing (S31).",
)

check_stop = Block(
    "checkStop",
    [assign(b1.wheels_below_2_5, all_of(*(speed < 2.5 for speed in b1.wheel_speed_rpm.values())))],
    text="All four wheels slower than 2.5 rpm.",
)
