"""Whether the tests notice when a rule of Stateflow's semantics is broken in a reading of drawn models.

    python -m benchmarks.chart_rules [--reading READING] [--write] [RULE ...]

Copies the project, breaks one rule of chart_rules.toml after the other, and runs the tests of its reading on
each: of the direct interpreter (``interpret``), of the lowering (``lower``), of what both rest on
(``drawn``), or of the packages (``simulink``): the one first that noticed it when the table was written with
``--write``.  Prints the first test that fails.  A rule is named by its first words.  The exit code is 1 if
one is broken unnoticed.
"""

import argparse
import re
import shutil
import subprocess
import sys
import tempfile
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import cast

import tomlkit
from tomlkit.items import AoT

from benchmarks.edits import LEFT_OUT, ROOT


@dataclass(frozen=True)
class Reading:
    """Where the modules of a reading are, and its tests, quick ones first."""

    folder: Path
    tests: tuple[str, ...]


@dataclass(frozen=True)
class BrokenRule:
    """A rule, the module of a reading it is in, what is written there once, and what takes its place."""

    name: str
    module: str
    before: str
    after: str
    reading: str = "interpret"
    noticed_by: str = ""
    """The test that has noticed it, which is run before all others."""


INTERPRETER = (
    "tests/drawn/test_interpreter.py", "tests/drawn/test_early_return.py",
    "tests/drawn/test_interpreter_times.py", "tests/drawn/test_interpreter_numbers.py",
    "tests/drawn/test_computed_numbers.py", "tests/drawn/test_arrays.py", "tests/drawn/test_diagram_runs.py",
    "tests/drawn/test_function_calls.py", "tests/drawn/test_merges.py",
    "tests/drawn/test_simulink_functions.py",
    "tests/drawn/test_boxes.py", "tests/drawn/test_atomic_subcharts.py",
    "tests/simulink/test_packages_by_hand.py", "tests/simulink/test_parameters.py",
    "tests/drawn/test_data_stores.py", "tests/drawn/test_machines.py", "tests/simulink/test_by_hand.py",
)  # fmt: skip
LOWERING = (
    "tests/drawn/test_lowering.py", "tests/drawn/test_lowering_blocks.py", *INTERPRETER,
    "tests/simulink/test_simulink_model.py", "tests/drawn/test_two_readings.py",
)  # fmt: skip
PACKAGES = (
    "tests/simulink/test_reader.py", "tests/simulink/test_diagrams.py",
    "tests/simulink/test_packages_by_hand.py", "tests/simulink/test_parameters.py",
    "tests/simulink/test_libraries.py", "tests/simulink/test_by_hand.py",
    "tests/drawn/test_simulink_functions.py",
)  # fmt: skip
READINGS: Mapping[str, Reading] = {
    "interpret": Reading(Path("checker/drawn/interpret"), INTERPRETER),
    "lower": Reading(Path("checker/drawn/lower"), LOWERING),
    "drawn": Reading(Path("checker/drawn"), INTERPRETER),
    "simulink": Reading(Path("checker/simulink"), PACKAGES),
}
TABLE = Path(__file__).with_suffix(".toml")
SECONDS = 900.0
"""After which tests that do not end are stopped."""
_TEST = re.compile(r"\S+::\S+")
_FAILED = re.compile(r"^(?:FAILED|ERROR) ([^\s\[]+)", re.MULTILINE)


def rules() -> list[BrokenRule]:
    """The rules and how each is broken."""
    return [BrokenRule(**one) for one in tomllib.loads(TABLE.read_text(encoding="utf-8"))["rule"]]


def written(table: str, noticed: Mapping[str, str]) -> str:
    """The table with the tests that have noticed its rules, by the names of these."""
    document = tomlkit.parse(table)
    for one in cast(AoT, document["rule"]):
        test = noticed.get(str(one["name"]), "")
        if _TEST.fullmatch(test):  # else the tests did not run, or did not end
            one["noticed_by"] = test
    return tomlkit.dumps(document)


def main(arguments: list[str]) -> int:
    """Break each rule, and print whether it is noticed; the exit code."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.chart_rules")
    parser.add_argument("--reading", choices=READINGS, action="append", help="only the rules of this reading")
    parser.add_argument("--write", action="store_true", help="note in the table which test noticed each")
    parser.add_argument("names", nargs="*", metavar="RULE", help="the first words of a rule")
    given = parser.parse_args(arguments)
    chosen = [
        one
        for one in rules()
        if one.reading in (given.reading or READINGS)
        and (not given.names or any(one.name.startswith(name) for name in given.names))
    ]
    noticed: dict[str, str] = {}
    with tempfile.TemporaryDirectory(prefix="rovercheck-rules-") as place:
        project = Path(place) / "project"
        shutil.copytree(ROOT, project, symlinks=True, ignore=LEFT_OUT)
        for reading in dict.fromkeys(one.reading for one in chosen):
            if failed := first_failure(project, READINGS[reading].tests):
                print(f"nothing is broken, and yet: {failed}", file=sys.stderr)
                return 4
        for one in chosen:
            if test := broken(project, one, READINGS[one.reading].tests):
                noticed[one.name] = test
            print(f"{one.reading:10} {one.name}: {test or 'UNNOTICED'}", flush=True)
    if given.write:
        TABLE.write_text(written(TABLE.read_text(encoding="utf-8"), noticed), encoding="utf-8")
    print(f"{len(noticed)} of {len(chosen)} broken rules are noticed")
    return 0 if len(noticed) == len(chosen) else 1


def broken(project: Path, one: BrokenRule, tests: Sequence[str]) -> str:
    """The first test that fails with a rule broken, which is then as it was; empty if none does."""
    file = project / READINGS[one.reading].folder / f"{one.module}.py"
    text = file.read_text(encoding="utf-8")
    if text.count(one.before) != 1:
        raise ValueError(f"{one.name}: {one.before!r} is {text.count(one.before)} times in {file.name}")
    file.write_text(text.replace(one.before, one.after), encoding="utf-8")
    try:
        if one.noticed_by and first_failure(project, [one.noticed_by]) == one.noticed_by:
            return one.noticed_by
        return first_failure(project, tests)
    finally:
        file.write_text(text, encoding="utf-8")


def first_failure(project: Path, tests: Sequence[str]) -> str:
    """The first of some tests that fails in a copy of the project; empty if all succeed."""
    command = [sys.executable, "-m", "pytest", "-q", "-x", "-p", "no:cacheprovider", *tests]
    try:
        done = subprocess.run(
            command, cwd=project, capture_output=True, check=False, timeout=SECONDS, text=True
        )
    except subprocess.TimeoutExpired:
        return "the tests do not end"
    if done.returncode == 0:
        return ""
    found = _FAILED.search(done.stdout)
    last = (done.stdout + done.stderr).strip().splitlines()[-1:]
    return found[1] if found else ": ".join(["the tests do not run", *last])


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
