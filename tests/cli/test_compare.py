"""``rovercheck compare``: report, exit codes, tests that it writes, bad input."""

import json
import subprocess
import sys
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import pytest
from jsonschema import validate

from rovercheck.checker.cli import run
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.compare import check, recorded_runs
from rovercheck.checker.compare.beside import Run
from rovercheck.checker.compare.environment import Environment
from rovercheck.spec_model.abstraction import boards
from tests.compare import cross_faults
from tests.compare.scenes import once
from tests.schemas import published

FAULTS = Path(cross_faults.__file__)
WIDTH = 80


@once
def recorded(env: Environment) -> Iterator[Run]:
    """The recorded counterexamples."""
    return recorded_runs.counterexamples(env.board)


@pytest.fixture(autouse=True)
def _on_counterexamples_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    """On the recorded counterexamples and the tests of a folder; tests/compare has the other runs."""

    def known(env: Environment, folder: Path | None) -> Iterator[Run]:
        yield from recorded(env)
        yield from recorded_runs.tests(folder, env.board) if folder else ()

    monkeypatch.setattr(check, "_known", known)


def compare(*arguments: str) -> Exit:
    return run(["compare", *arguments])


def test_a_board_conforms(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    assert compare("--system", "board2", "--examples", "1", "-o", str(tmp_path)) is Exit.AS_EXPECTED
    said = capsys.readouterr().out
    assert "✓ board2 conforms: " in said and "of boundaries" in said
    assert list(tmp_path.iterdir()) == []
    assert all(len(line) <= WIDTH for line in said.splitlines()[1:])


def test_a_fault_is_shown_and_becomes_a_test(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    fault, folder = f"python:{FAULTS}:StopsLate", tmp_path / "with a blank"
    code = compare("--system", "board2", "--impl", fault, "--examples", "0", "-o", str(folder))
    said = capsys.readouterr().out
    assert code is Exit.FAILED
    assert "board2 does not conform" in said and "the charts took" in said
    written = min(folder.glob("crosscheck_board2_*.py"))
    assert f"pytest '{written}'" in said, "a command that can be typed"
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
    asked = ["--system", "board2", "--impl", fault, "--examples", "0", "--no-causes"]
    code = compare(*asked, "--json", "-o", str(tmp_path))
    document = json.loads(capsys.readouterr().out)
    validate(document, published("crosscheck-1"))
    [result] = document["results"]
    assert document["exit"] == code == Exit.FAILED and document["complete"]
    assert result["verdict"] == "mismatch" and result["distinct"] >= len(result["mismatches"]) > 0
    first = result["mismatches"][0]
    assert first["differences"] and Path(first["test"]).is_file() and first["step"] > 0
    assert result["arrows"]["taken"] + len(result["arrows"]["missing"]) == result["arrows"]["all"]


def test_what_is_not_told_in_full_is_told_in_a_line_and_how_to_see_it(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    fault = f"python:{FAULTS}:StalePayload"
    asked = ["--system", "board1", "--impl", fault, "--examples", "0", "-o", str(tmp_path), "--no-causes"]
    assert compare(*asked, "--mismatches", "1") is Exit.FAILED
    said = " ".join(capsys.readouterr().out.split())
    assert compare(*asked, "--mismatches", "1", "--json") is Exit.FAILED
    [result] = json.loads(capsys.readouterr().out)["results"]
    found = result["mismatches"]
    assert result["distinct"] == len(found) > 1 and [m["small"] for m in found] == [
        True,
        *[False] * (len(found) - 1),
    ]
    assert len(list(tmp_path.glob("crosscheck_*.py"))) == 1 and [m["test"] for m in found[1:]] == [""] * (
        len(found) - 1
    )
    parts = Counter(one["decided_by"] for one in found)
    assert len(parts) < len(found) and f"({len(found)} findings of {len(parts)} parts)" in said
    assert f"Findings with a small run and a test: 1 of {len(found)}; " in said
    assert f"all of them with --mismatches {len(found)}." in said
    others = Counter(one["decided_by"] for one in found[1:])
    for number, one in enumerate(found[1:], 2):
        part, output = one["decided_by"], one["differences"][0]["output"]
        if others[part] > 1:
            more = "more " if part == found[0]["decided_by"] else ""
            assert said.count(f"{part} differs in {others[part]} {more}ways: ") == 1
            assert f" {number}. {output} " in said
        else:
            assert f"first in step {one['step']} of {one['origin']}" in said
            assert f"✗ {number}. board1, {part}: {output} " in said
    assert compare(*asked, "--mismatches", str(len(found))) is Exit.FAILED
    assert "all of them with" not in " ".join(capsys.readouterr().out.split())


def test_what_was_not_tried_is_said_with_the_reason(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.undo()
    fault = f"python:{FAULTS}:Crashing"
    asked = ["--system", "board2", "--impl", fault, "--examples", "7", "-o", str(tmp_path), "--failures", "2"]
    assert compare(*asked) is Exit.FAILED
    said = " ".join(capsys.readouterr().out.split())
    assert "tried, not all; given up after 2 runs not survived." in said
    assert "Random runs: 0 of 7 tried; given up after 2 runs not survived." in said
    assert "Try more with --failures N (now 2)." in said
    assert compare(*asked, "--json") is Exit.FAILED
    [result] = json.loads(capsys.readouterr().out)["results"]
    reason = "given up after 2 runs not survived"
    assert result["tried"][1] == {"kind": "random runs", "tried": 0, "of": 7, "because": reason}
    assert result["tried"][0]["because"] == reason and result["compared"] < result["steps"]


def test_a_crash_is_a_finding_that_becomes_a_test(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """On all runs, of which it does not survive the 50th."""
    monkeypatch.undo()
    fault = f"python:{FAULTS}:Crashing"
    code = compare("--system", "board2", "--impl", fault, "--examples", "0", "-o", str(tmp_path))
    said = capsys.readouterr().out
    assert code is Exit.FAILED
    assert "nobody steers" in said and "inputs that are not at rest" in said
    assert "does not conform (3 runs not survived, then the search gave up)" in " ".join(said.split())
    [written] = tmp_path.glob("crosscheck_board2_*.py")
    assert f"pytest {written}" in said
    assert pytest.main(["-q", "-p", "no:cacheprovider", str(written)]) is pytest.ExitCode.TESTS_FAILED
    assert "ImplementationError" in capsys.readouterr().out


DYING = """
import json, os, signal, sys
for line in sys.stdin:
    steps = 0 if "reset" in json.loads(line) else steps + 1
    if steps > 20:
        os.kill(os.getpid(), signal.SIGSEGV)
    print(json.dumps({} if "reset" in json.loads(line) else {"stop_pin": False}), flush=True)
"""


def test_a_command_that_dies_is_a_finding_and_what_it_answered_before_counts(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    program, tests = tmp_path / "dying.py", tmp_path / "tests"
    program.write_text(DYING, encoding="utf-8")
    asked = ["--system", "board2", "--impl", f"command:{sys.executable} {program}"]
    code = compare(*asked, "--examples", "0", "--json", "-o", str(tests))
    found = json.loads(capsys.readouterr().out)
    validate(found, published("crosscheck-1"))
    [result] = found["results"]
    assert code is Exit.FAILED
    assert all("SIGSEGV" in failure["message"] for failure in result["failures"])
    assert {f["step"] for f in result["failures"]} == {21}
    assert result["failures"][0]["inputs"].keys() == {s.name for s in boards()["board2"].inputs}
    assert Path(result["failures"][0]["test"]).is_file()


def test_other_charts_require_something_else(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    asked = ["--system", "board1", "--examples", "0", "--repair", "relay-without-delay"]
    assert compare(*asked, "-o", str(tmp_path)) is Exit.FAILED
    said = " ".join(capsys.readouterr().out.split())
    assert "charts under S45=IMMEDIATE with relay-without-delay; 0 random runs" in said
    assert "board1, Relay: give_b2_actuation is false instead of true" in said
    written = min(tmp_path.glob("crosscheck_board1_*.py"))
    text = " ".join(written.read_text(encoding="utf-8").split())
    assert "those of the charts under S45=IMMEDIATE with relay-without-delay as they were then" in text
    assert pytest.main(["-q", "-p", "no:cacheprovider", str(written)]) is pytest.ExitCode.TESTS_FAILED


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (["--interpret", "S43=any"], "leaves the sentence open"),
        (["--repair", "relay-with-delay"], "relay-without-delay"),
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
    assert compare(*arguments) is Exit.USAGE
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
    assert compare(*asked) is Exit.USAGE
    assert "20 ms apart" in capsys.readouterr().err
    bad.write_text(f"{names}\n20{row}\nx{row}\n", encoding="utf-8")
    assert compare(*asked) is Exit.USAGE
    assert "step 2" in capsys.readouterr().err
