"""A new operator is a row in the table of each reader of formulas; the tables that lack it are named here."""

import ast
from collections.abc import Mapping
from functools import cache
from importlib import import_module
from pathlib import Path

from rovercheck.spec_model.lang.operators import Op
from tests.encode.test_bitvector import CASES

ROOT = Path(__file__).parents[2]
NAME = "OPERATIONS"
WITHOUT = {
    "rovercheck.checker.conformance.program": "has the table of Python's text, with two rows for decimals",
    "rovercheck.checker.export.infix": "is the part that the tables of SMV and Promela have in common",
    "rovercheck.checker.drawn.charts.masks": "simplifies some operators, and leaves the others as they are",
    "rovercheck.checker.drawn.charts.tidy": "simplifies some operators, and leaves the others as they are",
    "rovercheck.checker.drawn.lower.bits": "makes formulas",
    "rovercheck.checker.drawn.lower.rounding": "makes formulas",
    "rovercheck.checker.system.wide_cells": "asks which operators keep the order of numbers",
    "rovercheck.checker.encode.terms": "simplifies some operators, and leaves the others as they are",
    "rovercheck.checker.mutate.rounding": "makes formulas",
    "rovercheck.spec_model.lang.words": "makes formulas",
}
"""What speaks of division, which every target writes in a way of its own, without a table."""


@cache
def targets() -> dict[str, ast.Module]:
    """The modules of the four packages, by name."""
    files = [f for p in ("spec_model", "properties", "checker") for f in sorted((ROOT / p).rglob("*.py"))]
    named = {".".join(("rovercheck", *f.relative_to(ROOT).with_suffix("").parts)): f for f in files}
    return {name: ast.parse(file.read_text(encoding="utf-8")) for name, file in named.items()}


def has_table(module: ast.Module) -> bool:
    found = [n.target for n in module.body if isinstance(n, ast.AnnAssign)]
    return any(isinstance(target, ast.Name) and target.id == NAME for target in found)


def divides(module: ast.Module) -> bool:
    return any(isinstance(n, ast.Attribute) and ast.unparse(n) == "Op.DIV" for n in ast.walk(module))


def lacking(tables: Mapping[str, Mapping[Op, object]]) -> dict[str, list[Op]]:
    """The operators without a row, by the name of the table."""
    return {name: gaps for name, rows in tables.items() if (gaps := [op for op in Op if op not in rows])}


def test_every_table_has_a_row_for_every_operator() -> None:
    tables = {name: getattr(import_module(name), NAME) for name, m in targets().items() if has_table(m)}
    assert lacking({**tables, "tests.encode.test_bitvector.CASES": CASES}) == {}


def test_a_table_that_lacks_a_row_is_named() -> None:
    assert lacking({"whole": CASES, "short": {op: () for op in CASES if op is not Op.MAX}}) == {
        "short": [Op.MAX]
    }


def test_what_speaks_of_operators_has_a_table() -> None:
    assert {name for name, m in targets().items() if divides(m) and not has_table(m)} == WITHOUT.keys()
