"""Statements of actions and scripts: assignments, events, calls, and in MATLAB branches and loops."""

from collections.abc import Callable
from typing import TypeAlias

from rovercheck.checker.drawn.grammar.actions import (
    ActionStatement,
    Assignment,
    BreakStatement,
    ContinueStatement,
    Evaluated,
    ForLoop,
    IfBranch,
    IfStatement,
    Increment,
    NameDeclaration,
    ReturnStatement,
    SwitchCase,
    SwitchStatement,
    WhileLoop,
)
from rovercheck.checker.drawn.grammar.cursor import Cursor, read_whole
from rovercheck.checker.drawn.grammar.expressions import entry, expression
from rovercheck.checker.drawn.grammar.operators import operators_of
from rovercheck.checker.drawn.grammar.syntax import (
    ActionLanguage,
    Applied,
    CellArray,
    ColonRange,
    Expression,
    Indexed,
    Matrix,
    Member,
    Name,
    UnaryOperation,
)
from rovercheck.checker.drawn.grammar.tokens import Token, TokenKind

__all__ = ["parse_statements", "statements"]

Statements: TypeAlias = tuple[ActionStatement, ...]
_WORDS = (TokenKind.NAME, TokenKind.NUMBER, TokenKind.TEXT)
_INSTEAD = {
    "function": "a function is a function of the chart",
    "end": "it ends no 'if', 'for', 'while' or 'switch' that stands before it",
    "else": "no 'if' stands before it",
    "elseif": "no 'if' stands before it",
    "case": "no 'switch' stands before it",
    "otherwise": "no 'switch' stands before it",
}


def parse_statements(text: str, language: ActionLanguage) -> Statements:
    """The statements of a text; raises ``GrammarError``."""
    return read_whole(text, language, statements, "a statement")


def statements(cursor: Cursor, until: Callable[[Cursor], bool] = Cursor.at_end) -> Statements:
    """The statements up to the end, or to where ``until`` says so at the beginning of one."""
    found: list[ActionStatement] = []
    while True:
        cursor.skip_separators()
        if cursor.at_end() or until(cursor):
            return tuple(found)
        statement = _statement(cursor)
        found.append(statement)
        if not isinstance(statement, IfStatement | ForLoop | WhileLoop | SwitchStatement):
            _ended(cursor, until)


def _ended(cursor: Cursor, until: Callable[[Cursor], bool]) -> None:
    """Refuse what cannot stand behind a statement."""
    if cursor.token.kind in (TokenKind.LINE, TokenKind.END) or cursor.at_sign(";", ",") or until(cursor):
        return
    cursor.refuse_sign()
    before = cursor.tokens[cursor.position - 1]
    if cursor.matlab and before.kind is TokenKind.NAME and cursor.token.kind in _WORDS:
        cursor.fail(
            f"'{before.text}' is followed by {cursor.shown()}: commands with words behind them have no "
            f"meaning in a chart: write a call, as in {before.text}(...), or an operator between them",
            before.at,
        )
    cursor.fail(f"{cursor.shown()} stands behind a statement: end it with ';' or a new line")


def _statement(cursor: Cursor) -> ActionStatement:
    token = cursor.token
    if token.kind is TokenKind.NAME:
        if not cursor.matlab and cursor.is_keyword(token):
            cursor.fail(f"actions in C have no '{token.text}': draw it as transitions between junctions")
        if cursor.is_keyword(token):
            with cursor.nested(token.at):
                return _keyword(cursor)
    if cursor.at_sign("[") and cursor.tokens[token.partner + 1].text == "=":
        targets = _targets(cursor)
        cursor.advance()
        return Assignment(targets, expression(cursor), at=token.at)
    if not cursor.matlab and cursor.at_sign("++", "--"):
        sign = cursor.advance()
        return _increment(cursor, expression(cursor), sign)
    left = expression(cursor)
    sign = cursor.token
    if cursor.at_sign("++", "--"):
        cursor.advance()
        return _increment(cursor, left, sign)
    table = operators_of(cursor.language).assignment
    if sign.kind is TokenKind.SIGN and sign.text in table:
        cursor.advance()
        target = _target(cursor, left)
        return Assignment((target,), expression(cursor), table[sign.text], sign.text == ":=", token.at)
    if isinstance(left, ColonRange | Matrix):
        cursor.fail(
            "a range or a matrix alone does nothing: give it to some data, or, if a section of a state was "
            "meant, begin it with entry, during, exit, bind or on",
            token.at,
        )
    return Evaluated(left, token.at)


def _increment(cursor: Cursor, target: Expression, sign: Token) -> Increment:
    return Increment(_target(cursor, target), 1 if sign.text == "++" else -1, target.at)


