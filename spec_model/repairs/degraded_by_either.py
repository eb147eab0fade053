"""Obstacles: a fault of Board 2 selects the degraded chart too, as one of Board 1 does."""

from rovercheck.spec_model.repairs import Repair

by_either = Repair(
    name="degraded-by-either",
    text="The flag that selects the degraded obstacle chart follows the masks of both boards (E09).",
    fixes=("P-STOP-DEGRADED-BY-2",),
    interpretations={"E09": "SEL-SAFETY"},
    gives_up=dict.fromkeys(
        ("PB2-51", "PB2-51-previous"),
        "It says that the flag follows the faults of Board 1, and who drives.",
    ),
)
