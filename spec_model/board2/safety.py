"""Safety state of the rover while Board 2 is authorised: degraded at best, critical with an emergency.

In the first authorised step after power-up the chart enters Rover_Degraded_State whatever the masks (G2).
"""

from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Chart, State, to
from rovercheck.spec_model.lang.words import named
from rovercheck.spec_model.signals.board2_supervisor import b1_emergency, b2_emergency, rover_safety_state

emergency = named("emergency", b1_emergency | b2_emergency)

safety_state_2 = Chart(
    "Safety_state_2",
    [
        State(
            "Rover_Degraded_State",
            entry=[assign(rover_safety_state, "SAFETY_DEGRADED")],
            transitions=[to("Rover_Critical_State", when=emergency)],
        ),
        State(
            "Rover_Critical_State",
            entry=[assign(rover_safety_state, "SAFETY_CRITICAL")],
            transitions=[to("Rover_Degraded_State", when=~emergency)],
        ),
    ],
    default="Rover_Degraded_State",
    text="Safety state while Board 2 is authorised: degraded or critical.",
)
