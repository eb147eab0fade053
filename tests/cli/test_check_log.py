"""``rovercheck check-log``: what it prints, its exit codes; one bad log does not spoil the others."""

import json
from pathlib import Path

import pytest

from rovercheck.checker.cli import run
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.spec_model.abstraction import boards
from tests.logs.recorded import copied, long_log, written

EXAMPLES = Path(__file__).parents[2] / "examples" / "logs"
FAULTS = [str(EXAMPLES / "faults.csv"), "--map", str(EXAMPLES / "map.toml")]


def check_log(*arguments: str) -> Exit:
    return run(["check-log", *arguments])


def test_the_good_example(capsys: pytest.CaptureFixture[str]) -> None:
    assert check_log(str(EXAMPLES / "good.csv")) is Exit.AS_EXPECTED
    printed = capsys.readouterr().out
    assert "Behaviour: a run of the charts, of 27 outputs compared." in printed
    assert "known findings" in printed and "not expected" not in printed
    assert "proved" not in printed, "a log proves nothing"


def test_the_example_with_faults(capsys: pytest.CaptureFixture[str]) -> None:
    assert check_log(*FAULTS) is Exit.FAILED
    printed = capsys.readouterr().out
    assert "3 distinct deviations from the charts" in printed
    assert "rover_safety_state one tick late" in printed and "swapped" in printed
    assert "tick 121, line 122, once" in printed
    assert max(map(len, printed.splitlines())) <= 80


def test_every_property_on_request(capsys: pytest.CaptureFixture[str]) -> None:
    check_log(*FAULTS, "--verbose")
    printed = capsys.readouterr().out
    assert "satisfied on this log" in printed and "never triggered: says nothing" in printed
    assert "missing: btn1" in printed and "no finite run breaks it" in printed


def test_json(capsys: pytest.CaptureFixture[str]) -> None:
    assert check_log(*FAULTS, "--json") is Exit.FAILED
    found = json.loads(capsys.readouterr().out)
    assert found["system"] == "board1" and not found["conforms"] and found["ticks"] == 300
    assert [d["kind"] for d in found["deviations"]] == ["late", "swapped", "value"]
    glitch = found["deviations"][2]
    assert glitch["differences"] == [
        {"output": "temp_status", "expected": ["TEMP_HEALTH_OK"], "logged": "TEMP_HEALTH_DEGRADED"}
    ]
    assert {"id", "verdict", "as_on_record", "ticks", "ticks_tested"} <= found["properties"][0].keys()


def test_another_reading_explains_another_log(capsys: pytest.CaptureFixture[str]) -> None:
    good = str(EXAMPLES / "good.csv")
    assert check_log(good, "--interpret", "S43=AND") is Exit.FAILED
    printed = capsys.readouterr().out
    assert (
        "under S43=AND" in printed
        and "1 distinct deviation" in printed
        and "Relay: in B1_actuating" in printed
    )
    assert check_log(good, "--interpret", "S43=OR", "--json") is Exit.AS_EXPECTED
    assert json.loads(capsys.readouterr().out)["charts"] == "under S43=OR"


def test_a_repair_is_compared_with_and_its_promises_are_expected(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "one.csv").write_bytes((EXAMPLES / "good.csv").read_bytes())
    assert check_log(str(tmp_path), "--repair", "relay-without-delay") is Exit.FAILED
    assert "with relay-without-delay" in capsys.readouterr().out
    check_log(str(tmp_path), "--repair", "relay-without-delay", "--json")
    [found] = json.loads(capsys.readouterr().out)["logs"]
    [broken] = [p for p in found["properties"] if p["id"] == "PB1-15"]
    assert broken["verdict"] == "violated" and not broken["as_on_record"]
    assert [d["outputs"] for d in found["deviations"]] == [["give_b2_actuation"]]


@pytest.mark.parametrize(
    ("option", "value", "says"),
    [
        ("--interpret", "S43=any", "leaves the sentence open"),
        ("--interpret", "S43=NAND", "has no choice 'NAND'"),
        ("--interpret", "S34=PARTIAL", "at the default interpretations only"),
        ("--repair", "relay-with-delay", "Did you mean 'relay-without-delay'"),
    ],
)
def test_charts_that_no_log_is_compared_with(
    option: str, value: str, says: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert check_log(str(EXAMPLES / "good.csv"), option, value) is Exit.USAGE
    assert says in " ".join(capsys.readouterr().err.split())


def test_what_cannot_be_decided_is_no_pass(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    inputs = [s.name for s in boards()["board1"].inputs if s.name != "now_ms"]
    log = written(tmp_path, copied(long_log("board1")[:400]), inputs)
    assert check_log(str(log)) is Exit.INCONCLUSIVE
    printed = capsys.readouterr().out
    assert "not all was decided" in printed and "unknown from tick" in printed


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (["nowhere.csv"], "does not exist"),
        ([str(EXAMPLES / "map.toml")], "no column has the name of a signal"),
        ([str(EXAMPLES / "good.csv"), "--system", "board3"], "Did you mean"),
        ([str(EXAMPLES / "good.csv"), "--map", "nowhere.toml"], "Cannot read the map nowhere.toml"),
        ([str(EXAMPLES / "good.csv"), *FAULTS[1:]], "has no column 't [s]', which the map names"),
    ],
)
def test_a_mistake_is_one_message(
    arguments: list[str], says: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert check_log(*arguments) is Exit.USAGE
    printed = capsys.readouterr()
    assert printed.out == "" and says in printed.err and "Traceback" not in printed.err


def test_a_folder_is_summed_up_though_one_log_is_broken(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    rows = copied(long_log("board1")[:200])
    written(tmp_path, rows, name="good.csv")
    (tmp_path / "cut.csv").write_text("now_ms,temp_status\n20\n40,0\n", encoding="utf-8")
    assert check_log(str(tmp_path)) is Exit.USAGE
    rows[90]["temp_status"] = (int(rows[90]["temp_status"]) + 1) % 3
    written(tmp_path, rows, name="odd.csv")
    written(tmp_path, copied(long_log("board2")[:200]), name="two.csv")
    capsys.readouterr()
    assert check_log(str(tmp_path)) is Exit.FAILED
    printed = capsys.readouterr().out
    lines = {line.split()[0]: line.split() for line in printed.splitlines() if line}
    assert lines["good.csv"][1:4] == ["board1", "200", "0"] and lines["odd.csv"][5] == "1"
    assert lines["two.csv"][1] == "board2"
    assert "cut.csv: not read: line 2: the row has 1 cells" in printed
    assert "4 logs: 1 with deviations or unexpected violations, 1 not read." in printed
    assert max(map(len, printed.splitlines())) <= 80


def test_a_folder_as_json(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    written(tmp_path, copied(long_log("board1")[:50]), name="good.csv")
    (tmp_path / "empty.csv").write_text("", encoding="utf-8")
    assert check_log(str(tmp_path), "--json") is Exit.USAGE
    logs = json.loads(capsys.readouterr().out)["logs"]
    assert [log.get("error", log.get("conforms")) for log in logs][1] is True
    assert "is empty" in logs[0]["error"]


def test_a_folder_without_logs(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert check_log(str(tmp_path)) is Exit.NOTHING
    assert "holds no log" in capsys.readouterr().err
