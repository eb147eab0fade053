"""``rovercheck trace``: the cause of a violation, several runs, runs into states and through transitions."""

from dataclasses import replace
from pathlib import Path

import pytest

from rovercheck.checker.cli import run
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.commands.trace.examples import TraceRequest
from rovercheck.checker.commands.trace.explain import ExplanationOptions
from rovercheck.checker.commands.trace.run import TraceDisplay, trace
from rovercheck.checker.engines import Limits
from rovercheck.checker.results.trace import Trace
from rovercheck.properties.expected import Expected
from rovercheck.properties.forms import Property, reachable
from rovercheck.spec_model.rover import systems
from tests.explain.test_others import BOTH, ENDS, SYSTEM, first, left


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ([], "Name one thing: the ID of a property, --state CHART.STATE or --transition"),
        (["PB1-15", "--state", "Relay.B1_actuating"], "Name one thing"),
        (["--state", "Relay"], "'Relay' names no state; write CHART.STATE"),
        (["--state", "Relai.B1_actuating"], "There is no chart 'Relai'. Did you mean 'Relay'"),
        (["--state", "Relay.B1"], "Relay has no state 'B1'. Known: B1_actuating"),
        (["--state", "Relay.B1_actuating", "--system", "board"], "There is no system 'board'. Did you mean"),
        (
            ["--state", "Relay.B1_actuating", "--system", "battery"],
            "battery does not execute Relay; these do",
        ),
        (["PB1-15", "--system", "board1"], "--system goes with --state and --transition"),
        (["--transition", "Relay"], "'Relay' names no transition; write 'CHART: A -> B'"),
        (
            ["--transition", "Relay: B1_actuating -> B1"],
            "has no transition 'B1_actuating -> B1'. Did you mean",
        ),
        (["PB1-15", "--witnesses", "2", "--format", "json"], "write --format table or markdown"),
        (["PSY-18", "--witnesses", "2"], "is about runs without end, of which one is shown"),
        (["PB1-15", "--witnesses", "0"], "0 is not in the range"),
        (["PB1-15", "--witnesses", "2", "--by", "length"], "'length' is not one of 'transitions', 'reason'"),
        (
            ["PB1-15", "--witnesses", "2", "--by", "reason", "--no-explain"],
            "--by reason compares the causes of runs",
        ),
        (["PB1-15", "--by", "reason"], "--by says in what several runs are to differ; add --witnesses"),
    ],
)
def test_mistakes_are_explained(arguments: list[str], said: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["trace", *arguments]) == Exit.USAGE
    told = capsys.readouterr()
    assert said in told.err and told.out == ""


def test_a_state_is_reached_and_the_run_explained(capfd: pytest.CaptureFixture[str]) -> None:
    assert run(["trace", "--state", "Monitor_battery.Batt_CRIT", "--engine", "bmc"]) == Exit.AS_EXPECTED
    shown = capfd.readouterr().out
    assert shown.startswith("The state Monitor_battery.Batt_CRIT can be reached.\nbattery: ")
    assert "Cause: the inputs that determine the outcome\n" in shown
    assert "The set is minimal and smallest." in " ".join(shown.split())
    assert max(map(len, shown.splitlines())) <= 80


def test_a_transition_is_taken_on_the_chart_as_drawn(capfd: pytest.CaptureFixture[str]) -> None:
    transition = "Monitor_battery: default → Batt_OK"
    assert run(["trace", "--transition", transition, "--engine", "bmc", "--no-explain"]) == Exit.AS_EXPECTED
    shown = capfd.readouterr().out
    assert "Monitor_battery: default → Batt_OK" in shown
    assert "goal" not in shown and "Cause:" not in shown


def trace_of(explanation: ExplanationOptions) -> Trace:
    return explanation(first(), ENDS, {"way": SYSTEM})


def test_when_interrupted_the_run_is_shown_all_the_same(
    monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    def interrupted(*_: object) -> Trace:
        raise KeyboardInterrupt

    monkeypatch.setattr("rovercheck.checker.explain.explanation.explained", interrupted)
    assert trace_of(ExplanationOptions()).necessary is None
    assert "Interrupted: the run is shown without its cause." in capfd.readouterr().err


def test_an_explanation_that_takes_too_long_is_left_out(capfd: pytest.CaptureFixture[str]) -> None:
    assert trace_of(ExplanationOptions(seconds=-1)).necessary is None
    assert "Wait for it with --explain, or leave it out with --no-explain." in capfd.readouterr().err
    assert trace_of(ExplanationOptions.chosen(True)).needed()


def test_a_run_without_end_says_why_it_is_not_explained(capfd: pytest.CaptureFixture[str]) -> None:
    looped = replace(first(), loop=1)
    assert ExplanationOptions()(looped, ENDS, systems()) is looped
    assert "its last ticks repeat for ever" in capfd.readouterr().err


def wanted(prop: Property, example: bool = False) -> TraceRequest:
    return TraceRequest(prop, {"way": SYSTEM}, lambda _: Expected(), example)


def test_several_runs_are_told_apart_until_there_is_no_more(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "runs.txt"
    assert trace(wanted(ENDS), "bdd", Limits(), TraceDisplay(runs=3, output=file)) == Exit.AS_EXPECTED
    told = " ".join(file.read_text(encoding="utf-8").split())
    assert "--- Run 2 --- Unlike run 1 it takes Way: Start -> " in told
    assert (
        "--- No run 3 --- Every other run to this end takes the same transitions as one of these: all "
        in told
    )
    assert told.count("Cause:") == 2 and capfd.readouterr().out == ""


def test_several_runs_are_told_apart_by_what_forces_them(capfd: pytest.CaptureFixture[str]) -> None:
    both = replace(wanted(ENDS), systems={"way": BOTH})
    assert trace(both, "bdd", Limits(), TraceDisplay(runs=3, by="reason")) == Exit.AS_EXPECTED
    told = " ".join(capfd.readouterr().out.split())
    assert "--- Run 2 --- Unlike run 1 it needs right; does not need left." in told
    assert "--- No run 3 --- Whenever another run first comes to this end, its last ticks are as" in told


def test_a_reason_that_is_not_known_cannot_be_told_from_another(capfd: pytest.CaptureFixture[str]) -> None:
    hurried = TraceDisplay(runs=3, by="reason", explaining=ExplanationOptions(seconds=-1))
    assert trace(wanted(ENDS), "bdd", Limits(), hurried) == Exit.AS_EXPECTED
    assert "--- No run 2 ---\nThe cause of run 1 is not known, so that no other" in capfd.readouterr().out


def test_what_no_run_reaches_is_said_with_the_proof(capfd: pytest.CaptureFixture[str]) -> None:
    nowhere = reachable("state Way.Nowhere", "", that=left & ~left, covers=["R"], on="way")
    assert trace(wanted(nowhere, example=True), "bdd", Limits(), TraceDisplay()) == Exit.AS_EXPECTED
    assert "state Way.Nowhere is in no run: bdd: in none of all " in capfd.readouterr().err
