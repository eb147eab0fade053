"""Signatures of functions, and scripts of several functions."""

import pytest

from rovercheck.checker.drawn.grammar.functions import FunctionSignature, parse_script, parse_signature
from rovercheck.checker.drawn.grammar.syntax import ActionLanguage
from tests.drawn.grammar.shapes import actions

MATLAB, C = ActionLanguage.MATLAB, ActionLanguage.C

SIGNATURES = [
    ("f", FunctionSignature("f")),
    ("f()", FunctionSignature("f")),
    ("f(a)", FunctionSignature("f", ("a",))),
    ("y = f(a, b)", FunctionSignature("f", ("a", "b"), ("y",))),
    ("y = f", FunctionSignature("f", (), ("y",))),
    ("[p, q] = f(a)", FunctionSignature("f", ("a",), ("p", "q"))),
    ("[p q]=f(a)", FunctionSignature("f", ("a",), ("p", "q"))),
    ("[] = f", FunctionSignature("f")),
    ("y = f(a, ...\n b)\n", FunctionSignature("f", ("a", "b"), ("y",))),
    ("y = ...\nf(a,\nb)", FunctionSignature("f", ("a", "b"), ("y",))),
]


@pytest.mark.parametrize("language", [MATLAB, C])
@pytest.mark.parametrize(("text", "signature"), SIGNATURES)
def test_signature(text: str, signature: FunctionSignature, language: ActionLanguage) -> None:
    assert parse_signature(text, language) == signature


def test_input_that_is_not_used() -> None:
    assert parse_signature("y = f(~, b)", MATLAB) == FunctionSignature("f", (None, "b"), ("y",))


ACC = """function y = acc(f)
persistent s
if isempty(s)
    s = 0;
end
for i = 1:2
    s = s + f(i);
end
y = s;
"""
LOST = """% Whether a stamp is old.

function y = isLost(now, stamp) %#codegen
% Whole seconds: integer division rounds to the nearest.
dt_s = (now - stamp) / 1000;
if stamp == 0
    y = false;
    return;
end
y = dt_s >= 1;
end   % isLost
"""


def shown(text: str) -> list[tuple[str, str]]:
    return [(function.signature.name, actions(function.body)) for function in parse_script(text)]


def test_function_without_end() -> None:
    body = "persistent s | if isempty(s) <s = 0> | for i (: 1 2) <s = (+ s f(i))> | y = s"
    assert shown(ACC) == [("acc", body)]


def test_function_with_end() -> None:
    body = "dt_s = (/ (- now stamp) 1000) | if (== stamp 0) <y = false | return> | y = (>= dt_s 1)"
    assert shown(LOST) == [("isLost", body)]


@pytest.mark.parametrize("end", ["", "end\n", "end;\n\n"])
def test_several_functions(end: str) -> None:
    text = f"function y = f(x)\ny = g(x);\n{end}function y = g(x)\nif x, y = 1; else, y = 2; end\n{end}"
    assert shown(text) == [("f", "y = g(x)"), ("g", "if x <y = 1> else <y = 2>")]


def test_function_without_body() -> None:
    assert shown("function f") == [("f", "")]
    assert shown("function f\nend") == [("f", "")]


def test_places() -> None:
    first, second = parse_script("function f\nfunction g\n")
    assert (first.at, second.at) == (0, 11)
    assert (first.signature.at, second.signature.at) == (9, 20)
