"""Operators in the texts of a chart, and where a result has no meaning, or does not fit its type."""

from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction

from rovercheck.checker.drawn.faults import BY_ZERO
from rovercheck.checker.drawn.grammar.syntax import (
    ActionLanguage,
    BinaryOperation,
    BinaryOperator,
    Expression,
    Number,
    NumberKind,
)
from rovercheck.checker.drawn.grammar.text import text_of
from rovercheck.checker.drawn.lower.arithmetic import DIVISIONS, binary, zeros_of
from rovercheck.checker.drawn.lower.conversions import as_number
from rovercheck.checker.drawn.lower.elements import ElementWriter
from rovercheck.checker.drawn.lower.names import TextScope
from rovercheck.checker.drawn.lower.symbols import (
    INTEGERS,
    Symbolic,
    SymbolicScalar,
    flat,
    folded,
    least_and_greatest,
    matrix,
    size_of,
)
from rovercheck.spec_model.lang.domain import Num
from rovercheck.spec_model.lang.expr import TRUE, Expr, all_of, any_of, const

CLOSED = ("+", "-", "*", ".*")
"""Operators of integers whose results may be more than their type holds."""


ONE = Number(Fraction(1), NumberKind.INTEGER, "1")
"""What ``x++`` adds."""


class OperatorWriter(ElementWriter):
    """Writes operators; ``only_if`` is the condition under which what is computed is looked at."""

    only_if: Expr = TRUE

    def operated(self, whole: BinaryOperation, one: Symbolic, other: Symbolic, scope: TextScope) -> Symbolic:
        """The value of an operation of two values.  Raises ``NotLowered``."""
        sign, rules = whole.operator, scope.rules
        if zero := zeros_of(sign, one, other, rules):
            said = f"{_shown(whole, scope)} {BY_ZERO}"
            self.writer.choose(folded(any_of(*zero)), lambda: self.writer.fault(said))
            return binary(sign, one, other, replace(rules, zero_noted=True))
        made = binary(sign, one, other, rules)
        if sign in CLOSED and made.kind in INTEGERS:
            exact = binary(sign, _as_real(one), _as_real(other), rules)
            outside = [c for e in flat(exact) for c in _outside(as_number(e), made.kind, rules.c)]
            if outside:
                how = "stops at an end of" if rules.saturates else "wraps around the ends of"
                said = f"{_shown(whole, scope)} {how} {made.kind} in {scope.node.path}"
                self.note_overflow(said, folded(all_of(self.only_if, folded(any_of(*outside)))))
        return made

    def note_overflow(self, what: str, condition: Expr) -> None:
        """Note where a result does not fit its type; where nothing is noted it is no matter."""


def _shown(whole: BinaryOperation, scope: TextScope) -> str:
    return f"`{text_of(whole, ActionLanguage.C_BITS if scope.rules.c else ActionLanguage.MATLAB)}`"


def _as_real(value: Symbolic) -> Symbolic:
    made = [SymbolicScalar("double", as_number(one)) for one in flat(value)]
    return matrix(made, *size_of(value))


def _outside(exact: Expr, kind: str, c: bool) -> Iterator[Expr]:
    """The conditions under which a number is rounded to none of a type of integers."""
    (low, high), (least, most) = INTEGERS[kind], least_and_greatest(exact)
    beyond = Fraction(1) if c else Fraction(1, 2)
    assert isinstance(exact.sort, Num)
    if most >= high + beyond:
        yield folded(exact >= const(high + beyond))
    if least <= low - beyond:
        yield folded(exact <= const(low - beyond))


def compound(sign: BinaryOperator, target: Expression, value: Expression) -> BinaryOperation:
    """What ``target += value`` computes."""
    return BinaryOperation(sign, target, value)


def division_in(expression: Expression) -> Iterator[BinaryOperation]:
    """An expression, if it is a division."""
    if isinstance(expression, BinaryOperation) and expression.operator in DIVISIONS:
        yield expression


__all__ = ["ONE", "OperatorWriter", "compound", "division_in"]
