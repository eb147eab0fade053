"""Temperature monitor of Board 1: how warm is the board, and is anybody still measuring [spec §2.4, Table 2].

The ranges read the last valid temperature, also when it is old (S11, S12); absence of readings counts
only through the assumed rise (S13).
"""

from fractions import Fraction

from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Chart, Junction, State, to
from rovercheck.spec_model.lang.expr import const
from rovercheck.spec_model.lang.time import sec
from rovercheck.spec_model.lang.words import held, named
from rovercheck.spec_model.signals.board1 import temp_age, temp_status, temperature_degC

__all__ = ["critical_range", "degraded_range", "monitor_temperature", "ok_range", "stale_above_65"]

T = temperature_degC
absent = temp_age >= 500

ok_range = named("T in ]-5;55[", (T > -5) & (T < 55))
degraded_range = named("T in ]-15;-5] or [55;60[", ((T > -15) & (T <= -5)) | ((T >= 55) & (T < 60)))
critical_range = named("T in ]-inf;-15] or [60;+inf[", (T <= -15) | (T >= 60))

RISE = const(Fraction(1, 1000), "°C/ms")
"""The assumed rise without readings, 1 °C/s."""

assumed_T = named("assumed_T", T + temp_age * RISE)
stale_above_65 = named("stale_above_65", absent & (assumed_T > 65))

monitor_temperature = Chart(
    "Monitor_temperature",
    [
        State(
            "Temp_OK",
            entry=[assign(temp_status, "TEMP_HEALTH_OK")],
            transitions=[to("decide")],
        ),
        State(
            "Temp_DEG",
            entry=[assign(temp_status, "TEMP_HEALTH_DEGRADED")],
            transitions=[to("decide")],
        ),
        State(
            "Temp_CRIT",
            entry=[assign(temp_status, "TEMP_HEALTH_CRITICAL")],
            transitions=[to("decide")],
        ),
    ],
    default=[to("decide"), to("Temp_OK")],  # classified in the very first step (S65)
    junctions=[
        Junction(
            "decide",
            [
                to("Temp_CRIT", when=held(critical_range, for_=4 * sec) | stale_above_65),
                to("Temp_DEG", when=degraded_range | critical_range),  # also before the 4 s are over (S01)
                to("Temp_OK", when=ok_range),
            ],
        )
    ],
    text="Temperature status from the last valid reading and its age.",
)
