"""What must be true of running, rotation and stop of Board 2, state by state [spec §3.4.2, Fig 20]."""

from rovercheck.properties.areas.board2_motion import EXECUTED, at_rest, braking, drives, normal, rotating
from rovercheck.properties.forms import Property, always, enters_only_if, leaves_only_if, never
from rovercheck.spec_model.lang.expr import all_of, implies, ite
from rovercheck.spec_model.lang.time import ticks
from rovercheck.spec_model.lang.words import absolute, held, once, previous
from rovercheck.spec_model.signals.board2_motion import (
    actuate_emergency_stop,
    angle_err,
    ay_norm,
    backward_enabled,
    bx_norm,
    current_action,
    invert_y,
    is_rotating180,
    omega_ref_actuation,
    v_ref_actuation,
    wheels_below_2_5,
)
from rovercheck.spec_model.signals.board2_supervisor import rover_safety_state, rx_status

ON = "references_2"
critical = rover_safety_state == "SAFETY_CRITICAL"
as_pulled = ~invert_y & ~previous(invert_y)
in_normal = drives & normal & previous(normal)
back = (ay_norm < -0.5) & ~backward_enabled

PB2_30a = always(
    "PB2-30a", "The flag of the rotation is set in the rotation and nowhere else.",
    that=is_rotating180 == rotating, covers=["B2-REF-01"], on=ON, interpretations=["S60"],
)  # fmt: skip
PB2_30b = enters_only_if(
    "PB2-30b", "A rotation begins only for a stick pulled back beyond half, outside backward mode.",
    entering=rotating, only_if=back & drives,
    covers=["B2-REF-01"], on=ON, from_tick=2, interpretations=["S59", "S60"],
)  # fmt: skip
PB2_30c = always(
    "PB2-30c", "Normal running does not go on with a stick pulled back beyond half, outside backward mode.",
    that=~(in_normal & back), covers=["B2-REF-01"], on=ON, from_tick=2, interpretations=["S59", "S60"],
)  # fmt: skip
PB2_30d = leaves_only_if(
    "PB2-30d", "The rotation ends less than 7.5° from its target, or by a critical safety state.",
    leaving=rotating, only_if=(absolute(previous(angle_err)) < 7.5) | critical,
    covers=["B2-REF-01"], on=ON, from_tick=2, interpretations=["S60", "S61"],
)  # fmt: skip
PB2_30e = always(
    "PB2-30e", "A rotation that was executed less than 7.5° from its target is over after the next step.",
    that=implies(
        drives & previous(drives & rotating & previous(rotating)) & (absolute(previous(angle_err)) < 7.5),
        ~rotating,
    ),
    covers=["B2-REF-01"], on=ON, from_tick=3, interpretations=["S60"],
)  # fmt: skip
PB2_30f = enters_only_if(
    "PB2-30f", "The stick changes its meaning only where a rotation ends with the stick pulled back.",
    entering=invert_y, only_if=previous(rotating) & normal & (ay_norm < 0),
    covers=["B2-REF-01"], on=ON, from_tick=2, interpretations=["S59"],
)  # fmt: skip
PB2_30g = leaves_only_if(
    "PB2-30g", "It keeps that meaning until the stick is no longer pulled back or the rover must stop.",
    leaving=invert_y, only_if=(ay_norm >= 0) | braking | critical,
    covers=["B2-REF-01"], on=ON, from_tick=2, interpretations=["S59"],
)  # fmt: skip
PB2_30h = always(
    "PB2-30h", "Where a rotation ends in normal running with the stick pulled back, its meaning changes.",
    that=implies(drives & previous(rotating) & normal, invert_y == (ay_norm < 0)),
    covers=["B2-REF-01"], on=ON, from_tick=2, interpretations=["S59"],
)  # fmt: skip
PB2_31a = always(
    "PB2-31a", "In normal running Board 2 moves at half of what the stick says, back only in backward mode.",
    that=implies(
        in_normal & as_pulled, v_ref_actuation == ite(backward_enabled | (ay_norm > 0), ay_norm * 0.5, 0)
    ),
    covers=["B2-REF-01"], on=ON, from_tick=2, interpretations=["S59"],
)  # fmt: skip
PB2_31b = always(
    "PB2-31b", "In normal running Board 2 turns at half of what the stick says.",
    that=implies(in_normal, omega_ref_actuation == bx_norm * 0.5),
    covers=["B2-REF-01"], on=ON, from_tick=2, interpretations=["S59"],
)  # fmt: skip
PB2_31c = always(
    "PB2-31c", "Outside backward mode normal running never moves the rover with the stick pulled back.",
    that=implies(in_normal & (ay_norm < 0) & ~backward_enabled, v_ref_actuation == 0),
    covers=["B2-REF-01"], on=ON, from_tick=2, interpretations=["S59"],
)  # fmt: skip
PB2_32a = always(
    "PB2-32a", "From the second step in which Board 2 drives, its current action is that of its state.",
    that=implies(
        drives & previous(drives),
        all_of(
            implies(normal, current_action == "CMD_NORMAL"),
            implies(rotating, current_action == "CMD_ROTATE_180"),
            implies(braking, current_action == "CMD_ESTOP"),
            implies(at_rest, current_action == "CMD_STOP"),
        ),
    ),
    covers=["B2-REF-01"], on=ON, from_tick=2, interpretations=["S60"],
)  # fmt: skip
PB2_32b = always(
    "PB2-32b", "Board 2 actuates the emergency stop in the stop procedure and nowhere else.",
    that=implies(drives, actuate_emergency_stop == (braking | at_rest)),
    covers=["B2-REF-01"], on=ON, from_tick=2, interpretations=["S62"],
)  # fmt: skip
PB2_32c = always(
    "PB2-32c", "Before Board 2 drives for the first time it stands, without stop, rotation or changed stick.",
    that=implies(
        ~once(drives),
        all_of(
            (v_ref_actuation == 0) & (omega_ref_actuation == 0), current_action == "CMD_NORMAL",
            ~actuate_emergency_stop, ~is_rotating180, ~invert_y,
        ),
    ),
    covers=["B2-REF-01"], on=ON,
)  # fmt: skip
PB2_32d = always(
    "PB2-32d", "The stop procedure takes back what a pulled stick means.",
    that=implies(drives & (braking | at_rest), ~invert_y),
    covers=["B2-REF-01"], on=ON, from_tick=2, interpretations=["S59"],
)  # fmt: skip
PB2_32e = always(
    "PB2-32e", "A rover at rest runs again in the next step in which Board 2 drives and nothing is critical.",
    that=implies(previous(at_rest) & drives & ~critical, ~at_rest),
    covers=["B2-REF-01"], on=ON, from_tick=2, interpretations=["S62"],
)  # fmt: skip


