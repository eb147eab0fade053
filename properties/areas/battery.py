"""What must be true of the battery status of Board 1 [spec Table 2]."""

from rovercheck.properties.document.battery import absent, critical_range, fresh, stale_below_15
from rovercheck.properties.forms import always, holds_after, reachable, until
from rovercheck.properties.past import STEPPED
from rovercheck.spec_model.board1.battery import monitor_battery
from rovercheck.spec_model.lang.expr import implies, ite
from rovercheck.spec_model.lang.time import sec
from rovercheck.spec_model.lang.words import held, previous
from rovercheck.spec_model.signals.board1 import batt_status, batt_update
from rovercheck.spec_model.signals.board1 import battery_pct as b

ON = "battery"
OK = batt_status == "BATT_HEALTH_OK"
DEGRADED = batt_status == "BATT_HEALTH_DEGRADED"
CRITICAL = batt_status == "BATT_HEALTH_CRITICAL"

PB1_04c = until(
    "PB1-04c", "A battery critical by its estimate stays critical until a new valid reading arrives.",
    start=CRITICAL & stale_below_15, holds=CRITICAL, release=batt_update,
    covers=["B1-BATT-05"], on=ON, from_tick=2, interpretations=["S24"],
)  # fmt: skip
PB1_04d = always(
    "PB1-04d", "An estimate below 15 % after 0.5 s without a reading is reported critical in the same step.",
    that=implies(stale_below_15, CRITICAL),
    covers=["B1-BATT-04", "B1-BATT-05"], on=ON, from_tick=2, interpretations=["S19", "S24"],
)  # fmt: skip
PB1_05a = always(
    "PB1-05a", "With fresh data the battery goes from OK to degraded only below 23 %.",
    that=implies(fresh & previous(OK) & DEGRADED, b < 23),
    covers=["B1-BATT-01", "B1-BATT-02"], on=ON, from_tick=2, interpretations=["S17", "S18"],
)  # fmt: skip
PB1_05b = always(
    "PB1-05b", "With fresh data the battery goes from degraded to OK only above 25 %.",
    that=implies(fresh & previous(DEGRADED) & OK, b > 25),
    covers=["B1-BATT-01", "B1-BATT-02"], on=ON, from_tick=2, interpretations=["S17", "S18"],
)  # fmt: skip
PB1_05c = always(
    "PB1-05c", "With fresh data below 23 % the battery is not OK.",
    that=implies(fresh & (b < 23), ~OK),
    covers=["B1-BATT-02"], on=ON, from_tick=2, interpretations=["S17", "S18"],
)  # fmt: skip
PB1_05d = always(
    "PB1-05d", "With fresh data above 25 % the battery is OK in the same step.",
    that=implies(fresh & (b > 25), OK),
    covers=["B1-BATT-01"], on=ON, from_tick=2, interpretations=["S17", "S22"],
)  # fmt: skip
PB1_28a = holds_after(
    "PB1-28a", "When the battery has been in [0;15] for 5 s, it is reported critical.",
    premise=critical_range, for_=5 * sec, then=CRITICAL,
    covers=["B1-BATT-03"], on=ON, interpretations=["S15", "S16", "S20", "S21"],
)  # fmt: skip
PB1_28b = until(
    "PB1-28b", "Once reported critical after 5 s in [0;15], it stays critical while it is there.",
    start=held(critical_range, for_=5 * sec), holds=CRITICAL, release=~critical_range,
    covers=["B1-BATT-03"], on=ON, from_tick=2, interpretations=["S15", "S16", "S22"],
)  # fmt: skip
PB1_29 = always(
    "PB1-29", "The battery is critical only after 5 s in [0;15] or on a stale estimate below 15 %.",
    that=implies(CRITICAL, held(critical_range, for_=5 * sec) | stale_below_15),
    covers=["B1-BATT-03", "B1-BATT-04", "B1-BATT-05"], on=ON, from_tick=2,
    interpretations=["S16", "S19", "S22", "S24"],
)  # fmt: skip
PB1_33k = always(
    "PB1-33k", "The rows of the battery, the first that is true: critical after 5 s in [0;15] or by an "
    "estimate below 15 %; below 23 % degraded; above 25 % OK. Between them the status stays, OK at first.",
    that=ite(
        held(critical_range, for_=5 * sec) | stale_below_15, CRITICAL,
        ite(b < 23, DEGRADED, ite(b > 25, OK, ite(
            STEPPED, (CRITICAL == previous(CRITICAL)) & (DEGRADED == previous(DEGRADED)), OK
        ))),
    ),
    covers=["B1-BATT-01", "B1-BATT-02", "B1-BATT-03", "B1-BATT-04", "B1-BATT-05"], on=ON,
    interpretations=["S15", "S16", "S17", "S18", "S19", "S20", "S21", "S22", "S23", "S24", "S26", "S65"],
)  # fmt: skip
PB1_33f = always(
    "PB1-33f", "A battery below 23 % is reported degraded or critical (so bit 1 of a mask is set: PB1-10).",
    that=implies(b < 23, ~OK),
    covers=["B1-BATT-06"], on=ON, from_tick=2, interpretations=["S25"],
)  # fmt: skip
PB1_33g = always(
    "PB1-33g", "A battery without a reading for 0.5 s is reported degraded or critical.",
    that=implies(absent, ~OK),
    covers=["B1-BATT-06"], on=ON, from_tick=2, interpretations=["S26"],
)  # fmt: skip
PB1_33h = always(
    "PB1-33h", "A battery without a reading for 0.5 s is reported critical.",
    that=implies(absent, CRITICAL),
    covers=["B1-BATT-06"], on=ON, from_tick=2, interpretations=["S26"],
)  # fmt: skip
PB1_33i = always(
    "PB1-33i", "A battery without a reading for 0.5 s is reported degraded.",
    that=implies(absent, DEGRADED),
    covers=["B1-BATT-06"], on=ON, from_tick=2, interpretations=["S26"],
)  # fmt: skip
PB1_33j = always(
    "PB1-33j", "A battery without a reading for 0.5 s and assumed below 15 % is degraded or critical.",
    that=implies(stale_below_15, ~OK),
    covers=["B1-BATT-06"], on=ON, from_tick=2, interpretations=["S26"],
)  # fmt: skip

REACH_BATT_DEG = reachable(
    "REACH-BATT-DEG", "The battery can be reported degraded.",
    that=monitor_battery.active("Batt_DEG") & DEGRADED, covers=["B1-BATT-02"], on=ON,
)  # fmt: skip
REACH_BATT_CRIT_RANGE = reachable(
    "REACH-BATT-CRIT-RANGE", "The battery can become critical by its range, with fresh readings.",
    that=monitor_battery.active("Batt_CRIT") & fresh & critical_range, covers=["B1-BATT-03"], on=ON,
)  # fmt: skip
REACH_BATT_CRIT_STALE = reachable(
    "REACH-BATT-CRIT-STALE", "A last reading of 80 % can become critical by its age alone.",
    that=monitor_battery.active("Batt_CRIT") & (b == 80), covers=["B1-BATT-05"], on=ON,
)  # fmt: skip
REACH_BATT_HYSTERESIS = reachable(
    "REACH-BATT-HYSTERESIS", "At 24 % the battery can be degraded, kept from below.",
    that=monitor_battery.active("Batt_DEG") & (b == 24) & previous(b == 24), covers=["B1-BATT-01"], on=ON,
    interpretations=["S17"],
)  # fmt: skip
