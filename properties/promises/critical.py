"""Critical => zero references: from each measured or received cause to what the driving board commands."""

from collections.abc import Sequence

from rovercheck.properties.document import battery, temperature
from rovercheck.properties.document.sources import BLE, IMU, silent_ms
from rovercheck.properties.forms import Property, costly, holds_after
from rovercheck.properties.promises import shown, steered
from rovercheck.properties.promises.driving import drives_1, drives_2, zero_1, zero_2
from rovercheck.properties.promises.promise import Chain, Promise
from rovercheck.spec_model.lang.expr import Expr, any_of
from rovercheck.spec_model.lang.time import Span, sec, tick, ticks
from rovercheck.spec_model.lang.words import bit, held
from rovercheck.spec_model.signals import board1 as b1
from rovercheck.spec_model.signals import board2_supervisor as b2

BEYOND_THE_LINK = (0, 1, 3, 4, 5, 6)
"""Bits of Board 1's critical mask that a loss of the link does not set [spec Table 1]."""


def _board_1(id: str, text: str, cause: Expr, covers: Sequence[str]) -> Property:
    return costly(holds_after(
        f"P-CRITICAL-{id}", f"{text}, in two successive steps of actuation: zero references in the second.",
        premise=cause & drives_1, for_=1 * tick, then=zero_1,
        covers=[*covers, "B1-REF-03", "B1-REF-06", "B1-REF-07"], on="board1_ms", from_tick=2,
        interpretations=["S55"],
    ))  # fmt: skip


def _board_2(id: str, text: str, cause: Expr, for_: Span, covers: Sequence[str]) -> Property:
    return costly(holds_after(
        f"P-CRITICAL-{id}", text, premise=cause & drives_2, for_=for_, then=zero_2,
        covers=[*covers, "B2-REF-01", "B1-REF-06"], on="board2_ms", from_tick=2,
    ))  # fmt: skip


HOT = _board_1(
    "HOT", "A temperature in the critical range for 4 s",
    held(temperature.critical_range, for_=4 * sec), ["B1-TEMP-03"],
)  # fmt: skip
ASSUMED_HOT = _board_1(
    "ASSUMED-HOT", "A temperature without readings, assumed above 65",
    temperature.stale_above_65, ["B1-TEMP-04", "B1-TEMP-05"],
)  # fmt: skip
FLAT = _board_1(
    "FLAT", "A battery in the critical range for 5 s",
    held(battery.critical_range, for_=5 * sec), ["B1-BATT-03"],
)  # fmt: skip
ASSUMED_FLAT = _board_1(
    "ASSUMED-FLAT", "A battery without readings, assumed below 15",
    battery.stale_below_15, ["B1-BATT-04", "B1-BATT-05"],
)  # fmt: skip
WHEEL = _board_1(
    "WHEEL", "A wheel without feedback while motion is not consistent",
    any_of(*b1.has_no_feedback.values()) & ~b1.is_motion_consistent, ["B1-WHL-03"],
)  # fmt: skip
TOLD_BY_2 = _board_1(
    "TOLD-BY-2", "A received mask that says joystick link or IMU of Board 2 critical",
    bit(b1.crit_mask_b2, 0) | bit(b1.crit_mask_b2, 1), ["B2-FLT-02"],
)  # fmt: skip

TOLD_BY_1 = _board_2(
    "TOLD-BY-1",
    "Board 2 driving, a critical fault of Board 1 beyond the link, received in two successive steps: zero "
    "references in the second.",
    any_of(*(bit(b2.crit_mask_b1, i) for i in BEYOND_THE_LINK)), 1 * tick, ["B1-REF-07"],
)  # fmt: skip
JOYSTICK = _board_2(
    "JOYSTICK",
    "Board 2 driving, joystick data older than 120 ms in four successive steps: zero references in the last.",
    silent_ms(BLE), 3 * ticks, ["B2-FLT-01"],
)  # fmt: skip
INERTIAL = _board_2(
    "INERTIAL",
    "Board 2 driving, IMU data older than 200 ms in four successive steps: zero references in the last.",
    silent_ms(IMU), 3 * ticks, ["B2-FLT-01"],
)  # fmt: skip

BEYOND = (
    (shown.TEMPERATURE, held(temperature.critical_range, for_=4 * sec) | temperature.stale_above_65),
    (shown.BATTERY, held(battery.critical_range, for_=5 * sec) | battery.stale_below_15),
    (shown.WHEELS, any_of(*b1.has_no_feedback.values()) & ~b1.is_motion_consistent),
)
"""Faults of Board 1 beyond the link, and what shows them to Board 2."""


def _chain(first: Property, cause: Expr) -> Chain:
    """From a fault of Board 1 to the references of Board 2, which drives."""
    sent, received = (
        any_of(*(bit(mask, i) for i in BEYOND_THE_LINK)) for mask in (b1.critical_mask, b2.crit_mask_b1)
    )
    return Chain(
        "PSY-14b",
        stands={
            "critical": cause,
            "critical_sent": sent,
            "critical_received": received & drives_2,
            "references_nonzero": ~zero_2,
        },
        by={"Sender.contract": first.id, "Receiver.contract": TOLD_BY_1.id},
        assuming=drives_2,
    )


CRITICAL = Promise(
    "CRITICAL",
    "Critical: zero references",
    "In SAFETY_CRITICAL the five limits are 0; the references then stop the rover.",
    "§2.7, Fig 20, Fig 21",
    "in the step in which a cause is critical",
    "in the next step (20 ms later); for a silent sensor of Board 2 in the fourth step of silence; the "
    "motors stand 500 ms after the last datum of joystick or IMU, 4.5 s at 64 °C, 5.5 s at 10 %, however the "
    "rover is steered",
    ("PB1-17a", "PB2-17"),
    (
        HOT, ASSUMED_HOT, FLAT, ASSUMED_FLAT, WHEEL, TOLD_BY_2, TOLD_BY_1, JOYSTICK, INERTIAL,
        steered.JOYSTICK, steered.IMU, steered.HOT, steered.FLAT,
    ),
    tuple(_chain(first, cause) for first, cause in BEYOND),
)  # fmt: skip
