"""Board 2 drives: an obstacle within 3 m stops the rover in the same step, whatever it does."""

from rovercheck.spec_model.repairs import Repair
from rovercheck.spec_model.repairs.degraded_first_step import look_first
from rovercheck.spec_model.repairs.stop_unconditional import stop_while_commanded
from rovercheck.spec_model.signals.board2_supervisor import cmd, rover_safety_state

board2_unconditional = Repair(
    name="board2-stop-unconditional",
    text=(
        "As stop-unconditional, in the motion chart of Board 2; and the obstacle chart that commands it "
        "looks at the distances in its first execution too."
    ),
    fixes=(
        "PB2-13a-0",
        "PB2-13a-1",
        "PB2-13a-2",
        "PB2-13b-0",
        "PB2-13b-1",
        "PB2-13b-2",
        "PB2-13c-0",
        "PB2-13c-2",
        "PB2-13c-3",
        "PB2-13s",
    ),
    charts={
        "ObstaclesDriving": look_first,
        "Motion_Supervision_2": stop_while_commanded(cmd, rover_safety_state),
    },
    gives_up={
        "REACH2-ESTOP-IGNORED": "It shows that a rotation goes on under CMD_ESTOP, which the repair ends.",
        "PB2-30d": "A rotation now ends by CMD_ESTOP too, far from its target.",
        "PB2-32e": "A rover at rest now waits while CMD_ESTOP lasts.",
        "PB2-33c": "A stop now begins by CMD_ESTOP whatever the user does.",
        "PB2-56-first": "The obstacle chart now looks at the distances in its first execution.",
    },
)
