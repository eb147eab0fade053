"""What Table 2 says of the temperature of Board 1: its ranges, and the estimate without readings."""

from collections.abc import Callable
from fractions import Fraction

from rovercheck.spec_model.ambiguity import choose
from rovercheck.spec_model.lang.expr import Expr, const, ite
from rovercheck.spec_model.lang.words import named
from rovercheck.spec_model.signals.board1 import temp_age
from rovercheck.spec_model.signals.board1 import temperature_degC as T

fresh = temp_age < 500
absent = temp_age >= 500

per_ms = const(Fraction(1, 1000), "°C/ms")
assumed_T = named(
    "assumed_T",
    choose("S09", {"FROM-LAST": T + temp_age * per_ms, "FROM-0.5": T + (temp_age - 500) * per_ms}),
)
"""Without readings the temperature is assumed to rise by 1 °C/s [spec Table 2]."""


def _side(interpretation: str, limit: Callable[[Expr], Expr]) -> Expr:
    """A limit on the last reading, or on the estimate while readings are absent (S11 hot, S12 cold)."""
    return choose(
        interpretation, {"MEASURED": limit(T), "ESTIMATED": ite(absent, limit(assumed_T), limit(T))}
    )


def _hot(limit: Callable[[Expr], Expr]) -> Expr:
    return _side("S11", limit)


def _cold(limit: Callable[[Expr], Expr]) -> Expr:
    return _side("S12", limit)


critical_range = named("T in ]-inf;-15] or [60;+inf[", _cold(lambda t: t <= -15) | _hot(lambda t: t >= 60))
degraded_range = named(
    "T in ]-15;-5] or [55;60[",
    _cold(lambda t: (t > -15) & (t <= -5)) | _hot(lambda t: (t >= 55) & (t < 60)),
)
ok_range = named("T in ]-5;55[", _cold(lambda t: t > -5) & _hot(lambda t: t < 55))


def _stale_above(limit: int) -> Expr:
    """0.5 s after the last reading the assumed temperature is above the limit [spec Table 2]."""
    old = choose("S08", {"EQ": temp_age == 500, "GE": temp_age >= 500, "GT": temp_age > 500})
    above = choose("S14", {"GT": assumed_T > limit, "GE": assumed_T >= limit})
    return choose("S07", {"TEMP": old & above, "RATE": False})  # a rise of 1 °C/s is never above 65 °C/s


stale_above_65 = choose("S06", {
    "AS-WRITTEN": named("stale_above_65", _stale_above(65)),
    "ALL-60": named("stale_above_60", _stale_above(60)),
})  # fmt: skip
