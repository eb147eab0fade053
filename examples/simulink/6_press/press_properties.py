"""What a press must keep, in the names of press.slx."""

from rovercheck import always, reachable, simulink_model

press = simulink_model("press.slx")

REQUIREMENTS = {"R-1": "A fault ends the work.", "R-2": "Alarms are counted."}
PROPERTIES = [
    always(
        "PRESS-1", "A fault is told as phase 99, and nothing else is.",
        that=press.active("Fault") == (press["phase"] == 99), covers=["R-1"], on=press.system,
    ),
    reachable("PRESS-2", "An alarm is counted.", that=press["alarms"] > 0, covers=["R-2"], on=press.system),
]  # fmt: skip
