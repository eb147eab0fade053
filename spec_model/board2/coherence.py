"""Coherence: does the rover turn as its wheels say [spec §2.2 for the purpose, the rest is design].

The rotation measured by the IMU is compared with that of the wheels over short windows of 0.1 s and
long windows of 3 s, which end at the first IMU stamp that late.  The result is false only in a step
that ends a window: a long one with a difference of 5° or more, or a short one when at least eight of
the last ten short ones were hits.

Time stamps lie on the 20 ms grid and all sums are exact.  A sum that reaches the end of its domain is kept
there: a window of 0.1 or 3 s gets there beyond 2,000° per second, the widest range of such a gyroscope, or
with every wheel beyond 320 rpm, four times what Board 2 commands; one that a silent IMU leaves open, sooner.
"""

from fractions import Fraction

from rovercheck.spec_model.lang.action import Action, assign, when
from rovercheck.spec_model.lang.chart import Block
from rovercheck.spec_model.lang.domain import Domain, fixed, integer
from rovercheck.spec_model.lang.expr import Const, Expr, Var, const, flag, ite, var
from rovercheck.spec_model.lang.words import absolute, bit, maximum, minimum, modulo
from rovercheck.spec_model.signals.board2_supervisor import (
    IMU,
    SUP,
    gz_dps,
    is_motion_consistent,
    wheel_speed_rpm,
)

SHORT, LONG = 5, 150
"""Length of the windows in ticks of 20 ms: 100 ms and 3 s."""

USABLE = 4
"""A gap of up to 80 ms counts; 0.1 s does not."""

WHEEL_RADIUS, TRACK, CORRECTION = Fraction("0.07"), Fraction("0.38"), Fraction("0.83")
DEGREES_PER_RPM_S = CORRECTION * 2 * WHEEL_RADIUS * 180 / (60 * TRACK)
"""Degrees turned in 1 s for 1 rpm of difference between the sides: 1743/1900."""


def _rotation(most: int) -> Domain:
    """Degrees, from rates in whole degrees per second."""
    return fixed(-most, most, "0.02", "°")


def _difference(most: int) -> Domain:
    """Two wheels to a side, from speeds in tenths of rpm: 1 rpm·s is 0.46°."""
    return fixed(-most, most, "0.002", "rpm·s")


imu_short = var("IMU_fast", _rotation(400), doc="rotation measured in the short window")
imu_long = var("IMU_long", _rotation(6200), doc="rotation measured in the long window")
odo_short = var("odo_fast", _difference(800), doc="left minus right wheels over the short window")
odo_long = var("odo_long", _difference(4000), doc="left minus right wheels over the long window")

started = flag("coherence_started", "the initial step is over", hidden=True)
wheel_gap = var(
    "coherence_wheel_gap",
    integer(0, USABLE),
    doc="ticks since last_valid_b1_ms, less one usable",
    hidden=True,
)
imu_gap = var(
    "coherence_imu_gap", integer(0, SHORT), doc="ticks since IMU.data_last_valid_ms, a few", hidden=True
)
long_gap = var(
    "coherence_long_gap", integer(0, LONG), doc="ticks since IMU.data_last_valid_ms, many", hidden=True
)
short_open = var("fast_open", integer(0, SHORT), doc="ticks from fast_start to the IMU stamp", hidden=True)
long_open = var("long_open", integer(0, LONG), doc="ticks from long_start to the IMU stamp", hidden=True)
ring = var(
    "coherence_hits", integer(0, 2**10 - 1), doc="bit i: the window i windows ago was a hit", hidden=True
)

hit = flag("fast_hit", "the short window turned by 1° or more and differs by 1° or more", hidden=True)
differs = flag("long_differs", "the long window differs by 5° or more", hidden=True)
short_ends = flag("fast_ends", "a short window ends in this step", hidden=True)
long_ends = flag("long_ends", "a long window ends in this step", hidden=True)
short_result = var("fast_result", flag("").domain, True, "what the short windows say in this step")
long_result = var("long_result", flag("").domain, True, "what the long window says in this step")


def _add(total: Var, rate: Expr, ticks: Expr) -> Action:
    grown = total + rate * ticks * const(Fraction(1, 50), "s")
    return assign(
        total,
        minimum(maximum(grown, Const(total.domain.low, total.sort)), Const(total.domain.high, total.sort)),
    )


