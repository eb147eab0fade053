"""Whatever a chart prints, its reader reads as the same formula and the same actions."""

from collections.abc import Iterator, Sequence
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rovercheck.checker.render.drawing.labels import action_lines, label
from rovercheck.spec_model.lang.action import Action, Assign, If, Send, assign, send, when
from rovercheck.spec_model.lang.chart import Chart, Path, State, Transition, to
from rovercheck.spec_model.lang.domain import Bool, Enum, Num, boolean, enumeration, fixed, integer
from rovercheck.spec_model.lang.evaluate import evaluate
from rovercheck.spec_model.lang.expr import Const, Expr, Var, all_of, any_of, const, flag, ite, var
from rovercheck.spec_model.lang.label import text
from rovercheck.spec_model.lang.stateflow.meaning import formula_of
from rovercheck.spec_model.lang.stateflow.names import LabelNames, names_of
from rovercheck.spec_model.lang.stateflow.statements import state_of, transition_of
from rovercheck.spec_model.lang.time import ms, sec, ticks
from rovercheck.spec_model.lang.walk import structure
from rovercheck.spec_model.lang.words import (
    absolute,
    after,
    bit,
    duration,
    held,
    maximum,
    minimum,
    modulo,
    named,
    previous,
    quotient,
    rising,
)
from rovercheck.spec_model.rover import systems

TWO_MEANINGS = ("nearly_turned := abs(angle_err) < 7.5", "B2.nearly_turned := abs(B2.angle_err) < 7.5")
"""What is computed here, a transition of the same chart reads later, under the words of the computation."""


def built(part: object) -> object:
    """How a formula, an action or a list of them is built."""
    match part:
        case tuple():
            return tuple(map(built, part))
        case Assign(target, value):
            return target.name, structure(value)
        case If(condition, then, otherwise):
            return structure(condition), built(then), built(otherwise)
        case Send(event, receiver):
            return event, receiver
        case Expr():
            return structure(part)
    return part


def charts() -> Iterator[Chart]:
    seen = set[int]()
    for system in systems().values():
        for chart in system.charts:
            if id(chart) not in seen:
                seen.add(id(chart))
                yield chart


def drawn(chart: Chart) -> Iterator[tuple[Path, Transition]]:
    for path, state in chart.states.items():
        yield from ((path, transition) for transition in (*state.default, *state.transitions))
    for path, junction in chart.junctions.items():
        yield from ((path[:-1], transition) for transition in junction.transitions)


def test_every_label_of_the_rover() -> None:
    count = 0
    for chart in charts():
        names = {path: names_of(chart, path) for path in chart.states}
        for path, one in drawn(chart):
            read = transition_of(label(one), names[path])
            told = (read.event, built(read.guard), built(read.do), built(read.then))
            assert told == (one.event, built(one.guard), built(one.do), built(one.then)), label(one)
            count += 1
    assert count > 1000


def test_every_action_of_the_rover() -> None:
    count = 0
    for chart in charts():
        for path, state in chart.states.items():
            lines = action_lines(state)
            if any(words in line for line in lines for words in TWO_MEANINGS):
                continue
            read = state_of("\n".join(lines), names_of(chart, path))
            for kind in ("entry", "during", "exit"):
                assert built(getattr(read, kind)) == built(getattr(state, kind)), lines
                count += len(getattr(state, kind))
    assert count > 1000


def test_the_words_with_two_meanings_are_there_still() -> None:
    lines = {line.strip() for chart in charts() for s in chart.states.values() for line in action_lines(s)}
    assert set(TWO_MEANINGS) <= lines


# --- random formulas and actions -----------------------------------------------------------------

MODE = enumeration("Mode", ["SLOW", "FAST", "T in ]1;2]"])
OTHER = enumeration("Other", ["SLOW", "HALT"])
mode, other = var("mode", MODE), var("B2.other", OTHER)
a, b, keyword, odd = flag("a"), flag("Überdruck"), flag("en"), flag("60 ms are over")
n, m, far = var("n", integer(-5, 9)), var("x.y", fixed(-1, 1, "0.25")), var("far", integer(0, 900, "ms"))
mask = var("mask", integer(0, 255))
nearby = named("n <= 3", n <= 3)
quick = named("T in ]-5;55[", all_of(n > -5, n < 5))
called = named("close(n)", n < 7)
DATA = (mode, other, a, b, keyword, odd, n, m, far, mask, nearby, quick, called)

