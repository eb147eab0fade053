"""Temperature monitor of Board 1 under other interpretations (S01 to S14, S65)."""

from collections.abc import Callable
from dataclasses import replace
from operator import ge, gt, le, lt

from rovercheck.spec_model.board1.temperature import (
    RISE,
    T,
    absent,
    assumed_T,
    critical_range,
    degraded_range,
    ok_range,
    stale_above_65,
)
from rovercheck.spec_model.interpretations import Change, alternative
from rovercheck.spec_model.lang.action import Action, If, assign, when
from rovercheck.spec_model.lang.change import formula, formulas, guards, inside, without
from rovercheck.spec_model.lang.chart import Block, Chart, to
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.edit import begin, constant, timer
from rovercheck.spec_model.lang.expr import FALSE, Expr, Var, ite, var
from rovercheck.spec_model.lang.time import sec, ticks
from rovercheck.spec_model.lang.words import held, minimum, named
from rovercheck.spec_model.signals.board1 import temp_age

Compare = Callable[[Expr, int], Expr]

MONITOR = "Monitor_temperature"
STEPS = "Critical_range.steps"

too_cold, too_hot = T <= -15, T >= 60
held_critical = held(critical_range, for_=4 * sec)
stale_above_60 = named("stale_above_60", absent & (assumed_T > 60))


LIMITS = ((stale_above_65, 65), (stale_above_60, 60))


def absent_means(old: Expr) -> Change:
    """Another length of absence after which the estimate counts, for both of its limits."""
    return formulas(*((stale, named(stale.name, old & (assumed_T > limit))) for stale, limit in LIMITS))


def estimated(*comparisons: tuple[Compare, int]) -> Change:
    """These limits are compared with the estimate while readings are absent."""
    return formulas(*((than(T, x), ite(absent, than(assumed_T, x), than(T, x))) for than, x in comparisons))


# --- the time in the critical range, added up (S04) ------------------------------------------------------
# CUMULATIVE never forgets the time in the range, because no sentence says when.

ENOUGH = 201
"""Samples in the critical range that make 4 s, the first one included."""

range_steps = var("range_steps", integer(0, 202), doc="steps so far with T in the critical range")
hot_steps = var("hot_steps", integer(0, 202), doc="steps so far with T in [60;+inf[")
cold_steps = var("cold_steps", integer(0, 202), doc="steps so far with T in ]-inf;-15]")
enough = critical_range & (range_steps >= ENOUGH)


def counted(steps: Var, condition: Expr) -> Action:
    return when(condition, [assign(steps, minimum(steps + 1, 202))])


def count_beside(chart: Chart) -> tuple[Block, Chart]:
    """The time is added up in every step, whatever the monitor does with it."""
    block = Block(STEPS, [counted(range_steps, critical_range)], text="The time in the range, added up.")
    return block, formula(held_critical, enough)(chart)


def count_each_side(block: Block) -> Block:
    [counting] = block.do
    assert isinstance(counting, If)
    sides = (counted(hot_steps, too_hot), counted(cold_steps, too_cold))
    return Block(block.name, [replace(counting, then=sides)], text=block.text, place=block.place)


# --- the alternatives --------------------------------------------------------------------------------------

GROWTH = named("assumed_T", T + (temp_age - 500) * RISE)


def lasts(span: int, samples: int) -> Change:
    """Another way to count 4 s: in ticks since the first sample, and in samples."""
    return guards("decide", "Temp_CRIT", lambda g: constant(ENOUGH, samples)(timer(span * ticks)(g)))


