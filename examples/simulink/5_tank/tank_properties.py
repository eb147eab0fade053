"""What the valve of a tank must keep, in the names of tank.slx."""

from rovercheck import always, implies, previous, reachable, simulink_model

tank = simulink_model("tank.slx")
status, opened, hold = tank["status"], tank["open"], tank["hold"]

REQUIREMENTS = {"R-1": "The valve stays as it is while it is held.", "R-2": "A lost sensor is seen."}
PROPERTIES = [
    always(
        "TANK-1", "While the valve is held it stays as it is.",
        that=implies(hold, opened == previous(opened)), covers=["R-1"], on=tank.system,
    ),
    reachable(
        "TANK-2", "A lost sensor is told.", that=status == "LEVEL_LOST", covers=["R-2"], on=tank.system
    ),
]  # fmt: skip