numbers = st.integers(-90, 90).map(lambda k: const(Fraction(k, 8)))
fractions = st.fractions(-9, 9, max_denominator=20).map(const)
spans = st.one_of(
    st.integers(0, 99).map(lambda k: k * ticks),
    st.integers(0, 99999).map(lambda k: k * ms),
    st.integers(1, 99).map(lambda k: k * sec),
)


def _possible(made: st.SearchStrategy[Expr | None]) -> st.SearchStrategy[Expr]:
    return made.filter(lambda e: e is not None)  # type: ignore[return-value]


def _pairs(*parts: st.SearchStrategy[Expr]) -> st.SearchStrategy[tuple[Expr, ...]]:
    return st.tuples(*parts)


def _number(inner: st.SearchStrategy[Expr]) -> st.SearchStrategy[Expr]:
    pair, divisor = _pairs(inner, inner), st.integers(1, 9)
    return st.one_of(
        pair.map(lambda p: p[0] + p[1]),
        pair.map(lambda p: p[0] - p[1]),
        pair.map(lambda p: p[0] * p[1]),
        pair.map(lambda p: minimum(*p)),
        pair.map(lambda p: maximum(*p)),
        inner.map(lambda e: -e),
        inner.map(absolute),
        st.tuples(inner, divisor).map(lambda p: modulo(*p)),
        st.tuples(st.sampled_from([n, mask]), divisor).map(lambda p: quotient(*p)),
        _pairs(conditions_of(st.sampled_from([a, b])), inner, inner).map(lambda p: ite(*p)),
    )


def conditions_of(leaves: st.SearchStrategy[Expr]) -> st.SearchStrategy[Expr]:
    return st.recursive(
        leaves,
        lambda inner: st.one_of(
            st.lists(inner, min_size=2, max_size=4).map(lambda p: all_of(*p)),
            st.lists(inner, min_size=2, max_size=4).map(lambda p: any_of(*p)),
            inner.map(lambda e: ~e),
            _pairs(inner, inner).map(lambda p: p[0] == p[1]),
            _pairs(inner, inner, inner).map(lambda p: ite(*p)),
        ),
        max_leaves=8,
    )


counted = st.recursive(st.one_of(st.sampled_from([n, m, mask]), numbers), _number, max_leaves=6)
divided = st.recursive(st.one_of(st.sampled_from([n, m, mask]), fractions), _number, max_leaves=6)
SIGNS = (Expr.__lt__, Expr.__le__, Expr.__gt__, Expr.__ge__, Expr.__eq__, Expr.__ne__)
timed = st.one_of(
    spans.map(after),
    st.tuples(st.sampled_from([a, b, quick]), spans).map(lambda p: duration(p[0]) > p[1]),
    st.tuples(st.sampled_from([a, b, n > 3]), spans).map(lambda p: duration(p[0]) >= p[1]),
    st.tuples(st.sampled_from([a, nearby]), spans).map(lambda p: held(*p)),
    st.sampled_from([a, odd, n > 3]).map(rising),
)
conditions = conditions_of(
    st.one_of(
        st.sampled_from([a, b, keyword, odd, nearby, quick, called, bit(mask, 3), const(True), const(False)]),
        st.tuples(st.sampled_from(SIGNS), counted, counted).map(lambda p: p[0](p[1], p[2])),
        st.sampled_from(["SLOW", "FAST", "T in ]1;2]"]).map(lambda name: mode == name),
        st.sampled_from(["SLOW", "HALT"]).map(lambda name: other != name),
        st.integers(0, 900).map(lambda k: far > k),
        timed,
    )
)
simple = st.one_of(
    st.sampled_from(
        [a, b, keyword, odd, nearby, quick, called, ~a, all_of(a, ~b), any_of(a, all_of(b, quick))]
    ),
    st.tuples(st.sampled_from(SIGNS), st.sampled_from([n, m, -n, n + 1]), numbers).map(
        lambda p: p[0](p[1], p[2])
    ),
)
assignments = st.one_of(
    simple.map(lambda e: assign(a, e)),
    st.just(assign(n, ite(a, minimum(n, 3), -n))),
    st.sampled_from(["SLOW", "HALT"]).map(lambda name: assign(other, name)),
    st.tuples(st.sampled_from([n, m, mask]), st.integers(-3, 3)).map(lambda p: assign(*p)),
    st.integers(0, 900).map(lambda k: assign(far, k)),
    st.just(send("stop", "Motor.Left")),
)
actions = st.recursive(
    assignments,
    lambda inner: st.tuples(simple, st.lists(inner, min_size=1, max_size=3), st.lists(inner, max_size=3)).map(
        lambda p: when(*p)
    ),
    max_leaves=6,
)


