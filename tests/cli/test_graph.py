"""``rovercheck graph``: state graphs from the command line, their limits and their mistakes."""

import json
from pathlib import Path

import pytest

from rovercheck.checker.cli import run
from rovercheck.checker.commands.graph import run as graphing
from rovercheck.checker.commands.shared.codes import Exit
from tests.model_files.files import HEATER

Capture = pytest.CaptureFixture[str]


def test_a_system_alone_is_told_how_to_project(capsys: Capture) -> None:
    assert run(["graph", "relay"]) == Exit.AS_EXPECTED
    told = capsys.readouterr().out
    assert "relay: 154 reachable states" in told
    assert "Relay              3 of 3" in told
    assert "    3  some                 rovercheck graph relay --project Relay\n" in told
    assert "154  all                  rovercheck graph relay --project Relay,Relay.B2_actuating.dur" in told


def test_the_offer_is_for_the_terminal_and_no_content_of_a_file(capsys: Capture, tmp_path: Path) -> None:
    """The list of projections was written into the file."""
    target = tmp_path / "relay.svg"
    assert run(["graph", "relay", "-o", str(target)]) == Exit.USAGE
    told = capsys.readouterr()
    assert "rovercheck graph relay --project Relay\n" in told.out and not target.exists()
    assert "Nothing is written to" in told.err and "needs --project" in told.err


@pytest.mark.parametrize("what", [["Relay"], ["relay", "--project", "Relay"]])
@pytest.mark.parametrize(
    ("name", "begins"),
    [("a.svg", "<svg"), ("a.HTML", "<!doctype"), ("a.mmd", ""), ("a.dot", "digraph"), ("a", "<svg")],
)
def test_the_name_of_a_file_says_its_format(what: list[str], name: str, begins: str, tmp_path: Path) -> None:
    target = tmp_path / name
    assert run(["graph", *what, "-o", str(target)]) == Exit.AS_EXPECTED
    written = target.read_text(encoding="utf-8")
    assert written.lower().startswith(begins) and ("<svg" in written) == (name not in ("a.mmd", "a.dot"))


@pytest.mark.parametrize("what", [["Relay"], ["relay", "--project", "Relay"]])
@pytest.mark.parametrize(
    ("name", "options", "message"),
    [
        ("a.pdf", [], ".dot, .graphml, .html, "),
        ("a.svg", ["--format", "dot"], "--format dot and "),
    ],
)
def test_a_name_that_says_another_format_or_none_is_refused(
    what: list[str], name: str, options: list[str], message: str, tmp_path: Path, capsys: Capture
) -> None:
    assert run(["graph", *what, "-o", str(tmp_path / name), *options]) == Exit.USAGE
    assert message in " ".join(capsys.readouterr().err.split()) and not (tmp_path / name).exists()


def test_a_format_that_is_named_may_have_any_suffix(tmp_path: Path) -> None:
    asked = ["graph", "Relay", "--format", "mermaid", "-o", str(tmp_path / "relay.md")]
    assert run(asked) == Exit.AS_EXPECTED and (tmp_path / "relay.md").exists()


def test_the_offer_of_a_cut_exploration_is_a_lower_bound(capsys: Capture) -> None:
    assert run(["graph", "relay", "--depth", "2"]) == Exit.INCONCLUSIVE
    assert "at least 3 reachable states" in capsys.readouterr().out


def test_a_picture_and_what_it_shows(capsys: Capture, tmp_path: Path) -> None:
    target = tmp_path / "relay.svg"
    assert run(["graph", "relay", "--project", "Relay", "-o", str(target)]) == Exit.AS_EXPECTED
    assert target.read_text(encoding="utf-8").startswith("<svg")
    told = capsys.readouterr()
    assert "3 nodes and 5 edges for 154 states" in told.err and told.out == ""


def test_the_summary_alone(capsys: Capture) -> None:
    assert run(["graph", "relay", "--project", "Relay", "--summary"]) == Exit.AS_EXPECTED
    told = capsys.readouterr().out
    assert told.startswith("relay on Relay\n") and "over-approximate" in told


def test_marks_and_the_run_of_a_property(capsys: Capture) -> None:
    asked = ["graph", "relay", "--project", "Relay", "--bad", "PB1-15", "--trace", "PB1-15"]
    assert run([*asked, "--format", "json"]) == Exit.AS_EXPECTED
    told = capsys.readouterr()
    found = json.loads(told.out)
    names = {n["id"]: n["values"]["Relay"] for n in found["nodes"]}
    assert [names[n] for n in found["path"]] == ["-", *["B1_actuating"] * 6, *["B2_actuating"] * 2]
    assert {names[n] for n in found["bad"]} == {"B2_actuating"}
    assert found["looked_for"] == "PB1-15 is broken"
    assert "PB1-15 is broken in 151 states behind 1 node" in told.err


