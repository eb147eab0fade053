"""Texts without a meaning: each error says where, why, and what to write."""

import pickle
from collections.abc import Callable
from functools import partial

import pytest

from rovercheck.checker.drawn.grammar.errors import GrammarError, line_and_column
from rovercheck.checker.drawn.grammar.expressions import MOST_TALL, parse_expression
from rovercheck.checker.drawn.grammar.functions import parse_script, parse_signature
from rovercheck.checker.drawn.grammar.labels import parse_state_label, parse_transition_label
from rovercheck.checker.drawn.grammar.literals import MOST_DIGITS
from rovercheck.checker.drawn.grammar.statements import parse_statements
from rovercheck.checker.drawn.grammar.syntax import ActionLanguage, parts
from rovercheck.checker.drawn.grammar.tokens import MOST_NESTED

MATLAB, C = ActionLanguage.MATLAB, ActionLanguage.C

Row = tuple[str, str, int, int]
EXPRESSIONS: list[Row] = [
    ("a +", "the end of the text stands where an operand must", 1, 4),
    ("\n\n  a + * b", "'*' stands where an operand must", 3, 7),
    ("a b", "'b' stands behind the end of the expression", 1, 3),
    ("(a", "'(' is never closed", 1, 1),
    ("a)", "')' closes nothing", 1, 2),
    ("(a]", "']' cannot close '('", 1, 3),
    ("f(a b)", "arguments are separated by commas", 1, 5),
    ("[a,,b]", "an entry is missing", 1, 4),
    ("['a'\"b\"]", "separate entries by commas", 1, 5),
    ("1:2:3:4", "at most three parts", 1, 4),
    ("x(:1)", "':' as an index stands alone", 1, 4),
    ("end", "'end' is a keyword", 1, 1),
    ("@f", "function handles", 1, 1),
    ("c{1}", "cell arrays", 1, 2),
    ("s.(n)", "a field whose name is computed", 1, 3),
    ("s. 1", "where the name of a field", 1, 4),
    ("3x", "'3x' is neither a number nor a name", 1, 1),
    ("2i", "complex numbers", 1, 2),
    ("1e999", "exponent", 1, 1),
    ("1" * (MOST_DIGITS + 1), "digits", 1, 1),
    ("0xFFu9", "8, 16, 32 or 64", 1, 1),
    ("'abc", "does not end in its line", 1, 1),
    ("x == \"abc\n\"", "does not end in its line", 1, 6),
    ("a # b", "'#' has no meaning", 1, 3),
    ("a /* b", "never ends", 1, 3),
    ("a = b", "to compare, write '=='", 1, 3),
    ("", "the end of the text stands", 1, 1),
]  # fmt: skip
EXPRESSIONS_IN_C: list[Row] = [
    ("{1}", "'{' stands where an operand must", 1, 1),
    ("x + ++y", "'++' has no value", 1, 5),
    ("1.0U", "only a whole number", 1, 1),
    ("a[1,2]", "an index of C is one expression", 1, 4),
    ("a[]", "']' stands where an operand must", 1, 3),
    ("0x1G", "neither a number nor a name", 1, 1),
    ("a'", "does not end in its line", 1, 2),
]
STATEMENTS: list[Row] = [
    ("x = 1;\nhold on", "'hold' is followed by 'on'", 2, 1),
    ("disp 'abc'", "write a call, as in disp(...)", 1, 1),
    ("x = 1 y = 2", "end it with ';'", 1, 7),
    ("if a\n x", "'if' is never closed", 1, 1),
    ("x = 1; end", "'end' begins no statement", 1, 8),
    ("else", "no 'if' stands before it", 1, 1),
    ("try\n x\nend", "'try' is not supported", 1, 1),
    ("x = ", "where an operand must", 1, 5),
    ("x =\n 1", "the end of the line stands where an operand must", 1, 4),
    ("f(x) + 1 = 2", "only data can be assigned to", 1, 6),
    ("[a, 1] = f", "only data can be assigned to", 1, 5),
    ("[] = f", "names nothing to assign to", 1, 1),
    ("x = y = z", "write '=='", 1, 7),
    ("switch x\n y = 1;\nend", "where 'case', 'otherwise' or 'end' must", 2, 2),
    ("for 1:3, end", "the name of a loop's variable", 1, 5),
    ("for i in x, end", "for i = 1:n", 1, 7),
    ("persistent", "the name of a persistent variable", 1, 11),
    ("x:y", "a range or a matrix alone does nothing", 1, 1),
    ("function f", "a function of the chart", 1, 1),
    ("%{\n abc", "close it with %}", 1, 1),
]
STATEMENTS_IN_C: list[Row] = [
    ("x = 1;\nif (a) { x = 1; }", "actions in C have no 'if'", 2, 1),
    ("x = 1 y = 2", "end it with ';'", 1, 7),
    ("x = a ? 1 : 2;", "no conditional values", 1, 7),
]
STATES: list[Row] = [
    ("", "the name of the state", 1, 1),
    ("/en: x", "the name of the state", 1, 1),
    ("end", "and is a keyword", 1, 1),
    ("A en: x = 1", "'en' stands behind the name 'A'", 1, 3),
    ("A\nen x = 1", "'en' begins a section only with a colon", 2, 1),
    ("A\nbind: x = 1", "only names", 2, 7),
    ("A\non: x", "the name of an event", 2, 3),
    ("A\nfoo: x", "begin it with entry, during, exit, bind or on", 2, 1),
    ("A\nen: if a\n b\n", "'if' is never closed", 2, 5),
]
TRANSITIONS: list[Row] = [
    ("E F", "a transition is written EVENT [guard]", 1, 3),
    ("[a][b]", "one guard", 1, 4),
    ("{a}[b]", "one guard", 1, 4),
    ("[a, b]", "a guard is one condition", 1, 3),
    ("E\n[a = 1]", "write '=='", 2, 4),
    ("E {a} b", "a transition is written", 1, 7),
    ("{if x\n y}", "'if' is never closed", 1, 2),
    ("A | ", "the name of an event", 1, 5),
    ("? x", "'x' stands behind the end of the label", 1, 3),
]
SIGNATURES: list[Row] = [
    ("", "the name of the function or its output", 1, 1),
    ("f(1)", "the name of an input", 1, 3),
    ("[a, b]", "behind the outputs follows the function", 1, 7),
    ("[a;b] = f", "separate them by commas", 1, 3),
    ("y = f(a) x", "behind the end of the signature", 1, 10),
]
SCRIPTS: list[Row] = [
    ("", "a script begins with a function", 1, 1),
    ("x = 1", "a script begins with a function", 1, 1),
    ("function f\nfunction g\nend\nend", "functions cannot stand in each other", 4, 1),
    ("function f\nx = 1;\nend\ny = 2;", "statements must be in a function", 4, 1),
    ("function f(x)\narguments\n x (1,1) double\nend\nend", "a block of arguments", 2, 1),
]
EVERY: list[tuple[Callable[[str], object], list[Row]]] = [
    (partial(parse_expression, language=MATLAB), EXPRESSIONS),
    (partial(parse_expression, language=C), EXPRESSIONS_IN_C),
    (partial(parse_statements, language=MATLAB), STATEMENTS),
    (partial(parse_statements, language=C), STATEMENTS_IN_C),
    (partial(parse_state_label, language=MATLAB), STATES),
    (partial(parse_transition_label, language=MATLAB), TRANSITIONS),
    (partial(parse_signature, language=MATLAB), SIGNATURES),
    (parse_script, SCRIPTS),
]


