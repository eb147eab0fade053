"""The chart language, from the docstrings of ``spec_model/lang`` and an example of each word."""

import ast
import importlib
import inspect
import textwrap
import tomllib
from collections.abc import Iterator
from dataclasses import replace
from operator import attrgetter
from pathlib import Path
from types import ModuleType
from typing import Any

from rovercheck.spec_model.lang.expr import Const, Expr, Var
from rovercheck.spec_model.lang.label import text

TABLE: dict[str, Any] = tomllib.loads(Path(__file__).with_name("examples.toml").read_text(encoding="utf-8"))
MODULES = (
    "domain", "expr", "words", "time", "action", "chart", "transition", "array", "function", "system", "edit",
)  # fmt: skip
HEAD = """# Chart language

A chart is a Python file in the words below. Each word stands with its text in the source, and an example;
beside the example of a formula is the label that it has on a transition. What has no meaning is refused when
it is written, with a message that says what to write.

In what is expected, an `Operand` is a formula, a number or a truth value; a `Number` may be a decimal, and is
taken as written; a `Span` is a length of time. The examples use

"""
PRELUDE = """from dataclasses import replace

Mode = enumeration("Mode", ["SLOW", "FAST"])
mode = var("mode", Mode)
minutes = var("minutes", integer(0, 9, "min"))
level = var("level", integer(0, 100, "%"))
previous_level = var("previous_level", integer(0, 100, "%"))
angle = var("angle", integer(-180, 180))
mask = var("mask", integer(0, 255))
full, door_open = flag("full"), flag("door_open")
opens, shuts = to("Open", when=door_open), to("Shut", when=~door_open)
door = Chart("Door", [State("Open", transitions=[shuts]), State("Shut")], default="Open")
two = Chart("Two", [State("Open", transitions=[shuts, opens]), State("Shut")], default="Open")
branching = Chart(
    "Branching",
    [State("Open", transitions=[to("j1")]), State("Shut")],
    junctions=[Junction("j1", [shuts, opens])],
    default="Open",
)
"""


def module(name: str) -> ModuleType:
    """A module of the language."""
    return importlib.import_module(f"rovercheck.spec_model.lang.{name}")


def words() -> dict[str, Any]:
    """Every name that a chart file may import, and ``replace``, which changes parts of one."""
    found: dict[str, Any] = {"replace": replace}
    for name in MODULES:
        found |= {n: v for n, v in vars(module(name)).items() if not n.startswith("_")}
    exec(PRELUDE, found)
    return found


def page() -> str:
    """The reference as Markdown.  Raises what an example without meaning raises."""
    scope = words()
    sections = (_section(section, scope) for section in TABLE["section"])
    return HEAD + fenced(PRELUDE) + "\n".join(line for section in sections for line in section)


def _section(section: dict[str, Any], scope: dict[str, Any]) -> Iterator[str]:
    yield f"\n## {section['title']}\n"
    home = "rovercheck" if section["module"] != "edit" else "rovercheck.spec_model.lang.edit"
    yield f"From `{home}`. {section['about']}\n"
    for name, entry in section["words"].items():
        word = attrgetter(name)(module(section["module"]))
        yield f"### {name}\n"
        yield fenced(signature(name, word)) if callable(word) else ""
        yield said(word, entry) + "\n"
        yield example(entry["example"], scope)


def signature(name: str, word: Any) -> str:
    """How a word is called, with the types as they are written in the source."""
    tree = ast.parse(textwrap.dedent(inspect.getsource(word))).body[0]
    if isinstance(tree, ast.ClassDef):
        made = {part.name: part for part in tree.body if isinstance(part, ast.FunctionDef)}
        maker = made.get("__init__") or made.get("__new__")
        arguments = ast.unparse(maker.args).split(", ", 1)[1] if maker else _fields(tree)
    else:
        assert isinstance(tree, ast.FunctionDef)
        arguments = ast.unparse(tree.args).removeprefix("self").removeprefix(", ")
    short = f"{name}({arguments})"
    return short if len(short) <= 90 else f"{name}(\n    {_by_lines(arguments)},\n)"


def _fields(tree: ast.ClassDef) -> str:
    return ", ".join(ast.unparse(part) for part in tree.body if isinstance(part, ast.AnnAssign))


def _by_lines(arguments: str) -> str:
    """One argument a line: broken at the commas outside brackets."""
    depth, lines = 0, [""]
    for letter in arguments:
        depth += (letter in "([{") - (letter in ")]}")
        if letter == "," and depth == 0:
            lines.append("")
        else:
            lines[-1] += letter
    return ",\n    ".join(line.strip() for line in lines)


def said(word: Any, entry: dict[str, str]) -> str:
    """The text of a word: its docstring, or what the table says of a plain value."""
    return entry.get("says") or (inspect.getdoc(word) or "").replace("``", "`")


def example(code: str, scope: dict[str, Any]) -> str:
    """An example, executed; of a formula also its label."""
    value = eval(code, dict(scope))
    label = text(value) if isinstance(value, Expr) and not isinstance(value, Var | Const) else ""
    shown = fenced(code)
    return f"{shown}\nOn a transition: `{label}`\n" if label and label != code else shown


def fenced(code: str) -> str:
    """Python on the page."""
    return f"```python\n{code.rstrip()}\n```\n"
