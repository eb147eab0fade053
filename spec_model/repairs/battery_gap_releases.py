"""Battery: a critical battery that is measured between 23 % and 25 % becomes degraded."""

from rovercheck.spec_model.lang.chart import to
from rovercheck.spec_model.lang.edit import also
from rovercheck.spec_model.repairs import Repair

gap_releases = Repair(
    name="battery-gap-releases",
    text="Where no row of Table 2 is true, Batt_CRIT is left for Batt_DEG instead of being kept (S17).",
    fixes=("PB1-29",),
    charts={"Monitor_battery": lambda chart: also(chart, "Batt_CRIT", to("Batt_DEG"))},
)
