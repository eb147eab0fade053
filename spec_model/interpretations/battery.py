"""Battery monitor of Board 1 under other interpretations (S15 to S24, S26, S65)."""

from rovercheck.spec_model.board1.battery import FALL, absent, assumed_b, b, critical_range, stale_below_15
from rovercheck.spec_model.interpretations import alternative
from rovercheck.spec_model.lang.change import formula, guards, inside, without
from rovercheck.spec_model.lang.chart import to
from rovercheck.spec_model.lang.edit import also, arrows, begin, in_expressions, timer
from rovercheck.spec_model.lang.expr import TRUE
from rovercheck.spec_model.lang.time import sec, ticks
from rovercheck.spec_model.lang.words import held, named
from rovercheck.spec_model.signals.board1 import batt_age, degraded_row_counts, temperature_degC

MONITOR = "Monitor_battery"
T = temperature_degC

degraded = b < 23
between_the_limits = (b >= 23) & (b <= 25)

ALTERNATIVES = (
    alternative("S65", "DEFAULT-OK", "The first step is OK, whatever is measured.", MONITOR,
        lambda chart: begin(chart, [to("Batt_OK")])),
    alternative("S16", "TABLE-ORDER", "The degraded row is tested before the critical one.", MONITOR,
        lambda chart: also(chart, "decide", to("Batt_DEG", when=degraded), first=True)),
    alternative("S16", "NONDET", "Either row may be tested first.", MONITOR,
        lambda chart: also(chart, "decide", to("Batt_DEG", when=degraded_row_counts & degraded), first=True)),
    alternative("S17", "OK-DEFAULT", "Between 23 % and 25 % the battery is OK.", MONITOR,
        guards("decide", "Batt_OK", lambda _: b >= 23)),
    alternative("S17", "DEG-DEFAULT", "Between 23 % and 25 % the battery is degraded.", MONITOR,
        formula(degraded, degraded | between_the_limits)),
    alternative("S26", "TABLE1", "Absence of readings is degraded.", MONITOR,
        formula(degraded, degraded | absent)),
    alternative("S18", "FILTERED", "Degraded needs 5 s too, for no other time is given.", MONITOR,
        formula(degraded, held(degraded, for_=5 * sec))),
    alternative("S23", "ESTIMATED", "The limit of 23 % holds for the estimate too.", MONITOR,
        formula(degraded, degraded | (absent & (assumed_b < 23)))),
    alternative("S24", "FROM-LAST-SUSTAINED", "The estimate needs 5 s too.", MONITOR,
        guards("decide", "Batt_CRIT", inside(stale_below_15, lambda stale: held(stale, for_=5 * sec)))),
    alternative("S24", "FROM-0.5-INSTANT", "The fall begins after 0.5 s.", MONITOR,
        formula(assumed_b, named("assumed_b", b - (batt_age - 500) * FALL))),
    alternative("S15", "TEMP", "The critical row is about the temperature, as it is written.", MONITOR,
        formula(critical_range, named("T in [0;15]", (T >= 0) & (T <= 15)))),
    alternative("S19", "UNIFORM-CLOSED", "The estimate is critical at 15 % too.", MONITOR,
        formula(stale_below_15, lambda _: named("stale_to_15", absent & (assumed_b <= 15)))),
    alternative("S19", "UNIFORM-OPEN", "The battery is critical below 15 % only.", MONITOR,
        formula(critical_range, named("b in [0;15[", (b >= 0) & (b < 15)))),
    alternative("S20", "CLAMP", "A battery below 0 % is critical too.", MONITOR,
        formula(b >= 0, TRUE)),
    alternative("S21", "GT-STEP", "Longer than 5 s.", MONITOR,
        lambda chart: in_expressions(chart, timer(251 * ticks))),
    alternative("S21", "COUNT", "250 samples, of which the first is 249 ticks old.", MONITOR,
        lambda chart: in_expressions(chart, timer(249 * ticks))),
    alternative("S22", "HYSTERESIS-25", "Critical is left above 25 % only.", MONITOR,
        without("Batt_CRIT", "decide"),
        lambda chart: also(chart, "Batt_CRIT", to("Batt_OK", when=b > 25))),
    alternative("S22", "LATCH", "Critical is never left.", MONITOR,
        lambda chart: arrows(chart, "Batt_CRIT", lambda _: [])),
)  # fmt: skip
"""From the outside in: each before those that change what it brings."""
