"""Motion: an emergency stop measures from its first step whether the wheels are at rest."""

from spec_model.lang.action import assign
from spec_model.lang.edit import entry
from spec_model.repairs import Repair
from spec_model.signals.board1 import rover_is_stopped, wheels_below_2_5

measured_anew = Repair(
    name="stop-measured-anew",
    text="In_frenata_di_emergenza writes roverIsStopped on entry too, where an earlier stop left its own.",
    fixes=("PB1-24b",),
    charts={
        "Motion_Supervision": lambda chart: entry(
            chart,
            "In_frenata_di_emergenza",
            lambda drawn: (*drawn, assign(rover_is_stopped, wheels_below_2_5)),
        )
    },
)
