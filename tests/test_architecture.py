"""Who may import whom: the contracts in pyproject.toml, and which third parties a package may need."""

import ast
import re
import sys
import tomllib
from collections.abc import Iterator
from itertools import chain
from pathlib import Path

import pytest
from importlinter.cli import lint_imports

ROOT = Path(__file__).parents[1]
CONFIG = ROOT / "pyproject.toml"
SETTINGS = tomllib.loads(CONFIG.read_text(encoding="utf-8"))
CONTRACTS = {c["id"]: c for c in SETTINGS["tool"]["importlinter"]["contracts"]}
TOP = "rovercheck"
PAGES = "docs"
"""A folder of what is installed from which nobody imports."""
PACKAGES = (TOP, *sorted(SETTINGS["tool"]["hatch"]["build"]["targets"]["wheel"]["sources"].keys() - {PAGES}))
"""The folders of what is installed: the first, and those that are packages below it."""
DISTRIBUTION = {
    "tree_sitter": "tree-sitter-c[core]",
    "tree_sitter_c": "tree-sitter-c[core]",
    "annotated_types": "annotated-types",
    "pysat": "python-sat",
    "typing_extensions": "typing-extensions",
    "vcd": "pyvcd",
    "z3": "z3-solver",
}
"""Import names that differ from the name to install."""


def modules(package: str) -> list[Path]:
    return sorted((ROOT / package).rglob("*.py"))


def imports(file: Path) -> Iterator[str]:
    """The modules that a file imports, anywhere in it, by absolute name."""
    for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
            yield node.module


def third_party(package: str) -> dict[str, Path]:
    """Top-level names that are neither the standard library's nor ours, each with a file that needs it."""
    found = {name.partition(".")[0]: file for file in modules(package) for name in imports(file)}
    return {n: f for n, f in found.items() if n not in sys.stdlib_module_names and n != TOP}


@pytest.mark.parametrize("contract", CONTRACTS)
def test_import_contract(contract: str, capsys: pytest.CaptureFixture[str]) -> None:
    status = lint_imports(str(CONFIG), limit_to_contracts=(contract,), cache_dir=None, no_cache=True)
    assert status == 0, f"{CONTRACTS[contract]['name']}\n{capsys.readouterr().out}"


def test_the_model_needs_only_the_standard_library() -> None:
    """And what reads labels, where there are some that are texts."""
    assert {**third_party("spec_model"), **third_party("properties")}.keys() == {"lark"}
    readers = [f for f in (ROOT / "spec_model").rglob("*.py") if re.search(r"(?m)^from lark", f.read_text())]
    assert {f.parent.name for f in readers} == {"stateflow"}


@pytest.mark.parametrize("package", PACKAGES)
def test_every_third_party_import_is_a_declared_dependency(package: str) -> None:
    """An extra counts: what needs it says how to install it."""
    extras = SETTINGS["project"]["optional-dependencies"].values()
    declared = " ".join([*SETTINGS["project"]["dependencies"], *chain.from_iterable(extras)])
    missing = {n: f for n, f in third_party(package).items() if f"{DISTRIBUTION.get(n, n)}>=" not in declared}
    assert missing == {}


def test_every_package_is_shipped_and_under_contract() -> None:
    found = {p.parent.name for p in ROOT.glob("*/__init__.py")} - {"tests", "benchmarks", "reports"}
    assert found == set(PACKAGES)
    assert found | {PAGES} == set(SETTINGS["tool"]["hatch"]["build"]["targets"]["wheel"]["only-include"])
    assert SETTINGS["tool"]["importlinter"]["root_packages"] == [TOP]


def test_every_folder_has_its_link_below_the_one_name() -> None:
    """Python, mypy and editors find in the repository what is installed elsewhere, under the same name."""
    links = {p.name: p.resolve() for p in (ROOT / TOP).iterdir() if p.is_symlink()}
    assert links == {name: ROOT / name for name in PACKAGES if name != TOP}


def test_nobody_imports_a_folder_by_another_name() -> None:
    """``checker.cli`` and ``rovercheck.checker.cli`` would be two modules with two of each class."""
    folders = (*PACKAGES, "tests", "benchmarks", PAGES)
    found = {
        n: f for p in folders for f in modules(p) for n in imports(f) if n.partition(".")[0] in PACKAGES[1:]
    }
    assert found == {}
