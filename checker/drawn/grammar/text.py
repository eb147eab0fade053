"""Expressions as text again, in the language they were written in: for messages."""

from rovercheck.checker.drawn.grammar.operators import operators_of
from rovercheck.checker.drawn.grammar.syntax import (
    ActionLanguage,
    Applied,
    BinaryOperation,
    CellArray,
    ColonRange,
    Expression,
    Indexed,
    LastIndex,
    Matrix,
    Member,
    Name,
    Number,
    NumberKind,
    TextLiteral,
    UnaryOperation,
    WholeRange,
)

__all__ = ["text_of"]

_PREFIXED, _RAISED, _WHOLE = 50, 60, 70
"""How strong an operator before its operand, a power or transpose, and what has no operator outside bind."""
_ESCAPES = {
    "\\": "\\\\",
    "\a": "\\a",
    "\b": "\\b",
    "\f": "\\f",
    "\n": "\\n",
    "\r": "\\r",
    "\v": "\\v",
    "\0": "\\0",
}


def text_of(expression: Expression, language: ActionLanguage) -> str:
    """An expression as a text that is read as the same expression, up to the bounds of the reader."""
    return _ExpressionWriter(language).text(expression)


class _ExpressionWriter:
    def __init__(self, language: ActionLanguage) -> None:
        self.matlab = language is ActionLanguage.MATLAB
        table = operators_of(language)
        self.prefix = {operator: sign for sign, operator in reversed(table.prefix.items())}
        self.infix = {operator: (level, sign) for sign, (level, operator) in reversed(table.infix.items())}
        self.power = {operator: sign for sign, operator in table.power.items()}

    def text(self, expression: Expression, least: int = 0) -> str:
        """The text, in brackets if it binds less than that."""
        text, strength = self._bare(expression)
        return f"({text})" if strength < least else text

    def _bare(self, expression: Expression) -> tuple[str, int]:
        match expression:
            case UnaryOperation("'" | ".'" as operator, operand):
                text = self.text(operand, _RAISED)
                # a quote behind a text would be a part of it
                return (f"({text})" if text.endswith("'") and operator == "'" else text) + operator, _RAISED
            case UnaryOperation(operator, operand):
                sign, text = self.prefix[operator], self.text(operand, _PREFIXED)
                return f"{sign} {text}" if text.startswith(sign) else sign + text, _PREFIXED
            case BinaryOperation(operator, left, right) if operator in self.power:
                text = f"{self.text(left, _RAISED)}{self.power[operator]}{self.text(right, _WHOLE)}"
                return text, _RAISED
            case BinaryOperation(operator, left, right):
                level, sign = self.infix[operator]
                return f"{self.text(left, level)} {sign} {self.text(right, level + 1)}", level
            case ColonRange(start, step, stop):
                level = self.infix[":"][0]
                bounds = [start, stop] if step is None else [start, step, stop]
                return ":".join(self.text(bound, level + 1) for bound in bounds), level
            case _:
                return self._operand(expression), _WHOLE

    def _operand(self, expression: Expression) -> str:
        match expression:
            case Number(_, kind, text):
                return text + ("F" if kind is NumberKind.SINGLE else "")
            case TextLiteral(value, quote):
                return self._quoted(value, quote)
            case Name(name):
                return name
            case Member(owner, name, arrow):
                return f"{self.text(owner, _WHOLE)}{'->' if arrow else '.'}{name}"
            case Applied(function, arguments):
                return f"{self.text(function, _WHOLE)}({', '.join(map(self.text, arguments))})"
            case Indexed(array, index):
                return f"{self.text(array, _WHOLE)}[{self.text(index)}]"
            case WholeRange():
                return ":"
            case LastIndex():
                return "end"
            case Matrix(rows):
                return f"[{self._rows(rows)}]"
            case CellArray(rows):
                return f"{{{self._rows(rows)}}}"
            case _:
                raise AssertionError(expression)

    def _rows(self, rows: tuple[tuple[Expression, ...], ...]) -> str:
        return "; ".join(", ".join(map(self.text, row)) for row in rows)

    def _quoted(self, value: str, quote: str) -> str:
        if not self.matlab:
            value = "".join(_ESCAPES.get(character, character) for character in value)
        doubled = self.matlab or quote == "'"
        return quote + value.replace(quote, 2 * quote if doubled else f"\\{quote}") + quote
