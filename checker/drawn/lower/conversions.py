"""Formulas of one type as formulas of another: truth values, members and numbers, in their ranges."""

from collections.abc import Callable
from dataclasses import dataclass, field

from rovercheck.checker.drawn.lower.kinds import KindTable, is_member
from rovercheck.checker.drawn.lower.rounding import MOST_CASES, nearest_of, sum_of, toward_zero
from rovercheck.checker.drawn.lower.symbols import (
    INTEGERS,
    LOGICAL,
    REALS,
    UNTYPED,
    NotLowered,
    Symbolic,
    SymbolicArray,
    SymbolicScalar,
    chosen,
    flat,
    folded,
    least_and_greatest,
    truth,
)
from rovercheck.spec_model.lang.domain import Bool, Num
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, all_of, any_of, const
from rovercheck.spec_model.lang.operators import Op


@dataclass(frozen=True)
class IntegerRules:
    """Whether numbers are those of C, and whether integers stop at their ends; else they wrap.

    ``zero_noted``: where something is divided by 0 the step has no meaning, which is noted.  ``outside``
    takes each type that a number does not fit, with the condition of it, where that is told.
    """

    c: bool = False
    saturates: bool = True
    zero_noted: bool = False
    outside: Callable[[str, Expr], None] | None = field(default=None, compare=False)

    def left(self, kind: str) -> str:
        """What happens to a number that an integer type does not hold."""
        return f"{'stops at an end of' if self.saturates else 'wraps around the ends of'} {kind}"


WRAPS = IntegerRules(False, False)
"""Integers that wrap, of which nothing is told."""


def as_number(value: SymbolicScalar) -> Expr:
    """Any scalar as a formula of numbers: true is 1, a member its number."""
    sort = value.expr.sort
    if isinstance(sort, Num):
        return value.expr
    if isinstance(sort, Bool):
        return chosen(value.expr, const(1), const(0))
    if isinstance(value.expr, Const):
        return const(value.expr.value)
    first, *others = (raw for _, raw in sort.members)
    made: Expr = const(first)
    for raw in others:
        made = chosen(folded(value.expr == Const(raw, sort)), const(raw), made)
    return made


def as_condition(value: SymbolicScalar) -> Expr:
    """Any scalar as a condition: anything but 0."""
    if isinstance(value.expr.sort, Bool):
        return value.expr
    return folded(as_number(value) != 0)


def condition_of(value: Symbolic) -> Expr:
    """A value as a condition: of a matrix all of it, if there is anything."""
    every = [as_condition(one) for one in flat(value)]
    return folded(all_of(*every)) if every else folded(~all_of())


def in_range(expr: Expr, kind: str, rules: IntegerRules) -> Expr:
    """A whole number in an integer type."""
    low, high = INTEGERS[kind]
    least, greatest = least_and_greatest(expr)
    if low <= least and greatest <= high:
        return expr
    if rules.outside is not None:
        beyond = [expr > high] * (greatest > high) + [expr < low] * (least < low)
        rules.outside(kind, folded(any_of(*map(folded, beyond))))
    if rules.saturates:
        if greatest > high:
            expr = folded(Apply(Op.MIN, (expr, const(high)), Num()))
        return folded(Apply(Op.MAX, (expr, const(low)), Num())) if least < low else expr
    shifted = sum_of(expr, const(-low)) if low else expr
    turned = folded(Apply(Op.MOD, (shifted, const(high - low + 1)), Num()))
    return sum_of(turned, const(low)) if low else turned


def converted(value: SymbolicScalar, kind: str, rules: IntegerRules, kinds: KindTable) -> SymbolicScalar:
    """A scalar in another type: rounded, and in its range.  Raises ``NotLowered``."""
    if value.kind == kind:
        return value
    if kind == LOGICAL:
        return truth(as_condition(value))
    expr = as_number(value)
    if kind in REALS:
        return SymbolicScalar(kind, expr)
    if kind in INTEGERS:
        whole = toward_zero(expr) if rules.c else nearest_of(expr)
        return SymbolicScalar(kind, in_range(whole, kind, rules))
    if is_member(kind):
        return _member(expr, kind, kinds)
    if kind == UNTYPED:
        return SymbolicScalar(kind, toward_zero(expr))
    raise NotLowered(f"the type {kind!r} is not known")


def _member(expr: Expr, kind: str, kinds: KindTable) -> SymbolicScalar:
    """The member of a number; of a number that is none, the default one."""
    domain = kinds.domain(kind)
    assert domain is not None
    if isinstance(expr, Const):
        if expr.value not in domain or expr.sort != Num():
            raise NotLowered(f"{expr} is no member of {domain.sort}")
        return SymbolicScalar(kind, Const(expr.value, domain.sort))
    low, high = least_and_greatest(expr)
    outside = high - low >= MOST_CASES or any(value not in domain for value in range(int(low), int(high) + 1))
    if outside:
        raise NotLowered(f"`{expr}` may be no member of {domain.sort}: convert each number by itself")
    first, *others = domain.values
    made: Expr = Const(first, domain.sort)
    for raw in others:
        made = chosen(folded(expr == raw), Const(raw, domain.sort), made)
    return SymbolicScalar(kind, made)


def each_converted(value: Symbolic, kind: str, rules: IntegerRules, kinds: KindTable) -> Symbolic:
    """All scalars of a value in another type; of a structure none."""
    match value:
        case SymbolicScalar():
            return converted(value, kind, rules, kinds)
        case SymbolicArray(_, rows, columns, values):
            made = tuple(converted(one, kind, rules, kinds) for one in values)
            return SymbolicArray(kind, rows, columns, made)
    return value


__all__ = [
    "WRAPS",
    "IntegerRules",
    "as_condition",
    "as_number",
    "condition_of",
    "converted",
    "each_converted",
    "in_range",
]
