"""Battery: readings that are absent for 0.5 s slow the rover, until their estimate stops it."""

from rovercheck.spec_model.repairs import Repair, battery_absent_degrades, safety_critical_first

absent_slows = Repair(
    name="battery-absent-slows",
    text="battery-absent-degrades and safety-critical-first together (S26).",
    fixes=("P-WEATHER-BATTERY",),
    charts=safety_critical_first.critical_first.charts,
    interpretations=battery_absent_degrades.absent_degrades.interpretations,
    gives_up=safety_critical_first.critical_first.gives_up,
)
