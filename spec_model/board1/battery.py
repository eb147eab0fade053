"""Battery monitor of Board 1: is there charge left, and is anybody still measuring [spec §2.4, Table 2].

The document writes "temperature" in the critical row and "voltage" in Table 1; both mean the battery
percentage (S15, S25).  Between 23 % and 25 % no row is true and the state is kept (S17).
"""

from fractions import Fraction

from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Chart, Junction, State, to
from rovercheck.spec_model.lang.expr import const
from rovercheck.spec_model.lang.time import sec
from rovercheck.spec_model.lang.words import held, named
from rovercheck.spec_model.signals.board1 import (
    batt_age,
    batt_status,
    battery_pct,
)

b = battery_pct
absent = batt_age >= 500


critical_range = named("b in [0;15]", (b >= 0) & (b <= 15))

FALL = const(Fraction("0.42") / 1000, "%/ms")
"""The assumed fall without readings, 0.42 %/s."""

assumed_b = named("assumed_b", b - batt_age * FALL)
stale_below_15 = named("stale_below_15", absent & (assumed_b < 15))

monitor_battery = Chart(
    "Monitor_battery",
    [
        State(
            "Batt_OK",
            entry=[assign(batt_status, "BATT_HEALTH_OK")],
            transitions=[to("decide")],
        ),
        State(
            "Batt_DEG",
            entry=[assign(batt_status, "BATT_HEALTH_DEGRADED")],
            transitions=[to("decide")],
        ),
        State(
            "Batt_CRIT",
            entry=[assign(batt_status, "BATT_HEALTH_CRITICAL")],
            transitions=[to("decide")],
        ),
    ],
    default=[to("decide"), to("Batt_OK")],
    junctions=[
        Junction(
            "decide",
            [
                to("Batt_CRIT", when=held(critical_range, for_=5 * sec) | stale_below_15),
                to("Batt_DEG", when=b < 23),  # at once, also in [0;15] for less than 5 s
                to("Batt_OK", when=b > 25),
            ],
        )
    ],
    text="Battery status from the last valid percentage and its age.",
)
