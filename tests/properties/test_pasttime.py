"""Forms as past-time logic, against monitors written form by form, on random formulas and runs."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rovercheck.checker.logs.form_monitors import Judge
from rovercheck.checker.logs.formula import FormulaRows
from rovercheck.properties import reduce as reduction
from rovercheck.properties.forms import (
    Always,
    EntersOnlyIf,
    Form,
    HoldsAfter,
    HoldsFor,
    LeavesOnlyIf,
    Never,
    Precedes,
    Property,
    Reachable,
    Responds,
    Until,
)
from rovercheck.properties.pasttime import Bounded
from rovercheck.properties.reduce import Question, reduce
from rovercheck.spec_model.lang.action import Assign
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.evaluate import step
from rovercheck.spec_model.lang.expr import Expr, Var, flag, implies, var
from rovercheck.spec_model.lang.system import TransitionSystem
from rovercheck.spec_model.lang.time import Span, ms, ticks
from rovercheck.spec_model.lang.words import held, once, previous, rising
from tests.profiles import examples
from tests.properties.judge_by_form import JudgeByForm
from tests.properties.reduced_by_form import MonitorsByForm
from tests.strategies_ts import booleans

p, q, r, n = flag("p"), flag("q"), flag("r"), var("n", integer(0, 3))
SCOPE: tuple[Var, ...] = (p, q, r, n)
PASSED = var("passed", integer(19, 21, "ms"), 20)
PLAIN = TransitionSystem("toy", SCOPE, (), (flag("x"),), (), (Assign(flag("x"), p),))
MEASURED = replace(PLAIN, inputs=(*SCOPE, PASSED), elapsed=PASSED)


@st.composite
def conditions(draw: st.DrawFn) -> Expr:
    """A formula, many of them about the past."""
    one, two = (booleans(draw, SCOPE, draw(st.integers(0, 2))) for _ in range(2))
    kinds: list[Expr] = [one, one, ~one & two, previous(one), rising(one), held(one, 2 * ticks)]
    return draw(st.sampled_from([*kinds, once(one) & two, implies(previous(one), two)]))


def spans(*units: Span) -> st.SearchStrategy[Span]:
    return st.builds(lambda number, unit: number * unit, st.integers(0, 4), st.sampled_from(units))


def forms(*units: Span) -> st.SearchStrategy[Form]:
    """Every form a finite run breaks."""
    c, long = conditions(), spans(*units)
    return st.one_of(
        st.builds(Always, c), st.builds(Never, c), st.builds(Reachable, c), st.builds(Responds, c, c, long),
        st.builds(HoldsAfter, c, long, c), st.builds(HoldsFor, c, c, long), st.builds(LeavesOnlyIf, c, c),
        st.builds(EntersOnlyIf, c, c), st.builds(Precedes, c, c), st.builds(Until, c, c, c),
    )  # fmt: skip


def properties(*units: Span) -> st.SearchStrategy[Property]:
    return st.builds(
        lambda form, first: Property("P", "", form, ("R",), "toy", first), forms(*units), st.integers(1, 3)
    )


TICK = st.fixed_dictionaries({v.name: st.sampled_from(v.domain.values) for v in (*SCOPE, PASSED)})
RUNS = st.lists(st.tuples(TICK, st.integers(1, 5)), min_size=1, max_size=7).map(
    lambda blocks: [tick for tick, long in blocks for _ in range(long)]
)
"""Inputs that keep their values for some ticks."""


def test_every_form_that_a_finite_run_breaks_is_drawn() -> None:
    drawn = {Always, Never, Reachable, Responds, HoldsAfter, HoldsFor, LeavesOnlyIf, EntersOnlyIf}
    assert {*Bounded.__subclasses__()} == drawn | {Precedes, Until}


# --- engines ---------------------------------------------------------------------------------------


def broken(question: Question, run: Sequence[Mapping[str, int]]) -> list[int]:
    at: Mapping[str, int] = question.system.init
    found = []
    for inputs in run:
        at = step(question.system, at, {v.name: inputs[v.name] for v in question.system.inputs})
        found.append(at["P"])
    return found


def by_form(system: TransitionSystem, prop: Property) -> Question:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(reduction, "_Monitors", MonitorsByForm)
        return reduce(system, [prop])


@examples(400)
@given(prop=properties(ticks, 20 * ms), run=RUNS)
def test_monitors_for_engines(prop: Property, run: list[dict[str, int]]) -> None:
    """Broken in the same ticks, and nothing else is remembered: the same variables, names and domains."""
    found, wanted = reduce(PLAIN, [prop]), by_form(PLAIN, prop)
    assert broken(found, run) == broken(wanted, run)
    assert _remembered(found) == _remembered(wanted)


@examples(200)
@given(prop=properties(ticks, 20 * ms, 19 * ms), run=RUNS)
def test_monitors_where_ticks_last_unlike_times(prop: Property, run: list[dict[str, int]]) -> None:
    found, wanted = reduce(MEASURED, [prop]), by_form(MEASURED, prop)
    assert broken(found, run) == broken(wanted, run)
    assert _remembered(found) == _remembered(wanted)


def _remembered(question: Question) -> tuple[Any, ...]:
    """What a monitor remembers; of two memories of one name the second has a number, which says nothing."""
    goal = question.goals[0]
    variables = sorted(
        (v.name.partition(" #")[0], str(v.domain), v.init, v.doc) for v in question.system.variables
    )
    memory = sorted(name.partition(" #")[0] for name in goal.memory)
    return variables, goal.var.name, goal.reach, memory, [str(part) for part, _ in goal.parts]


# --- logs ------------------------------------------------------------------------------------------


@examples(400)
@given(
    prop=properties(ticks),
    run=RUNS,
    cuts=st.sets(st.integers(1, 30), max_size=3),
    gaps=st.sets(st.integers(0, 30), max_size=2),
)
def test_monitors_of_logs(prop: Property, run: list[dict[str, int]], cuts: set[int], gaps: set[int]) -> None:
    """Broken and put to the test in the same rows, whatever the blocks, and after gaps."""
    judge, by_hand = Judge(prop), JudgeByForm(prop)
    ends = sorted({e for e in (*cuts, *gaps) if e < len(run)} | {0, len(run)})
    for start, end in pairwise(ends):
        if start in gaps:
            judge.gap()
            by_hand.gap()
        columns = {v.name: np.array([tick[v.name] for tick in run[start:end]], float) for v in SCOPE}
        found, wanted = (one.advance(FormulaRows(columns, end - start)) for one in (judge, by_hand))
        for ours, theirs in zip(found, wanted, strict=True):
            assert _rows(ours, end - start) == _rows(theirs, end - start)


def _rows(truth: Any, count: int) -> Any:
    return np.broadcast_to(truth, count).tolist()
