"""What one step makes of the motion of Board 1: the meaning of the stick, the dodges, the turn, the stop.

The stop is tested before the user's command of the step is read, the transitions of running after it.
"""

from fractions import Fraction

from rovercheck.properties.areas.manoeuvres import ACTIONS, DEGRADED, OK, during
from rovercheck.properties.areas.motion import at_rest, braking, normal, rotating, stopped
from rovercheck.properties.areas.references import drives, running
from rovercheck.properties.forms import Property, always, enters_only_if, holds_after, reachable
from rovercheck.spec_model.ambiguity import choose
from rovercheck.spec_model.board1.motion import motion_supervision
from rovercheck.spec_model.lang.expr import Expr, all_of, const, implies
from rovercheck.spec_model.lang.time import ticks
from rovercheck.spec_model.lang.words import absolute, held, maximum, minimum, once, previous
from rovercheck.spec_model.signals.board1 import (
    angle_err,
    backward_enabled,
    cmd,
    invert_y,
    is_rotating180,
    omega_ref,
    rover_safety_state,
    v_ref,
    wheels_below_2_5,
    x_norm,
    y_norm,
)

ON = "references"
CRITICAL = rover_safety_state == "SAFETY_CRITICAL"
MANOEUVRES = {
    state: ACTIONS[state]
    for state in ("Schivata_a_sinistra", "Schivata_a_destra", "Evita_sinistra", "Evita_destra")
}
"""The command that begins each dodge and each way round."""
active = motion_supervision.active
forward = (y_norm > 0) | (y_norm < 0) & previous(invert_y)
"""The user drives forward; a stick whose meaning changed in an earlier step does so pulled back, too."""


# --- what the stick means --------------------------------------------------------------------------

PB1_40a = always(
    "PB1-40a", "Where a rotation ends in running, a stick pulled back means forward, and no other does.",
    that=implies(drives & previous(rotating) & normal, invert_y == (y_norm < 0)),
    covers=["B1-REF-02"], on=ON, from_tick=2, interpretations=["S59"],
)  # fmt: skip
PB1_40b = always(
    "PB1-40b", "A stick that is no longer pulled back means what it says.",
    that=implies(drives & (y_norm >= 0), ~invert_y),
    covers=["B1-REF-02"], on=ON, from_tick=2, interpretations=["S59"],
)  # fmt: skip
PB1_40c = always(
    "PB1-40c", "In backward mode a stick that has changed its meaning and is pulled back moves forward.",
    that=implies(
        during("Normale_marcia") & invert_y & previous(invert_y) & backward_enabled & OK, v_ref == -y_norm
    ),
    covers=["B1-REF-02"], on=ON, from_tick=2, interpretations=["S59"],
)  # fmt: skip

# --- dodging and avoiding ----------------------------------------------------------------------------

PB1_40d = always(
    "PB1-40d", "A manoeuvre begins only for a user who drives forward.",
    that=all_of(*(implies(active(state) & ~previous(active(state)), forward) for state in MANOEUVRES)),
    covers=["B1-ACT-01"], on=ON, from_tick=2, interpretations=["S60"],
)  # fmt: skip
PB1_40e = always(
    "PB1-40e", "A user who drives forward in normal running does the manoeuvre of its command at once.",
    that=all_of(*(
        implies(drives & running & previous(normal) & forward & (cmd == command), active(state))
        for state, command in MANOEUVRES.items()
    )),
    covers=["B1-ACT-01"], on=ON, from_tick=2, interpretations=["S60"],
)  # fmt: skip
PB1_40f = always(
    "PB1-40f", "A manoeuvre ends only by CMD_NORMAL or by the stop.",
    that=all_of(*(
        implies(previous(active(state)) & ~active(state), (cmd == "CMD_NORMAL") & normal | stopped)
        for state in MANOEUVRES
    )),
    covers=["B1-ACT-01"], on=ON, from_tick=2, interpretations=["S60"],
)  # fmt: skip


def _dodges(id: str, side: str, state: str, omega: Expr) -> Property:
    return always(
        f"PB1-40{id}", f"Dodging to the {side} the healthy rover moves at most at 0.8, turning at least 0.4.",
        that=implies(
            during(state) & (y_norm > 0) & OK, (v_ref == minimum(y_norm, 0.8)) & (omega_ref == omega)
        ),
        covers=["B1-ACT-01", "B1-REF-04"], on=ON, from_tick=2, interpretations=["S57", "S60"],
    )  # fmt: skip


PB1_40g = _dodges("g", "left", "Schivata_a_sinistra", maximum(x_norm, 0.4))
PB1_40h = _dodges("h", "right", "Schivata_a_destra", minimum(x_norm, -0.4))

