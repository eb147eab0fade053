"""Motion of both boards: an emergency stop measures from its first step whether the wheels are at rest."""

from collections.abc import Callable

from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Chart
from rovercheck.spec_model.lang.edit import entry
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.repairs import Repair
from rovercheck.spec_model.signals import board1, board2_motion


def _measured(stopped: Var, below: Var) -> Callable[[Chart], Chart]:
    return lambda chart: entry(
        chart, "In_frenata_di_emergenza", lambda drawn: (*drawn, assign(stopped, below))
    )


measured_anew = Repair(
    name="stop-measured-anew",
    text="In_frenata_di_emergenza writes roverIsStopped on entry too, where an earlier stop left its own.",
    fixes=("PB1-24b", "PB2-32f"),
    charts={
        "Motion_Supervision": _measured(board1.rover_is_stopped, board1.wheels_below_2_5),
        "Motion_Supervision_2": _measured(board2_motion.rover_is_stopped, board2_motion.wheels_below_2_5),
    },
)
