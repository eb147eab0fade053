"""What the door of door.scxml must keep."""

from rovercheck import always, implies, scxml_model

door = scxml_model("door.scxml")
motor = door["motor"]

PROPERTIES = [
    always(
        "DOOR-1", "The motor stands still while the door is closed or open.",
        that=implies(door.active("closed", "open"), motor == 0),
        covers=["R-1"], on=door.system,
    ),
    always(
        "DOOR-2", "The motor never closes the door in an emergency.",
        that=implies(door.active("emergency"), motor != -1),
        covers=["R-2"], on=door.system,
    ),
]  # fmt: skip
REQUIREMENTS = {
    "R-1": "The motor stands still while the door is closed or open.",
    "R-2": "In an emergency the door is never closed by its motor.",
}
