"""``check-log --causes``: what explains the deviations of logs, on the terminal, in JSON and on the page."""

import json
from pathlib import Path
from typing import Any

import pytest
from jsonschema import Draft202012Validator

from rovercheck.checker.cli import run
from rovercheck.checker.commands.check_log import causes as causes_of_logs
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.logs import LogError
from tests.logs.recorded import Row, copied, long_log, written
from tests.schemas import published

LATE = "Safety_state behaves as if rover_safety_state is given a step later"
STEPS = 300


def late(rows: list[Row]) -> list[Row]:
    """The safety state a step later than it must be."""
    every = [row["rover_safety_state"] for row in rows]
    return [{**row, "rover_safety_state": old} for row, old in zip(rows, [0, *every[:-1]], strict=True)]


@pytest.fixture
def logs(tmp_path: Path) -> Path:
    rows = copied(long_log("board1"))
    written(tmp_path, late(rows[:STEPS]), name="one.csv")
    written(tmp_path, rows[:100], name="good.csv")
    other = late(rows[:STEPS])
    other[100]["wheel_status_FL"] = (int(other[100]["wheel_status_FL"]) + 1) % 3
    written(tmp_path, other, name="two.csv")
    return tmp_path


def document(place: Path, capsys: pytest.CaptureFixture[str], *more: str) -> Any:
    capsys.readouterr()
    code = run(["check-log", str(place), "--json", *more])
    found = json.loads(capsys.readouterr().out)
    Draft202012Validator(published("conform-1")).validate(found)
    assert found["exit"] == code == Exit.FAILED
    return found


def causes(found: Any) -> dict[str, set[str]]:
    """Of each cause the logs in which it is met; of what has none under the empty text."""
    told: dict[str, set[str]] = {}
    for one in found["campaign"]["findings"]:
        if one["word"] == "new":
            told.setdefault(one["cause"], set()).update(m["recording"] for m in one["sightings"])
    return told


def test_deviations_of_one_cause_are_one_finding_over_all_logs(
    logs: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert causes(document(logs, capsys, "--causes")) == {LATE: {"one.csv", "two.csv"}, "": {"two.csv"}}
    assert causes(document(logs, capsys)) == {"": {"one.csv", "two.csv"}}, "only where it is asked for"


def test_it_is_told_on_the_terminal_and_on_the_page(logs: Path, capsys: pytest.CaptureFixture[str]) -> None:
    page = logs.parent / "page.html"
    assert run(["check-log", str(logs), "--causes", "--html", str(page)]) is Exit.FAILED
    assert f"cause: {LATE}." in " ".join(capsys.readouterr().out.split())
    assert LATE in page.read_text("utf-8")
    assert run(["check-log", str(logs / "two.csv"), "--causes"]) is Exit.FAILED
    said = " ".join(capsys.readouterr().out.split())
    assert f"- {LATE}: 1 deviation" in said and "wheel_status_FL" in said and "nothing found" in said


def test_a_search_that_the_time_ends_says_so(logs: Path, capsys: pytest.CaptureFixture[str]) -> None:
    found = document(logs, capsys, "--causes", "--seconds", "1e-9")
    assert any("more with --seconds S" in note for note in found["campaign"]["notes"])


def test_what_is_known_is_told_apart_from_what_is_new_of_one_cause(
    logs: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    known = logs.parent / "known.toml"
    run(["check-log", str(logs / "one.csv"), "--write-known", str(known)])
    found = document(logs, capsys, "--causes", "--known", str(known))
    words = {one["cause"]: one["word"] for one in found["campaign"]["findings"]}
    assert words[LATE] == "known" and words[""] != "known"


def test_logs_that_cannot_be_read_again_are_told(
    logs: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def changed(*_: object) -> None:
        raise LogError("has changed")

    monkeypatch.setattr(causes_of_logs, "followed", changed)
    found = document(logs, capsys, "--causes")
    assert causes(found) == {"": {"one.csv", "two.csv"}}
    assert any("Causes were looked for without 2 logs" in note for note in found["campaign"]["notes"])
    run(["check-log", str(logs), "--causes"])
    assert "Causes were looked for without 2 logs" in " ".join(capsys.readouterr().out.split())
