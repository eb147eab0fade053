"""Obstacles: a turn to the wrong side does not end a deviation."""

from rovercheck.spec_model.lang.chart import Chart
from rovercheck.spec_model.lang.edit import in_expressions, instead
from rovercheck.spec_model.lang.expr import Expr
from rovercheck.spec_model.lang.walk import variables
from rovercheck.spec_model.lang.words import absolute, named, wrap
from rovercheck.spec_model.repairs import Repair

TEST = "gyroTargetDiff(yaw, targetAngle)"


def not_beyond_135(test: Expr) -> Expr:
    """More than 135 degrees from the target means a turn of more than 135 degrees to the other side.

    A chart with the heading left free keeps its test: some yaw still makes it true, some false.
    """
    data = variables(test)
    if "targetAngle" not in data:
        return test
    rest = named("wrap(targetAngle - yaw)", wrap(data["targetAngle"] - data["yaw"]))
    return test & (absolute(rest) < 135)


def on_its_side(chart: Chart) -> Chart:
    return in_expressions(chart, instead(TEST, not_beyond_135))


its_side = Repair(
    name="turn-on-its-side",
    text="gyroTargetDiff is true only while the heading is less than 135 degrees from its target (E06).",
    fixes=("PB2-08-left", "PB2-08-right"),
    charts={"Obstacles": on_its_side},
)
