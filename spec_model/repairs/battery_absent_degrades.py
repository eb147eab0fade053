"""Battery: readings that are absent for 0.5 s degrade, so that bit 1 of a mask is set (Table 1)."""

from rovercheck.spec_model.repairs import Repair

absent_degrades = Repair(
    name="battery-absent-degrades",
    text="Half a second without a reading makes the battery at least degraded (S26).",
    fixes=("PB1-33g",),
    interpretations={"S26": "TABLE1"},
)
