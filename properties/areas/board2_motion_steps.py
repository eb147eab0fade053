"""When Board 2 begins a stop and when it counts it as done, and its safety state and limits (E22, E25)."""

from rovercheck.properties.areas.board2_motion import at_rest, braking, drives, rotating
from rovercheck.properties.document.causes import emergency
from rovercheck.properties.forms import always, enters_only_if, holds_after, never, reachable
from rovercheck.spec_model.lang.expr import all_of, implies
from rovercheck.spec_model.lang.time import ticks
from rovercheck.spec_model.lang.words import absolute, held, once, previous
from rovercheck.spec_model.signals.board2_motion import (
    actuate_emergency_stop,
    angle_err,
    ay_norm,
    invert_y,
    is_rotating180,
    wheels_below_2_5,
)
from rovercheck.spec_model.signals.board2_supervisor import (
    cmd,
    rover_safety_state,
    rx_status,
    wheel_speed_rpm,
)

ON = "references_2"
critical = rover_safety_state == "SAFETY_CRITICAL"
stopped = actuate_emergency_stop
unheard = rx_status == "RX_CRITICAL"
forward = (ay_norm > 0) | (ay_norm < 0) & previous(invert_y)
"""The user drives forward; a stick whose meaning changed in an earlier step does so pulled back, too."""

# --- the safety state in which Board 2 drives ------------------------------------------------------------

PB2_33a = always(
    "PB2-33a", "From its second step on Board 2 drives critical with an emergency, degraded without one.",
    that=implies(
        drives & previous(once(drives)),
        critical == emergency,
    ),
    covers=["B2-REF-01"], on=ON, from_tick=2, interpretations=["E22"],
)  # fmt: skip
PB2_33b = always(
    "PB2-33b", "Board 2 never drives with a safety state of OK, which it has before it drives.",
    that=(rover_safety_state == "SAFETY_OK") == ~once(drives),
    covers=["B2-REF-01"], on=ON, interpretations=["E22"],
)  # fmt: skip

# --- the stop ------------------------------------------------------------------------------------------

PB2_33c = always(
    "PB2-33c",
    "A stop of Board 2 begins only by CMD_ESTOP to a rover that the user drove forward, not rotating, or by "
    "a critical safety state.",
    that=implies(
        previous(drives) & stopped & ~previous(stopped),
        (cmd == "CMD_ESTOP") & previous(forward & ~is_rotating180) | critical,
    ),
    covers=["B2-REF-01"], on=ON, from_tick=3, interpretations=["S61", "S63"],
)  # fmt: skip
standing = stopped & (wheels_below_2_5 | ~drives)
"""In the stop with all wheels below 2.5 rpm, which only a step in which Board 2 drives looks at."""
PB2_33d = enters_only_if(
    "PB2-33d",
    "With reception the first stop of Board 2 counts as done only after 51 steps of it with all wheels below "
    "2.5 rpm.",
    entering=once(at_rest), only_if=previous(held(standing, for_=50 * ticks)) | unheard,
    covers=["B2-REF-01"], on=ON, from_tick=2, interpretations=["S62"],
)  # fmt: skip
PB2_33e = enters_only_if(
    "PB2-33e", "A stop with turning wheels counts as done only after 2 s of it, the last without reception.",
    entering=at_rest, only_if=previous(standing) | unheard & held(previous(braking), for_=99 * ticks),
    covers=["B2-REF-01"], on=ON, from_tick=2, interpretations=["S62"],
)  # fmt: skip
PB2_33f = holds_after(
    "PB2-33f", "Braking ends when the rover has stood for more than 1 s, Board 2 driving.",
    premise=drives & previous(drives & braking & wheels_below_2_5), for_=51 * ticks, then=~braking,
    covers=["B2-REF-01"], on=ON, from_tick=2, interpretations=["S62"],
)  # fmt: skip
PB2_33g = never(
    "PB2-33g", "Without reception braking lasts at most 2 s, Board 2 driving.",
    that=held(drives & braking & unheard, for_=100 * ticks),
    covers=["B2-REF-01"], on=ON, interpretations=["S62"],
)  # fmt: skip

PB2_33h = always(
    "PB2-33h", "For Board 2 the rover stands where all four wheels, as last received, turn below 2.5 rpm.",
    that=wheels_below_2_5 == all_of(*(absolute(speed) < 2.5 for speed in wheel_speed_rpm.values())),
    covers=["B2-REF-01"], on="references_2_drawn", interpretations=["S62"],
)  # fmt: skip
REACH2_NEAR = reachable(
    "REACH2-ROTATION-NEAR", "A rotation of Board 2 can come near its target.",
    that=drives & rotating & previous(rotating) & (absolute(angle_err) < 7.5),
    covers=["B2-REF-01"], on=ON, interpretations=["S60"],
)  # fmt: skip
