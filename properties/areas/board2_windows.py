"""How rotation is measured on Board 2, step by step: what is summed, when a window ends, what is a hit.

Time stamps are on the 20 ms grid: a gap between two stamps counts if it is shorter than 0.1 s, at most four
steps; a short window is over at the first IMU stamp five steps or more after the one that began it, a long
window at the first 150 steps or more after it.  All stamps are 0 ms until the first datum; the first step
only takes them down, and begins both windows.
"""

from fractions import Fraction

from rovercheck.properties.document.sources import IMU, SUP
from rovercheck.properties.forms import Property, always, holds_after
from rovercheck.spec_model.board2.coherence import (
    SUM,
    differs,
    hit,
    imu_gap,
    imu_long,
    imu_short,
    long_ends,
    long_gap,
    odo_long,
    odo_short,
    ring,
    short_ends,
    wheel_gap,
)
from rovercheck.spec_model.lang.expr import Expr, Var, all_of, const, implies, ite
from rovercheck.spec_model.lang.time import ticks
from rovercheck.spec_model.lang.words import absolute, bit, held, maximum, minimum, once, previous
from rovercheck.spec_model.signals.board2_supervisor import gz_dps, is_motion_consistent, wheel_speed_rpm

EXACT, LONG, SHORT = "coherence", "coherence_long", "coherence_short"
ANY, COMPARED = "coherence_any_sums", "coherence_comparison"
STEPPED = once(const(True))
"""A step was made: true in every step, and before the first one false."""
SEEN = previous(STEPPED)
STEP = const(Fraction(1, 50), "s")
_by_wheels = wheel_speed_rpm["FL"] + wheel_speed_rpm["RL"] - wheel_speed_rpm["FR"] - wheel_speed_rpm["RR"]
BY_IMU, BY_WHEELS = (gz_dps, IMU.update, imu_gap), (_by_wheels, SUP.update, wheel_gap)
"""How fast the rover turns, in degrees per second, and as the difference of two wheels on either side, each
with its stamp and the steps since."""


def _steps(update: Var, gap: Var) -> Expr:
    """Steps since the stamp before this one, or since 0 ms (PB2-28v, PB2-28w); 0 where they are too many."""
    return ite(update & SEEN & (previous(gap) < 4), previous(gap) + 1, 0)


def _grown(total: Expr, most: Expr, by: tuple[Expr, Var, Var]) -> Expr:
    """What a sum is with this step, before the end of its window clears it."""
    rate, update, gap = by
    return minimum(maximum(total + rate * _steps(update, gap) * STEP, -most), most)


def _summed(id: str, what: str, total: Var, most: Expr, by: tuple[Expr, Var, Var], ends: Var) -> Property:
    return always(
        id, f"The rotation by {what} grows by rate times time since the last stamp, up to {most}; its end "
        "clears it.",
        that=total == ite(ends, 0, _grown(previous(total), most, by)),
        covers=["B1-IN-03"], on=EXACT,
    )  # fmt: skip


def _rpm_s(most: int) -> Expr:
    return const(most, "rpm·s")


MOST = {
    imu_short.name: const(400, "°"),
    imu_long.name: const(6200, "°"),
    odo_short.name: _rpm_s(800),
    odo_long.name: _rpm_s(4000),
}
"""What a sum grows to at most."""

PB2_28h, PB2_28i, PB2_28j, PB2_28k = (
    _summed(f"PB2-28{letter}", what, total, most, by, ends)
    for letter, what, total, most, by, ends in (
        ("h", "the IMU in a short window", imu_short, MOST[imu_short.name], BY_IMU, short_ends),
        ("i", "the IMU in a long window", imu_long, MOST[imu_long.name], BY_IMU, long_ends),
        ("j", "the wheels in a short window", odo_short, MOST[odo_short.name], BY_WHEELS, short_ends),
        ("k", "the wheels in a long window", odo_long, MOST[odo_long.name], BY_WHEELS, long_ends),
    )
)  # fmt: skip

DEGREES_PER_RPM_S = const(Fraction("0.83") * Fraction("0.14") * 180 / 60 / Fraction("0.38") / 2, "°/rpm/s")
"""Degrees turned for 1 rpm·s of difference of two wheels on either side: wheels of 0.14 m, 0.38 m apart, of
which 0.83 is turned.
"""


def _differing(imu: Expr, odo: Expr) -> Expr:
    return absolute(imu - odo * DEGREES_PER_RPM_S)


PB2_79a = always(
    "PB2-79a", "A short window is a hit if the IMU has turned by 1° or more, and the wheels by 1° less or "
    "more.",
    that=hit == (absolute(imu_short) >= 1) & (_differing(imu_short, odo_short) >= 1),
    covers=["B1-IN-03"], on=COMPARED,
)  # fmt: skip
PB2_79b = always(
    "PB2-79b", "A long window differs if the IMU has turned by 5° less or more than the wheels.",
    that=differs == (_differing(imu_long, odo_long) >= 5), covers=["B1-IN-03"], on=COMPARED,
)  # fmt: skip
PB2_79c, PB2_79d, PB2_79e, PB2_79f = (
    always(
        f"PB2-79{letter}", f"Whatever {what} has summed up, the next stamp adds rate times time, up to "
        f"{MOST[total.name]}.",
        that=total == ite(ends, 0, _grown(SUM[total.name], MOST[total.name], by)),
        covers=["B1-IN-03"], on=ANY,
    )
    for letter, what, total, by, ends in (
        ("c", "the IMU in a short window", imu_short, BY_IMU, short_ends),
        ("d", "the IMU in a long window", imu_long, BY_IMU, long_ends),
        ("e", "the wheels in a short window", odo_short, BY_WHEELS, short_ends),
        ("f", "the wheels in a long window", odo_long, BY_WHEELS, long_ends),
    )
)  # fmt: skip

