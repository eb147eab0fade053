"""An oven whose labels are texts, as they stand on a chart of Stateflow, and what must be true of it."""

from rovercheck import (
    Action,
    Chart,
    Expr,
    State,
    always,
    array,
    assign,
    boolean,
    enumeration,
    flag,
    function,
    holds_for,
    implies,
    integer,
    sec,
    to,
    var,
)

MODE = enumeration("Mode", ["BAKE", "GRILL", "WARM"])
mode = var("mode", MODE)
start, door_open = flag("start"), flag("door_open")
minutes = var("minutes", integer(0, 3, "min"))
left = var("left", integer(0, 180, "s"))
heater = array("heater", ["top", "bottom"], boolean)


@function
def too_long(time: Expr) -> Expr:
    """A formula: labels show the call."""
    return time > 120


@function
def heaters_off() -> list[Action]:
    """Actions that several states share."""
    return [assign(one, False) for one in heater]


oven = Chart(
    "Oven",
    [
        State(
            "Off",
            "entry: heaters_off()",
            transitions=[to("Heating", "[start && !door_open && minutes > 0] / left = 60 * minutes")],
        ),
        State(
            "Heating",
            """entry: heater[top] = mode != WARM
                      heater[bottom] = mode ~= GRILL && !too_long(left)
               exit:  heaters_off()""",
            transitions=[
                to("Paused", "[door_open]"),
                to("Off", "[left <= 0]"),
                to("Heating", "after(1, sec) {left = max(left - 1 s, 0)}"),
            ],
        ),
        State(
            "Paused",
            transitions=[
                to("Off", "[!start && duration(!door_open) > 1 s]"),
                to("Heating", "[duration(!door_open) > 1 s]"),
            ],
        ),
    ],
    default="Off",
    data=[mode, start, door_open, minutes, left, heater, too_long, heaters_off],
    text="Heats for some minutes; an open door interrupts it.",
)

OVEN_1 = always(
    "OVEN-1",
    "With the door open no heater is on.",
    that=implies(door_open, ~heater["top"] & ~heater["bottom"]),
    covers=["safety"],
    on=oven,
)
OVEN_2 = holds_for(
    "OVEN-2",
    "A door that was opened keeps the oven off for a second.",
    start=oven.active("Paused"),
    that=~heater["top"],
    for_=1 * sec,
    covers=["safety"],
    on=oven,
)