half_y = choose("S57", {"SCALE": y_norm * 0.5, "CLIP": minimum(y_norm, 0.5)})
half_x = choose("S57", {"SCALE": x_norm * 0.5, "CLIP": maximum(minimum(x_norm, 0.5), -0.5)})
PB1_40i = always(
    "PB1-40i", "The degraded rover dodges at most at 0.4 and turns at least 0.2.",
    that=implies(
        DEGRADED & (y_norm > 0),
        all_of(
            implies(
                during("Schivata_a_sinistra"),
                (v_ref == minimum(half_y, 0.4)) & (omega_ref == maximum(half_x, 0.2)),
            ),
            implies(
                during("Schivata_a_destra"),
                (v_ref == minimum(half_y, 0.4)) & (omega_ref == minimum(half_x, -0.2)),
            ),
        ),
    ),
    covers=["B1-ACT-01", "B1-REF-05"], on=ON, from_tick=2, interpretations=["S57", "S60"],
)  # fmt: skip
PB1_40j = always(
    "PB1-40j", "In normal running the degraded rover turns at half of what the stick says.",
    that=implies(during("Normale_marcia") & DEGRADED, omega_ref == half_x),
    covers=["B1-REF-05"], on=ON, from_tick=2, interpretations=["S57", "S59"],
)  # fmt: skip

# --- the 180° rotation ---------------------------------------------------------------------------------

PB1_40k = always(
    "PB1-40k", "A rotation that was executed less than 7.5° from its target is over after the next step.",
    that=implies(
        drives & previous(drives & rotating & previous(rotating)) & (absolute(previous(angle_err)) < 7.5),
        ~rotating,
    ),
    covers=["B1-ACT-01"], on=ON, from_tick=3, interpretations=["S60"],
)  # fmt: skip
slowing = maximum(absolute(angle_err), 15) * const(Fraction("0.005"), "1/°")
PB1_40l = always(
    "PB1-40l", "At 45° and less the healthy rover turns at 0.005 per degree left, 15° at least; at 0° not.",
    that=implies(
        during("Retromarcia_180") & OK & (absolute(angle_err) <= 45),
        all_of(
            implies(angle_err < 0, omega_ref == slowing),
            implies(angle_err > 0, omega_ref == -slowing),
            implies(angle_err == 0, omega_ref == 0),
        ),
    ),
    covers=["B1-ACT-01", "B1-REF-04"], on=ON, from_tick=2, interpretations=["S60", "S64"],
)  # fmt: skip

PB1_40q = always(
    "PB1-40q", "Normal running does not go on with a stick pulled back beyond half, outside backward mode.",
    that=~(during("Normale_marcia") & (y_norm < -0.5) & ~backward_enabled),
    covers=["B1-ACT-01"], on=ON, from_tick=2, interpretations=["S59", "S60"],
)  # fmt: skip
REACH_NEAR = reachable(
    "REACH1-ROTATION-NEAR", "A rotation can come near its target.",
    that=during("Retromarcia_180") & (absolute(angle_err) < 7.5),
    covers=["B1-ACT-01"], on=ON, interpretations=["S60"],
)  # fmt: skip

# --- the stop -----------------------------------------------------------------------------------------

commanded = choose(
    "S63",
    {
        "ONLY-FORWARD": (cmd == "CMD_ESTOP") & previous(forward & ~is_rotating180),
        "UNCONDITIONAL": cmd == "CMD_ESTOP",
    },
)
PB1_40m = always(
    "PB1-40m",
    "A stop begins only by CMD_ESTOP to a rover that the user drove forward, not rotating, or by a critical "
    "safety state.",
    that=implies(previous(drives) & stopped & ~previous(stopped), commanded | CRITICAL),
    covers=["B1-EST-01"], on=ON, from_tick=3, interpretations=["S61", "S63"],
)  # fmt: skip
PB1_40n = always(
    "PB1-40n",
    "A rover at rest runs again in the next step in which Board 1 drives, nothing critical and no CMD_ESTOP.",
    that=implies(previous(at_rest) & drives & ~CRITICAL & (cmd != "CMD_ESTOP"), running & ~stopped),
    covers=["B1-EST-01", "B1-ACT-01"], on=ON, from_tick=2, interpretations=["S62"],
)  # fmt: skip
standing = stopped & (wheels_below_2_5 | ~drives)
"""In the stop with all wheels below 2.5 rpm, which only a step in which Board 1 drives looks at."""
PB1_40o = enters_only_if(
    "PB1-40o", "The first stop counts as done only after 51 steps of it with all wheels below 2.5 rpm.",
    entering=once(at_rest), only_if=previous(held(standing, for_=50 * ticks)),
    covers=["B1-EST-01"], on=ON, from_tick=2, interpretations=["S48", "S62"],
)  # fmt: skip
PB1_40p = enters_only_if(
    "PB1-40p", "A stop counts as done only after 50 steps of it with all wheels below 2.5 rpm.",
    entering=at_rest, only_if=previous(held(standing, for_=49 * ticks)),
    covers=["B1-EST-01"], on=ON, from_tick=2, interpretations=["S48", "S62"],
)  # fmt: skip
PB1_40r = holds_after(
    "PB1-40r", "Braking ends when the rover has stood for more than 1 s, Board 1 driving.",
    premise=drives & previous(drives & braking & wheels_below_2_5), for_=51 * ticks, then=~braking,
    covers=["B1-EST-01"], on=ON, from_tick=2, interpretations=["S62"],
)  # fmt: skip
