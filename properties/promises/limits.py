"""Limits: what the references may be at most, whatever is commanded, and what an emergency stop means."""

from rovercheck.properties.document import temperature
from rovercheck.properties.forms import always, costly, holds_after
from rovercheck.properties.promises import steered
from rovercheck.properties.promises.driving import drives_1, half_1, half_2, zero_1, zero_2
from rovercheck.properties.promises.promise import Promise
from rovercheck.spec_model.lang.expr import any_of, implies
from rovercheck.spec_model.lang.time import ticks
from rovercheck.spec_model.lang.words import absolute, named
from rovercheck.spec_model.signals import board1 as b1
from rovercheck.spec_model.signals import board2_motion as motion
from rovercheck.spec_model.signals import board2_supervisor as b2

degraded = named(
    "a degraded cause",
    any_of(
        temperature.degraded_range,
        (b1.battery_pct < 23),
        *b1.has_no_feedback.values(),
        b1.degr_mask_b2 != 0,
    ),
)
"""Measured by Board 1 or told by Board 2 [spec Table 2, Fig 21]."""

uncritical = named("no critical bit", (b1.critical_mask == 0) & (b1.crit_mask_b2 == 0))
"""Of both boards; how bits follow from what is measured is promised apart (``shown``)."""

DEGRADED = costly(holds_after(
    "P-LIMITS-DEGRADED",
    "A degraded cause and no critical one for three successive steps of actuation under CMD_NORMAL, no 180° "
    "rotation: both references are at most 0.5 in the last.",
    premise=degraded & uncritical & drives_1 & (b1.cmd == "CMD_NORMAL") & ~b1.is_rotating180,
    for_=2 * ticks, then=half_1,
    covers=["B1-REF-05", "B1-REF-03"], on="board1_ms", from_tick=2, interpretations=["S57"],
))  # fmt: skip
FULL = costly(always(
    "P-LIMITS-FULL", "The references of Board 1 are at most full speed, whatever happens.",
    that=(absolute(b1.v_ref) <= 1) & (absolute(b1.omega_ref) <= 1),
    covers=["B1-REF-04"], on="board1_ms", from_tick=2,
))  # fmt: skip
BOARD_2 = costly(always(
    "P-LIMITS-BOARD-2", "The references of Board 2 are at most half of full speed, whatever happens.",
    that=half_2,
    covers=["B2-ACT-01", "B1-REF-05"], on="board2_ms", interpretations=["E25"],
))  # fmt: skip
MOTORS = costly(always(
    "P-LIMITS-MOTORS", "Board 2 commands at most 80 rpm on each side, whatever happens.",
    that=(absolute(b2.left_rpm) <= 80) & (absolute(b2.right_rpm) <= 80),
    covers=["B2-ACT-01"], on="board2_ms",
))  # fmt: skip
ESTOP_1 = costly(always(
    "P-LIMITS-ESTOP-1", "The emergency stop of Board 1 implies zero references.",
    that=implies(b1.actuate_emergency_stop, zero_1),
    covers=["B1-EST-01"], on="board1_ms", from_tick=2, interpretations=["S62"],
))  # fmt: skip
ESTOP_2 = costly(always(
    "P-LIMITS-ESTOP-2", "The emergency stop of Board 2 implies zero references.",
    that=implies(motion.actuate_emergency_stop, zero_2),
    covers=["B1-EST-01", "B2-REF-01"], on="board2_ms", interpretations=["S62"],
))  # fmt: skip

LIMITS = Promise(
    "LIMITS",
    "Limits and emergency stop",
    "Nominal limits 1.0, halved when degraded; Board 2 drives at half speed; an emergency stop stops.",
    "Fig 20, §2.3",
    "in the same step",
    "in the third step, and only under CMD_NORMAL: a deviation keeps the speed of its entry, and the last "
    "45° of a 180° rotation are turned at the speed of before",
    ("PB1-20a", "PB1-20b", "PB1-20c", "PB1-20d", steered.WHEEL.id),
    (DEGRADED, FULL, BOARD_2, MOTORS, ESTOP_1, ESTOP_2),
)
