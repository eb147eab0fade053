"""Who moves the rover: the relay, the motor commands of both boards, and the motor driver.

The relay connects the motor line and the stop pin of one board to the driver [spec §2.5, Fig 17].  Its
coil holds Board 1 while that board has power and keeps ``give_b2_actuation`` false; without power the
line is on Board 2 (S47).  The driver keeps the last command, and stops the motors when none came for
300 ms.  Speeds are only told zero or not.  Under B2-ONLY both boards may command it in one step (E22).
"""

from rovercheck.spec_model.ambiguity import under
from rovercheck.spec_model.lang.action import assign, when
from rovercheck.spec_model.lang.chart import Block
from rovercheck.spec_model.lang.domain import boolean, enumeration, integer
from rovercheck.spec_model.lang.expr import flag, ite, member, var
from rovercheck.spec_model.lang.words import minimum, named
from rovercheck.spec_model.signals import board1 as b1
from rovercheck.spec_model.signals import board2_supervisor as b2

BOARD = enumeration("Board", ["nobody", "Board1", "Board2"])
TIME_OUT = 15
"""Ticks of 20 ms without a command after which the driver stops the motors: 300 ms."""

board1_powered = var("Board1.powered", boolean, True, "Board 1 has power")
connected = var("relay.connected", BOARD, "Board2", "the board whose motor line and stop pin are connected")
followed = var("motors.followed", BOARD, "nobody", "the board whose command the driver got in this step")
silence = var("motors.silence", integer(0, TIME_OUT), TIME_OUT, "ticks since the last motor command")
commanded_zero = var("motors.commanded_zero", boolean, True, "the last motor command was 0 on both sides")
motors_zero = var("motors.zero", boolean, True, "the driver outputs 0")

coil = named("coil energised", board1_powered & ~b1.give_b2_actuation)
zero_1 = (b1.v_ref == 0) & (b1.omega_ref == 0)
zero_2 = (b2.left_rpm == 0) & (b2.right_rpm == 0)

started = flag("rover.started", "the boards have executed before")
runs_1 = var("SUP1.runs", boolean, True, "the supervisor of Board 1 executes")
runs_2 = var("SUP2.runs", boolean, True, "the supervisor of Board 2 executes")
# Board 1 has a task that goes on sending, Board 2 sends in the activation of its supervisor.
sends_2 = named("Board 2 sends wheel speeds", runs_2 & b2.sends_speeds)

relay_and_driver = Block(
    "RelayAndDriver",
    [
        assign(connected, ite(coil, member(BOARD, "Board1"), member(BOARD, "Board2"))),
        assign(followed, "nobody"),
        when(coil, [assign(followed, "Board1"), assign(commanded_zero, zero_1)]),
        when(
            (~coil | under("E22", "B2-ONLY")) & sends_2,
            [assign(followed, "Board2"), assign(commanded_zero, zero_2)],
        ),
        assign(silence, ite(followed == "nobody", minimum(silence + 1, TIME_OUT), 0)),
        assign(
            motors_zero,
            commanded_zero
            | (silence == TIME_OUT)
            | ((connected == "Board1") & b1.actuate_emergency_stop)
            | ((connected == "Board2") & b2.stop_pin),
        ),
    ],
    text="The connected board's commands move the motors; after 300 ms without one they stop.",
)

power_lost = flag("Board1.power_lost", "Board 1 loses its power in this step, for good")
stop_1 = flag("SUP1.stops", "from this step on the supervisor of Board 1 executes no more")
stop_2 = flag("SUP2.stops", "from this step on the supervisor of Board 2 executes no more")

faults = Block(
    "Faults",
    [
        when(power_lost, [assign(board1_powered, False), assign(runs_1, False)]),
        # Before its first step Board 1 would keep the relay open (S47), which give_b2_actuation does not say.
        when(stop_1 & started, [assign(runs_1, False)]),
        when(stop_2, [assign(runs_2, False)]),
    ],
    text="A supervisor stops, that of Board 1 after its first step, or Board 1 loses its power; for good.",
)