@pytest.mark.parametrize(("read", "row"), [(read, row) for read, rows in EVERY for row in rows])
def test_error(read: Callable[[str], object], row: Row) -> None:
    text, words, line, column = row
    with pytest.raises(GrammarError) as error:
        read(text)
    assert words in error.value.message
    assert (error.value.line, error.value.column) == (line, column)
    assert str(error.value) == f"line {line}, column {column}: {error.value.message}"


def test_an_error_is_sent_between_processes() -> None:
    with pytest.raises(GrammarError) as error:
        parse_expression("a\n b", MATLAB)
    copy = pickle.loads(pickle.dumps(error.value))
    assert (str(copy), copy.at, copy.line) == (str(error.value), 3, 2)


def test_lines_end_in_three_ways() -> None:
    assert line_and_column("a\r\nb\rc\nd", 7) == (4, 1)
    assert line_and_column("abc", 2) == (1, 3)


# --- bounds -----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("pair", ["( )", "[ ]", "f( )", "-( )", "{ }"])
def test_brackets_in_each_other(pair: str) -> None:
    opening, closing = pair.split()

    def nested(deep: int) -> str:
        return opening * deep + "x" + closing * deep

    parse_expression(nested(MOST_NESTED), MATLAB)
    with pytest.raises(GrammarError, match="brackets in each other"):
        parse_expression(nested(MOST_NESTED + 1), MATLAB)
    with pytest.raises(GrammarError):
        parse_expression(opening * 100_000, MATLAB)


def test_the_deepest_expression_in_the_deepest_statement() -> None:
    """Every operator of its own strength between the brackets, which must not make the reader go deeper."""
    deep = "a||b&&c|d&e==f:g+h*-i^(" * MOST_NESTED + "x" + ")" * MOST_NESTED
    with pytest.raises(GrammarError, match="operators are applied"):
        parse_expression(deep, MATLAB)
    text = (
        "if a\n" * MOST_NESTED
        + "x = "
        + "f(" * MOST_NESTED
        + ")" * MOST_NESTED
        + "\n"
        + "end\n" * MOST_NESTED
    )
    assert len(parse_statements(text, MATLAB)) == 1
    with pytest.raises(GrammarError, match="statements in each other"):
        parse_statements(f"if a\n{text}\nend", MATLAB)


@pytest.mark.parametrize("link", [" + x", " && x", ".x", "^x", "'"])
def test_long_chains(link: str) -> None:
    assert len(list(parts(parse_expression("x" + link * (MOST_TALL - 1), MATLAB)))) >= MOST_TALL
    with pytest.raises(GrammarError, match="operators are applied"):
        parse_expression("x" + link * MOST_TALL, MATLAB)


@pytest.mark.parametrize("sign", ["-", "~", "!"])
def test_many_signs(sign: str) -> None:
    with pytest.raises(GrammarError, match="operators are applied"):
        parse_expression(sign * 10_000 + "x", MATLAB)
