"""What must be true of the motor driver behind the relay: when the motors move, and when they stop."""

from rovercheck.properties.forms import always, holds_after
from rovercheck.spec_model.composition.motors import (
    board1_powered,
    connected,
    followed,
    motors_zero,
    power_lost,
    runs_1,
    runs_2,
    started,
    stop_1,
    stop_2,
)
from rovercheck.spec_model.lang.expr import any_of, implies
from rovercheck.spec_model.lang.time import ticks
from rovercheck.spec_model.lang.words import held, named, once, previous
from rovercheck.spec_model.signals.board1 import actuate_emergency_stop, give_b2_actuation, omega_ref, v_ref
from rovercheck.spec_model.signals.board2_supervisor import left_rpm, right_rpm, sends_speeds, stop_pin

ON = "motors"
zero_1 = (v_ref == 0) & (omega_ref == 0)
zero_2 = (left_rpm == 0) & (right_rpm == 0)
stopped = named(
    "the stop pin of the connected board stops",
    ((connected == "Board1") & actuate_emergency_stop) | ((connected == "Board2") & stop_pin),
)
power_gone = once(power_lost)
drives_1 = board1_powered & ~give_b2_actuation

PSY_22a = holds_after(
    "PSY-22a", "Without a motor command for 300 ms the motors are at rest.",
    premise=followed == "nobody", for_=14 * ticks, then=motors_zero,
    covers=["B1-REL-05", "B2-ACT-01"], on=ON, interpretations=["E22"],
)  # fmt: skip
PSY_22b = always(
    "PSY-22b", "The stop pin of the connected board stops the motors in the same step.",
    that=implies(stopped, motors_zero), covers=["B1-REL-01", "B1-EST-01"], on=ON, interpretations=["S47"],
)  # fmt: skip
PSY_22c = always(
    "PSY-22c", "A command that is followed moves the motors if it is not zero and no stop pin stops them.",
    that=any_of(
        followed == "nobody",
        stopped,
        (followed == "Board1") & (motors_zero == zero_1),
        (followed == "Board2") & (motors_zero == zero_2),
    ),
    covers=["B1-REL-01", "B2-ACT-01"], on=ON, interpretations=["E22"],
)  # fmt: skip
PSY_22d = always(
    "PSY-22d", "Board 1 is followed exactly while it has power and keeps the relay closed.",
    that=(followed == "Board1") == drives_1,
    covers=["B1-REL-01", "B1-REL-03"], on=ON, interpretations=["E22", "S47"],
)  # fmt: skip
PSY_22e = always(
    "PSY-22e",
    "Board 2 is followed exactly while Board 1 does not drive, its supervisor executes and it sends speeds.",
    that=(followed == "Board2") == (~drives_1 & runs_2 & sends_speeds),
    covers=["B1-REL-01", "B2-ACT-01"], on=ON, interpretations=["E22", "S47"],
)  # fmt: skip
PSY_22f = always(
    "PSY-22f", "Motors that turn go on for less than 300 ms without a command while no stop pin stops them.",
    that=implies(
        previous(~motors_zero) & (followed == "nobody") & ~held(followed == "nobody", 14 * ticks) & ~stopped,
        ~motors_zero,
    ),
    covers=["B1-REL-05", "B2-ACT-01"], on=ON, from_tick=2, interpretations=["E22"],
)  # fmt: skip

# --- what fails, for good [design] ---------------------------------------------------------------------

PSY_27a = always(
    "PSY-27a", "Board 1 has power until it loses it, and never again.",
    that=board1_powered == ~power_gone, covers=["B1-REL-05"], on=ON, interpretations=["S47"],
)  # fmt: skip
PSY_27b = always(
    "PSY-27b", "The supervisor of Board 1 executes until it stops after its first step or the power is lost.",
    that=runs_1 == ~(power_gone | once(stop_1 & started)), covers=["B1-REL-05"], on=ON,
)  # fmt: skip
PSY_27c = always(
    "PSY-27c", "The supervisor of Board 2 executes until it stops.",
    that=runs_2 == ~once(stop_2), covers=["B2-ACT-01"], on=ON,
)  # fmt: skip
