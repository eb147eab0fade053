"""``rovercheck crosscheck``: report, exit codes, tests that it writes, bad input."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

from checker.cli import run
from checker.commands.codes import Exit
from tests.conform import cross_faults

FAULTS = Path(cross_faults.__file__)
WIDTH = 80


def crosscheck(*arguments: str) -> Exit:
    return run(["crosscheck", *arguments])


def test_a_board_conforms(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    assert crosscheck("--system", "board2", "--examples", "1", "-o", str(tmp_path)) is Exit.AS_EXPECTED
    said = capsys.readouterr().out
    assert "✓ board2 conforms: " in said and "of boundaries" in said and "Arrows that no run took" in said
    assert list(tmp_path.iterdir()) == []
    assert all(len(line) <= WIDTH for line in said.splitlines()[1:])


def test_a_fault_is_shown_and_becomes_a_test(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    fault = f"python:{FAULTS}:StopsLate"
    code = crosscheck("--system", "board2", "--impl", fault, "--examples", "0", "-o", str(tmp_path))
    said = capsys.readouterr().out
    assert code is Exit.CHANGED
    assert "board2 does not conform" in said and "the charts took" in said
    written = min(tmp_path.glob("crosscheck_board2_*.py"))
    assert f"pytest {written}" in said
    ran = subprocess.run(
        [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", str(written)],
        capture_output=True,
        text=True,
        check=False,
        cwd=tmp_path,
        timeout=300,
    )
    assert ran.returncode == 1 and "1 failed" in ran.stdout


def test_results_for_machines(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    fault = f"python:{FAULTS}:SwappedSonars"
    code = crosscheck("--system", "board2", "--impl", fault, "--examples", "0", "--json", "-o", str(tmp_path))
    document = json.loads(capsys.readouterr().out)
    [result] = document["results"]
    assert document["exit"] == code == Exit.CHANGED and document["complete"]
    assert result["verdict"] == "mismatch" and result["distinct"] >= len(result["mismatches"]) > 0
    first = result["mismatches"][0]
    assert first["differences"] and Path(first["test"]).is_file() and first["step"] > 0
    assert result["arrows"]["taken"] + len(result["arrows"]["missing"]) == result["arrows"]["all"]


def test_an_implementation_that_crashes_is_inconclusive(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    fault = f"python:{FAULTS}:Crashing"
    code = crosscheck("--system", "board2", "--impl", fault, "--examples", "0", "-o", str(tmp_path))
    said = capsys.readouterr().out
    assert code is Exit.INCONCLUSIVE
    assert "nobody steers" in said and "step" in said and "inconclusive" in said


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (["--system", "board3"], "No board 'board3'"),
        (["--impl", "python:a:B"], "write --system"),
        (["--system", "board1", "--impl", "nonsense"], "names no implementation"),
        (["--system", "board1", "--impl", "python:no_such_module:X"], "no_such_module"),
        (["--system", "board1", "--tests", "no/such/folder"], "is no folder"),
        (["--profile", "long"], "profile"),
        (["--examples", "-1"], "examples"),
    ],
)
def test_bad_input(arguments: list[str], says: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert crosscheck(*arguments) is Exit.USAGE
    assert says in capsys.readouterr().err


def test_tests_of_a_folder_are_run_too(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    bad = tmp_path / "test.csv"
    names = (
        "now_ms,last_valid_b1_ms,b1_data_last_valid_ms,imu_last_valid_ms,ble_last_valid_ms,sonar_last_valid_ms,"
        "d1,d2,d3,yaw,gz_dps,bx_norm,ay_norm,btn1,btn2,crit_mask_b1,degr_mask_b1,"
        "wheel_speed_rpm_FL,wheel_speed_rpm_FR,wheel_speed_rpm_RL,wheel_speed_rpm_RR"
    )
    row = ",0,0,0,0,0,0,0,0,0,0,0,0,false,false,0,0,0,0,0,0"
    asked = ["--system", "board2", "--examples", "0", "--tests", str(tmp_path)]
    bad.write_text(f"{names}\n20{row}\n45{row}\n", encoding="utf-8")
    assert crosscheck(*asked) is Exit.USAGE
    assert "20 ms apart" in capsys.readouterr().err
    bad.write_text(f"{names}\n20{row}\nx{row}\n", encoding="utf-8")
    assert crosscheck(*asked) is Exit.USAGE
    assert "step 2" in capsys.readouterr().err
