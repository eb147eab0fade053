"""What must be true of the wheel speeds that Board 2 commands [spec §3.1] (E25)."""

from rovercheck.properties.forms import always, holds_after, reachable
from rovercheck.spec_model.lang.expr import all_of, implies
from rovercheck.spec_model.lang.time import ticks
from rovercheck.spec_model.lang.words import absolute, named, once, previous
from rovercheck.spec_model.signals.board2_motion import (
    actuate_emergency_stop,
    omega_ref_actuation,
    v_ref_actuation,
)
from rovercheck.spec_model.signals.board2_supervisor import (
    autorized_to_send_command,
    driver_initialised,
    left_rpm,
    right_rpm,
    sends_speeds,
    stop_pin,
)

ON, ALONE = "actuation_2", "board2_on_its_own"
autorized = autorized_to_send_command
at_rest = named("wheel speeds of 0 commanded", (left_rpm == 0) & (right_rpm == 0))
LIMIT, RAMP = 80, 4
"""Half of the full scale of 160 rpm; rpm from one command to the next [design] (E25)."""
no_motion = named("zero references", (v_ref_actuation == 0) & (omega_ref_actuation == 0))

PB2_16m = always(
    "PB2-16m", "Board 2 sends motor commands only in steps in which it is authorised.",
    that=implies(sends_speeds, autorized), covers=["B2-ACT-01"], on=ON, interpretations=["E22"],
)  # fmt: skip
PB2_16n = always(
    "PB2-16n", "The commanded wheel speeds are at most 80 rpm in magnitude.",
    that=(absolute(left_rpm) <= LIMIT) & (absolute(right_rpm) <= LIMIT),
    covers=["B2-ACT-01", "B1-REF-05"], on=ON, interpretations=["E25"],
)  # fmt: skip
PB2_16o = always(
    "PB2-16o", "A commanded wheel speed changes by at most 4 rpm from one command to the next.",
    that=implies(
        autorized & previous(autorized),
        all_of(*(absolute(side - previous(side)) <= RAMP for side in (left_rpm, right_rpm))),
    ),
    covers=["B2-ACT-01"], on=ON,
)  # fmt: skip
PB2_16p = always(
    "PB2-16p", "The first step of an authorisation commands at most 4 rpm, the very first nothing.",
    that=implies(
        autorized & ~previous(autorized),
        (absolute(left_rpm) <= RAMP) & (absolute(right_rpm) <= RAMP)
        & (sends_speeds == previous(driver_initialised)),
    ),
    covers=["B2-ACT-01"], on=ON, from_tick=2,
)  # fmt: skip
PB2_18m = holds_after(
    "PB2-18m", "Twenty executions with zero references bring the commanded wheel speeds to 0.",
    premise=autorized & no_motion, for_=19 * ticks, then=at_rest,
    covers=["B2-REF-01", "B1-REF-06"], on=ON, from_tick=2,
)  # fmt: skip
PB2_16r = holds_after(
    "PB2-16r", "Half of full speed straight on, for 40 executions, commands 80 rpm on both sides.",
    premise=autorized & (v_ref_actuation == 0.5) & (omega_ref_actuation == 0), for_=39 * ticks,
    then=(left_rpm == LIMIT) & (right_rpm == LIMIT),
    covers=["B2-ACT-01", "B1-REF-05"], on=ON, from_tick=2,
)  # fmt: skip
PB2_16s = holds_after(
    "PB2-16s", "Half of full angular speed, for 40 executions, turns the sides against one another.",
    premise=autorized & (v_ref_actuation == 0) & (omega_ref_actuation == 0.5), for_=39 * ticks,
    then=(left_rpm == -LIMIT) & (right_rpm == LIMIT),
    covers=["B2-ACT-01", "B1-REF-05"], on=ON, from_tick=2,
)  # fmt: skip
PB2_16q = always(
    "PB2-16q", "In a step with motor commands the stop pin follows the emergency stop.",
    that=implies(sends_speeds, stop_pin == actuate_emergency_stop), covers=["B2-ACT-01"], on=ON,
)  # fmt: skip
PB2_16t = holds_after(
    "PB2-16t", "Half of full angular speed the other way, for 40 executions, turns the sides the other way.",
    premise=autorized & (v_ref_actuation == 0) & (omega_ref_actuation == -0.5), for_=39 * ticks,
    then=(left_rpm == LIMIT) & (right_rpm == -LIMIT),
    covers=["B2-ACT-01", "B1-REF-05"], on=ON, from_tick=2,
)  # fmt: skip
PB2_16u = always(
    "PB2-16u", "Until Board 2 sends speeds for the first time they are 0, and its stop pin is at stop level.",
    that=implies(~once(sends_speeds), at_rest & stop_pin), covers=["B2-ACT-01"], on=ON,
)  # fmt: skip
PB2_16v = always(
    "PB2-16v", "The first step in which Board 2 is authorised sends no wheel speeds.",
    that=implies(sends_speeds, previous(once(autorized))), covers=["B2-ACT-01"], on=ON,
)  # fmt: skip
PB2_16w = always(
    "PB2-16w", "Without authorisation the last commanded wheel speeds and the stop pin stay as they are.",
    that=implies(
        ~autorized,
        all_of(*(side == previous(side) for side in (left_rpm, right_rpm)), stop_pin == previous(stop_pin)),
    ),
    covers=["B2-ACT-01"], on=ON, from_tick=2, interpretations=["E22"],
)  # fmt: skip

REACH_B2_FULL_SPEED = reachable(
    "REACH-B2-FULL-SPEED", "Board 2 can command 80 rpm on both sides.",
    that=(left_rpm == LIMIT) & (right_rpm == LIMIT), covers=["B2-ACT-01"], on=ALONE,
)  # fmt: skip
REACH_B2_TURN = reachable(
    "REACH-B2-TURN", "Board 2 can turn the sides against one another.",
    that=(left_rpm == -LIMIT) & (right_rpm == LIMIT), covers=["B2-ACT-01"], on=ALONE,
)  # fmt: skip
REACH_B2_INITIALISES = reachable(
    "REACH-B2-INITIALISES", "The first authorised step sends no wheel speeds.",
    that=autorized & ~sends_speeds, covers=["B2-ACT-01"], on=ALONE,
)  # fmt: skip
