"""updateSafetyLimits: the five limits of the references, scaled by the safety state [spec §2.7, Fig 20].

The motion chart calls it when its running state updates the user's command.  Here it is executed before
the chart in every step, which gives the same references: nothing reads a limit but after that call.
"""

from fractions import Fraction

from rovercheck.spec_model.lang.action import Action, assign, when
from rovercheck.spec_model.lang.chart import Block
from rovercheck.spec_model.signals.board1 import (
    OMEGA_GO_LEFT,
    OMEGA_GO_RIGHT,
    OMEGA_MAX,
    V_MAX,
    V_MAX_MANEUVER,
    rover_safety_state,
)


def _scaled(factor: Fraction) -> list[Action]:
    return [
        assign(V_MAX, factor * 1),
        assign(OMEGA_MAX, factor * 1),
        assign(V_MAX_MANEUVER, factor * Fraction("0.8")),
        assign(OMEGA_GO_LEFT, factor * Fraction("0.4")),
        assign(OMEGA_GO_RIGHT, factor * Fraction("-0.4")),
    ]


update_safety_limits = Block(
    "updateSafetyLimits",
    [
        when(
            rover_safety_state == "SAFETY_DEGRADED",
            _scaled(Fraction("0.5")),
            [when(rover_safety_state == "SAFETY_CRITICAL", _scaled(Fraction(0)), _scaled(Fraction(1)))],
        )
    ],
    text="Nominal limits, half of them when degraded, 0 when critical.",
)
