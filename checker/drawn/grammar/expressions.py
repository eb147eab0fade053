"""Expressions of charts, read with the precedences of their language.

Operators are joined on a stack, not by functions that call each other: only brackets make a reader go deeper,
and of these ``MOST_NESTED`` may stand in each other.
"""

from typing import Literal, TypeAlias

from rovercheck.checker.drawn.grammar.cursor import Cursor, read_whole
from rovercheck.checker.drawn.grammar.literals import number, quoted_text
from rovercheck.checker.drawn.grammar.operators import COLON, RangeOperator, operators_of
from rovercheck.checker.drawn.grammar.syntax import (
    ActionLanguage,
    Applied,
    BinaryOperation,
    BinaryOperator,
    CellArray,
    ColonRange,
    Expression,
    Indexed,
    LastIndex,
    Matrix,
    Member,
    Name,
    UnaryOperation,
    UnaryOperator,
    WholeRange,
    operands,
)
from rovercheck.checker.drawn.grammar.tokens import Token, TokenKind

__all__ = ["MOST_TALL", "argument_list", "entry", "expression", "parse_expression"]

MOST_TALL = 200
"""So many operators may be applied to each other's results, as in a sum of one number more."""

_CONVERSIONS = frozenset(
    [
        "double", "single", "int8", "int16", "int32", "int64", "uint8", "uint16", "uint32", "uint64",
        "boolean", "logical",
    ]
)  # fmt: skip
_TRANSPOSES: dict[str, UnaryOperator] = {"'": "'", ".'": ".'"}
_Before: TypeAlias = tuple[UnaryOperator | Literal["cast"], Token]
_Between: TypeAlias = tuple[int, BinaryOperator | RangeOperator, int]


def parse_expression(text: str, language: ActionLanguage) -> Expression:
    """The tree of a text that is one expression, over several lines or not; raises ``GrammarError``."""

    def whole(cursor: Cursor) -> Expression:
        with cursor.inside("brackets"):
            return expression(cursor)

    return read_whole(text, language, whole, "the expression")


def expression(cursor: Cursor) -> Expression:
    """The expression that is next; raises ``GrammarError``, also for one taller than ``MOST_TALL``."""
    at = cursor.token.at
    found = _expression(cursor)
    waiting = [(found, 1)]
    while waiting:
        part, depth = waiting.pop()
        if depth > MOST_TALL:
            cursor.fail(
                f"more than {MOST_TALL} operators are applied to each other's results: "
                "put brackets around parts, or name them",
                at,
            )
        waiting += [(operand, depth + 1) for operand in operands(part)]
    return found


def entry(cursor: Cursor) -> Expression:
    """The next entry between ``[`` and ``]``: a blank may end it."""
    with cursor.inside("entries"):
        return expression(cursor)


def _expression(cursor: Cursor) -> Expression:
    found = [_operand(cursor)]
    pending: list[_Between] = []
    while operator := _operator_ahead(cursor):
        # Colons wait for each other: `a:b:c` is one range.
        while pending and (
            pending[-1][0] > operator[0] or (pending[-1][0] == operator[0] and operator[1] != COLON)
        ):
            _join(cursor, found, pending)
        cursor.advance()
        pending.append(operator)
        found.append(_operand(cursor))
    while pending:
        _join(cursor, found, pending)
    return found[0]


def _operator_ahead(cursor: Cursor) -> _Between | None:
    """The operator that goes on with the expression, if one does."""
    table = operators_of(cursor.language).infix
    token = cursor.token
    if token.kind is TokenKind.LINE and cursor.surroundings == "lines" and not cursor.matlab:
        # A statement of C goes on in the next line where an operator says so.
        after = cursor.behind_lines()
        if after.kind is TokenKind.SIGN and after.text in table:
            cursor.skip_lines()
            token = after
    if token.kind is not TokenKind.SIGN or token.text not in table:
        return None
    if cursor.surroundings == "entries" and token.text in "+-" and token.blank and not cursor.ahead().blank:
        return None
    strength, operator = table[token.text]
    return strength, operator, token.at


def _join(cursor: Cursor, found: list[Expression], pending: list[_Between]) -> None:
    """Apply the last operator to the last operands."""
    _, operator, at = pending.pop()
    right, left = found.pop(), found.pop()
    if operator != COLON:
        found.append(BinaryOperation(operator, left, right, at))
        return
    step = None
    if pending and pending[-1][1] == COLON:
        at = pending.pop()[2]
        left, step = found.pop(), left
        if pending and pending[-1][1] == COLON:
            cursor.fail("a range has at most three parts, start:step:stop", at)
    found.append(ColonRange(left, step, right, at))


def _operand(cursor: Cursor) -> Expression:
    before = _prefixes(cursor)
    found = _postfix(cursor)
    powers = operators_of(cursor.language).power
    while cursor.token.kind is TokenKind.SIGN:
        token = cursor.token
        if cursor.matlab and token.text in _TRANSPOSES:
            cursor.advance()
            found = UnaryOperation(_TRANSPOSES[token.text], found, token.at)
        elif token.text in powers:
            cursor.advance()
            signs = _prefixes(cursor)
            exponent = _prefixed(signs, _postfix(cursor))
            found = BinaryOperation(powers[token.text], found, exponent, token.at)
        else:
            break
    return _prefixed(before, found)