def _names() -> LabelNames:
    names = LabelNames()
    for datum in DATA:
        names.add(datum)
    return names


NAMES = _names()
VALUES = [
    {v.name: v.domain.values[k % len(v.domain)] for v in DATA if isinstance(v, Var)} for k in range(0, 40, 3)
]


def _worth(expr: Expr, values: dict[str, int]) -> object:
    raw = evaluate(expr, values)
    return raw * expr.sort.resolution if isinstance(expr.sort, Num) else Fraction(raw)


def same(one: Expr, another: Expr) -> bool:
    """Built alike, or of one sort and one value; sums and products may be grouped otherwise."""
    if structure(one) == structure(another):
        return True
    kinds = type(one.sort) is type(another.sort)
    return kinds and all(_worth(one, values) == _worth(another, values) for values in VALUES)


def alike(one: Sequence[Action], another: Sequence[Action]) -> bool:
    return len(one) == len(another) and all(map(_alike, one, another))


def _alike(one: Action, another: Action) -> bool:
    match one, another:
        case Assign(target, value), Assign(target_, value_):
            return target.name == target_.name and same(value, value_)
        case If(test, then, other_), If(test_, then_, other__):
            return same(test, test_) and alike(then, then_) and alike(other_, other__)
    return one == another


def _timeless(expr: Expr) -> bool:
    return not any(word in text(expr) for word in ("after(", "duration(", "held(", "rising("))


@given(conditions)
def test_random_conditions(condition: Expr) -> None:
    read = formula_of(text(condition), NAMES, Bool())
    assert text(read) == text(condition) or _timeless(condition)
    assert not _timeless(condition) or same(read, condition)


@given(divided)
def test_random_numbers(number: Expr) -> None:
    read = formula_of(text(number), NAMES, Num())
    assert same(read, number)
    assert same(formula_of(text(read), NAMES, Num()), number)


@given(
    st.sampled_from([None, "stop", "en"]),
    st.none() | simple,
    st.lists(actions, max_size=3),
    st.lists(actions, max_size=3),
)
def test_random_transitions(
    event: str | None, guard: Expr | None, do: list[Action], then: list[Action]
) -> None:
    event = None if event == "en" else event
    read = transition_of(label(to("X", guard, event, do, then)), NAMES)
    assert read.event == event
    assert guard is None if read.guard is None else guard is not None and same(read.guard, guard)
    shown = label(to("X", read.guard, read.event, read.do, read.then))
    assert shown == label(to("X", guard, event, do, then))


@given(st.lists(actions, max_size=3), st.lists(actions, max_size=3), st.lists(actions, max_size=2))
def test_random_states(entry: list[Action], during: list[Action], exit: list[Action]) -> None:
    """As drawn, with the actions of conditionals indented and without braces."""
    drawn = "\n".join(action_lines(State("S", entry=entry, during=during, exit=exit)))
    read = state_of(drawn, NAMES)
    again = State("S", entry=read.entry, during=read.during, exit=read.exit)
    assert "\n".join(action_lines(again)) == drawn


@pytest.mark.parametrize("expr", [previous(n) > 3, ite(a, mode, Const(1, MODE.sort)) == "FAST"])
def test_words_that_charts_do_not_print(expr: Expr) -> None:
    assert structure(formula_of(text(expr), NAMES)) == structure(expr)


def test_what_is_tried_here_has_all_sorts() -> None:
    kinds = {type(v.sort) for v in DATA}
    assert kinds == {Bool, Enum, Num}
    assert boolean in {v.domain for v in DATA if isinstance(v, Var)}
