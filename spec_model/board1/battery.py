"""Battery monitor of Board 1: is there charge left, and is anybody still measuring [seed §2.4, Table 2].

The document writes "temperature" in the critical row and "voltage" in Table 1; both mean the battery
percentage (S15, S25).  Between 23 % and 25 % no row is true and the state is kept (S17).
"""

from fractions import Fraction

from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Chart, Junction, State, to
from rovercheck.spec_model.lang.expr import Expr, const
from rovercheck.spec_model.lang.time import sec, ticks
from rovercheck.spec_model.lang.words import held, named
from rovercheck.spec_model.readings import choose, under
from rovercheck.spec_model.signals.board1 import (
    batt_age,
    batt_status,
    battery_pct,
    degraded_row_counts,
    temperature_degC,
)

b, T = battery_pct, temperature_degC
absent = batt_age >= 500


def for_5_s(condition: Expr) -> Expr:
    """Whether the condition has lasted 5 s (S21)."""
    return choose(
        "S21",
        {
            "GE": held(condition, for_=5 * sec),
            "GT-STEP": held(condition, for_=251 * ticks),
            "COUNT": held(condition, for_=249 * ticks),  # the first of 250 samples is 249 ticks old
        },
    )


from_0 = choose("S20", {"LITERAL": b >= 0, "CLAMP": True})
closed, open_ = named("b in [0;15]", from_0 & (b <= 15)), named("b in [0;15[", from_0 & (b < 15))
percent_range = choose("S19", {"AS-WRITTEN": closed, "UNIFORM-CLOSED": closed, "UNIFORM-OPEN": open_})
critical_range = choose("S15", {"PCT": percent_range, "TEMP": named("T in [0;15]", (T >= 0) & (T <= 15))})

FALL = const(Fraction("0.42") / 1000, "%/ms")
"""The assumed fall without readings, 0.42 %/s."""

from_last = b - batt_age * FALL
assumed_b = named(
    "assumed_b",
    choose(
        "S24",
        {
            "FROM-LAST-INSTANT": from_last,
            "FROM-0.5-INSTANT": b - (batt_age - 500) * FALL,
            "FROM-LAST-SUSTAINED": from_last,
        },
    ),
)
strictly = named("stale_below_15", absent & (assumed_b < 15))
stale_below_15 = choose(
    "S19",
    {
        "AS-WRITTEN": strictly,
        "UNIFORM-CLOSED": named("stale_to_15", absent & (assumed_b <= 15)),
        "UNIFORM-OPEN": strictly,
    },
)
estimated = choose(
    "S24",
    {
        "FROM-LAST-INSTANT": stale_below_15,
        "FROM-0.5-INSTANT": stale_below_15,
        "FROM-LAST-SUSTAINED": for_5_s(stale_below_15),
    },
)

below_23 = choose("S23", {"MEASURED": b < 23, "ESTIMATED": (b < 23) | (absent & (assumed_b < 23))})
to_be_degraded = (
    choose("S18", {"IMMEDIATE": below_23, "FILTERED": for_5_s(below_23)})  # no time but 5 s is given
    | (under("S17", "DEG-DEFAULT") & (b >= 23) & (b <= 25))
    | (under("S26", "TABLE1") & absent)
)
to_be_ok = choose("S17", {"HOLD": b > 25, "OK-DEFAULT": b >= 23, "DEG-DEFAULT": b > 25})
degraded_first = choose("S16", {"SEVERITY": False, "TABLE-ORDER": True, "NONDET": degraded_row_counts})

released = choose("S22", {"IMMEDIATE": True, "HYSTERESIS-25": False, "LATCH": False})

monitor_battery = Chart(
    "Monitor_battery",
    [
        State(
            "Batt_OK",
            entry=[assign(batt_status, "BATT_HEALTH_OK")],
            transitions=[to("decide")],
        ),
        State(
            "Batt_DEG",
            entry=[assign(batt_status, "BATT_HEALTH_DEGRADED")],
            transitions=[to("decide")],
        ),
        State(
            "Batt_CRIT",
            entry=[assign(batt_status, "BATT_HEALTH_CRITICAL")],
            transitions=[
                to("decide", when=released),
                to("Batt_OK", when=under("S22", "HYSTERESIS-25") & (b > 25)),  # the third row only
            ],
        ),
    ],
    default=[to("decide", when=under("S65", "CLASSIFY")), to("Batt_OK")],
    junctions=[
        Junction(
            "decide",
            [
                to("Batt_DEG", when=degraded_first & to_be_degraded),
                to("Batt_CRIT", when=for_5_s(critical_range) | estimated),
                to("Batt_DEG", when=to_be_degraded),  # at once, also in [0;15] for less than 5 s
                to("Batt_OK", when=to_be_ok),
            ],
        )
    ],
    text="Battery status from the last valid percentage and its age.",
)
