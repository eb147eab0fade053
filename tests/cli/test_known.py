"""Known deviations, for ``compare`` and ``check-log``: expected, gone, changed, expired; bad files."""

import json
from collections.abc import Iterator, Sequence
from datetime import date, timedelta
from itertools import islice
from pathlib import Path
from typing import Any

import pytest
from jsonschema import validate

from rovercheck.checker.cli import run
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.compare import check
from rovercheck.checker.compare.beside import Run
from rovercheck.checker.compare.environment import Environment
from rovercheck.checker.compare.recorded_runs import counterexamples
from rovercheck.checker.conformance.known_file import known_of, known_text
from rovercheck.spec_model.abstraction import boards
from rovercheck.spec_model.lang.errors import ModelError
from tests.compare.scenes import once, scenes
from tests.logs.recorded import Row, copied, long_log, written
from tests.schemas import published

FIRMWARE = """
from rovercheck.checker.adapters.firmware import places
from rovercheck.checker.adapters.python_calls import Instance
from rovercheck.spec_model.abstraction import boards
from rovercheck.supervisor.board1 import Board1

class Faulty:
    def __init__(self):
        self._right = Instance(Board1, places(boards()["board1"]))

    def step(self, inputs):
        read = dict(inputs)
        %s
        found = dict(self._right.step(read))
        %s
        return found
"""
WARM = "read['temperature_degC'] = min(read['temperature_degC'], 54.0)"
EMPTY = "read['battery_pct'] = max(read['battery_pct'], 30.0)"
WHEEL = "read['hasNoFeedback_FL'] = False"
HALF = "found['v_ref'] = found['v_ref'] / 2"
TURN = "found['omega_user'] = found['omega_user'] + 0.25"
WARM_LATER = "read['temperature_degC'] = min(read['temperature_degC'], 59.0)"


@once
def short_runs(env: Environment) -> Iterator[Run]:
    """The scenes of tests/compare and a few runs of the model checker."""
    yield from scenes(env)
    yield from islice(counterexamples(env.board), 5)


@pytest.fixture(autouse=True)
def _on_short_runs_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(check, "_known", lambda env, folder: short_runs(env))


def firmware(folder: Path, reads: Sequence[str] = (), gives: Sequence[str] = ()) -> str:
    file = folder / "firmware.py"
    file.write_text(FIRMWARE % ("; ".join(reads) or "pass", "; ".join(gives) or "pass"), encoding="utf-8")
    return f"python:{file}:Faulty"


def compare(address: str, folder: Path, *more: str, causes: bool = False) -> Exit:
    return run(["compare", "--system", "board1", "--impl", address, "--examples", "0", "--mismatches", "0",
                "-o", str(folder), *([] if causes else ["--no-causes"]), *more])  # fmt: skip


def document(address: str, folder: Path, capsys: pytest.CaptureFixture[str], *more: str) -> Any:
    capsys.readouterr()
    code = compare(address, folder, "--json", *more)
    found = json.loads(capsys.readouterr().out)
    validate(found, published("crosscheck-1"))
    assert found["exit"] == code
    return found["results"][0]


