"""Signatures of functions in charts, and MATLAB scripts, which are functions one after another."""

from dataclasses import dataclass, field

from rovercheck.checker.drawn.grammar.actions import (
    ActionStatement,
)
from rovercheck.checker.drawn.grammar.cursor import Cursor, read_whole
from rovercheck.checker.drawn.grammar.statements import statements
from rovercheck.checker.drawn.grammar.syntax import (
    ActionLanguage,
)
from rovercheck.checker.drawn.grammar.tokens import TokenKind

__all__ = ["FunctionSignature", "ScriptFunction", "parse_script", "parse_signature"]


@dataclass(frozen=True, slots=True)
class FunctionSignature:
    """``[outputs] = name(inputs)``; an input that is not used, ``~`` in MATLAB, is None."""

    name: str
    inputs: tuple[str | None, ...] = ()
    outputs: tuple[str, ...] = ()
    at: int = field(default=0, compare=False)


@dataclass(frozen=True, slots=True)
class ScriptFunction:
    """A function of a script."""

    signature: FunctionSignature
    body: tuple[ActionStatement, ...]
    at: int = field(default=0, compare=False)


def parse_signature(text: str, language: ActionLanguage) -> FunctionSignature:
    """What the label of a function says: its name, inputs and outputs; raises ``GrammarError``."""

    def whole(cursor: Cursor) -> FunctionSignature:
        with cursor.inside("brackets"):
            return _signature(cursor)

    return read_whole(text, language, whole, "the signature")


def parse_script(text: str) -> tuple[ScriptFunction, ...]:
    """The functions of a MATLAB script, of which the first is the one called; raises ``GrammarError``."""
    return read_whole(text, ActionLanguage.MATLAB, _functions, "the script")


def _functions(cursor: Cursor) -> tuple[ScriptFunction, ...]:
    found: list[ScriptFunction] = []
    while True:
        cursor.skip_separators()
        if cursor.at_end() and found:
            return tuple(found)
        if not cursor.at_word("function"):
            why = (
                "statements must be in a function, and functions cannot stand in each other"
                if found
                else "a script begins with a function, as in function y = f(x)"
            )
            cursor.fail(f"{cursor.shown()} stands where 'function' must: {why}")
        at = cursor.advance().at
        signature = _signature(cursor)
        if cursor.behind_lines().text == "arguments":
            cursor.fail("a block of arguments is not supported: leave it out", cursor.behind_lines().at)
        body = statements(cursor, lambda here: here.at_word("function", "end"))
        if cursor.at_word("end"):
            cursor.advance()
        found.append(ScriptFunction(signature, body, at))


def _signature(cursor: Cursor) -> FunctionSignature:
    at = cursor.token.at
    if cursor.at_sign("["):
        outputs = _outputs(cursor)
        cursor.expect("=", "behind the outputs follows the function, as in [a, b] = f(x)")
        name = cursor.name("the function").text
    else:
        name, outputs = cursor.name("the function or its output").text, ()
        if cursor.take("="):
            outputs, name = (name,), cursor.name("the function").text
    inputs = _inputs(cursor) if cursor.at_sign("(") else ()
    return FunctionSignature(name, inputs, outputs, at)


def _outputs(cursor: Cursor) -> tuple[str, ...]:
    found: list[str] = []
    cursor.advance()
    with cursor.inside("brackets"):
        while not cursor.at_sign("]"):
            found.append(cursor.name("an output").text)
            if not cursor.take(",") and not cursor.at_sign("]") and cursor.token.kind is not TokenKind.NAME:
                cursor.fail(f"{cursor.shown()} stands between outputs: separate them by commas")
        cursor.advance()
    return tuple(found)


def _inputs(cursor: Cursor) -> tuple[str | None, ...]:
    found: list[str | None] = []
    cursor.advance()
    with cursor.inside("brackets"):
        while not cursor.at_sign(")"):
            if found:
                cursor.expect(",", "inputs are separated by commas")
            unused = cursor.matlab and cursor.take("~")
            found.append(None if unused else cursor.name("an input").text)
        cursor.advance()
    return tuple(found)
