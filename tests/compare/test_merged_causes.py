"""Deviations merged by the change of the charts that explains them."""

import json
from pathlib import Path

import pytest

from rovercheck.checker.adapters import python
from rovercheck.checker.cli import run
from rovercheck.checker.compare import cross_check, effort
from rovercheck.checker.compare.run_follower import RecordedRun
from rovercheck.checker.compare.variants import of_model
from rovercheck.checker.diagnosis.causes import by_cause
from rovercheck.checker.diagnosis.result import diagnose_board
from rovercheck.checker.model.load import load
from tests.model_files.files import BASELINE, FIRMWARE, HEATER


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "heater.py").write_text(HEATER, encoding="utf-8")
    (tmp_path / "baseline.toml").write_text(BASELINE, encoding="utf-8")
    (tmp_path / "firmware.py").write_text(FIRMWARE, encoding="utf-8")
    return tmp_path


def test_every_deviation_is_under_one_cause_with_and_without_a_change(folder: Path) -> None:
    board = of_model(load(folder / "heater.py"))
    firmware = python.start(f"{folder / 'firmware.py'}:Hot", board, isolated=False)
    runs: list[RecordedRun] = []
    result = cross_check(board, firmware, effort("ci", 5), deviating=runs.append)
    diagnosis = diagnose_board(board, [r.recording for r in runs], 20, deciding=False)
    merged = by_cause(result.deviations, diagnosis.parts)
    assert [c.change.kind for c in merged if c.change is not None] == ["limit"]
    for causes in (merged, by_cause(result.deviations, [])):
        told = [d.scope for cause in causes for d in cause.deviations]
        assert sorted(told) == sorted(d.scope for d in result.deviations)
    assert all(cause.change is None for cause in by_cause(result.deviations, []))


def test_the_command_names_the_planted_limit(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    asked = [
        *("compare", "--model", str(folder / "heater.py"), "--impl", f"python:{folder / 'firmware.py'}:Hot"),
        *("--examples", "5", "--mismatches", "0", "--causes"),
    ]
    assert run(asked) == 1
    told = " ".join(capsys.readouterr().out.split())
    assert "have 1 cause: - Heater behaves as with a limit of" in told
    assert "instead of 22 °C, open, in the guard of transition 1 from On: 1" in told
    assert run([*asked, "--json"]) == 1
    [row] = json.loads(capsys.readouterr().out)["results"]
    [cause] = row["causes"]
    assert cause["deviations"] == [one["id"] for one in row["mismatches"]]
    assert cause["change"]["old"] != cause["change"]["new"]
    assert cause["complete"]
