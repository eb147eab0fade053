"""Temperature monitor of Board 1: how warm is the board, and is anybody still measuring [seed §2.4, Table 2].

The ranges read the last valid temperature, also when it is old (S11, S12); absence of readings counts
only through the assumed rise (S13).  The words of the rows under other readings: `temperature_ranges`.
"""

from rovercheck.spec_model.board1.temperature_ranges import (
    T_cold,
    T_hot,
    absent,
    assumed_T,
    critical_for_4_s,
    critical_range,
    for_4_s,
)
from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Chart, Junction, State, to
from rovercheck.spec_model.lang.expr import Expr
from rovercheck.spec_model.lang.time import sec
from rovercheck.spec_model.lang.words import held, named
from rovercheck.spec_model.readings import choose, under
from rovercheck.spec_model.signals.board1 import temp_age, temp_status

__all__ = ["critical_range", "degraded_range", "monitor_temperature", "ok_range", "stale_above_65"]

ok_range = named("T in ]-5;55[", (T_cold > -5) & (T_hot < 55))
degraded_range = named(
    "T in ]-15;-5] or [55;60[", ((T_cold > -15) & (T_cold <= -5)) | ((T_hot >= 55) & (T_hot < 60))
)
to_be_degraded = degraded_range | (under("S01", "DEG-WHILE-PENDING") & critical_range)
to_be_ok = ok_range | (under("S01", "OK-DEFAULT") & critical_range)


def stale_above(limit: int) -> Expr:
    """Readings are absent and the assumed temperature is above the limit."""
    old = choose("S08", {"EQ": temp_age == 500, "GE": temp_age >= 500, "GT": temp_age > 500})
    above = choose("S14", {"GT": assumed_T > limit, "GE": assumed_T >= limit})
    return choose("S07", {"TEMP": old & above, "RATE": False})  # 1 °C/s is never above 65 °C/s


stale_above_65 = choose(
    "S06",
    {
        "AS-WRITTEN": named("stale_above_65", stale_above(65)),
        "ALL-60": named("stale_above_60", stale_above(60)),
    },
)
estimated = choose("S10", {"INSTANT": stale_above_65, "SUSTAINED": for_4_s(stale_above_65)})

sustained = choose(
    "S01",
    {
        "HOLD": critical_for_4_s,
        "DEG-WHILE-PENDING": critical_for_4_s,
        "OK-DEFAULT": critical_for_4_s,
        "CRIT-AT-ONCE": critical_range,
    },
)
released = choose(
    "S05",
    {"IMMEDIATE": True, "SYMMETRIC": held(~critical_range & ~stale_above_65, for_=4 * sec), "LATCH": False},
)

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
            transitions=[to("decide", when=released)],
        ),
    ],
    default=[  # classified in the very first step (S65)
        to("decide", when=under("S65", "CLASSIFY")),
        to("Temp_OK"),
    ],
    junctions=[
        Junction(
            "decide",
            [
                to("Temp_CRIT", when=sustained | estimated | (under("S13", "TABLE1-CRIT") & absent)),
                to("Temp_DEG", when=to_be_degraded | (under("S13", "TABLE1-DEG") & absent)),
                to("Temp_OK", when=to_be_ok),
            ],
        )
    ],
    text="Temperature status from the last valid reading and its age.",
)
