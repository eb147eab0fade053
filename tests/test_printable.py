"""Texts from outside command no terminal and are not interpreted, wherever they are printed."""

import ast
import json
from io import StringIO
from pathlib import Path

import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from rich.console import RenderableType
from rich.padding import Padding
from rich.table import Table
from rich.text import Text

from rovercheck.checker.io.console import UnmarkedConsole
from rovercheck.checker.io.printable import json_text, one_line, printable

CHECKER = Path(__file__).parents[1] / "checker"
HOSTILE = "\x1b]0;owned\x07\x1b[31m:1234: :smile: [red]x[/red] [/] \x9b2J \u202eabc \r\b\x7f \ud800 \u2028"
"""Title and colour of a terminal, emoji, markup, an 8-bit escape, reversed text, half a character."""


def printed(thing: RenderableType, width: int = 4000) -> str:
    file = StringIO()
    UnmarkedConsole(file=file, width=width, soft_wrap=True).print(thing)
    return file.getvalue()


def harmless(text: str) -> bool:
    return all(c.isprintable() or c.isspace() for c in text) and not set(text) & set(
        "\r\x0b\x0c\x85\u2028\u2029"
    )


def test_what_is_escaped_and_what_stays() -> None:
    assert printable(HOSTILE) == (
        r"\x1b]0;owned\x07\x1b[31m:1234: :smile: [red]x[/red] [/] \x9b2J \u202eabc \r\x08\x7f \ud800 \u2028"
    )
    plain = "°C → ≤ ½ é 中 ✓ 👍\ttab\nline \xa0"
    assert printable(plain) == plain and one_line(plain) == plain.replace("\t", r"\t").replace("\n", r"\n")


@given(st.text(st.characters()))
@example(HOSTILE)
def test_every_text_becomes_harmless_and_stays_so(text: str) -> None:
    assert harmless(printable(text)) and printable(printable(text)) == printable(text)
    assert len(one_line(text).splitlines()) <= 1


@given(st.text(st.characters()), st.booleans())
@example(HOSTILE, True)
@example(HOSTILE, False)
def test_json_is_printable_and_says_the_same(text: str, ascii: bool) -> None:
    written = json_text({text: [text]}, ascii=ascii)
    assert harmless(written) and json.loads(written) == {text: [text]}
    assert not ascii or written.isascii()


@pytest.mark.parametrize("kind", ["text", "styled", "part", "cell", "cell text", "header", "title", "padded"])
@pytest.mark.parametrize(
    "text", [HOSTILE, "gcc: a.c:1234: [error] x", "[bold]", ":bug:", "[link=file:x]y[/link]"]
)
def test_it_is_printed_as_it_is_wherever_it_stands(kind: str, text: str) -> None:
    found = printed(_thing(kind, text))
    due = printable(
        "".join(c for c in text if kind in ("text", "cell", "header", "title") or c not in "\r\b\x07")
    )
    assert " ".join(due.split()) in " ".join(found.split()) and harmless(found)


def _thing(kind: str, text: str) -> RenderableType:
    table = Table(text if kind == "header" else "", title=text if kind == "title" else None, box=None)
    match kind:
        case "text":
            return text
        case "styled":
            return Text(text, style="bold")
        case "part":
            return Text("before ").append(text, style="red").append(" after")
        case "padded":
            return Padding(Text(text), (0, 4))
        case "cell":
            table.add_row(text)
        case "cell text":
            table.add_row(Text(text))
        case _:
            table.add_row("x" * 200)
    return table


def test_styles_stay_where_they_were() -> None:
    file = StringIO()
    console = UnmarkedConsole(file=file, width=80, force_terminal=True, color_system="standard", _environ={})
    console.print(Text("a\x1b").append("b\x9b", style="red").append("c"))
    assert file.getvalue() == "a\\x1b\x1b[31mb\x1b[0m\x1b[31m\\x9b\x1b[0mc\n"


@given(st.text(st.characters(), max_size=30))
def test_any_text_in_narrow_tables(text: str) -> None:
    table = Table("a", "b")
    table.add_row(text, Text(text))
    assert harmless(printed(table, 20))


# --- nothing prints past it ----------------------------------------------------------------------


def calls(tree: ast.AST) -> set[str]:
    return {ast.unparse(node.func) for node in ast.walk(tree) if isinstance(node, ast.Call)}


def test_no_module_makes_a_console_of_its_own_or_reads_markup() -> None:
    forbidden = {"Console", "rich.print", "Text.from_markup", "render_markup", "escape"}
    for module in sorted(CHECKER.rglob("*.py")):
        tree = ast.parse(module.read_text(encoding="utf-8"))
        from_rich = any(
            isinstance(node, ast.ImportFrom) and (node.module or "").startswith("rich")
            for node in ast.walk(tree)
        )
        assert not (from_rich and calls(tree) & forbidden), module


def test_what_verbs_print_for_programs_is_printable() -> None:
    """Whatever goes to standard output without the console is JSON made printable, or for GitHub."""
    for verb in sorted((CHECKER / "commands").glob("*.py")):
        for node in ast.walk(ast.parse(verb.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call) and ast.unparse(node.func) == "print":
                assert ast.unparse(node.args[0]).startswith("json_text(") or verb.stem == "ci", verb
