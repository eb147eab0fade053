"""Whether the tests notice when a rule of Stateflow's semantics is broken in the interpreter of drawn models.

    python -m benchmarks.chart_rules [RULE ...]

Copies the project, breaks one rule of chart_rules.toml after the other, and runs the tests of the interpreter
(tests/drawn) on each.  A rule is named by its first words.  The exit code is 1 if one is broken unnoticed.
"""

import shutil
import subprocess
import sys
import tempfile
import tomllib
from dataclasses import dataclass
from pathlib import Path

from benchmarks.edits import LEFT_OUT, ROOT

TESTS = (
    "tests/drawn/test_interpreter.py",
    "tests/drawn/test_interpreter_times.py",
    "tests/drawn/test_interpreter_numbers.py",
    "tests/drawn/test_diagram_runs.py",
)
INTERPRETER = Path("checker/drawn/interpret")


@dataclass(frozen=True)
class BrokenRule:
    """A rule, the module in which it stands, what is written there once, and what takes its place."""

    name: str
    module: str
    before: str
    after: str


def rules() -> list[BrokenRule]:
    """The rules and how each is broken."""
    text = Path(__file__).with_suffix(".toml").read_text(encoding="utf-8")
    return [BrokenRule(**one) for one in tomllib.loads(text)["rule"]]


def main(names: list[str]) -> int:
    """Break each rule, and print whether it is noticed; the exit code."""
    chosen = [one for one in rules() if not names or any(one.name.startswith(name) for name in names)]
    unnoticed = 0
    with tempfile.TemporaryDirectory(prefix="rovercheck-rules-") as place:
        project = Path(place) / "project"
        shutil.copytree(ROOT, project, symlinks=True, ignore=LEFT_OUT)
        if not tested(project):
            print("the tests fail though nothing is broken", file=sys.stderr)
            return 4
        for one in chosen:
            noticed = broken(project, one)
            unnoticed += not noticed
            print(f"{'noticed' if noticed else 'UNNOTICED':10} {one.name}", flush=True)
    print(f"{len(chosen) - unnoticed} of {len(chosen)} broken rules are noticed")
    return 1 if unnoticed else 0


def broken(project: Path, one: BrokenRule) -> bool:
    """Whether the tests fail with a rule broken, which is then as it was."""
    file = project / INTERPRETER / f"{one.module}.py"
    text = file.read_text(encoding="utf-8")
    if text.count(one.before) != 1:
        raise ValueError(f"{one.name}: {one.before!r} is {text.count(one.before)} times in {file.name}")
    file.write_text(text.replace(one.before, one.after), encoding="utf-8")
    try:
        return not tested(project)
    finally:
        file.write_text(text, encoding="utf-8")


def tested(project: Path) -> bool:
    """Whether the tests of the interpreter succeed in a copy of the project."""
    command = [sys.executable, "-m", "pytest", "-q", "-x", "-p", "no:cacheprovider", *TESTS]
    return subprocess.run(command, cwd=project, capture_output=True, check=False, timeout=900).returncode == 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