def _rests(id: str, steps: int) -> Property:
    stood = previous(held(braking & wheels_below_2_5, for_=(steps - 1) * ticks))
    unheard = (rx_status == "RX_CRITICAL") & held(previous(braking), for_=99 * ticks)
    return enters_only_if(
        id,
        f"Board 2 counts a stop as done only after {steps} successive executed steps of it with all wheels "
        f"below 2.5 rpm, or after 2 s of it without reception.",
        entering=at_rest, only_if=stood | unheard,
        covers=["B2-REF-01"], on=EXECUTED, from_tick=2, interpretations=["S62"],
    )  # fmt: skip


PB2_32f, PB2_32h = _rests("PB2-32f", 51), _rests("PB2-32h", 50)
PB2_32g = never(
    "PB2-32g", "Braking ends when the rover has stood for more than 1 s.",
    that=braking & held(previous(braking) & previous(wheels_below_2_5), for_=53 * ticks),
    covers=["B2-REF-01"], on=EXECUTED, from_tick=2, interpretations=["S62"],
)  # fmt: skip
PB2_31d = always(
    "PB2-31d", "At 45° and less from its target the turning reference stays as it is.",
    that=implies(
        drives & rotating & previous(rotating) & (absolute(angle_err) <= 45),
        omega_ref_actuation == previous(omega_ref_actuation),
    ),
    covers=["B2-REF-01"], on=ON, from_tick=2, interpretations=["S60", "S64"],
)  # fmt: skip
PB2_31e = always(
    "PB2-31e", "In backward mode a stick that has changed its meaning and is pulled back moves forward.",
    that=implies(
        in_normal & invert_y & previous(invert_y) & backward_enabled, v_ref_actuation == ay_norm * -0.5
    ),
    covers=["B2-REF-01"], on=ON, from_tick=2, interpretations=["S59"],
)  # fmt: skip
