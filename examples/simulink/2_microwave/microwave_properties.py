"""What a microwave oven must keep, in the names of microwave.slx."""

from rovercheck import always, enters_only_if, implies, reachable, simulink_model

oven = simulink_model("microwave.slx")
heating, door, left, bell = (oven[name] for name in ("heating", "door", "left", "bell"))

REQUIREMENTS = {
    "R-1": "It heats with its door closed only.",
    "R-2": "It heats while time is left, and rings when none is.",
}
PROPERTIES = [
    always(
        "OVEN-1", "The heating is on in the state Heat only.",
        that=implies(heating, oven.active("Oven/Cooking/Heat")), covers=["R-1"], on=oven.system,
    ),
    always(
        "OVEN-2", "It never heats with its door open.",
        that=~(heating & door), covers=["R-1"], on=oven.system,
    ),
    always(
        "OVEN-3", "It heats only while time is left.",
        that=implies(heating, left > 0), covers=["R-2"], on=oven.system,
    ),
    reachable("OVEN-4", "The bell can ring.", that=bell, covers=["R-2"], on=oven.system),
    enters_only_if(
        "OVEN-5", "It begins to cook with its door closed only.",
        entering=oven.active("Cooking"), only_if=~door, covers=["R-1"], on=oven.system,
    ),
]  # fmt: skip
