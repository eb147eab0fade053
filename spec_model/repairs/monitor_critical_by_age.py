"""Monitors of Board 2: a source is critical in every step in which it is silent."""

from collections.abc import Callable, Sequence
from functools import partial

from rovercheck.spec_model.board2.monitor_systems import twin
from rovercheck.spec_model.lang.chart import Chart
from rovercheck.spec_model.lang.edit import guard, swap
from rovercheck.spec_model.lang.expr import all_of
from rovercheck.spec_model.repairs import Repair
from rovercheck.spec_model.signals.board2_supervisor import SOURCES, SourceSignals


def looking_at_the_age(sources: Sequence[SourceSignals]) -> Callable[[Chart], Chart]:
    """The edit of a chart with a region for some of the sources."""

    def change(chart: Chart) -> Chart:
        for source in sources:
            if (source.region,) in chart.states:
                chart = _one_region(chart, source)
        return chart

    return change


def _one_region(chart: Chart, source: SourceSignals) -> Chart:
    """The mean of the gaps stays short while no stamp comes, so that CRIT ends in the midst of a silence."""
    for level in ("OK", "DEG"):
        chart = swap(chart, f"{source.region}.{level}", 1, 2)
    silent = next(
        transition.guard
        for transition in chart.states[source.region, "OK"].transitions
        if transition.target == "CRIT"
    )
    assert silent is not None
    return guard(chart, f"{source.region}.CRIT", 1, partial(all_of, ~silent))


by_age = Repair(
    name="monitor-critical-by-age",
    text=(
        "In a monitor of Board 2, OK and DEG test their transition to CRIT first, and the transition that "
        "leaves CRIT asks in addition that the source is not silent."
    ),
    fixes=(
        "PB2-14c",
        "PB2-20a",
        "PB2-20b",
        "PB2-20c",
        "PB2-20d",
        "PSY-07b",
        "P-WEATHER-LINK12",
        "P-WEATHER-LINK12-2",
        "P-WEATHER-JOYSTICK-LINK21",
        "P-WEATHER-IMU-LINK21",
        "P-WEATHER-JOYSTICK-2",
        "P-WEATHER-IMU-2",
    ),
    charts={
        "Monitors_2": looking_at_the_age(SOURCES),
        "Twin_monitors_2": looking_at_the_age([twin(source) for source in SOURCES]),
    },
)
