"""Statements of actions: how they end, and what each kind is made of."""

import pytest

from rovercheck.checker.drawn.grammar.statements import parse_statements
from rovercheck.checker.drawn.grammar.syntax import ActionLanguage
from tests.drawn.grammar.shapes import actions

MATLAB, C, C_BITS = ActionLanguage.MATLAB, ActionLanguage.C, ActionLanguage.C_BITS

IN_MATLAB = [
    ("", ""),
    ("x = 1; y = 2, z = 3\nw = 4", "x = 1 | y = 2 | z = 3 | w = 4"),
    (";;\n x = 1;;", "x = 1"),
    ("x = a + ...\n b;", "x = (+ a b)"),
    ("x = [1 2\n3 4];", "x = [1 2; 3 4]"),
    ("[a, ~] = f(x);", "a ~ = f(x)"),
    ("[~, b] = f(x)", "~ b = f(x)"),
    ("[a b.c d(1)] = f(x)", "a b.c d(1) = f(x)"),
    ("[~ b] = f(x)", "~ b = f(x)"),
    ("[a] = f(x)", "a = f(x)"),
    ("x(i + 1).y = 3", "x((+ i 1)).y = 3"),
    ("x += 1; y -= 2; z *= 3; w /= 4", "x += 1 | y -= 2 | z *= 3 | w /= 4"),
    ("i++; j--", "i +1 | j -1"),
    ("i++ % next", "i +1"),
    ("FAIL; alarms = alarms + 100", "FAIL | alarms = (+ alarms 100)"),
    ("send(HALT, Cars.Red); S.E", "send(HALT, Cars.Red) | S.E"),
    ("x = 'a;b'; y = \"%\"", "x = 'a;b' | y = \"%\""),
    ("x = a'; y = b';", "x = (' a) | y = (' b)"),
    ("if a x = 1; end", "if a <x = 1>"),
    ("if (a) x = 1; else y = 2; end; z = 3", "if a <x = 1> else <y = 2> | z = 3"),
    ("if a, b = 1, elseif c\n d = 2\nelse\nend", "if a <b = 1> if c <d = 2>"),
    ("if a\n if b\n c = 1;\n end\nend\n", "if a <if b <c = 1>>"),
    ("for i = 1:3\n s = s + f(i);\nend", "for i (: 1 3) <s = (+ s f(i))>"),
    ("for (i = 1:2:9) s = i; end", "for i (: 1 2 9) <s = i>"),
    ("for k = [1 -2], f(k), end", "for k [1 (- 2)] <f(k)>"),
    ("while a\n a = 1; break; continue; return\nend", "while a <a = 1 | break | continue | return>"),
    (
        "switch mode\n case {1, Gear.N}\n x = 1;\n case 'off'\n x = 2;\n otherwise\n x = 3;\nend",
        "switch mode case 1 Gear.N <x = 1> case 'off' <x = 2> otherwise <x = 3>",
    ),
    ("switch(x), case -1, y = 1; end", "switch x case (- 1) <y = 1>"),
    ("persistent s t\nglobal g", "persistent s t | global g"),
    ("x = 1; % one\n%{\n y = 2;\n %{\n nested\n %}\n%}\nz = 3;", "x = 1 | z = 3"),
    ("x = 1; // one\n/* two\n */ y = 2", "x = 1 | y = 2"),
    ("x = 1 %{ no block\ny = 2", "x = 1 | y = 2"),
    ("x = 1;\r\ny = 2\rz = 3", "x = 1 | y = 2 | z = 3"),
    ("x = y(end); end_of = 1", "x = y(end) | end_of = 1"),
    ("x &= a; y |= b; z ^= 2", "x &= a | y |= b | z ^= 2"),
]  # fmt: skip
IN_C = [
    ("x = 1; y = 2, z = 3", "x = 1i | y = 2i | z = 3i"),
    ("x = a\n + b\ny = c", "x = (+ a b) | y = c"),
    ("x = a +\n b;", "x = (+ a b)"),
    ("x = y\n++z", "x = y | z +1"),
    ("trace++; --n", "trace +1 | n -1"),
    ("x := y * 2;", "x := (* y 2i)"),
    ("*p = 3; q->x[2] = 1; a[i] += 2", "(pointee p) = 3i | q->x[2i] = 1i | a[i] += 2i"),
    ("E; send(E, S); f(&x);", "E | send(E, S) | f((address x))"),
    ("[a, b] = f(x);", "a b = f(x)"),
    ("x = y %% 3; % rest\ny = 1", "x = (%% y 3i) | y = 1i"),
    ("%% a heading\nx = 1;\n%% another\n", "x = 1i"),
    ("persistent = 1; end = 2", "persistent = 1i | end = 2i"),
    ("s = \"a;b\"; t = 'c';", "s = \"a;b\" | t = 'c'"),
]


@pytest.mark.parametrize(("text", "tree"), IN_MATLAB)
def test_matlab(text: str, tree: str) -> None:
    assert actions(parse_statements(text, MATLAB)) == tree


@pytest.mark.parametrize("language", [C, C_BITS])
@pytest.mark.parametrize(("text", "tree"), IN_C)
def test_c(text: str, tree: str, language: ActionLanguage) -> None:
    assert actions(parse_statements(text, language)) == tree


def test_assignments_with_bits() -> None:
    text = "x |= a; y &= b; z ^= c"
    assert actions(parse_statements(text, C_BITS)) == "x bit|= a | y bit&= b | z bit^= c"
    assert actions(parse_statements(text, C)) == "x |= a | y &= b | z ^= c"


def test_places() -> None:
    one, other = parse_statements("x = 1;\n  if a\n b\n end", MATLAB)
    assert (one.at, other.at) == (0, 9)
