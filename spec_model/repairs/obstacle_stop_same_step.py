"""Obstacles: the stop follows the distances of the step itself, not only those of the step before."""

from rovercheck.spec_model.board2.obstacles import check_emergency_stop
from rovercheck.spec_model.lang.change import formula_of
from rovercheck.spec_model.lang.chart import Chart
from rovercheck.spec_model.lang.edit import guard
from rovercheck.spec_model.repairs import Repair


def look_before_testing(chart: Chart) -> Chart:
    """The during action computes ``stop`` after the transitions were tested, one step too late for them."""
    near = formula_of(chart, check_emergency_stop.name)
    chart = guard(chart, "check_sonars_for_stopping", 1, lambda g: g | near)
    return guard(chart, "check_sonars_for_moving_again", 1, lambda g: g & ~near)


same_step = Repair(
    name="obstacle-stop-same-step",
    text="Both transitions of distance_70 test check_emergency_stop too, beside the stop of the step before.",
    fixes=("PB2-01", "PB2-02-scan-2", "PB2-04-same"),
    charts={"Obstacles": look_before_testing},
)
