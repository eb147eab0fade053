"""The door of the cabin: it opens on a call, waits three seconds, and gives way to what is in it."""

from signals import WIDE, at_floor, blocked, call, close_button, gap, locked, motor, moving

from rovercheck import Block, Chart, State, after, assign, maximum, minimum, sec, to, when

leaves = Block(
    "Leaves",
    [
        when(motor == "OPEN", [assign(gap, minimum(gap + 1, WIDE))]),
        when(motor == "CLOSE", [assign(gap, maximum(gap - 1, 0))]),
    ],
    text="The motor moves the leaves of the door by one step in each tick.",
)

door = Chart(
    "Door",
    [
        State(
            "Closed",
            entry=[assign(motor, "STOP"), assign(locked, True)],
            exit=[assign(locked, False)],
            transitions=[to("Opening", when=call & at_floor & ~moving)],
        ),
        State(
            "Opening",
            entry=[assign(motor, "OPEN")],
            transitions=[to("Open", when=gap == WIDE)],
        ),
        State(
            "Open",
            entry=[assign(motor, "STOP")],
            transitions=[
                to("Closing", when=after(3 * sec) & ~blocked),
                to("Closing", when=close_button & ~blocked),
            ],
        ),
        State(
            "Closing",
            entry=[assign(motor, "CLOSE")],
            transitions=[to("Opening", when=blocked), to("Closed", when=gap == 0)],
        ),
    ],
    default="Closed",
    text="Opens on a call at a floor, closes after 3 s or on the button, opens again when blocked.",
)
