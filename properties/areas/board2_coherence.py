"""What must be true of the coherence of IMU and odometry on Board 2 [spec §2.2 for the purpose]."""

from collections.abc import Sequence

from rovercheck.properties.forms import always, reachable, until
from rovercheck.spec_model.board2.coherence import (
    differs,
    long_ends,
    long_result,
    ring,
    short_ends,
    short_result,
)
from rovercheck.spec_model.lang.expr import Expr, const, implies, ite
from rovercheck.spec_model.lang.words import bit, previous
from rovercheck.spec_model.signals.board2_supervisor import is_motion_consistent

LONG, SHORT = "coherence_long", "coherence_short"
BLOCKED, SPINNING = "coherence_blocked", "coherence_spinning"
incoherent = ~is_motion_consistent


def _number(conditions: Sequence[Expr]) -> Expr:
    total: Expr = const(0)
    for condition in conditions:
        total = total + ite(condition, const(1), const(0))
    return total


hits = _number([bit(ring, i) for i in range(10)])
"""Hits among the last ten short windows [design]."""

PB2_28a = always(
    "PB2-28a", "A long window that ends with a difference of 5° or more makes the motion inconsistent.",
    that=implies(long_ends & differs, incoherent),
    covers=["B1-IN-03"], on=LONG, from_tick=2,
)  # fmt: skip
PB2_28b = until(
    "PB2-28b",
    "After a long window that ends with a difference of 5° or more the motion is inconsistent until the end "
    "of one that differs by less.",
    start=long_ends & differs, holds=incoherent, release=long_ends & ~differs,
    covers=["B1-IN-03"], on=BLOCKED, from_tick=2,
)  # fmt: skip
PB2_28c = always(
    "PB2-28c", "Of the long windows exactly one that ends with such a difference makes the motion "
    "inconsistent, and the short ones do by their own result.",
    that=incoherent == ((long_ends & differs) | ~short_result), covers=["B1-IN-03"], on=LONG,
)  # fmt: skip
PB2_28d = always(
    "PB2-28d", "A short window makes the motion inconsistent only with eight hits in ten.",
    that=implies(incoherent, (short_ends & (hits >= 8)) | ~long_result),
    covers=["B1-IN-03"], on=SHORT, from_tick=2,
)  # fmt: skip
PB2_28e = always(
    "PB2-28e", "A short window that ends with eight hits in ten makes the motion inconsistent.",
    that=implies(short_ends & (hits >= 8), incoherent),
    covers=["B1-IN-03"], on=SHORT, from_tick=2,
)  # fmt: skip
PB2_28f = always(
    "PB2-28f", "The motion is inconsistent in a step only if a window ends in it.",
    that=implies(incoherent, long_ends | ~short_result), covers=["B1-IN-03"], on=LONG, from_tick=2,
)  # fmt: skip
PB2_28g = always(
    "PB2-28g", "A rover that the IMU sees turn by 2° each second has no hits: only a long window tells.",
    that=implies(incoherent, long_ends), covers=["B1-IN-03"], on=BLOCKED, from_tick=2,
)  # fmt: skip

REACH_COH_LONG = reachable(
    "REACH-COH-LONG", "A rover that turns while its wheels stand still is found inconsistent after 3 s.",
    that=incoherent & long_ends & differs, covers=["B1-IN-03"], on=BLOCKED,
)  # fmt: skip
REACH_COH_SHORT = reachable(
    "REACH-COH-SHORT", "Eight hits can make the motion inconsistent.",
    that=incoherent & short_ends, covers=["B1-IN-03"], on=SPINNING,
)  # fmt: skip
REACH_COH_AGAIN = reachable(
    "REACH-COH-AGAIN", "The motion can be consistent again in the step after.",
    that=is_motion_consistent & previous(incoherent & short_ends), covers=["B1-IN-03"], on=SPINNING,
)  # fmt: skip
