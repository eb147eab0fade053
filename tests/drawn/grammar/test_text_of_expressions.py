"""The text of an expression is read as the same expression, also with comments between its words."""

from fractions import Fraction
from typing import get_args

import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.strategies import DrawFn, SearchStrategy

from rovercheck.checker.drawn.grammar.expressions import parse_expression
from rovercheck.checker.drawn.grammar.operators import COLON, operators_of
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
    Number,
    NumberKind,
    TextLiteral,
    UnaryOperation,
    UnaryOperator,
    WholeRange,
)
from rovercheck.checker.drawn.grammar.text import text_of
from rovercheck.checker.drawn.grammar.tokens import TokenKind, tokens_of
from tests.profiles import examples

MATLAB, C, C_BITS = ActionLanguage.MATLAB, ActionLanguage.C, ActionLanguage.C_BITS
NAMES = st.sampled_from(["a", "b", "speed", "Gear", "E1", "_x", "endx"])
CHARACTERS = st.text(st.sampled_from("ab '\"\\%/*{}[];n"), max_size=5)


def numbers(language: ActionLanguage) -> SearchStrategy[Number]:
    whole, pointed = ["0", "7", "1024"], ["0.5", ".25", "3.0", "1e3", "2.5e-2"]
    point = NumberKind.DOUBLE if language is MATLAB else NumberKind.FLOATING
    plain = NumberKind.DOUBLE if language is MATLAB else NumberKind.INTEGER
    found = [Number(Fraction(text), plain, text) for text in whole]
    found += [Number(Fraction(text), point, text) for text in pointed]
    if language is not MATLAB:
        found += [Number(Fraction(text), NumberKind.SINGLE, text) for text in ("2", "0.5")]
    found += [Number(Fraction(int(text, 0)), NumberKind.BITS, text) for text in ("0x1F", "0b101")]
    return st.sampled_from(found)


def expressions(language: ActionLanguage) -> SearchStrategy[Expression]:
    leaf = st.one_of(
        numbers(language),
        st.builds(Name, NAMES),
        st.builds(TextLiteral, CHARACTERS, st.sampled_from("'\"")),
    )
    return st.recursive(leaf, lambda inner: composed(language, inner), max_leaves=12)


@st.composite
def places(draw: DrawFn, language: ActionLanguage, inner: SearchStrategy[Expression]) -> Expression:
    """A name with members and what it is applied to."""
    found: Expression = Name(draw(NAMES))
    for kind in draw(st.lists(st.sampled_from("matlab" if language is MATLAB else "cpma"), max_size=3)):
        match kind:
            case "c" | "p":
                found = Indexed(found, draw(inner))
            case "m":
                found = Member(found, draw(NAMES), draw(st.booleans()) if language is not MATLAB else False)
            case _:
                found = Applied(found, tuple(draw(st.lists(arguments(language, inner), max_size=3))))
    return found


def arguments(language: ActionLanguage, inner: SearchStrategy[Expression]) -> SearchStrategy[Expression]:
    if language is not MATLAB:
        return inner
    last = st.builds(LastIndex)
    return st.one_of(
        inner,
        st.builds(WholeRange),
        last,
        st.builds(ColonRange, inner, st.none(), last),
        st.builds(minus_one, last),
    )


def minus_one(expression: Expression) -> Expression:
    return BinaryOperation("-", expression, Number(Fraction(1), NumberKind.DOUBLE, "1"))


def composed(language: ActionLanguage, inner: SearchStrategy[Expression]) -> SearchStrategy[Expression]:
    table = operators_of(language)
    between = {sign for _, sign in table.infix.values() if sign != COLON} | set(table.power.values())
    before: set[UnaryOperator] = set(table.prefix.values())
    if language is MATLAB:
        before |= {"'", ".'"}
    kinds: list[SearchStrategy[Expression]] = [
        st.builds(BinaryOperation, st.sampled_from(sorted(between)), inner, inner),
        st.builds(UnaryOperation, st.sampled_from(sorted(before)), inner),
        places(language, inner),
    ]
    if language is MATLAB:
        rows = st.lists(st.lists(inner, min_size=1, max_size=3).map(tuple), max_size=2).map(tuple)
        kinds += [
            st.builds(ColonRange, inner, st.one_of(st.none(), inner), inner),
            st.builds(Matrix, rows),
            st.builds(CellArray, rows),
        ]
    return st.one_of(kinds)


def test_every_operator_is_drawn() -> None:
    tables = [operators_of(language) for language in ActionLanguage]
    found: set[str] = {"'", ".'"}
    for table in tables:
        found |= {sign for _, sign in table.infix.values()} | {*table.power.values(), *table.prefix.values()}
    assert found == {COLON, *get_args(BinaryOperator), *get_args(UnaryOperator)}


@pytest.mark.parametrize("language", ActionLanguage)
@examples(240)
@given(st.data())
def test_round_trip(language: ActionLanguage, data: st.DataObject) -> None:
    tree = data.draw(expressions(language))
    assert parse_expression(text_of(tree, language), language) == tree


NOISE = st.sampled_from(["", " ", "\t", "  ", " ... on\n", " /* (' */ ", " % ' (\n", " // [\n", "\n\r\n"])


@pytest.mark.parametrize("language", ActionLanguage)
@examples(120)
@given(st.data())
def test_blanks_lines_and_comments_between_words_change_nothing(
    language: ActionLanguage, data: st.DataObject
) -> None:
    tree = data.draw(expressions(language))
    text = text_of(tree, language)
    noisy, square = [], 0
    for token in tokens_of(text, language):
        square += {"[": 1, "{": 1, "]": -1, "}": -1}.get(token.text, 0) if token.kind is TokenKind.SIGN else 0
        blank = " " if token.blank else ""
        keeps = token.text in ("'", ".'", ".", "%%") or (language is MATLAB and square)
        noisy.append(blank + ("" if keeps else data.draw(NOISE)) + token.text)
    assert parse_expression("".join(noisy), language) == tree


@pytest.mark.parametrize(
    ("written", "language", "shown"),
    [
        ("a+b*-c", MATLAB, "a + b * -c"),
        ("(a+b)*c ~= d'", MATLAB, "(a + b) * c ~= d'"),
        ("[1 -2;x(end) 'it''s']", MATLAB, "[1, -2; x(end), 'it''s']"),
        ("1:n-1", MATLAB, "1:n - 1"),
        ("('')'", MATLAB, "('')'"),
        ("!(a!=b)&&p->x[2].y", C, "!(a != b) && p->x[2].y"),
        ("(mode>>1)|(flags&0x80)", C_BITS, "mode >> 1 | flags & 0x80"),
        ("1.5F+2U-(- -a)", C, "1.5F + 2 - - -a"),
    ],
)
def test_text(written: str, language: ActionLanguage, shown: str) -> None:
    assert text_of(parse_expression(written, language), language) == shown
