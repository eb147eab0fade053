"""Temperature: readings that are absent for 0.5 s slow the rover, until their estimate stops it."""

from rovercheck.spec_model.repairs import Repair, safety_critical_first, temperature_absent_degrades

absent_slows = Repair(
    name="temperature-absent-slows",
    text="temperature-absent-degrades and safety-critical-first together (S13).",
    fixes=("P-WEATHER-TEMPERATURE",),
    charts=safety_critical_first.critical_first.charts,
    interpretations=temperature_absent_degrades.absent_degrades.interpretations,
    gives_up=safety_critical_first.critical_first.gives_up,
)
