"""Obstacles: a deviation of a rover that does not turn ends after 10 s."""

from rovercheck.spec_model.repairs import Repair

bounded = Repair(
    name="deviation-bounded",
    text="MoveToS1 and MoveToS3 are left after 10 s, turned or not (E08).",
    fixes=("PB2-09b",),
    interpretations={"E08": "BOUNDED"},
)
