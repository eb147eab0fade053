"""Any text is read or refused with its place: nothing else happens, however long or odd it is."""

from collections.abc import Callable
from functools import partial
from itertools import product

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rovercheck.checker.drawn.grammar.errors import GrammarError
from rovercheck.checker.drawn.grammar.expressions import parse_expression
from rovercheck.checker.drawn.grammar.functions import parse_script, parse_signature
from rovercheck.checker.drawn.grammar.labels import parse_state_label, parse_transition_label
from rovercheck.checker.drawn.grammar.statements import parse_statements
from rovercheck.checker.drawn.grammar.syntax import ActionLanguage
from tests.profiles import examples

READERS = [parse_expression, parse_statements, parse_state_label, parse_transition_label, parse_signature]
EVERY: list[Callable[[str], object]] = [
    *(partial(reader, language=language) for reader, language in product(READERS, ActionLanguage)),
    parse_script,
]
PIECES = [
    "a", "b", "E", "S.E", "x(1)", "1", "0.5", "1e3", "0xFF", "3F", "end", "if", "else", "elseif", "for",
    "while", "switch", "case", "otherwise", "function", "persistent", "return", "en", "du:", "ex", "on",
    "bind", "after", "sec", " ", " ", " ", "\n", "\n", "\r\n", ";", ";", ",", ":", ".", "...", "(", ")",
    "(", ")", "[", "]", "{", "}", "=", "==", "~=", "!=", "<", "<<", "->", "+", "-", "++", "--", "+=", "*",
    "/", "\\", "^", ".*", ".^", "%%", "%", "%{\n", "%}\n", "//", "/*", "*/", "'", "'", "\"", "\"", "~", "!",
    "&", "&&", "|", "||", "?", "@", "#", "é", "\0",
]  # fmt: skip


BEGINNINGS = [
    (parse_expression, ""),
    (parse_expression, "x(["),
    (parse_statements, "if a\n"),
    (parse_state_label, "A\n"),
    (parse_transition_label, ""),
    (parse_transition_label, "{"),
]


def attempt(text: str, readers: list[Callable[[str], object]]) -> None:
    lines = len(text.splitlines()) + 1
    for read in readers:
        try:
            read(text)
        except GrammarError as error:
            assert 1 <= error.line <= lines + 1 and error.column >= 1 and 0 <= error.at <= len(text)
            assert error.message


@examples(400)
@given(st.lists(st.sampled_from(PIECES), max_size=25).map("".join))
def test_pieces_in_any_order(text: str) -> None:
    attempt(text, EVERY)


@examples(200)
@given(st.text(max_size=30))
def test_any_characters(text: str) -> None:
    attempt(text, EVERY)


@pytest.mark.parametrize("piece", [
    "a", "a ", "a;", "a,", "a\n", "a+", "a.", "-", "!", "(", "[", "{", "f(", "a[", "'", "' ", "if a\n",
    "if a,", "{}", "en,", "en:", "on a,", "on a|", "on a:\n", "[a", "[a]", "[a] = ", "a = ", "1:", "1 ",
    "++", "a++;", "%{\n", "%", "/*", "/**/", "...\n", "\n", " ", "++ ", "case 1\n", "switch a\n",
    "function f\n", "(uint8)", "a|", "a\n|", "0", "1e", "\"\"", "''", "/", "a'", "^a", "elseif a\n",
    "persistent a\n", "~,",
])  # fmt: skip
def test_long_texts(piece: str) -> None:
    """Neither how much stands in each other nor how much follows another makes a reader give up halfway."""
    long = piece * (1_500 // len(piece))
    for language in (ActionLanguage.MATLAB, ActionLanguage.C_BITS):
        for reader, beginning in BEGINNINGS:
            attempt(beginning + long, [partial(reader, language=language)])
    attempt(f"function f\n{long}", [parse_script])
