"""Safety state of the rover from the fault masks of both boards [spec §2.7, Fig 21].

The junctions, arrows and priorities are those of the figure (S56): Rover_Degraded_State tests "not
degraded" before "critical", so a critical cause that replaces a degraded one is met in
Rover_Safe_State first.
"""

from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Chart, Junction, State, to
from rovercheck.spec_model.signals.board1 import (
    b1_critical,
    b1_degraded,
    b2_critical,
    b2_degraded,
    rover_safety_state,
)

critical = b1_critical | b2_critical
degraded = b1_degraded | b2_degraded

safety_state = Chart(
    "Safety_state",
    [
        State(
            "Rover_Safe_State",
            entry=[assign(rover_safety_state, "SAFETY_OK")],
            transitions=[
                to("safe_1", when=critical),
                to("Rover_Degraded_State", when=degraded),
            ],
        ),
        State(
            "Rover_Degraded_State",
            entry=[assign(rover_safety_state, "SAFETY_DEGRADED")],
            transitions=[
                to("degraded_1"),
                to("degraded_3"),
            ],
        ),
        State(
            "Rover_Critical_State",
            entry=[assign(rover_safety_state, "SAFETY_CRITICAL")],
            transitions=[to("critical_1", when=~critical)],
        ),
    ],
    default="Rover_Safe_State",
    junctions=[
        Junction("safe_1", [to("Rover_Critical_State")]),
        Junction("degraded_1", [to("degraded_2", when=~degraded)]),
        Junction("degraded_2", [to("Rover_Safe_State")]),
        Junction("degraded_3", [to("Rover_Critical_State", when=critical)]),
        Junction(
            "critical_1",
            [
                to("Rover_Safe_State", when=~degraded),
                to("Rover_Degraded_State", when=degraded),
            ],
        ),
    ],
    text="Rover safety state: safe, degraded or critical.",
)
