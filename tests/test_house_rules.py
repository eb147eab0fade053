"""House rules that a machine can see: small files, a first sentence in each, nothing of one person's machine."""

import ast
import re
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
CONFIG = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
PACKAGES = CONFIG["tool"]["importlinter"]["root_packages"]
MODULES = [p.relative_to(ROOT).as_posix() for package in PACKAGES for p in sorted((ROOT / package).rglob("*.py"))]
MOST_LINES = 400
TEXT = {".py", ".md", ".toml", ".lock", ".txt", ".json", ".svg", ".html", ".csv", ".dot", ".mmd", ".yaml", ".vcd"}
SOMEONES_MACHINE = re.compile(r"(?<![\w.])/(?:work|root|home|Users)/\w|[A-Z]:\\Users|file://")


@pytest.mark.parametrize("module", MODULES)
def test_a_module_is_short_and_opens_with_a_sentence(module: str) -> None:
    source = (ROOT / module).read_text(encoding="utf-8")
    assert len(source.splitlines()) <= MOST_LINES
    assert ast.get_docstring(ast.parse(source)), "the first line says what the module is for"


def test_no_path_of_a_machine() -> None:
    found = []
    for file in ROOT.rglob("*"):
        parts = file.relative_to(ROOT).parts
        hidden = any(p.startswith(".") or p in ("build", "dist") for p in parts)
        if file.suffix in TEXT and not hidden and file.is_file():
            lines = file.read_text(encoding="utf-8").splitlines()
            found += [f"{'/'.join(parts)}:{n}" for n, line in enumerate(lines, 1) if SOMEONES_MACHINE.search(line)]
    assert found == []


def test_the_lock_names_hashes_and_no_package_index() -> None:
    lock = (ROOT / "requirements.lock").read_text(encoding="utf-8")
    pinned = [line for line in lock.splitlines() if re.match(r"[a-z0-9]", line)]
    assert pinned and all("==" in line and line.endswith("\\") for line in pinned)
    assert "--hash=sha256:" in lock
    assert not re.search(r"://|--(extra-)?index-url|--find-links", lock)
