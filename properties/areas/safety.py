"""What must be true of the safety state of the rover [spec §2.7, Fig 21]."""

from rovercheck.properties.document.causes import critical, degraded
from rovercheck.properties.forms import always, holds_after, reachable, responds
from rovercheck.spec_model.ambiguity import choose
from rovercheck.spec_model.board1.safety import safety_state
from rovercheck.spec_model.lang.expr import all_of, implies
from rovercheck.spec_model.lang.time import tick, ticks
from rovercheck.spec_model.lang.words import bit, named, once
from rovercheck.spec_model.signals.board1 import (
    b2_critical,
    b2_degraded,
    crit_mask_b2,
    degr_mask_b2,
    give_b2_actuation,
    rover_safety_state,
)

ON = "safety"
CRITICAL = rover_safety_state == "SAFETY_CRITICAL"
NOT_OK = rover_safety_state != "SAFETY_OK"
drives = named("Board 1 actuates", ~give_b2_actuation)
critical_cause = named("critical cause while Board 1 actuates", drives & critical)
any_cause = named("cause while Board 1 actuates", drives & (critical | degraded))

PB1_16a = always(
    "PB1-16a", "While Board 1 actuates, a critical cause makes the safety state critical in the same step.",
    that=implies(critical_cause, CRITICAL),
    covers=["B1-REF-03", "B1-REF-07"], on=ON, from_tick=2, interpretations=["S55", "S56"],
)  # fmt: skip
PB1_16b = always(
    "PB1-16b",
    "While Board 1 actuates, with a critical or degraded cause the safety state is not OK in the same step.",
    that=implies(any_cause, NOT_OK),
    covers=["B1-REF-03", "B1-REF-07"], on=ON, from_tick=2, interpretations=["S55", "S56"],
)  # fmt: skip
PB1_16c = holds_after(
    "PB1-16c",
    "A critical cause in two successive steps of actuation makes the safety state critical in the second.",
    premise=critical_cause, for_=1 * tick, then=CRITICAL,
    covers=["B1-REF-03", "B1-REF-07"], on=ON, from_tick=2, interpretations=["S55", "S56"],
)  # fmt: skip
PB1_16d = holds_after(
    "PB1-16d", "With a cause in two successive steps of actuation the safety state is not OK in the second.",
    premise=any_cause, for_=1 * tick, then=NOT_OK,
    covers=["B1-REF-03", "B1-REF-07"], on=ON, from_tick=2, interpretations=["S55", "S56"],
)  # fmt: skip
PB1_16e = responds(
    "PB1-16e", "A critical cause, even of one step, makes the safety state critical within one step.",
    trigger=critical_cause, response=CRITICAL, within=1 * tick,
    covers=["B1-REF-03", "B1-REF-07"], on=ON, from_tick=2, interpretations=["S55", "S56"],
)  # fmt: skip
PB1_16f = always(
    "PB1-16f",
    "While Board 1 actuates, the safety state is critical only with a critical cause in the same step.",
    that=implies(drives & CRITICAL, critical),
    covers=["B1-REF-07"], on=ON, from_tick=2, interpretations=["S55", "S56"],
)  # fmt: skip
PB1_16g = always(
    "PB1-16g", "While Board 1 actuates, without any cause the safety state is OK in the same step.",
    that=implies(drives & ~critical & ~degraded, ~NOT_OK),
    covers=["B1-REF-07"], on=ON, from_tick=2, interpretations=["S55", "S56"],
)  # fmt: skip
PB1_16i = holds_after(
    "PB1-16i",
    "With a degraded cause in three successive steps of actuation the safety state is not OK in the third.",
    premise=named("degraded cause while Board 1 actuates", drives & degraded), for_=2 * ticks,
    then=NOT_OK, covers=["B1-REF-03", "B1-REF-07"], on=ON, from_tick=2, interpretations=["S55", "S56"],
)  # fmt: skip

bit_0, bit_1, bit_2, bit_3 = (bit(crit_mask_b2, i) for i in range(4))
any_critical, any_degraded = crit_mask_b2 != 0, degr_mask_b2 != 0
stops = choose("S54", {"B2BITS": bit_0 | bit_1, "SAME-AS-B1": bit_0 | bit_1 | bit_3})
slows = choose("S54", {"B2BITS": bit_2 | bit_3, "SAME-AS-B1": bit_2})
PB1_16j = always(
    "PB1-16j",
    "Before Board 1 actuates for the first time, in its first step where the relay is (PB1-14b), the safety "
    "state is OK.",
    that=implies(~once(drives), rover_safety_state == "SAFETY_OK"), covers=["B1-REF-04"], on=ON,
)  # fmt: skip
PB1_16h = always(
    "PB1-16h",
    "Of Board 2, critical bits 0 and 1 are a critical cause; 2, 3 and any degraded bit are a degraded one.",
    that=all_of(
        b2_critical == choose("S55", {"CLASSIFIED": stops, "ANY-BIT": any_critical}),
        b2_degraded == choose("S55", {"CLASSIFIED": slows | any_degraded, "ANY-BIT": any_degraded}),
    ),
    covers=["B1-REF-07"], on=ON, interpretations=["S54", "S55"],
)  # fmt: skip

REACH_SAFETY_DEGRADED = reachable(
    "REACH-SAFETY-DEGRADED", "The rover can be degraded.",
    that=safety_state.active("Rover_Degraded_State"), covers=["B1-REF-07"], on=ON,
)  # fmt: skip
REACH_SAFETY_CRITICAL = reachable(
    "REACH-SAFETY-CRITICAL", "The rover can be critical.",
    that=safety_state.active("Rover_Critical_State"), covers=["B1-REF-07"], on=ON,
)  # fmt: skip
