"""A heater that runs for at most ten seconds at a time, and what must be true of it."""

from rovercheck import (
    Chart,
    State,
    after,
    always,
    assign,
    flag,
    holds_for,
    implies,
    integer,
    previous,
    responds,
    sec,
    to,
    var,
)

temperature = var("temperature", integer(-20, 40, "°C"))
door_open = flag("door_open")
heating = flag("heating")

heater = Chart(
    "Heater",
    [
        State(
            "Off",
            entry=[assign(heating, False)],
            transitions=[to("On", when=(temperature < 18) & ~door_open)],
        ),
        State(
            "On",
            entry=[assign(heating, True)],
            transitions=[
                to("Off", when=door_open | (temperature > 22)),
                to("Pause", when=after(10 * sec)),
            ],
        ),
        State(
            "Pause",
            entry=[assign(heating, False)],
            transitions=[to("Off", when=after(5 * sec))],
        ),
    ],
    default="Off",
    text="Heats below 18 °C until it is above 22 °C, with the door closed, for at most 10 s at a time.",
)

REQUIREMENTS = {
    "R1": "The room is not heated with the door open.",
    "R2": "The coil is hot for 10 s at most, and then rests for 5 s.",
}

HEAT_1 = always(
    "HEAT-1",
    "With the door open the heater is off.",
    that=implies(door_open, ~heating),
    covers=["R1"],
    on="Heater",
)
HEAT_2 = responds(
    "HEAT-2",
    "The heater never runs for longer than 10 s at a time.",
    trigger=heating,
    response=~heating,
    within=10 * sec,
    covers=["R2"],
    on="Heater",
)
HEAT_3 = holds_for(
    "HEAT-3",
    "Once switched off, the heater stays off for 5 s.",
    start=previous(heating) & ~heating,
    that=~heating,
    for_=5 * sec,
    covers=["R2"],
    on="Heater",
)
