"""What Table 2 says of the battery of Board 1: its ranges, and the estimate without readings."""

from fractions import Fraction

from rovercheck.spec_model.ambiguity import choose
from rovercheck.spec_model.lang.expr import const
from rovercheck.spec_model.lang.words import named
from rovercheck.spec_model.signals.board1 import batt_age
from rovercheck.spec_model.signals.board1 import battery_pct as b
from rovercheck.spec_model.signals.board1 import temperature_degC as T

fresh = batt_age < 500
absent = batt_age >= 500

from_0 = choose("S20", {"LITERAL": b >= 0, "CLAMP": True})
closed, half_open = named("b in [0;15]", from_0 & (b <= 15)), named("b in [0;15[", from_0 & (b < 15))
critical_range = choose("S15", {
    "PCT": choose("S19", {"AS-WRITTEN": closed, "UNIFORM-CLOSED": closed, "UNIFORM-OPEN": half_open}),
    "TEMP": named("T in [0;15]", (T >= 0) & (T <= 15)),
})  # fmt: skip
"""[0 %; 15 %], printed as a range of the temperature [spec Table 2]."""

per_ms = const(Fraction("0.42") / 1000, "%/ms")
from_last = b - batt_age * per_ms
assumed_b = named("assumed_b", choose("S24", {
    "FROM-LAST-INSTANT": from_last,
    "FROM-0.5-INSTANT": b - (batt_age - 500) * per_ms,
    "FROM-LAST-SUSTAINED": from_last,
}))  # fmt: skip
"""Without readings the battery is assumed to fall by 0.42 %/s [spec Table 2]."""

strictly = named("stale_below_15", absent & (assumed_b < 15))
stale_below_15 = choose("S19", {
    "AS-WRITTEN": strictly,
    "UNIFORM-CLOSED": named("stale_to_15", absent & (assumed_b <= 15)),
    "UNIFORM-OPEN": strictly,
})  # fmt: skip
"""0.5 s after the last reading the assumed battery is below 15 % [spec Table 2]."""
