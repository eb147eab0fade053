"""Safety state: a critical cause is tested before the absence of a degraded one."""

from spec_model.lang.edit import swap
from spec_model.repairs import Repair

critical_first = Repair(
    name="safety-critical-first",
    text="Rover_Degraded_State tests its arrow to Rover_Critical_State first.",
    fixes=("PB1-16a", "PB1-16b", "PB1-16d", "PB1-16e", "PB1-17a"),
    charts={"Safety_state": lambda chart: swap(chart, "Rover_Degraded_State", 1, 2)},
)
