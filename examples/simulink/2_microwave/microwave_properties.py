"""What a microwave oven must keep, in the names of microwave.slx."""

from rovercheck import always, implies, reachable, simulink_model

oven = simulink_model("microwave.slx")
REQUIREMENTS = {
    "R-1": "It heats with the door closed only.",
    "R-2": "It stops heating at once when the door is opened.",
    "R-3": "It counts down the time that was asked for, and rings.",
}
heating, door, left, bell = (oven[name] for name in ("heating", "door", "left", "bell"))

PROPERTIES = [
    always("OVEN-1", "It heats only while the heater is on duty.", that=implies(heating, oven.active("Heat")), covers=["R-1"], on=oven.system),
    always("OVEN-2", "It never heats with the door open.", that=~(heating & door), covers=["R-1", "R-2"], on=oven.system),
    always("OVEN-3", "It heats only while time is left.", that=implies(heating, left > 0), covers=["R-3"], on=oven.system),
    reachable("OVEN-4", "The bell can ring.", that=bell, covers=["R-3"], on=oven.system),
]
