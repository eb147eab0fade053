"""Engines that contradict each other: exit code 3, and a folder with all that shows it."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from rovercheck.checker.commands.shared.codes import Exit, UsageError
from rovercheck.checker.commands.shared.disagreement import bundle
from rovercheck.checker.verify.portfolio import Disagreement

ROOT = Path(__file__).parents[2]
LIAR = '''
"""An engine for tests: says that nothing is ever reached."""

from rovercheck.checker.results.verdict import Inductive, Unreachable

NAME = "liar"
SUMMARY = "wrong on purpose"


def check(system, goals, limits, progress):
    return {g.name: Unreachable(Inductive(())) for g in goals}
'''
FOUND = "import rovercheck.checker.engines; rovercheck.checker.engines.__path__.append({folder!r})"


@pytest.fixture
def environment(tmp_path: Path) -> dict[str, str]:
    """One in which every Python finds one more engine."""
    engines = tmp_path / "site" / "engines"
    engines.mkdir(parents=True)
    (engines / "liar.py").write_text(LIAR, encoding="utf-8")
    (engines.parent / "sitecustomize.py").write_text(FOUND.format(folder=str(engines)), encoding="utf-8")
    path = os.pathsep.join([str(engines.parent), str(ROOT), os.environ.get("PYTHONPATH", "")])
    return {**os.environ, "PYTHONPATH": path}


def check(environment: dict[str, str], folder: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "rovercheck", "check", *arguments]
    return subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=False)


def test_a_lie_is_found_and_can_be_seen_again(environment: dict[str, str], tmp_path: Path) -> None:
    shown = check(environment, tmp_path, "PB1-30c-FL", "--all-engines", "--depth", "30")
    assert shown.returncode == Exit.INTERNAL, shown.stderr
    assert "engines disagree" in shown.stderr and "liar: never" in shown.stderr
    [folder] = tmp_path.glob("rovercheck-disagreement-*")
    assert folder.name in shown.stderr
    found = json.loads((folder / "disagreement.json").read_text(encoding="utf-8"))
    answers = {answer["engine"]: answer for answer in found["answers"]}
    assert answers["bmc"]["replays"] is True and len(answers["bmc"]["run"]["inputs"]) > 0
    assert answers["liar"]["run"] is None and answers["liar"]["replays"] is None
    assert {"python", "z3-solver"} <= found["versions"].keys()
    again = (folder / "README.md").read_text(encoding="utf-8")
    assert " ".join(found["command"]) in again
    assert check(environment, tmp_path, *found["command"][2:]).returncode == Exit.INTERNAL


def test_what_was_found_before_is_not_lost_to_machines(environment: dict[str, str], tmp_path: Path) -> None:
    shown = check(environment, tmp_path, "PB1-30c-FL", "--all-engines", "--depth", "30", "--json")
    assert shown.returncode == Exit.INTERNAL
    assert json.loads(shown.stdout)["complete"] is False


def test_a_folder_that_cannot_be_made_is_said(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    with pytest.raises(UsageError, match="Cannot write"):
        bundle(Disagreement("relay", "PB1-11", ()), ["rovercheck"], tmp_path / "file")


def test_honest_engines_agree(tmp_path: Path) -> None:
    shown = check(
        {**os.environ, "PYTHONPATH": str(ROOT)}, tmp_path, "PB1-30c-FL", "--all-engines", "--depth", "30"
    )
    assert shown.returncode == Exit.AS_EXPECTED, shown.stderr
    assert list(tmp_path.glob("rovercheck-disagreement-*")) == []