PB2_78 = always(
    "PB2-78", "The latest result on record is that of the short window that ends in this step.",
    that=implies(short_ends, bit(ring, 0) == hit), covers=["B1-IN-03"], on=EXACT,
)  # fmt: skip

GAPS = {
    wheel_gap.name: (SUP.update, "of the wheels", EXACT),
    imu_gap.name: (IMU.update, "of the IMU", SHORT),
    long_gap.name: (IMU.update, "of the IMU, in a long window,", LONG),
}
"""The steps since a stamp, by which the gap to the next one is known."""


def _gap(id: str, gap: Var, most: int) -> Property:
    update, what, on = GAPS[gap.name]
    return always(
        id, f"The gap to the last stamp {what} is none in its step, and grows by 20 ms in every other, up to "
        f"{20 * most} ms.",
        that=gap == ite(update, 0, minimum(previous(gap) + 1, most)), covers=["B1-IN-03"], on=on,
    )  # fmt: skip


PB2_28v = _gap("PB2-28v", wheel_gap, 4)
PB2_28w = _gap("PB2-28w", imu_gap, 5)
PB2_28x = _gap("PB2-28x", long_gap, 150)


_turned = absolute(previous(imu_short) + gz_dps * STEP)
PB2_28l = always(
    "PB2-28l", "While the wheels rest, a short window is a hit if the IMU has turned by 1° or more in it.",
    that=implies(short_ends, hit == (_turned >= 1)), covers=["B1-IN-03"], on="coherence_spinning",
)  # fmt: skip
_turned = absolute(previous(imu_long) + gz_dps * STEP)
PB2_28m = always(
    "PB2-28m", "While the wheels rest, a long window differs if the IMU has turned by 5° or more in it.",
    that=implies(long_ends, differs == (_turned >= 5)), covers=["B1-IN-03"], on="coherence_blocked",
)  # fmt: skip


def _not_before(id: str, what: str, ends: Var, steps: int, on: str) -> Property:
    """A window begins with the stamp that ends another, the first with that of the first step, else at 0."""
    begun = ends | ~SEEN & IMU.update
    return always(
        id, f"After the beginning of a {what} window none ends for {20 * (steps - 1)} ms.",
        that=implies(ends, held(SEEN & ~previous(begun), for_=(steps - 2) * ticks)),
        covers=["B1-IN-03"], on=on,
    )  # fmt: skip


PB2_28n = _not_before("PB2-28n", "short", short_ends, 5, SHORT)
PB2_28o = _not_before("PB2-28o", "long", long_ends, 150, LONG)


def _at_the_stamp(id: str, what: str, ends: Var, steps: int, on: str) -> Property:
    return holds_after(
        id, f"Without the end of a {what} window for {20 * steps} ms the next stamp of the IMU ends one.",
        premise=~ends & SEEN, for_=(steps - 1) * ticks, then=~IMU.update, covers=["B1-IN-03"], on=on,
    )  # fmt: skip


PB2_28p = _at_the_stamp("PB2-28p", "short", short_ends, 5, SHORT)
PB2_28q = _at_the_stamp("PB2-28q", "long", long_ends, 150, LONG)
PB2_28r, PB2_28s = (
    always(
        f"PB2-28{letter}", f"A {what} window ends only in a step with a stamp of the IMU.",
        that=implies(ends, IMU.update), covers=["B1-IN-03"], on=on,
    )
    for letter, what, ends, on in (("r", "short", short_ends, SHORT), ("s", "long", long_ends, LONG))
)  # fmt: skip
PB2_28t = always(
    "PB2-28t", "The end of a short window moves the last nine results on by one; nothing else changes them.",
    that=all_of(*(
        bit(ring, i)
        == ite(short_ends, previous(bit(ring, i - 1)) if i else hit, SEEN & previous(bit(ring, i)))
        for i in range(10)
    )),
    covers=["B1-IN-03"], on=SHORT,
)  # fmt: skip
_hits: Expr = const(0)
for _i in range(10):
    _hits = _hits + ite(bit(ring, _i), 1, 0)
PB2_28u = always(
    "PB2-28u", "The motion is inconsistent exactly at the end of a short window with eight hits in ten, or "
    "of a long one that differs.",
    that=~is_motion_consistent == (short_ends & (_hits >= 8)) | (long_ends & differs),
    covers=["B1-IN-03"], on=EXACT,
)  # fmt: skip
PB2_28y = always(
    "PB2-28y", "In the first step nothing has turned, no window has ended, and the motion is consistent.",
    that=SEEN | all_of(*(total == 0 for total in (imu_short, imu_long, odo_short, odo_long)),
                       ring == 0, ~short_ends, ~long_ends, is_motion_consistent),
    covers=["B1-IN-03"], on=EXACT,
)  # fmt: skip
