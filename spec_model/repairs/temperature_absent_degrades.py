"""Temperature: readings that are absent for 0.5 s degrade, so that bit 0 of a mask is set (Table 1)."""

from rovercheck.spec_model.repairs import Repair

absent_degrades = Repair(
    name="temperature-absent-degrades",
    text="Half a second without a reading makes the temperature at least degraded (S13).",
    fixes=("PB1-33b",),
    interpretations={"S13": "TABLE1-DEG"},
)