def _prefixes(cursor: Cursor) -> list[_Before]:
    """The operators and conversions in brackets that stand before an operand."""
    table = operators_of(cursor.language).prefix
    found: list[_Before] = []
    if not cursor.matlab:
        cursor.skip_lines()
    while cursor.token.kind is TokenKind.SIGN:
        token = cursor.token
        if token.text in table:
            cursor.advance()
            found.append((table[token.text], token))
        elif _is_cast(cursor):
            cursor.advance()
            found.append(("cast", cursor.advance()))
            cursor.advance()
        else:
            break
    return found


def _is_cast(cursor: Cursor) -> bool:
    """Whether ``(uint8)`` is next."""
    name, close = cursor.ahead(1), cursor.ahead(2)
    return not cursor.matlab and cursor.at_sign("(") and name.text in _CONVERSIONS and close.text == ")"


def _prefixed(before: list[_Before], found: Expression) -> Expression:
    for operator, token in reversed(before):
        if operator == "cast":
            found = Applied(Name(token.text, token.at), (found,), token.at)
        else:
            found = UnaryOperation(operator, found, token.at)
    return found


def _postfix(cursor: Cursor) -> Expression:
    """An operand with what is applied to it: members, arguments, indices."""
    named = cursor.token.kind is TokenKind.NAME
    found = _primary(cursor)
    while cursor.token.kind is TokenKind.SIGN:
        token = cursor.token
        if cursor.surroundings == "entries" and token.blank:
            break
        if token.text == "." or (token.text == "->" and not cursor.matlab):
            cursor.advance()
            found = _member(cursor, found, token)
            named = True
        elif token.text == "(" and named:
            found = Applied(found, argument_list(cursor), found.at)
        elif token.text == "[" and not cursor.matlab:
            cursor.advance()
            with cursor.inside("brackets"):
                index = _expression(cursor)
                cursor.expect("]", "an index of C is one expression in [ ], and a second one has its own")
            found = Indexed(found, index, found.at)
        elif token.text == "{" and named and cursor.matlab and not token.blank:
            cursor.fail("elements of cell arrays, as in c{1}, are not supported: use an array and c(1)")
        else:
            break
    return found


def _member(cursor: Cursor, owner: Expression, dot: Token) -> Expression:
    token = cursor.token
    if token.text == "(":
        cursor.fail("a field whose name is computed, as in s.(name), is not supported: write its name")
    if token.kind is not TokenKind.NAME:
        cursor.fail(f"{cursor.shown()} stands behind '{dot.text}', where the name of a field or member must")
    cursor.advance()
    return Member(owner, token.text, dot.text == "->", owner.at)


def argument_list(cursor: Cursor) -> tuple[Expression, ...]:
    """The arguments in round brackets that are next."""
    cursor.advance()
    found: list[Expression] = []
    with cursor.inside("brackets", index=True):
        while not cursor.at_sign(")"):
            if found:
                cursor.expect(",", "arguments are separated by commas")
            found.append(_argument(cursor))
        cursor.advance()
    return tuple(found)


def _argument(cursor: Cursor) -> Expression:
    if cursor.matlab and cursor.at_sign(COLON):
        at = cursor.advance().at
        if not cursor.at_sign(",", ")"):
            cursor.fail("':' as an index stands alone: write start:stop")
        return WholeRange(at)
    return _expression(cursor)


def _primary(cursor: Cursor) -> Expression:
    token = cursor.token
    match token.kind:
        case TokenKind.NUMBER:
            return number(cursor)
        case TokenKind.TEXT:
            return quoted_text(cursor)
        case TokenKind.NAME:
            return _name(cursor)
        case TokenKind.SIGN if token.text == "(":
            cursor.advance()
            with cursor.inside("brackets"):
                inner = _expression(cursor)
                cursor.expect(")", "what stands in round brackets is one expression")
            return inner
        case TokenKind.SIGN if token.text == "[":
            return Matrix(_rows(cursor, "]"), token.at)
        case TokenKind.SIGN if token.text == "{" and cursor.matlab:
            return CellArray(_rows(cursor, "}"), token.at)
        case TokenKind.SIGN if token.text == "@":
            cursor.fail("function handles, as in @f, are not supported: call the function by its name")
        case TokenKind.SIGN if token.text in ("++", "--"):
            cursor.fail(f"'{token.text}' has no value: write it as a statement of its own, x{token.text};")
        case _:
            cursor.fail(f"{cursor.shown()} stands where an operand must: a name, a number, or a bracket")


def _name(cursor: Cursor) -> Expression:
    token = cursor.token
    if cursor.matlab and token.text == "end" and cursor.in_index:
        cursor.advance()
        return LastIndex(token.at)
    if cursor.is_keyword(token):
        cursor.fail(f"'{token.text}' is a keyword and has no value: an operand must stand here")
    cursor.advance()
    return Name(token.text, token.at)


def _rows(cursor: Cursor, close: str) -> tuple[tuple[Expression, ...], ...]:
    """The rows of a matrix or cell array, whose opening bracket is next."""
    cursor.advance()
    rows: list[list[Expression]] = [[]]
    with cursor.inside("entries"):
        separated = True
        while not cursor.at_sign(close):
            if cursor.token.kind is TokenKind.LINE or cursor.at_sign(";"):
                cursor.advance()
                rows.append([])
                separated = True
            elif cursor.at_sign(","):
                if not rows[-1] or separated:
                    cursor.fail("an entry is missing before ','")
                cursor.advance()
                separated = True
            elif separated or cursor.token.blank:
                rows[-1].append(_expression(cursor))
                separated = False
            else:
                cursor.fail(f"{cursor.shown()} stands behind an entry: separate entries by commas")
        cursor.advance()
    return tuple(tuple(row) for row in rows if row)
