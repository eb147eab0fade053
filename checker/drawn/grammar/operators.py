"""Which operators each language has, how they are written, and which bind stronger."""

from dataclasses import dataclass
from typing import Literal, TypeAlias

from rovercheck.checker.drawn.grammar.syntax import ActionLanguage, BinaryOperator, UnaryOperator

__all__ = ["COLON", "OperatorTable", "RangeOperator", "operators_of"]

RangeOperator: TypeAlias = Literal[":"]
COLON: RangeOperator = ":"


@dataclass(frozen=True, slots=True)
class OperatorTable:
    """The operators of a language by their signs; of signs with one meaning the first is the one to write.

    ``infix`` says how strong each binds, all to the left; ``power`` binds stronger than all of them and than
    ``prefix``; ``assignment`` says what ``+=`` and its like do besides (nothing, of ``=``).
    """

    infix: dict[str, tuple[int, BinaryOperator | RangeOperator]]
    power: dict[str, BinaryOperator]
    prefix: dict[str, UnaryOperator]
    assignment: dict[str, BinaryOperator | None]


_COMPARISONS: dict[str, BinaryOperator] = {"<": "<", "<=": "<=", ">": ">", ">=": ">="}
_EQUALITIES: dict[str, BinaryOperator] = {"==": "==", "~=": "!=", "!=": "!="}
_C_EQUALITIES: dict[str, BinaryOperator] = {"==": "==", "!=": "!=", "~=": "!=", "<>": "!="}
_PLAIN: dict[str, BinaryOperator | None] = {"=": None, "+=": "+", "-=": "-", "*=": "*", "/=": "/"}


def _levels(*rows: dict[str, BinaryOperator] | str) -> dict[str, tuple[int, BinaryOperator | RangeOperator]]:
    """Rows of operators, the weakest first."""
    found: dict[str, tuple[int, BinaryOperator | RangeOperator]] = {}
    for strength, row in enumerate(rows, 1):
        if isinstance(row, str):
            found[COLON] = strength, COLON
        else:
            found.update({sign: (strength, operator) for sign, operator in row.items()})
    return found


_MATLAB = OperatorTable(
    infix=_levels(
        {"||": "||"},
        {"&&": "&&"},
        {"|": "|"},
        {"&": "&"},
        _COMPARISONS | _EQUALITIES,
        COLON,
        {"+": "+", "-": "-"},
        {"*": "*", "/": "/", "\\": "\\", ".*": ".*", "./": "./", ".\\": ".\\"},
    ),
    power={"^": "^", ".^": ".^"},
    prefix={"-": "-", "+": "+", "~": "!", "!": "!"},
    assignment=_PLAIN | {"&=": "&", "|=": "|", "^=": "^"},
)
_C_PREFIX: dict[str, UnaryOperator] = {"-": "-", "+": "+", "!": "!", "&": "address", "*": "pointee"}
_C = OperatorTable(
    infix=_levels(
        {"||": "||"},
        {"&&": "&&"},
        {"|": "|"},
        {"&": "&"},
        _C_EQUALITIES,
        _COMPARISONS,
        {"<<": "<<", ">>": ">>"},
        {"+": "+", "-": "-"},
        {"*": "*", "/": "/", "%%": "%%"},
    ),
    power={"^": "^"},
    prefix=_C_PREFIX | {"~": "!"},
    assignment=_PLAIN | {":=": None, "&=": "&", "|=": "|", "^=": "^"},
)
_C_BITS = OperatorTable(
    infix=_levels(
        {"||": "||"},
        {"&&": "&&"},
        {"|": "bit|"},
        {"^": "bit^"},
        {"&": "bit&"},
        _C_EQUALITIES,
        _COMPARISONS,
        {"<<": "<<", ">>": ">>"},
        {"+": "+", "-": "-"},
        {"*": "*", "/": "/", "%%": "%%"},
    ),
    power={},
    prefix=_C_PREFIX | {"~": "bit~"},
    assignment=_PLAIN | {":=": None, "&=": "bit&", "|=": "bit|", "^=": "bit^"},
)
_TABLES = {ActionLanguage.MATLAB: _MATLAB, ActionLanguage.C: _C, ActionLanguage.C_BITS: _C_BITS}


def operators_of(language: ActionLanguage) -> OperatorTable:
    """The operators of a language."""
    return _TABLES[language]
