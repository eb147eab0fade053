"""Engines that fail with an internal error: verdicts of the others, exit code 3, and a message."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
from junitparser import JUnitXml

from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.engines import explicit, kinduction

ROOT = Path(__file__).parents[2]
FOUND = "import rovercheck.checker.engines; rovercheck.checker.engines.__path__.insert(0, {folder!r})"
FAILED = "failed on {system} with AssertionError: two and two are five (rovercheck.checker.engines."


@pytest.fixture
def environment(tmp_path: Path) -> dict[str, str]:
    """One in which ``explicit``, which is asked first of all, fails."""
    return broken(tmp_path, "explicit")


def broken(folder: Path, *names: str) -> dict[str, str]:
    for name in names:
        place = folder / "site" / "engines" / name
        place.mkdir(parents=True)
        real = Path({"explicit": explicit, "kinduction": kinduction}[name].__file__ or "")
        said = f"__path__.append({str(real.parent)!r})\n" + real.read_text(encoding="utf-8")
        failing = "\n\ndef check(*_):\n    raise AssertionError('two and two are\\nfive')\n"
        (place / "__init__.py").write_text(said + failing, encoding="utf-8")
    engines = folder / "site" / "engines"
    (engines.parent / "sitecustomize.py").write_text(FOUND.format(folder=str(engines)), encoding="utf-8")
    path = os.pathsep.join([str(engines.parent), str(ROOT), os.environ.get("PYTHONPATH", "")])
    return {**os.environ, "PYTHONPATH": path, "COLUMNS": "400"}


def command(environment: dict[str, str], folder: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    line = [sys.executable, "-m", "rovercheck", *arguments]
    return subprocess.run(line, cwd=folder, env=environment, capture_output=True, text=True, check=False)


def test_another_engine_decides_and_the_error_is_told(environment: dict[str, str], tmp_path: Path) -> None:
    """What was asked ended as unknown, and with exit code 2."""
    shown = command(environment, tmp_path, "check", "PB1-11", "--junit", "j.xml")
    assert shown.returncode == Exit.INTERNAL, shown.stderr
    assert "PB1-11" in shown.stdout and "proved" in shown.stdout
    assert shown.stderr.count("Internal error: explicit " + FAILED.format(system="relay")) == 1
    assert "The verdicts of others stand." in shown.stderr and "please report it" in shown.stderr
    cases = {c.name: c for suite in JUnitXml.fromfile(str(tmp_path / "j.xml")) for c in suite}
    assert cases["PB1-11"].is_passed and "Internal error: explicit" in cases["faulty"].result[0].message


@pytest.mark.parametrize("how", [(), ("--all-engines",)])
def test_machines_are_told_the_code_and_every_verdict(
    how: tuple[str, ...], environment: dict[str, str], tmp_path: Path
) -> None:
    shown = command(environment, tmp_path, "check", "PB1-11", "--json", *how)
    found = json.loads(shown.stdout)
    assert shown.returncode == found["exit"] == Exit.INTERNAL and found["complete"] is True
    assert [row["verdict"] for row in found["results"]] == ["proved"]
    assert "Internal error: explicit failed" in shown.stderr


def test_one_engine_alone_leaves_it_unknown(environment: dict[str, str], tmp_path: Path) -> None:
    shown = command(environment, tmp_path, "check", "PB1-11", "--engine", "explicit")
    assert shown.returncode == Exit.INTERNAL
    assert "explicit failed with AssertionError: two and two are five" in " ".join(shown.stdout.split())


def test_a_counterexample_is_shown_all_the_same(environment: dict[str, str], tmp_path: Path) -> None:
    shown = command(environment, tmp_path, "trace", "PB1-15")
    assert shown.returncode == Exit.INTERNAL
    assert "tick" in shown.stdout and "Internal error: explicit failed" in shown.stderr


def test_the_doctor_names_the_engine(environment: dict[str, str], tmp_path: Path) -> None:
    shown = command(environment, tmp_path, "doctor", "--json")
    found = {f["name"]: f for f in json.loads(shown.stdout)["findings"]}
    assert found["engine explicit"]["ok"] is False and "AssertionError" in found["engine explicit"]["found"]
    assert found["engine bmc"]["ok"] and shown.returncode == Exit.FAILED
