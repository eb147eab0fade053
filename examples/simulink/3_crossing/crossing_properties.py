"""What the lights of a crossing must keep, in the names of crossing.slx."""

from rovercheck import always, implies, reachable, simulink_model

crossing = simulink_model("crossing.slx")
cars, walk, count = (crossing[name] for name in ("cars", "walk", "count"))

REQUIREMENTS = {"R-1": "Cars and walkers never cross at once.", "R-2": "Walkers get their turn."}
PROPERTIES = [
    always(
        "CROSS-1", "While walkers may go, cars have red.",
        that=implies(walk, cars == "RED"), covers=["R-1"], on=crossing.system,
    ),
    reachable("CROSS-2", "Walkers get green.", that=walk, covers=["R-2"], on=crossing.system),
    reachable(
        "CROSS-3", "The count stops at its end.",
        that=count == 255, covers=["R-2"], on=crossing.system,
    ),
]  # fmt: skip