ALTERNATIVES = (
    alternative("S65", "DEFAULT-OK", "The first step is OK, whatever is measured.", MONITOR,
        lambda chart: begin(chart, [to("Temp_OK")])),
    alternative("S01", "HOLD", "The status is kept until the 4 s are over.", MONITOR,
        guards("decide", "Temp_DEG", lambda _: degraded_range)),
    alternative("S01", "OK-DEFAULT", "The status is OK until the 4 s are over.", MONITOR,
        guards("decide", "Temp_DEG", lambda _: degraded_range),
        guards("decide", "Temp_OK", lambda _: ok_range | critical_range)),
    alternative("S01", "CRIT-AT-ONCE", "The critical range needs no 4 s.", MONITOR,
        guards("decide", "Temp_DEG", lambda _: degraded_range),
        guards("decide", "Temp_CRIT", inside(held_critical, critical_range))),
    alternative("S10", "SUSTAINED", "The estimate needs the 4 s too.", MONITOR,
        guards("decide", "Temp_CRIT", inside(stale_above_65, lambda stale: held(stale, for_=4 * sec)))),
    alternative("S05", "SYMMETRIC", "Critical is left after 4 s without a cause.", MONITOR,
        guards("Temp_CRIT", "decide", lambda _: held(~critical_range & ~stale_above_65, for_=4 * sec))),
    alternative("S05", "LATCH", "Critical is never left.", MONITOR, without("Temp_CRIT", "decide")),
    alternative("S07", "RATE", "The limit is one of the slope, and 1 °C/s is never above 65 °C/s.", MONITOR,
        formula(stale_above_65, FALSE)),
    alternative("S06", "ALL-60", "The limit of the estimate is 60, as that of the range.", MONITOR,
        formula(stale_above_65, stale_above_60)),
    alternative("S08", "EQ", "The estimate counts at an absence of 0.5 s only.", MONITOR,
        absent_means(temp_age == 500)),
    alternative("S08", "GT", "The estimate counts after an absence of 0.5 s.", MONITOR,
        absent_means(temp_age > 500)),
    alternative("S14", "GE", "The estimate counts from the limit on.", MONITOR,
        formulas(*((assumed_T > limit, assumed_T >= limit) for _, limit in LIMITS))),
    alternative("S13", "TABLE1-CRIT", "Absence of readings is critical.", MONITOR,
        guards("decide", "Temp_CRIT", lambda g: g | absent)),
    alternative("S13", "TABLE1-DEG", "Absence of readings is degraded.", MONITOR,
        guards("decide", "Temp_DEG", lambda g: g | absent)),
    alternative("S04", "CUMULATIVE", "The 4 s add up, whatever comes between.", MONITOR, count_beside),
    alternative("S03", "PER-SIDE", "The 4 s are those of one side.", STEPS, count_each_side),
    alternative("S03", "PER-SIDE", "The 4 s are those of one side.", MONITOR,
        formulas(
            (held_critical, held(too_cold, for_=4 * sec) | held(too_hot, for_=4 * sec)),
            (enough, (too_hot & (hot_steps >= ENOUGH)) | (too_cold & (cold_steps >= ENOUGH))),
        )),
    alternative("S02", "GT-STEP", "Longer than 4 s.", MONITOR, lasts(201, 202)),
    alternative("S02", "COUNT", "200 samples, of which the first is 199 ticks old.", MONITOR,
        lasts(199, 200)),
    alternative("S11", "ESTIMATED", "The hot limits are compared with the estimate.", MONITOR,
        estimated((lt, 55), (ge, 55), (lt, 60), (ge, 60))),
    alternative("S11", "ESTIMATED", "The hot limits are compared with the estimate.", STEPS,
        estimated((ge, 60))),
    alternative("S12", "ESTIMATED", "The cold limits are compared with the estimate.", MONITOR,
        estimated((gt, -5), (le, -5), (gt, -15), (le, -15))),
    alternative("S12", "ESTIMATED", "The cold limits are compared with the estimate.", STEPS,
        estimated((le, -15))),
    *(alternative("S09", "FROM-0.5", "The rise begins after 0.5 s.", part, formula(assumed_T, GROWTH))
      for part in (MONITOR, STEPS)),
)  # fmt: skip
"""From the outside in: each before those that change what it brings."""
