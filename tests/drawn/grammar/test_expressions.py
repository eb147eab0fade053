"""Expressions of both languages: what binds stronger, what a blank means, what a number is."""

from fractions import Fraction

import pytest

from rovercheck.checker.drawn.grammar.expressions import parse_expression
from rovercheck.checker.drawn.grammar.syntax import ActionLanguage, Name, Number, operands, parts
from tests.drawn.grammar.shapes import shape

MATLAB, C, C_BITS = ActionLanguage.MATLAB, ActionLanguage.C, ActionLanguage.C_BITS

IN_MATLAB = [
    ("a + b * c", "(+ a (* b c))"),
    ("(a + b) * c", "(* (+ a b) c)"),
    ("a - b - c", "(- (- a b) c)"),
    ("-a ^ 2", "(- (^ a 2))"),
    ("2 ^ -1", "(^ 2 (- 1))"),
    ("2 ^ -1 ^ 2", "(^ (^ 2 (- 1)) 2)"),
    ("2 ^ 3 ^ 2", "(^ (^ 2 3) 2)"),
    ("-a * b", "(* (- a) b)"),
    ("~a == b", "(== (! a) b)"),
    ("!a != b", "(!= (! a) b)"),
    (
        "~button && after(0.5, sec) || ...\n after(5, sec)",
        "(|| (&& (! button) after(1/2, sec)) after(5, sec))",
    ),
    ("a || b && c | d & e == f", "(|| a (&& b (| c (& d (== e f)))))"),
    ("a < b == c", "(== (< a b) c)"),
    ("a + 1 : b - 1", "(: (+ a 1) (- b 1))"),
    ("0 : 0.1 : 2 > 1", "(> (: 0 1/10 2) 1)"),
    ("(1:2):3", "(: (: 1 2) 3)"),
    ("x .* y ./ z .^ w .\\ v \\ u", "(\\ (.\\ (./ (.* x y) (.^ z w)) v) u)"),
    ("a' * b'", "(* (' a) (' b))"),
    ("a.'", "(.' a)"),
    ("a ^ b'", "(' (^ a b))"),
    ("-a'", "(- (' a))"),
    ("a'", "(' a)"),
    ("x(1)'", "(' x(1))"),
    ("s.end'", "(' s.end)"),
    ("x == 'on'", "(== x 'on')"),
    ('f(\'it\'\'s\', "a ""b""")', 'f(\'it\'s\', "a "b"")'),
    ("LevelStatus.LEVEL_OK", "LevelStatus.LEVEL_OK"),
    ("bus.part(2).value", "bus.part(2).value"),
    ("x(end)", "x(end)"),
    ("x(end - 1, :)", "x((- end 1), :)"),
    ("x([1 end])", "x([1 end])"),
    ("x(:)", "x(:)"),
    ("x(2:end)", "x((: 2 end))"),
    ("f()", "f()"),
    ("f (a)", "f(a)"),
    ("[1 -2]", "[1 (- 2)]"),
    ("[1 - 2]", "[(- 1 2)]"),
    ("[1 -2 + 3]", "[1 (+ (- 2) 3)]"),
    ("[1-2]", "[(- 1 2)]"),
    ("[a -b]", "[a (- b)]"),
    ("[(a -b)]", "[(- a b)]"),
    ("[f(a -b) c]", "[f((- a b)) c]"),
    ("[a ~b]", "[a (! b)]"),
    ("[a ~= b]", "[(!= a b)]"),
    ("[a' b']", "[(' a) (' b)]"),
    ("[a 'b']", "[a 'b']"),
    ("[a (1)]", "[a 1]"),
    ("[a(1) b]", "[a(1) b]"),
    ("[1, 2; 3, 4]", "[1 2; 3 4]"),
    ("[1 2\n 3 4]", "[1 2; 3 4]"),
    ("[1, 2, ... more\n 3]", "[1 2 3]"),
    ("[\n1 2;\n\n3 4;\n]", "[1 2; 3 4]"),
    ("[1, 2,]", "[1 2]"),
    ("[]", "[]"),
    ("[1 2]'", "(' [1 2])"),
    ("[[1 2] 3]", "[[1 2] 3]"),
    ("{1, 'a'; x}", "{1 'a'; x}"),
    ("1./x", "(./ 1 x)"),
    ("2.^x", "(.^ 2 x)"),
    ("1.'", "(.' 1)"),
    ("a % what follows\n", "a"),
    ("a /* in between */ + b // what follows", "(+ a b)"),
    ("a++b", "(+ a (+ b))"),
    ("0xFFu8", "uint8(255b)"),
    ("0b101s16", "int16(5b)"),
    ("0x1F", "31b"),
    ("1...\n+ 2", "(+ 1 2)"),
    ("f(a,\n  b)", "f(a, b)"),
]
IN_C = [
    ("a + b * c %% d", "(+ a (%% (* b c) d))"),
    ("!a == b", "(== (! a) b)"),
    ("a == b < c", "(== a (< b c))"),
    ("a <> b ~= c", "(!= (!= a b) c)"),
    ("a << 2 + 1", "(<< a (+ 2i 1i))"),
    ("x[i + 1][j]", "x[(+ i 1i)][j]"),
    ("p->speed.value", "p->speed.value"),
    ("*p + f(&x)", "(+ (pointee p) f((address x)))"),
    ("uint8(x)", "uint8(x)"),
    ("(uint8) x + 1", "(+ uint8(x) 1i)"),
    ("(uint8)(x + 1)", "uint8((+ x 1i))"),
    ("(single) -x", "single((- x))"),
    ("(uint8) x[1]", "uint8(x[1i])"),
    ("ml.f(x)", "ml.f(x)"),
    ("ml('sin(x)')", "ml('sin(x)')"),
    ('s == "a\\n\\"b\\""', '(== s "a\n"b"")'),
    ("0x80 + 0xFUL", "(+ 128b 15b)"),
    ("10U + 3 + 1.0 + .5F + 2e3 + 1f", "(+ (+ (+ (+ (+ 10i 3i) 1f) 1/2s) 2000f) 1s)"),
    ("a % b", "a"),
    ("- -a", "(- (- a))"),
    ("a\n + b", "(+ a b)"),
    ("mode - x(1)", "(- mode x(1i))"),
]
ONLY_BITS = [
    ("a | b ^ c & d == e", "(bit| a (bit^ b (bit& c (== d e))))"),
    ("~a & 0x0F", "(bit& (bit~ a) 15b)"),
    ("(mode >> 1) | (flags & 0x80)", "(bit| (>> mode 1i) (bit& flags 128b))"),
    ("a && b | c", "(&& a (bit| b c))"),
]
ONLY_PLAIN = [
    ("a > 1 | b < 2", "(| (> a 1i) (< b 2i))"),
    ("a | b & c", "(| a (& b c))"),
    ("a * b ^ 2", "(* a (^ b 2i))"),
    ("-a ^ 2", "(- (^ a 2i))"),
    ("~a", "(! a)"),
]