def test_a_cut_graph_is_written_and_inconclusive(capsys: Capture, tmp_path: Path) -> None:
    target = tmp_path / "relay.json"
    asked = ["graph", "relay", "--project", "Relay", "--depth", "5", "--format", "json", "-o", str(target)]
    assert run(asked) == Exit.INCONCLUSIVE
    assert json.loads(target.read_text(encoding="utf-8"))["cut"] == "the limit of 5 ticks is reached"
    assert "CUT" in capsys.readouterr().err


def test_too_large_a_picture_is_refused_with_smaller_ones(capsys: Capture, tmp_path: Path) -> None:
    target = tmp_path / "relay.svg"
    asked = ["graph", "relay", "--project", "Relay,Relay.B2_actuating.duration1", "-o", str(target)]
    assert run(asked) == Exit.USAGE
    told = capsys.readouterr().err
    assert "has 154 nodes; more than 150 cannot be read" in told
    assert "--max-nodes 154" in told and "rovercheck graph relay --project Relay\n" in told
    assert not target.exists()
    assert run([*asked, "--max-nodes", "154"]) == Exit.AS_EXPECTED and target.exists()


@pytest.mark.parametrize("format", ["json", "graphml", "dot"])
def test_data_is_written_whatever_the_size(capsys: Capture, format: str) -> None:
    asked = ["graph", "relay", "--project", "Relay,Relay.B2_actuating.duration1", "--max-nodes", "1"]
    assert run([*asked, "--format", format]) == Exit.AS_EXPECTED
    assert capsys.readouterr().out.count("duration1") >= 154


MISTAKES = {
    "no variable": (["--project", ","], "--project names no variable"),
    "trace without a projection": (["--trace", "PB1-15"], "--trace needs --project"),
    "bad without a projection": (["--bad", "PB1-15"], "--bad needs --project"),
    "property of another system": (["--project", "Relay", "--bad", "PB1-29"], "PB1-29 is about battery"),
    "unknown property": (["--project", "Relay", "--trace", "PB1-15x"], "There is no property 'PB1-15x'"),
    "proved property": (["--project", "Relay", "--trace", "PB1-11"], "PB1-11 is proved and has no trace"),
    "input": (["--project", "rx_status"], "rx_status is an input of relay"),
    "unknown format": (["--project", "Relay", "--format", "htm"], "Did you mean 'html'"),
}


@pytest.mark.parametrize("name", MISTAKES)
def test_mistakes_say_what_to_write(capsys: Capture, name: str) -> None:
    asked, message = MISTAKES[name]
    assert run(["graph", "relay", *asked]) == Exit.USAGE
    assert message in " ".join(capsys.readouterr().err.split())


INSTEAD = {
    "B1_actuating": "'B1_actuating' is a state of the charts Relay, Check_Board1; rovercheck graph Relay",
    "Relay.B2_actuating": "is a state of the chart Relay; rovercheck graph Relay draws it.",
    "targetAngle180": "is data of board1, board1_ms, board1_plain, board1_buttons and others: "
    "rovercheck graph board1 --project targetAngle180",
    "rx_status": "is data of reception,",
    "Rely": "There is no chart or system 'Rely'. Did you mean 'Relay'?",
}


@pytest.mark.parametrize("name", INSTEAD)
def test_what_is_no_chart_is_told_where_it_is(capsys: Capture, name: str) -> None:
    """A state's name was answered with names that look alike."""
    assert run(["graph", name]) == Exit.USAGE
    assert INSTEAD[name] in " ".join(capsys.readouterr().err.split())


def test_every_format_that_is_offered_for_a_chart_is_written(capsys: Capture) -> None:
    assert run(["graph", "--help"]) == Exit.AS_EXPECTED
    offered = " ".join(capsys.readouterr().out.split()).partition("--format FORMAT ")[2].partition(";")[0]
    formats = offered.replace(" or ", ", ").split(", ")
    assert len(formats) == 5
    for format in formats:
        assert run(["graph", "Relay", "--format", format]) == Exit.AS_EXPECTED


def test_ctrl_c_writes_nothing(monkeypatch: pytest.MonkeyPatch, capsys: Capture, tmp_path: Path) -> None:
    def interrupted(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(graphing, "made", interrupted)
    target = tmp_path / "relay.svg"
    assert run(["graph", "relay", "--project", "Relay", "-o", str(target)]) == Exit.INTERRUPTED
    assert "nothing was written" in capsys.readouterr().err and not target.exists()


def test_where_data_of_the_only_system_is_has_no_comma_too_many(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "heater.py").write_text(HEATER)
    assert run(["graph", "door_open", "--model", str(tmp_path / "heater.py")]) == Exit.USAGE
    assert "'door_open' is an input of Heater: rovercheck graph Heater --model " in capfd.readouterr().err
