"""What must be true of the temperature status of Board 1 [spec Table 2]."""

from rovercheck.properties.document.temperature import (
    absent,
    critical_range,
    degraded_range,
    fresh,
    ok_range,
    stale_above_65,
)
from rovercheck.properties.forms import always, holds_after, reachable, until
from rovercheck.properties.past import STEPPED
from rovercheck.spec_model.board1.temperature import monitor_temperature
from rovercheck.spec_model.lang.expr import implies
from rovercheck.spec_model.lang.time import sec
from rovercheck.spec_model.lang.words import held
from rovercheck.spec_model.signals.board1 import temp_status, temp_update

ON = "temperature"
OK = temp_status == "TEMP_HEALTH_OK"
DEGRADED = temp_status == "TEMP_HEALTH_DEGRADED"
CRITICAL = temp_status == "TEMP_HEALTH_CRITICAL"

PB1_01a = always(
    "PB1-01a", "A fresh temperature in ]-5;55[ is reported OK in the same step.",
    that=implies(fresh & ok_range, OK),
    covers=["B1-TEMP-01"], on=ON, from_tick=2, interpretations=["S01", "S05", "S65"],
)  # fmt: skip
PB1_01b = always(
    "PB1-01b", "A fresh temperature in ]-15;-5] or [55;60[ is reported degraded in the same step.",
    that=implies(fresh & degraded_range, DEGRADED),
    covers=["B1-TEMP-02"], on=ON, from_tick=2, interpretations=["S01", "S05", "S65"],
)  # fmt: skip
PB1_01c = always(
    "PB1-01c", "In the very first step, too, a reading is classified: OK in ]-5;55[, degraded in ]-15;-5] or "
    "[55;60[.",
    that=implies(~STEPPED & fresh, implies(ok_range, OK) & implies(degraded_range, DEGRADED)),
    covers=["B1-TEMP-01", "B1-TEMP-02"], on=ON, interpretations=["S01", "S65"],
)  # fmt: skip
PB1_02a = holds_after(
    "PB1-02a", "When the temperature has been in the critical range for 4 s, it is reported critical.",
    premise=critical_range, for_=4 * sec, then=CRITICAL,
    covers=["B1-TEMP-03"], on=ON, interpretations=["S02", "S03", "S04"],
)  # fmt: skip
PB1_02b = until(
    "PB1-02b", "Once reported critical after 4 s in the critical range, it stays critical while it is there.",
    start=held(critical_range, for_=4 * sec), holds=CRITICAL, release=~critical_range,
    covers=["B1-TEMP-03"], on=ON, from_tick=2, interpretations=["S02", "S03", "S05"],
)  # fmt: skip
PB1_03 = always(
    "PB1-03",
    "The temperature is critical only after 4 s in the critical range or on a stale estimate above 65.",
    that=implies(CRITICAL, held(critical_range, for_=4 * sec) | stale_above_65),
    covers=["B1-TEMP-03", "B1-TEMP-04", "B1-TEMP-05"], on=ON, from_tick=2,
    interpretations=["S01", "S06", "S09"],
)  # fmt: skip
PB1_04a = until(
    "PB1-04a", "A temperature critical by its estimate stays critical until a new valid reading arrives.",
    start=CRITICAL & stale_above_65, holds=CRITICAL, release=temp_update,
    covers=["B1-TEMP-05"], on=ON, from_tick=2, interpretations=["S10"],
)  # fmt: skip
PB1_04b = always(
    "PB1-04b", "An estimate above 65 after 0.5 s without a reading is reported critical in the same step.",
    that=implies(stale_above_65, CRITICAL),
    covers=["B1-TEMP-04", "B1-TEMP-05"], on=ON, from_tick=2, interpretations=["S07", "S08", "S10", "S14"],
)  # fmt: skip
PB1_33a = always(
    "PB1-33a",
    "A temperature out of ]-5;55[ is reported degraded or critical (so bit 0 of a mask is set: PB1-10).",
    that=implies(~ok_range, ~OK),
    covers=["B1-TEMP-06"], on=ON, from_tick=2, interpretations=["S01"],
)  # fmt: skip
PB1_33b = always(
    "PB1-33b", "A temperature without a reading for 0.5 s is reported degraded or critical.",
    that=implies(absent, ~OK),
    covers=["B1-TEMP-06"], on=ON, from_tick=2, interpretations=["S13"],
)  # fmt: skip
PB1_33c = always(
    "PB1-33c", "A temperature without a reading for 0.5 s is reported critical.",
    that=implies(absent, CRITICAL),
    covers=["B1-TEMP-06"], on=ON, from_tick=2, interpretations=["S13"],
)  # fmt: skip
PB1_33d = always(
    "PB1-33d", "A temperature without a reading for 0.5 s is reported degraded.",
    that=implies(absent, DEGRADED),
    covers=["B1-TEMP-06"], on=ON, from_tick=2, interpretations=["S13"],
)  # fmt: skip
PB1_33e = always(
    "PB1-33e", "A temperature without a reading for 0.5 s and assumed above 65 is degraded or critical.",
    that=implies(stale_above_65, ~OK),
    covers=["B1-TEMP-06"], on=ON, from_tick=2, interpretations=["S13"],
)  # fmt: skip

REACH_TEMP_DEG = reachable(
    "REACH-TEMP-DEG", "The temperature can be reported degraded.",
    that=monitor_temperature.active("Temp_DEG") & DEGRADED, covers=["B1-TEMP-02"], on=ON,
)  # fmt: skip
REACH_TEMP_CRIT_RANGE = reachable(
    "REACH-TEMP-CRIT-RANGE", "The temperature can become critical by its range, with fresh readings.",
    that=monitor_temperature.active("Temp_CRIT") & fresh, covers=["B1-TEMP-03"], on=ON,
)  # fmt: skip
REACH_TEMP_CRIT_STALE = reachable(
    "REACH-TEMP-CRIT-STALE", "A last reading in the OK range can become critical by its age alone.",
    that=monitor_temperature.active("Temp_CRIT") & ok_range, covers=["B1-TEMP-05"], on=ON,
)  # fmt: skip
