"""What the rows of the temperature monitor ask under each reading: limits, estimate, times [seed Table 2]."""

import operator
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction

from rovercheck.spec_model.lang.action import Action, assign, when
from rovercheck.spec_model.lang.chart import Block
from rovercheck.spec_model.lang.domain import Number, integer
from rovercheck.spec_model.lang.expr import Expr, Var, const, ite, var
from rovercheck.spec_model.lang.time import sec, ticks
from rovercheck.spec_model.lang.words import held, minimum, named
from rovercheck.spec_model.readings import choose, under
from rovercheck.spec_model.signals.board1 import temp_age, temperature_degC

T = temperature_degC
absent = temp_age >= 500

RISE = const(Fraction(1, 1000), "°C/ms")
"""The assumed rise without readings, 1 °C/s."""

assumed_T = named(
    "assumed_T",
    choose("S09", {"FROM-LAST": T + temp_age * RISE, "FROM-0.5": T + (temp_age - 500) * RISE}),
)


@dataclass(frozen=True)
class RangeSide:
    """The temperature that the limits on one side are compared with: ``T_hot >= 60``.

    ``reading`` says whether it stays the measured value while readings are absent, or is the estimate.
    """

    reading: str

    def __lt__(self, limit: Number) -> Expr:
        return self._compared(operator.lt, limit)

    def __le__(self, limit: Number) -> Expr:
        return self._compared(operator.le, limit)

    def __gt__(self, limit: Number) -> Expr:
        return self._compared(operator.gt, limit)

    def __ge__(self, limit: Number) -> Expr:
        return self._compared(operator.ge, limit)

    def _compared(self, compare: Callable[[Expr, Number], Expr], limit: Number) -> Expr:
        measured = compare(T, limit)
        estimated = ite(absent, compare(assumed_T, limit), measured)
        return choose(self.reading, {"MEASURED": measured, "ESTIMATED": estimated})


T_hot, T_cold = RangeSide("S11"), RangeSide("S12")

too_hot, too_cold = T_hot >= 60, T_cold <= -15
critical_range = named("T in ]-inf;-15] or [60;+inf[", too_cold | too_hot)


def for_4_s(condition: Expr) -> Expr:
    """Whether the condition has lasted 4 s (S02)."""
    return choose(
        "S02",
        {
            "GE": held(condition, for_=4 * sec),
            "GT-STEP": held(condition, for_=201 * ticks),
            "COUNT": held(condition, for_=199 * ticks),  # the first of 200 samples is 199 ticks old
        },
    )


# S04 CUMULATIVE adds up the time in the range and never forgets it, because no sentence says when.

ENOUGH = choose("S02", {"GE": 201, "GT-STEP": 202, "COUNT": 200})
"""Samples in the critical range that make 4 s, the first one included."""

range_steps = var("range_steps", integer(0, 202), doc="steps so far with T in the critical range")
hot_steps = var("hot_steps", integer(0, 202), doc="steps so far with T in [60;+inf[")
cold_steps = var("cold_steps", integer(0, 202), doc="steps so far with T in ]-inf;-15]")


def _counted(steps: Var, condition: Expr) -> Action:
    return when(condition, [assign(steps, minimum(steps + 1, 202))])


count_range_steps = Block(
    "Critical_range.steps",
    [
        when(
            under("S04", "CUMULATIVE"),
            [
                when(
                    under("S03", "UNION"),
                    [_counted(range_steps, critical_range)],
                    [_counted(hot_steps, too_hot), _counted(cold_steps, too_cold)],
                )
            ],
        )
    ],
    text="The time in the critical range, added up in every step, whatever the monitor does with it.",
)

_continuous = choose(
    "S03", {"UNION": for_4_s(critical_range), "PER-SIDE": for_4_s(too_cold) | for_4_s(too_hot)}
)
_cumulative = choose(
    "S03",
    {
        "UNION": critical_range & (range_steps >= ENOUGH),
        "PER-SIDE": (too_hot & (hot_steps >= ENOUGH)) | (too_cold & (cold_steps >= ENOUGH)),
    },
)
critical_for_4_s = choose("S04", {"CONTINUOUS": _continuous, "CUMULATIVE": _cumulative})