@pytest.mark.parametrize(("text", "tree"), IN_MATLAB)
def test_matlab(text: str, tree: str) -> None:
    assert shape(parse_expression(text, MATLAB)) == tree


@pytest.mark.parametrize("language", [C, C_BITS])
@pytest.mark.parametrize(("text", "tree"), IN_C)
def test_c(text: str, tree: str, language: ActionLanguage) -> None:
    assert shape(parse_expression(text, language)) == tree


@pytest.mark.parametrize(("text", "tree"), ONLY_BITS)
def test_bit_operations(text: str, tree: str) -> None:
    assert shape(parse_expression(text, C_BITS)) == tree


@pytest.mark.parametrize(("text", "tree"), ONLY_PLAIN)
def test_without_bit_operations(text: str, tree: str) -> None:
    assert shape(parse_expression(text, C)) == tree


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("0.1", Fraction(1, 10)),
        (".5", Fraction(1, 2)),
        ("5.", Fraction(5)),
        ("1e-3", Fraction(1, 1000)),
        ("1.25E+2", Fraction(125)),
        ("1d2", Fraction(100)),
        ("9007199254740993", Fraction(9007199254740993)),
    ],
)
def test_numbers_are_exact(text: str, value: Fraction) -> None:
    found = parse_expression(text, MATLAB)
    assert isinstance(found, Number)
    assert (found.value, found.text) == (value, text)


def test_places() -> None:
    found = parse_expression("  speed +\n gear.TOP", MATLAB)
    assert [(type(part).__name__, part.at) for part in parts(found)] == [
        ("BinaryOperation", 8),
        ("Name", 2),
        ("Member", 11),
        ("Name", 11),
    ]


def test_places_are_not_compared() -> None:
    assert parse_expression("a+b", MATLAB) == parse_expression("  a  + b", MATLAB)
    assert hash(Name("a", 3)) == hash(Name("a"))


def test_parts_go_through_everything() -> None:
    found = parse_expression("f(-a.b, [c d; e], {g}, h(:), 1:2:k)", MATLAB)
    assert {part.name for part in parts(found) if isinstance(part, Name)} == set("facdeghk")
    assert len(operands(found)) == 6
    assert [shape(part) for part in operands(parse_expression("x[i]", C))] == ["x", "i"]
