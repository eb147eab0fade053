"""Safety state: a critical cause is tested before the absence of a degraded one, in the first step too."""

from rovercheck.spec_model.board1.safety import critical, degraded
from rovercheck.spec_model.lang.chart import Chart, Junction, to
from rovercheck.spec_model.lang.edit import begin, swap
from rovercheck.spec_model.repairs import Repair


def critical_cause_first(chart: Chart) -> Chart:
    """A default transition that tests nothing would let a critical cause pass for one step, as does
    transition 1.
    """
    first = Junction(
        "first",
        [
            to("Rover_Critical_State", when=critical),
            to("Rover_Degraded_State", when=degraded),
            to("Rover_Safe_State"),
        ],
    )
    return begin(swap(chart, "Rover_Degraded_State", 1, 2), [to("first")], [first])


critical_first = Repair(
    name="safety-critical-first",
    text=(
        "Rover_Degraded_State tests its transition to Rover_Critical_State first, and the default transition "
        "leads to the state that the causes ask for."
    ),
    fixes=("PB1-16a", "PB1-16b", "PB1-16d", "PB1-16e", "PB1-17a"),
    charts={"Safety_state": critical_cause_first},
    gives_up={
        "PSY-10m": "After a critical first step v_user is 0: a CMD_ESTOP in the second is met in the third."
    },
)
