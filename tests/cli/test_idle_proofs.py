"""Proofs that kill no known mutant of the charts are named by `check`."""

import json
from pathlib import Path

import pytest

from rovercheck.checker.cli import run
from rovercheck.checker.commands.shared.codes import Exit
from tests.cli.test_report import EMPTY

pytestmark = pytest.mark.usefixtures("no_child")

IDLE = """
IDLE = always("IDLE", "It is lit or not.", that=lamp | ~lamp, covers=["R"], on="hall")
"""


@pytest.fixture
def hall(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> Path:
    file = tmp_path / "hall.py"
    file.write_text(EMPTY + IDLE, encoding="utf-8")
    return file


def checked(hall: Path, *options: str) -> Exit:
    return Exit(run(["check", "--model", str(hall), *options]))


def recorded(hall: Path) -> None:
    assert run(["mutate", "--model", str(hall), "--record-kills", "--timeout", "10"]) == Exit.AS_EXPECTED


def test_a_proof_that_notices_no_fault_is_told(hall: Path, capsys: pytest.CaptureFixture[str]) -> None:
    said = "no mutant of the charts is known that they kill: IDLE."
    assert checked(hall, "FULL", "IDLE") == Exit.AS_EXPECTED, "no faults are recorded"
    assert said not in capsys.readouterr().out
    recorded(hall)
    assert "None was found for IDLE." in capsys.readouterr().out
    assert checked(hall, "FULL", "IDLE") == Exit.AS_EXPECTED
    assert said in capsys.readouterr().out
    assert checked(hall, "FULL") == Exit.AS_EXPECTED
    assert "no mutant of the charts is known" not in capsys.readouterr().out


def test_strict_makes_it_an_error(hall: Path, capsys: pytest.CaptureFixture[str]) -> None:
    recorded(hall)
    assert checked(hall, "FULL", "IDLE", "--strict") == Exit.INCONCLUSIVE
    assert checked(hall, "FULL", "--strict") == Exit.AS_EXPECTED
    assert "1 proof kills a mutant of the charts." in capsys.readouterr().out
    assert checked(hall, "FULL", "IDLE", "--strict", "--quiet") == Exit.INCONCLUSIVE
    assert "no mutant of the charts is known that they kill: IDLE." in capsys.readouterr().out
    hall.with_name("baseline.toml").write_text('[IDLE]\nno_fault = "A tautology."\n', encoding="utf-8")
    assert checked(hall, "FULL", "IDLE", "--strict") == Exit.AS_EXPECTED


def test_json_says_of_each_proof_whether_it_notices_a_fault(
    hall: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    recorded(hall)
    capsys.readouterr()
    checked(hall, "--json")
    rows = json.loads(capsys.readouterr().out)["results"]
    assert {row["id"]: row["noticed"] for row in rows} == {"EMPTY": True, "FULL": True, "IDLE": False}


def test_a_reason_in_the_baseline_excuses_it(hall: Path, capsys: pytest.CaptureFixture[str]) -> None:
    recorded(hall)
    baseline = hall.with_name("baseline.toml")
    baseline.write_text('[IDLE]\nno_fault = "A tautology, for the tests."\n', encoding="utf-8")
    assert checked(hall, "FULL", "IDLE") == Exit.AS_EXPECTED
    assert "no mutant of the charts is known" not in capsys.readouterr().out
    baseline.write_text('[IDLE]\nno_fault = ""\n', encoding="utf-8")
    assert checked(hall, "IDLE") == Exit.USAGE
    assert "IDLE needs because = and verdict =" in " ".join(capsys.readouterr().err.split())


def test_a_property_that_says_less_than_its_kill_is_told_once_kills_are_recorded_anew(
    hall: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    recorded(hall)
    hall.write_text(hall.read_text(encoding="utf-8").replace('active("On"), lamp)', 'active("On"), True)'))
    recorded(hall)
    assert "None was found for FULL, IDLE." in capsys.readouterr().out
