"""What sensors, link and clock may do to Board 1: time stamps as ages.

Blocks that run before the charts.  Nothing is assumed of the inputs but what the interface says: a
datum changes only together with its time stamp [spec Fig 13, §2.4].  An age is `now_ms` minus the
stamp, on the 20 ms grid: an update seen in a step carries the time of that step.  Time 0 is
power-up with all stamps 0, and the first step is at 20 ms.

An age stops growing at a value that stands for all larger ones, because no comparison of the charts
can change beyond it:

* links: 140 ms, the first age above 120 ms [spec Table 2];
* temperature: 81 020 ms, where even the coldest reading, -16 °C, is assumed above 65 °C (1 °C/s);
* battery: 154 780 ms, where even a charge of 80 % is assumed below 15 % (0.42 %/s);
* both 500 ms later where the estimate counts from 0.5 s on (S09, S24).
"""

from rovercheck.spec_model.ambiguity import choose
from rovercheck.spec_model.lang.action import assign, when
from rovercheck.spec_model.lang.chart import Block
from rovercheck.spec_model.lang.expr import Expr, Var, all_of, const, implies
from rovercheck.spec_model.lang.words import absolute, minimum
from rovercheck.spec_model.signals import board1 as b1


def _older(age: Var, last_ms: int) -> Expr:
    """The age one step later; it stops growing at ``last_ms``."""
    return minimum(age + const(20, "ms"), const(last_ms, "ms"))


def clock(name: str, update: Var, age: Var) -> Block:
    """The age of a time stamp that is set to `now_ms` by an update."""
    grow = assign(age, _older(age, age.domain.high * 20))
    return Block(name, [when(update, [assign(age, 0)], [grow])], text=f"Time since {update.name}.")


def measurement(name: str, update: Var, reading: Var, value: Var, age: Var, older: Expr) -> Block:
    """A datum of a snapshot with its age, else one step ``older``: an update replaces the value."""
    return Block(
        name,
        [when(update, [assign(value, reading), assign(age, 0)], [assign(age, older)])],
        text=f"{value.name} keeps the last valid reading.",
    )


temperature_readings = measurement(
    "Board_Health.temperature",
    b1.temp_update,
    b1.temp_reading,
    b1.temperature_degC,
    b1.temp_age,
    choose("S09", {"FROM-LAST": _older(b1.temp_age, 81_020), "FROM-0.5": _older(b1.temp_age, 81_520)}),
)
battery_readings = measurement(
    "Board_Health.battery",
    b1.batt_update,
    b1.batt_reading,
    b1.battery_pct,
    b1.batt_age,
    choose(
        "S24",
        {
            "FROM-LAST-INSTANT": _older(b1.batt_age, 154_780),
            "FROM-0.5-INSTANT": _older(b1.batt_age, 155_280),
            "FROM-LAST-SUSTAINED": _older(b1.batt_age, 154_780),
        },
    ),
)
reception_clock = clock("Board2_Data.age", b1.rx_update, b1.rx_age)
heartbeat_clock = clock("Heartbeat.age", b1.heartbeat_update, b1.heartbeat_age)

heartbeat_travels_in_frames = implies(b1.heartbeat_update, b1.rx_update)
"""A new heartbeat can only come with an accepted frame, which carries it."""

_PAYLOAD = (
    b1.cmd, b1.x_norm, b1.y_norm, b1.current_yaw, b1.btn1, b1.btn2,
    b1.is_motion_consistent, b1.crit_mask_b2, b1.degr_mask_b2,
)  # fmt: skip

received_payload = Block(
    "Board2_Data.payload",
    [when(b1.rx_update, [assign(field, b1.sent(field)) for field in _PAYLOAD])],
    text="An accepted frame replaces the payload; it is kept while frames are missing (S31).",
)

check_stop = Block(
    "checkStop",
    [assign(b1.wheels_below_2_5, all_of(*(absolute(speed) < 2.5 for speed in b1.wheel_speed_rpm.values())))],
    text="All four wheels slower than 2.5 rpm.",
)
