"""House rules a machine can see: small files, a first sentence in each, nothing of one person's machine."""

import ast
import os
import re
import tomllib
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).parents[1]
CONFIG = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
PACKAGES = CONFIG["tool"]["hatch"]["build"]["targets"]["wheel"]["only-include"]
MODULES = [p.relative_to(ROOT).as_posix() for name in PACKAGES for p in sorted((ROOT / name).rglob("*.py"))]
MOST_LINES = 400
LONGER: dict[str, int] = {}
"""Files whose parts are read together, each with a limit of its own."""
TEXT = {".py", ".md", ".toml", ".lock", ".txt", ".json", ".svg", ".html", ".csv", ".dot", ".mmd", ".vcd"}
SOMEONES_MACHINE = re.compile(r"(?<![\w.])/(?:work|root|home|Users)/\w|[A-Z]:\\Users|file:/{2}")


def test_the_modules_are_found() -> None:
    """Of every folder some: a link to a folder is no folder to ``rglob``."""
    assert {module.partition("/")[0] for module in MODULES} == set(PACKAGES)
    assert len(MODULES) > 500


def test_every_module_is_short_and_opens_with_a_sentence() -> None:
    """The first line says what the module is for."""
    sources = {module: (ROOT / module).read_text(encoding="utf-8") for module in MODULES}
    lines = {module: len(source.splitlines()) for module, source in sources.items()}
    assert {m: n for m, n in lines.items() if n > LONGER.get(m, MOST_LINES)} == {}
    assert [module for module, source in sources.items() if not ast.get_docstring(ast.parse(source))] == []


def texts() -> Iterator[Path]:
    """Every text file of the project; hidden folders and what a build leaves behind are not."""
    for folder, below, files in os.walk(ROOT):
        below[:] = [b for b in below if not b.startswith(".") and b not in ("build", "dist")]
        yield from (Path(folder, f) for f in files if Path(f).suffix in TEXT or f == "Makefile")
    yield from (ROOT / ".ci").glob("*")


def test_no_path_of_a_machine() -> None:
    found = [
        f"{file.relative_to(ROOT)}:{number}"
        for file in texts()
        for number, line in enumerate(file.read_text(encoding="utf-8").splitlines(), 1)
        if SOMEONES_MACHINE.search(line)
    ]
    assert found == []


def test_the_lock_names_hashes_and_no_package_index() -> None:
    lock = (ROOT / "requirements.lock").read_text(encoding="utf-8")
    pinned = [line for line in lock.splitlines() if re.match(r"[a-z0-9]", line)]
    assert pinned and all("==" in line and line.endswith("\\") for line in pinned)
    assert "--hash=sha256:" in lock
    assert not re.search(r"://|--(extra-)?index-url|--find-links", lock)
