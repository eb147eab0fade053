"""Motor commands of Board 2: wheel speeds of the two sides from the references, limited and ramped.

Executed in authorised steps.  The first one after power-up only initialises the motor driver; a new
authorisation starts the ramp from 0 again.
"""

from rovercheck.spec_model.lang.action import assign, when
from rovercheck.spec_model.lang.chart import Block
from rovercheck.spec_model.lang.expr import TRUE, Expr, Var, const
from rovercheck.spec_model.lang.words import maximum, minimum
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
    was_autorized,
)

FULL_SCALE, LIMIT, RAMP = 160, 80, 4
"""rpm of a reference of 1; largest magnitude in rpm; largest change in rpm per execution."""


def _toward(last: Var, reference: Expr) -> Expr:
    wanted = maximum(minimum(reference * const(FULL_SCALE, "rpm"), LIMIT), -LIMIT)
    return maximum(minimum(wanted, last + RAMP), last - RAMP)


_drive = [
    assign(left_rpm, _toward(left_rpm, v_ref_actuation - omega_ref_actuation)),
    assign(right_rpm, _toward(right_rpm, v_ref_actuation + omega_ref_actuation)),
    assign(stop_pin, actuate_emergency_stop),
]

actuation = Block("Actuation", [
    when(autorized_to_send_command & ~was_autorized, [assign(left_rpm, 0), assign(right_rpm, 0)]),
    assign(sends_speeds, autorized_to_send_command & driver_initialised),
    when(sends_speeds, _drive),
    when(autorized_to_send_command, [assign(driver_initialised, TRUE)]),
    assign(was_autorized, autorized_to_send_command),
], text="Wheel speeds of the two sides and the stop pin, in authorised steps.")  # fmt: skip