_left_minus_right = (
    wheel_speed_rpm["FL"] + wheel_speed_rpm["RL"] - wheel_speed_rpm["FR"] - wheel_speed_rpm["RR"]
)


def by_wheels(odometry: Var) -> Expr:
    """The rotation in degrees that the wheels have made: half the difference of two wheels a side."""
    return odometry * const(DEGREES_PER_RPM_S / 2, "°/rpm/s")


accumulate = Block("Coherence.rotation", [
    when(started & SUP.update & (wheel_gap < USABLE), [
        _add(total, _left_minus_right, wheel_gap + 1) for total in (odo_short, odo_long)
    ]),
    when(started & IMU.update & (imu_gap < USABLE), [
        _add(total, gz_dps, imu_gap + 1) for total in (imu_short, imu_long)
    ]),
    assign(hit, (absolute(imu_short) >= 1) & (absolute(imu_short - by_wheels(odo_short)) >= 1)),
    assign(differs, absolute(imu_long - by_wheels(odo_long)) >= 5),
], text="Rotation by IMU and by wheels in the open windows.")  # fmt: skip


def _ends(window: Var, length: int, ends: Var, gap: Var) -> list[Action]:
    """The window grows to the IMU stamp of the step, if there is a new one, and ends when long enough."""
    grown = minimum(window + gap + 1, length)
    return [
        when(started & IMU.update, [assign(window, grown)]),
        assign(ends, window >= length),
        when(ends, [assign(window, 0)]),
    ]


_hits: Expr = const(0)
for _i in range(10):
    _hits = _hits + ite(bit(ring, _i), const(1), const(0))
hits = _hits
"""Hits among the last ten short windows."""

short_windows = Block("Coherence.short", [
    *_ends(short_open, SHORT, short_ends, imu_gap),
    when(short_ends, [assign(ring, modulo(ring * 2 + ite(hit, const(1), const(0)), 2**10))]),
    assign(short_result, ~(short_ends & (hits >= 8))),
], text="Short windows: eight hits in ten.")  # fmt: skip

long_windows = Block("Coherence.long", [
    *_ends(long_open, LONG, long_ends, long_gap),
    assign(long_result, ~(long_ends & differs)),
], text="Long windows: 5° of difference.")  # fmt: skip

result = Block(
    "Coherence.result",
    [assign(is_motion_consistent, short_result & long_result)],
    text="True unless a window that ends in this step says otherwise.",
)

clear = Block("Coherence.clear", [
    when(short_ends, [assign(imu_short, 0), assign(odo_short, 0)]),
    when(long_ends, [assign(imu_long, 0), assign(odo_long, 0)]),
], text="A new window begins with no rotation.")  # fmt: skip


def _follow(update: Var, gap: Var) -> Action:
    return assign(gap, ite(update, 0, minimum(gap + 1, gap.domain.high)))


stamps = Block(
    "Coherence.stamps",
    [
        _follow(SUP.update, wheel_gap),
        _follow(IMU.update, imu_gap),
        _follow(IMU.update, long_gap),
        assign(started, True),
    ],
    text="The stamps that the next step compares with.",
)

COHERENCE = (accumulate, short_windows, long_windows, result, clear, stamps)
"""F-COH2 as a whole, in order."""

SUM = {
    total.name: var(f"before_{total.name}", total.domain, doc=f"{total.doc}, before the step", hidden=True)
    for total in (imu_short, imu_long, odo_short, odo_long)
}
"""What has been summed up when a step begins, if that is anything."""


def _any_sums(*further: Action) -> Block:
    return Block(
        "AnySums",
        [*(assign(total, SUM[total.name]) for total in (imu_short, imu_long, odo_short, odo_long)), *further],
        text="Anything has been summed up before.",
    )


FROM_ANY_SUMS = (_any_sums(), *COHERENCE)
"""Over-approximation: any sums before each step."""

COMPARISON_ALONE = (_any_sums(assign(started, False)), accumulate)
"""Any sums before each step, to which nothing is added: as in the initial step, nothing came before."""

LONG_ALONE = (long_windows, result, stamps)
"""Over-approximation: any rotation in any long window, any result of the short ones."""

SHORT_ALONE = (short_windows, result, stamps)
"""Over-approximation: any rotation in any short window, any result of the long ones."""
