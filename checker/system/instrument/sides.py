"""The comparisons and timers that a formula consists of: when each is at a boundary, and when it decides."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import product
from math import prod

from rovercheck.spec_model.lang.domain import Bool, Num
from rovercheck.spec_model.lang.evaluate import evaluate
from rovercheck.spec_model.lang.expr import FALSE, TRUE, Apply, Const, Expr, Named, Temporal, Var, When
from rovercheck.spec_model.lang.label import text
from rovercheck.spec_model.lang.operators import COMPARISONS, Op
from rovercheck.spec_model.lang.time import ticks
from rovercheck.spec_model.lang.walk import children, structure, variables

COUNTED = (When.AFTER, When.DURATION, When.HELD)
MOST = 4096
"""Combinations of values that are tried to find the nearest beside a boundary; beyond, any value counts."""
CONNECTIVES = (Op.NOT, Op.AND, Op.OR, Op.ITE)


@dataclass(frozen=True)
class AtomSide:
    """A side of a boundary in words, and the condition under which a formula is evaluated there."""

    text: str
    condition: Expr


def sides(expr: Expr, step_ms: int) -> Iterator[AtomSide]:
    """Every side of every comparison and timer in a formula; equal ones once."""
    seen: set[tuple[object, ...]] = set()
    for atom in _atoms(expr):
        key = structure(atom)
        if key not in seen:
            seen.add(key)
            yield from _sides(atom, step_ms)


def deciding_sides(expr: Expr, step_ms: int) -> Iterator[AtomSide]:
    """For every condition of every decision in a formula: true where it decides, and false where it does.

    A condition decides where the decision would be the other way if it alone were (modified
    condition/decision coverage, DO-178C, with masking).  A comparison is to do so on both sides of its limit,
    a timer one step early and when it has just run out: a limit that is wrong by one step is then seen.
    """
    seen: set[tuple[object, ...]] = set()
    for decision in _decisions(expr):
        whole = structure(decision)
        if whole in seen:
            continue
        seen.add(whole)
        alike: set[tuple[object, ...]] = set()
        for atom in _conditions(decision):
            key = structure(atom)
            if key not in alike:
                alike.add(key)
                decides = _with(decision, key, TRUE) != _with(decision, key, FALSE)
                for side in _next_to_limit(atom, step_ms):
                    yield AtomSide(f"{side.text} and decides", side.condition & decides)


def _decisions(expr: Expr) -> Iterator[Expr]:
    """The largest formulas with a truth value, and those that stand inside of their conditions."""
    if not isinstance(expr.sort, Bool):
        for child in children(expr):
            yield from _decisions(child)
        return
    yield expr
    for atom in _conditions(expr):
        for child in children(atom):
            if not isinstance(child, Var):
                yield from _decisions(child)


def _conditions(decision: Expr) -> Iterator[Expr]:
    """The conditions that connectives make a decision of."""
    match decision:
        case Named(_, body):
            yield from _conditions(body)
        case Apply(op, args, Bool()) if op in CONNECTIVES:
            for arg in args:
                yield from _conditions(arg)
        case Const():
            pass
        case _:
            yield decision


def _with(decision: Expr, key: tuple[object, ...], value: Expr) -> Expr:
    """The decision with a value for a condition, wherever that occurs in it."""
    match decision:
        case Named(_, body):
            return _with(body, key, value)
        case Apply(op, args, Bool()) if op in CONNECTIVES:
            return replace(decision, args=tuple(_with(arg, key, value) for arg in args))
        case _:
            return value if structure(decision) == key else decision


def _next_to_limit(atom: Expr, step_ms: int) -> list[AtomSide]:
    """The sides between which a condition changes its truth."""
    found = list(_sides(atom, step_ms))
    match atom:
        case Temporal(when, _, span) if when in COUNTED and span is not None:
            return found[:2]
        case Apply(Op.LT | Op.GE, (left, _), _) if isinstance(left.sort, Num):
            return found[:2]
        case Apply(Op.LE | Op.GT, (left, _), _) if isinstance(left.sort, Num):
            return found[1:]
    return found


def _atoms(expr: Expr) -> Iterator[Expr]:
    """The conditions in a formula that no connective builds, inside arithmetic and timers too."""
    match expr:
        case Apply(op, _, Bool()) if op not in CONNECTIVES:
            yield expr
        case Var(_, domain) if isinstance(domain.sort, Bool):
            yield expr
        case Temporal():
            yield expr
    for child in children(expr):
        inside = _truth_of_a_datum(expr, child)
        yield from () if inside else _atoms(child)


def _truth_of_a_datum(expr: Expr, child: Expr) -> bool:
    """Whether the child is a truth value whose comparison already is the condition."""
    return isinstance(expr, Apply) and expr.op in COMPARISONS and isinstance(child, Var)


def _sides(atom: Expr, step_ms: int) -> Iterator[AtomSide]:
    match atom:
        case Temporal(when, _, span) if when in COUNTED and span is not None:
            yield from _timer(atom, step_ms)
        case Apply(op, (left, right), _) if op in COMPARISONS and isinstance(left.sort, Num):
            yield from _numbers(atom, left, right)
        case _:
            yield AtomSide(f"{text(atom)} true", atom)
            yield AtomSide(f"{text(atom)} false", ~atom)


def _timer(word: Temporal, step_ms: int) -> Iterator[AtomSide]:
    """The step before a timer runs out, the step in which it does, and the one after."""
    assert word.span is not None
    last = word.span.ticks(step_ms) + (1 if word.when is When.DURATION and word.strict else 0)
    for count, said in ((last - 1, "one step early"), (last, "just run out"), (last + 1, "one step late")):
        exactly = _at_least(word, count) & ~_at_least(word, count + 1)
        yield AtomSide(f"{text(word)} {said}", exactly)


def _at_least(word: Temporal, count: int) -> Expr:
    """The condition that the timer has counted so far."""
    always = count < 0 if word.when is When.HELD else count <= 0
    return TRUE if always else replace(word, span=count * ticks, strict=False)


def _numbers(atom: Expr, left: Expr, right: Expr) -> Iterator[AtomSide]:
    """The nearest difference of two numbers below zero, none, and the nearest above."""
    assert isinstance(left.sort, Num)
    difference = Apply(Op.SUB, (left, right), left.sort)
    below, above = _nearest(difference)

    def compared(op: Op, value: int) -> Expr:
        return Apply(op, (difference, Const(value, difference.sort)), Bool())

    low = TRUE if below is None else compared(Op.GE, below)
    high = TRUE if above is None else compared(Op.LE, above)
    yield AtomSide(f"{text(atom)} just below", compared(Op.LT, 0) & low)
    yield AtomSide(f"{text(atom)} at it", compared(Op.EQ, 0))
    yield AtomSide(f"{text(atom)} just above", compared(Op.GT, 0) & high)


def _nearest(difference: Expr) -> tuple[int | None, int | None]:
    """The largest negative and the least positive value, or None: none, or too many combinations to try."""
    data = variables(difference)
    if prod(len(v.domain) for v in data.values()) > MOST:
        return None, None
    combinations = product(*(v.domain.values for v in data.values()))
    found = {evaluate(difference, dict(zip(data, values, strict=True))) for values in combinations}
    return max((v for v in found if v < 0), default=None), min((v for v in found if v > 0), default=None)
