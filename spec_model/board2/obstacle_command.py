"""The obstacle command of Board 2 while it is authorised: go on, or stop for anything within 3 m.

The second instance of the degraded obstacle chart, frozen while Board 2 is not authorised.  In the
first authorised step after power-up it lets the rover move whatever the distances (G2).
"""

from rovercheck.spec_model.board2.obstacles_degraded import obstacles_degraded
from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Block
from rovercheck.spec_model.lang.expr import ite, member
from rovercheck.spec_model.signals.board2 import number
from rovercheck.spec_model.signals.board2_supervisor import B2DecDriving, cmd
from rovercheck.spec_model.signals.common import COMMAND

obstacles_driving = obstacles_degraded("ObstaclesDriving", B2DecDriving)

obstacle_command = Block(
    "Obstacle_command",
    [
        assign(
            cmd, ite(B2DecDriving == number(6), member(COMMAND, "CMD_ESTOP"), member(COMMAND, "CMD_NORMAL"))
        )
    ],
    text="Decision 5 or 6 as a command of the motion charts.",
)
