"""Temperature: readings that are absent for 0.5 s are a critical fault, the safer reading of Table 1."""

from rovercheck.spec_model.repairs import Repair

absent_stops = Repair(
    name="temperature-absent-stops",
    text="Half a second without a reading makes the temperature critical (S13).",
    fixes=("PB1-33b", "PB1-33c"),
    interpretations={"S13": "TABLE1-CRIT"},
    gives_up={"PB1-03": "It allows a critical temperature for the causes of Table 2 only, without absence."},
)
