"""Obstacles, degraded: the first execution of the chart looks at the distances too."""

from rovercheck.spec_model.board2.obstacles_degraded import check300
from rovercheck.spec_model.lang.chart import Chart, Junction, to
from rovercheck.spec_model.lang.edit import begin
from rovercheck.spec_model.repairs import Repair


def look_first(chart: Chart) -> Chart:
    """A default transition without a guard lets the rover go on for one step, whatever is before it."""
    first = Junction(
        "first",
        [to("check_sonars_for_moving_again", when=check300), to("check_sonars_for_stopping")],
    )
    return begin(chart, [to("first")], [first])


first_step = Repair(
    name="degraded-first-step",
    text="The default transition of the degraded obstacle chart leads to a junction that tests the "
    "distances.",
    fixes=("PB2-12-first",),
    charts={"ObstaclesDegraded": look_first},
)
