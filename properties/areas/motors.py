"""What must be true of the motor driver behind the relay: when the motors move, and when they stop."""

from properties.forms import always, holds_after
from spec_model.composition.motors import connected, followed, motors_zero
from spec_model.lang.expr import any_of, implies
from spec_model.lang.time import ticks
from spec_model.lang.words import named
from spec_model.signals.board1 import actuate_emergency_stop, omega_ref, v_ref
from spec_model.signals.board2_supervisor import left_rpm, right_rpm, stop_pin

ON = "motors"
zero_1 = (v_ref == 0) & (omega_ref == 0)
zero_2 = (left_rpm == 0) & (right_rpm == 0)
stopped = named(
    "the stop pin of the connected board stops",
    ((connected == "Board1") & actuate_emergency_stop) | ((connected == "Board2") & stop_pin),
)

PSY_22a = holds_after(
    "PSY-22a", "Without a motor command for 300 ms the motors are at rest.",
    premise=followed == "nobody", for_=14 * ticks, then=motors_zero,
    covers=["B1-REL-05", "B2-ACT-01"], on=ON, readings=["E22"],
)  # fmt: skip
PSY_22b = always(
    "PSY-22b", "The stop pin of the connected board stops the motors in the same step.",
    that=implies(stopped, motors_zero), covers=["B1-REL-01", "B1-EST-01"], on=ON, readings=["S47"],
)  # fmt: skip
PSY_22c = always(
    "PSY-22c", "A command that is followed moves the motors if it is not zero and no stop pin stops them.",
    that=any_of(
        followed == "nobody",
        stopped,
        (followed == "Board1") & (motors_zero == zero_1),
        (followed == "Board2") & (motors_zero == zero_2),
    ),
    covers=["B1-REL-01", "B2-ACT-01"], on=ON, readings=["E22"],
)  # fmt: skip