@pytest.fixture
def known(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> Path:
    """The deviations of a firmware with two faults."""
    file = tmp_path / "known.toml"
    assert compare(firmware(tmp_path, [WARM], [HALF]), tmp_path, "--write-known", str(file)) is Exit.FAILED
    capsys.readouterr()
    return file


def words(found: Any) -> dict[str, int]:
    told: dict[str, int] = {}
    for one in found["mismatches"]:
        told[one["known"]] = told.get(one["known"], 0) + 1
    return told


# --- compare ------------------------------------------------------------------------------------


def test_what_is_known_is_expected_and_goes_on_being_checked(
    known: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    address = firmware(tmp_path, [WARM], [HALF])
    assert compare(address, tmp_path, "--known", str(known)) is Exit.AS_EXPECTED
    said = " ".join(capsys.readouterr().out.split())
    assert "known deviations and no other" in said and "(known as board1-temp_status-" in said
    found = document(address, tmp_path, capsys, "--known", str(known))
    assert found["verdict"] == "known" and set(words(found)) == {"known"}
    assert {row["verdict"] for row in found["known"]} == {"seen"}
    assert {one["id"] for one in found["mismatches"]} == {row["id"] for row in found["known"]}


def test_three_faults_on_top_are_all_new(
    known: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    found = document(firmware(tmp_path, [WARM, EMPTY, WHEEL], [HALF, TURN]), tmp_path, capsys,
                     "--known", str(known))  # fmt: skip
    new = {d["output"] for one in found["mismatches"] if one["known"] == "new" for d in one["differences"]}
    assert new == {"batt_status", "wheel_status_FL", "omega_user"}
    assert found["verdict"] == "mismatch" and words(found)["known"] == len(found["known"])


def test_what_is_gone_is_said_and_is_no_fault(
    known: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    address = firmware(tmp_path, [], [HALF])
    assert compare(address, tmp_path, "--known", str(known)) is Exit.AS_EXPECTED
    said = " ".join(capsys.readouterr().out.split())
    assert "is gone: what it is about was put to the test" in said
    found = document(address, tmp_path, capsys, "--known", str(known))
    gone = {row["id"] for row in found["known"] if row["verdict"] == "gone"}
    assert gone and all(id.startswith("board1-temp_status-") for id in gone)
    assert (
        document("python:rovercheck.supervisor.board1:Board1", tmp_path, capsys, "--known", str(known))[
            "verdict"
        ]
        == "conforms"
    )


def test_what_nothing_put_to_the_test_is_not_gone(
    known: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def short(env: Environment, folder: Path | None) -> Iterator[Run]:
        yield from islice(counterexamples(env.board), 1)

    monkeypatch.setattr(check, "_known", short)
    found = document(firmware(tmp_path), tmp_path, capsys, "--known", str(known))
    assert {row["verdict"] for row in found["known"] if row["id"].startswith("board1-temp")} == {"not met"}


def test_another_shape_is_a_change_and_not_known(
    known: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    other = "found['v_ref'] = found['v_ref'] / 2; found['temp_status'] = 2 - found['temp_status']"
    address = firmware(tmp_path, [], [other])
    assert compare(address, tmp_path, "--known", str(known)) is Exit.FAILED
    said = " ".join(capsys.readouterr().out.split())
    assert (
        "has changed: another one was met in its place" in said
        and "(new shape of board1-temp_status-" in said
    )
    found = document(address, tmp_path, capsys, "--known", str(known))
    assert words(found)["changed"] and "changed" in {row["verdict"] for row in found["known"]}


def test_what_has_expired_is_not_known(
    known: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    address, text = firmware(tmp_path, [WARM], [HALF]), known.read_text(encoding="utf-8")
    today = date.today()
    known.write_text(text.replace('until = "never"', f"until = {today + timedelta(2)}"), encoding="utf-8")
    assert compare(address, tmp_path, "--known", str(known)) is Exit.AS_EXPECTED
    yesterday = today - timedelta(1)
    known.write_text(text.replace('until = "never"', f"until = {yesterday}"), encoding="utf-8")
    capsys.readouterr()
    assert compare(address, tmp_path, "--known", str(known)) is Exit.FAILED
    assert f"has expired on {yesterday}" in " ".join(capsys.readouterr().out.split())


def test_a_crash_is_never_known(known: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    address = firmware(
        tmp_path, [WARM], [HALF, "found['temp_status'] or 1 / 0 if inputs['now_ms'] > 40 else 0"]
    )
    assert compare(address, tmp_path, "--known", str(known)) is Exit.FAILED


def test_writing_again_keeps_reasons_and_the_order_and_leaves_out_what_is_gone(
    known: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = known.read_text(encoding="utf-8")
    filled = text.replace('reason = ""', 'reason = "a \\"word\\", ü"').replace(
        'until = "never"', "until = 2999-12-31"
    )
    known.write_text(filled, encoding="utf-8")
    compare(firmware(tmp_path, [WARM], [HALF]), tmp_path, "--known", str(known), "--write-known", str(known))
    assert known.read_text(encoding="utf-8") == filled
    compare(firmware(tmp_path, [WARM], [HALF]), tmp_path, "--write-known", str(known))
    assert known.read_text(encoding="utf-8") == filled, "also where it is not named as known"
    compare(firmware(tmp_path, [EMPTY], [HALF]), tmp_path, "--write-known", str(known))
    whole = known_of(known.read_text(encoding="utf-8"), "known", boards(), "")
    after = whole.deviations
    assert {one.scope.outputs for one in after} == {("batt_status",), ("v_ref",)}
    assert {bool(one.reason) for one in after if one.scope.outputs == ("v_ref",)} == {True}
    assert known_text(reversed(after), "", reversed(whole.causes)) == known.read_text(encoding="utf-8")


BAD = [
    ('format = "rovercheck/known/1"', "format = 7", "this version reads"),
    ('charts = "as specified"', 'charts = "under S43=AND"', "it is of charts 'under S43=AND'"),
    ('reason = ""', 'because = ""', "has no 'because'"),
    ('owner = ""', "owner = 3", "write a text in quotes"),
    ('owner = ""\n', "", "owner is missing"),
    ('until = "never"', 'until = "2027-13-01"', "write a date without quotes"),
    ('until = "never"', "until = 2027-13-01", "is no TOML"),
    ('until = "never"', "until = 2027-01-01T00:00:00Z", "write a date without quotes"),
    ('board = "board1"', 'board = "board9"', "no board 'board9'"),
    ('part = "Monitor_temperature"', 'part = "Monitor_lamp"', "has no part 'Monitor_lamp'"),
    ('output = "temp_status"', 'output = "lamp"', "has no output 'lamp'"),
    ('kind = "value"', 'kind = "odd"', "no kind 'odd'"),
    ("differences = [", "differences = [3, ", "no list of tables"),
]


@pytest.mark.parametrize(("old", "new", "says"), BAD)
def test_a_bad_file_is_one_message_with_its_place(
    old: str, new: str, says: str, known: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = known.read_text(encoding="utf-8")
    assert old in text
    known.write_text(text.replace(old, new, 1), encoding="utf-8")
    for more in (["--known", str(known)], ["--write-known", str(known)]):
        assert compare(firmware(tmp_path), tmp_path, *more) is Exit.USAGE
        printed = capsys.readouterr().err
        assert says in " ".join(printed.split()) and known.name in printed and "Traceback" not in printed
    assert known.read_text(encoding="utf-8") == text.replace(old, new, 1), "never written over"


def test_places_are_lines_and_ids_are_single(known: Path) -> None:
    text = known.read_text(encoding="utf-8")
    lines = text.splitlines()
    at = [i for i, line in enumerate(lines, 1) if line.startswith("until")]
    lines[at[1] - 1] = "until = 5"
    with pytest.raises(ModelError, match=f"^known:{at[1]}: until is 5"):
        known_of("\n".join(lines), "known", boards(), "")
    record = text[text.index("[[deviation]]") :]
    with pytest.raises(ModelError, match="two of the id"):
        known_of(text + record, "known", boards(), "")


def test_a_file_of_another_board_is_refused(
    known: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    asked = ["compare", "--system", "board2", "--examples", "0", "-o", str(tmp_path), "--known", str(known)]
    assert run(asked) is Exit.USAGE
    assert "knows deviations of board1 alone" in " ".join(capsys.readouterr().err.split())
    assert compare(firmware(tmp_path), tmp_path, "--known", str(tmp_path / "none.toml")) is Exit.USAGE
    assert "cannot be read" in capsys.readouterr().err


# --- check-log ----------------------------------------------------------------------------------


def rows(*wrong: str, at: Sequence[int] = (30,)) -> list[Row]:
    """A log in which outputs are wrong that no property speaks of, or a status."""
    found = copied(long_log("board1")[:120])
    for place in at:
        for name in wrong:
            value = found[place][name]
            found[place][name] = (value + 1) % 3 if isinstance(value, int) else value + 0.125
    return found


def check_log(place: Path, *more: str) -> Exit:
    return run(["check-log", str(place), *more])


def test_logs_of_a_folder_have_each_deviation_once_and_know_it(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    folder, file = tmp_path / "logs", tmp_path / "known.toml"
    folder.mkdir()
    written(folder, rows("v_user"), name="a.csv")
    written(folder, rows("v_user", at=(30, 60)), name="b.csv")
    assert check_log(folder, "--write-known", str(file)) is Exit.FAILED
    assert "in 2 of 2 logs" in " ".join(capsys.readouterr().out.split())
    assert check_log(folder, "--known", str(file)) is Exit.AS_EXPECTED
    capsys.readouterr()
    assert check_log(folder / "a.csv", "--known", str(file)) is Exit.AS_EXPECTED
    assert "known as board1-v_user-" in capsys.readouterr().out
    written(folder, rows("omega_user"), name="c.csv")
    assert check_log(folder, "--known", str(file), "--json") is Exit.FAILED
    found = json.loads(capsys.readouterr().out)
    validate(found, published("conform-1"))
    told = {one["outputs"][0]: one["known"] for one in found["deviations"]}
    assert told == {"v_user": "known", "omega_user": "new"}
    assert {row["verdict"] for row in found["known"]} == {"seen"}


def test_what_no_log_shows_any_more_is_gone(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "known.toml"
    wrong = written(tmp_path, rows("temp_status"), name="wrong.csv")
    assert check_log(wrong, "--write-known", str(file)) is Exit.FAILED
    capsys.readouterr()
    assert check_log(written(tmp_path, rows(), name="good.csv"), "--known", str(file), "--json") == 0
    [row] = json.loads(capsys.readouterr().out)["known"]
    assert row["verdict"] == "gone"
    empty = written(tmp_path, rows(), without=["temp_status"], name="without.csv")
    assert check_log(empty, "--known", str(file), "--json") == 0
    [row] = json.loads(capsys.readouterr().out)["known"]
    assert row["verdict"] == "not met"


def test_one_file_serves_both(known: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """What a comparison wrote is known of logs of the same firmware."""
    log = copied(long_log("board1")[:200])
    for row in log:
        row["v_ref"] = row["v_ref"] / 2
    place = written(tmp_path, log)
    capsys.readouterr()
    check_log(place, "--known", str(known), "--json")
    found = json.loads(capsys.readouterr().out)
    assert found["deviations"] and "known" in {one["known"] for one in found["deviations"]}
