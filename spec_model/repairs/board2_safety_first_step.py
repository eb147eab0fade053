"""Safety state of Board 2: the first execution looks at the masks too."""

from rovercheck.spec_model.board2.safety import emergency
from rovercheck.spec_model.lang.chart import Chart, Junction, to
from rovercheck.spec_model.lang.edit import begin
from rovercheck.spec_model.repairs import Repair


def look_first(chart: Chart) -> Chart:
    """A default transition without a guard is degraded for one step, whatever Board 2 knows."""
    first = Junction("first", [to("Rover_Critical_State", when=emergency), to("Rover_Degraded_State")])
    return begin(chart, [to("first")], [first])


safety_first_step = Repair(
    name="board2-safety-first-step",
    text="The default transition of the safety state of Board 2 leads to a junction that tests for an "
    "emergency.",
    fixes=("PB2-17s",),
    charts={"Safety_state_2": look_first},
)
