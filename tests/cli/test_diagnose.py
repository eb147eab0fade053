"""``rovercheck diagnose``: what it prints, the variant it writes, its exit codes."""

import json
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from rovercheck.checker.cli import run
from rovercheck.checker.commands.shared.codes import Exit
from tests.logs.recorded import copied, long_log, written
from tests.schemas import published

EXAMPLES = Path("examples/logs")
FAULTS = (str(EXAMPLES / "faults.csv"), "--map", str(EXAMPLES / "map.toml"))


def diagnose(*arguments: str) -> Exit:
    return run(["diagnose", *arguments])


def test_the_causes_of_a_log_are_told_and_written(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    variant = tmp_path / "variant.toml"
    assert diagnose(*FAULTS, "--write", str(variant), "--json") is Exit.FAILED
    document: Any = json.loads(capsys.readouterr().out)
    jsonschema.validate(document, published("diagnose-1"))
    [board] = document["boards"]
    causes = {p["part"]: p["cause"] and p["cause"]["says"] for p in board["parts"]}
    assert causes == {
        "Monitor_temperature": None,
        "Monitor_wheel_FL": "Monitor_wheel_FL behaves as if hasNoFeedback_FR is read in place of "
        "hasNoFeedback_FL",
        "Monitor_wheel_FR": "Monitor_wheel_FR behaves as if hasNoFeedback_FL is read in place of "
        "hasNoFeedback_FR",
        "Safety_state": "Safety_state behaves as if rover_safety_state is given a step later",
    }
    assert all(p["tried"] == p["candidates"] for p in board["parts"])
    assert diagnose(*FAULTS, "--variant", str(variant), "--seconds", "20") is Exit.FAILED
    told = capsys.readouterr().out
    assert "Safety_state" not in told and "Monitor_wheel" not in told
    # Two columns of that log are exchanged, no wheels: its masks are those of the charts.
    assert "Fault_masks behaves as if wheel_status_FL and wheel_status_FR are" in told


def test_a_log_of_the_charts_has_no_cause(capsys: pytest.CaptureFixture[str]) -> None:
    assert diagnose(str(EXAMPLES / "good.csv")) is Exit.AS_EXPECTED
    assert "no deviation from the charts" in capsys.readouterr().out


def test_the_time_that_is_over_is_said(capsys: pytest.CaptureFixture[str]) -> None:
    assert diagnose(*FAULTS, "--seconds", "0.000001") is Exit.FAILED
    assert "not all candidates tried:" in capsys.readouterr().out


def test_a_folder_has_each_cause_once(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A status that is late in two logs, and a file that is no log."""
    for name, rows in (("one.csv", long_log("board1")[:500]), ("two.csv", long_log("board1")[:800])):
        late = copied(rows)
        for row, before in zip(late[:0:-1], late[-2::-1], strict=True):
            row["batt_status"] = before["batt_status"]
        written(tmp_path, late, name=name)
    (tmp_path / "three.csv").write_text("a,b\n1,2\n", encoding="utf-8")
    assert diagnose(str(tmp_path)) is Exit.FAILED
    told = " ".join(capsys.readouterr().out.split())
    assert "1 cause found" in told and "three.csv: not read:" in told
    assert "Monitor_battery behaves as if batt_status is given a step later" in told
    assert "in 2 recordings" in told


@pytest.mark.parametrize(
    "options",
    [
        ("--variant", "missing.toml"),
        ("--map", "missing.toml"),
        ("--system", "board3"),
        ("--seconds", "0"),
        ("--write", "missing/variant.toml"),
    ],
)
def test_what_has_no_meaning_is_one_message(options: tuple[str, str], tmp_path: Path) -> None:
    given = (options[0], str(tmp_path / options[1]) if options[1].endswith("toml") else options[1])
    log = FAULTS if options[0] == "--write" else (FAULTS[0],)
    assert diagnose(*log, *given, *(("--seconds", "5") if options[0] == "--write" else ())) is Exit.USAGE


def test_a_folder_without_logs_has_its_code(tmp_path: Path) -> None:
    assert diagnose(str(tmp_path)) is Exit.NOTHING


def test_a_torn_log_is_told_as_far_as_it_goes(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    torn = tmp_path / "torn.csv"
    torn.write_text((EXAMPLES / "good.csv").read_text(encoding="utf-8")[:-40], encoding="utf-8")
    assert diagnose(str(torn)) is Exit.INCONCLUSIVE
    told = " ".join(capsys.readouterr().out.split())
    assert "no deviation from the charts" in told
    assert "torn.csv: told up to what cannot be read: line" in told
