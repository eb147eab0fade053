"""Obstacles: the stop follows the distances of the step itself, not those of the step before."""

from spec_model.board2.obstacles import check_emergency_stop
from spec_model.lang.chart import Chart
from spec_model.lang.edit import guard, instead
from spec_model.repairs import Repair


def test_the_distances(chart: Chart) -> Chart:
    """The during action computes ``stop`` after the arrows were tested, one step too late for them."""
    for state in ("check_sonars_for_stopping", "check_sonars_for_moving_again"):
        chart = guard(chart, state, 1, instead("stop", lambda _: check_emergency_stop))
    return chart


same_step = Repair(
    name="obstacle-stop-same-step",
    text="The arrows of distance_70 test check_emergency_stop instead of the value stop of the step before.",
    fixes=("PB2-01", "PB2-02-scan-2", "PB2-04-same"),
    charts={"Obstacles": test_the_distances},
)
