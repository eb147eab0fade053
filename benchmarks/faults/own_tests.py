"""Mutants against the supervisors' own tests: the link, which no chart describes, and what lies outside."""

import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from benchmarks.faults.judged import OUTSIDE, judgements
from benchmarks.faults.mutate import Mutant, mutants, path
from benchmarks.faults.package import PACKAGE, modules
from benchmarks.measure import ROOT

COPIED = (
    "rovercheck/__init__.py",
    "rovercheck/supervisor",
    "tests/supervisor",
    "tests/conftest.py",
    "tests/profiles.py",
    "pyproject.toml",
)
LINK = f"{PACKAGE}.link"
OF_THE_LINK = tuple(f"tests/supervisor/test_{name}.py" for name in ("crc", "frame", "heartbeat", "receiver"))
"""The tests of the link."""
LIMIT = 600
"""Seconds for the tests; a mutant with which they take longer is found by that."""


def of_the_link() -> Iterator[Mutant]:
    """The mutants of the link."""
    return (m for name in modules() if name.startswith(LINK) for m in mutants(name))


@contextmanager
def copied() -> Iterator[Path]:
    """A folder with the supervisors, their tests, and no more."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for part in COPIED:
            to = folder / part
            to.parent.mkdir(parents=True, exist_ok=True)
            (shutil.copytree if (ROOT / part).is_dir() else shutil.copy)(ROOT / part, to)
        yield folder


def outside() -> Iterator[Mutant]:
    """The mutants of the boards that are judged to lie outside what the charts give a meaning to."""
    known = judgements()
    places = {f"{PACKAGE}.{name.split()[0].rstrip(':')}" for name in known}
    made = (m for name in sorted(places) for m in mutants(name))
    return (m for m in made if m.name in known and known[m.name].kind == OUTSIDE)


def tests_of_the_boards() -> tuple[str, ...]:
    """The tests of all that is no bench, which needs more than is copied."""
    files = sorted((ROOT / "tests" / "supervisor").glob("test_*.py"))
    return tuple(f"tests/supervisor/{f.name}" for f in files if not f.name.startswith("test_bench"))


def fails(folder: Path, tests: Sequence[str]) -> bool:
    """Whether one of the tests of the folder fails."""
    command = [sys.executable, "-m", "pytest", "-x", "-q", "-p", "no:cacheprovider"]
    command += ["--hypothesis-profile=full", *tests]
    try:
        done = subprocess.run(command, cwd=folder, capture_output=True, timeout=LIMIT, check=False)
    except subprocess.TimeoutExpired:
        return True
    return done.returncode != 0


def examine(todo: Sequence[Mutant]) -> Iterator[tuple[Mutant, bool]]:
    """Each mutant, and whether the tests find it.  Raises ``RuntimeError`` if they fail without one."""
    with copied() as folder:
        if fails(folder, tests_of_the_boards()):
            raise RuntimeError("tests/supervisor fails as it is; mend that first")
        for mutant in todo:
            tests = OF_THE_LINK if mutant.module.startswith(LINK) else tests_of_the_boards()
            file = folder / path(mutant.module).relative_to(ROOT)
            original = file.read_bytes()
            file.write_text(mutant.source, encoding="utf-8")
            yield mutant, fails(folder, tests)
            file.write_bytes(original)
