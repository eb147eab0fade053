"""Operators in the texts of a chart, and where a result has no meaning, or does not fit its type."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
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
from rovercheck.checker.drawn.lower.elements import ElementWriter
from rovercheck.checker.drawn.lower.names import TextScope
from rovercheck.checker.drawn.lower.symbols import (
    Symbolic,
    folded,
)
from rovercheck.spec_model.lang.expr import TRUE, Expr, all_of, any_of

ONE = Number(Fraction(1), NumberKind.INTEGER, "1")
"""What ``x++`` adds."""


class OperatorWriter(ElementWriter):
    """Writes operators; ``only_if`` is the condition under which what is computed is looked at.

    ``language`` is that of the chart, but for its MATLAB functions.
    """

    only_if: Expr = TRUE
    language = ActionLanguage.MATLAB

    def operated(self, whole: BinaryOperation, one: Symbolic, other: Symbolic, scope: TextScope) -> Symbolic:
        """The value of an operation of two values.  Raises ``NotLowered``."""
        sign, rules = whole.operator, scope.rules
        if zero := zeros_of(sign, one, other, rules):
            said = f"`{self._text(whole, scope)}` {BY_ZERO}"
            self.writer.choose(folded(any_of(*zero)), lambda: self.writer.fault(said))
            rules = replace(rules, zero_noted=True)
        with self.noting(whole, scope) as outside:
            return binary(sign, one, other, replace(rules, outside=outside))

    @contextmanager
    def noting(self, whole: Expression, scope: TextScope) -> Iterator[Callable[[str, Expr], None]]:
        """Note once where a value, or an element of it, does not fit its type while it is computed."""
        found: dict[str, list[Expr]] = {}
        yield lambda kind, condition: found.setdefault(kind, []).append(condition)
        for kind, conditions in found.items():
            self._note_outside(self._text(whole, scope), kind, folded(any_of(*conditions)), scope)

    def assigning(self, scope: TextScope, *sides: Expression) -> TextScope:
        """The scope of an assignment, in which is noted before it where a value does not fit its type."""

        def outside(kind: str, condition: Expr) -> None:
            shown = " = ".join(self._text(one, scope) for one in sides)
            self._note_outside(shown, kind, condition, scope)

        return replace(scope, rules=replace(scope.rules, outside=outside))

    def _note_outside(self, shown: str, kind: str, condition: Expr, scope: TextScope) -> None:
        said = f"`{shown}` {scope.rules.left(kind)} in {scope.node.path}"
        self.note_overflow(said, folded(all_of(self.only_if, condition)))

    def _text(self, expression: Expression, scope: TextScope) -> str:
        return text_of(expression, self.language if scope.rules.c else ActionLanguage.MATLAB)

    def note_overflow(self, what: str, condition: Expr) -> None:
        """Note where a result does not fit its type; where nothing is noted it is no matter."""


def compound(sign: BinaryOperator, target: Expression, value: Expression) -> BinaryOperation:
    """What ``target += value`` computes."""
    return BinaryOperation(sign, target, value)


def division_in(expression: Expression) -> Iterator[BinaryOperation]:
    """An expression, if it is a division."""
    if isinstance(expression, BinaryOperation) and expression.operator in DIVISIONS:
        yield expression


__all__ = ["ONE", "OperatorWriter", "compound", "division_in"]