def _target(cursor: Cursor, target: Expression) -> Expression:
    """An expression that can be assigned to."""
    inner = target
    while True:
        match inner:
            case Name() | UnaryOperation("pointee"):
                return target
            case Member(owner) | Applied(owner) | Indexed(owner):
                inner = owner
            case _:
                cursor.fail("only data can be assigned to: a name, a field or an element of it", target.at)


def _targets(cursor: Cursor) -> tuple[Expression | None, ...]:
    """What stands in the square brackets before ``=``."""
    opening = cursor.advance()
    found: list[Expression | None] = []
    while not cursor.at_sign("]"):
        after = cursor.ahead()
        if cursor.at_sign("~") and (after.blank or after.text in (",", "]")):
            cursor.advance()
            found.append(None)
        else:
            found.append(_target(cursor, entry(cursor)))
        if not cursor.take(",") and not cursor.at_sign("]") and not cursor.token.blank:
            cursor.fail(f"{cursor.shown()} stands in a list of targets: separate them by commas")
    if not found:
        cursor.fail("'[]' names nothing to assign to", opening.at)
    cursor.advance()
    return tuple(found)


def _keyword(cursor: Cursor) -> ActionStatement:
    token = cursor.advance()
    match token.text:
        case "if":
            return _if(cursor, token)
        case "for":
            return _for(cursor, token)
        case "while":
            condition = expression(cursor)
            return WhileLoop(condition, _body(cursor, token), token.at)
        case "switch":
            return _switch(cursor, token)
        case "return":
            return ReturnStatement(token.at)
        case "break":
            return BreakStatement(token.at)
        case "continue":
            return ContinueStatement(token.at)
        case "persistent" | "global" as keyword:
            names: list[str] = []
            while not names or cursor.token.kind is TokenKind.NAME:
                names.append(cursor.name(f"a {keyword} variable").text)
            return NameDeclaration(keyword, tuple(names), token.at)
        case word if word in _INSTEAD:
            cursor.fail(f"'{word}' begins no statement: {_INSTEAD[word]}", token.at)
        case word:
            cursor.fail(f"'{word}' is not supported: write it with if, for, while or switch", token.at)


def _block(cursor: Cursor, opening: Token, *words: str) -> Statements:
    """Statements up to one of these words, which closes what an opening word began."""
    found = statements(cursor, lambda here: here.at_word(*words) or here.at_sign("}"))
    if not cursor.at_word(*words):
        cursor.fail(f"'{opening.text}' is never closed: write 'end' behind its statements", opening.at)
    return found


def _body(cursor: Cursor, opening: Token) -> Statements:
    found = _block(cursor, opening, "end")
    cursor.advance()
    return found


def _if(cursor: Cursor, opening: Token) -> IfStatement:
    branches = []
    at = opening.at
    while True:
        condition = expression(cursor)
        body = _block(cursor, opening, "elseif", "else", "end")
        branches.append(IfBranch(condition, body, at))
        word = cursor.advance()
        if word.text != "elseif":
            break
        at = word.at
    otherwise = _body(cursor, opening) if word.text == "else" else ()
    return IfStatement(tuple(branches), otherwise, opening.at)


def _for(cursor: Cursor, opening: Token) -> ForLoop:
    """``for i = values``, with or without brackets around it."""
    bracketed = cursor.at_sign("(")
    with cursor.inside("brackets" if bracketed else "lines"):
        cursor.take("(")
        variable = cursor.name("a loop's variable").text
        cursor.expect("=", "a loop is written for i = 1:n")
        values = expression(cursor)
        if bracketed:
            cursor.expect(")", "it was opened behind 'for'")
    return ForLoop(variable, values, _body(cursor, opening), opening.at)


def _switch(cursor: Cursor, opening: Token) -> SwitchStatement:
    subject = expression(cursor)
    cursor.skip_separators()
    cases = []
    otherwise: Statements = ()
    while cursor.at_word("case"):
        at = cursor.advance().at
        label = expression(cursor)
        values = tuple(v for row in label.rows for v in row) if isinstance(label, CellArray) else (label,)
        cases.append(SwitchCase(values, _block(cursor, opening, "case", "otherwise", "end"), at))
    if cursor.at_word("otherwise"):
        cursor.advance()
        otherwise = _block(cursor, opening, "end")
    if not cursor.at_word("end"):
        cursor.fail(f"{cursor.shown()} stands in a 'switch' where 'case', 'otherwise' or 'end' must")
    cursor.advance()
    return SwitchStatement(subject, tuple(cases), otherwise, opening.at)
