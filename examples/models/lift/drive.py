"""The drive of the cabin: it moves only while the door is locked."""

from signals import at_floor, locked, moving, ride

from rovercheck import Chart, State, assign, to

drive = Chart(
    "Drive",
    [
        State(
            "Standing",
            entry=[assign(moving, False)],
            transitions=[to("Moving", when=ride & locked)],
        ),
        State(
            "Moving",
            entry=[assign(moving, True)],
            transitions=[to("Standing", when=at_floor & ~ride)],
        ),
    ],
    default="Standing",
    text="Rides to another floor while the door is locked.",
)
