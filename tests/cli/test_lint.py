"""``rovercheck lint``: what can never happen in charts."""

import json
import re
from collections.abc import Iterable, Iterator
from itertools import islice
from pathlib import Path

import pytest
from jsonschema import Draft202012Validator

from rovercheck.checker.cli import run
from rovercheck.checker.commands.lint import run as lint_run
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.commands.shared.verdicts import results
from rovercheck.checker.simulink.writer.packages import WrittenModel
from rovercheck.checker.verify.result import Result
from tests.drawn.test_function_calls import Calling, called_chart
from tests.schemas import published
from tests.simulink.known.packages import ChartText
from tests.simulink.samples import package_of

LAMP = """from rovercheck import Chart, State, flag, to

lit, broken = flag("lit"), flag("broken")
lamp = Chart(
    "Lamp",
    [
        State("Off", transitions=[to("On", when=lit), to("Burnt", when=lit)]),
        State(
            "On",
            transitions=[to("Worn", when=~lit & broken), to("Off", when=~lit), to("On", when=broken)],
        ),
        State("Worn", transitions=[to("Gone", when=lit | ~lit)]),
        State("Burnt"),
        State("Gone"),
    ],
    default="Off",
)
"""


@pytest.fixture
def model(tmp_path: Path) -> str:
    file = tmp_path / "lamp.py"
    file.write_text(LAMP, encoding="utf-8")
    return str(file)


def test_what_never_happens_is_told_with_its_proof(model: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["lint", "--model", model]) == Exit.FAILED
    said = " ".join(capsys.readouterr().out.split())
    assert "✗ Lamp, Lamp: state Burnt is never active." in said
    assert "✗ Lamp, Lamp: transition Off -> Burnt (transition 2) [lit] is never taken." in said
    assert "5 states, 7 transitions, 2 of them as above" in said
    assert "reachable states of Lamp" in said


def test_conditions_that_always_hold_and_orders_that_decide_are_told(
    model: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["lint", "--model", model]) == Exit.FAILED
    said = " ".join(capsys.readouterr().out.split())
    worn = "Worn -> Gone (transition 1) [lit || !lit]"
    assert f"✗ Lamp, Lamp: the condition of {worn} always holds where it is tested." in said
    both = "On -> Worn (transition 1) [!lit && broken] and On -> Off (transition 2) [!lit]"
    assert f"• Lamp, Lamp: transitions {both} hold at the same time in some run: their order decides." in said
    assert (
        "On -> Off (transition 2) [!lit] and" not in said
    )  # [!lit] and [broken]: the first one was not taken
    assert "• Lamp, Lamp: state Gone is never left once it is active." in said
    assert "state Burnt is never left" not in said


DOOR = """from rovercheck import Chart, State, flag, to

push, lock = flag("push"), flag("lock")
door = Chart(
    "Door",
    [
        State("Shut", transitions=[to("Open", when=push), to("Locked", when=lock)]),
        State("Open", transitions=[to("Shut", when=~push)]),
        State("Locked"),
    ],
    default="Shut",
)
"""


def test_an_order_that_decides_is_no_failure(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "door.py"
    file.write_text(DOOR, encoding="utf-8")
    assert run(["lint", "--model", str(file)]) == Exit.AS_EXPECTED
    said = " ".join(capsys.readouterr().out.split())
    assert "their order decides." in said and "state Locked is never left" in said and "✗" not in said


TWO_REGIONS = """from rovercheck import Chart, State, flag, to

go, halt = flag("go"), flag("halt")
OUT, ON = to("Halted", when=halt), to("B2", when=go)
both = Chart(
    "Both",
    [
        State(
            "Run",
            states=[
                State("A", states=[State("A1", transitions=[to("A2", when=go)]), State("A2")], default="A1"),
                State("B", states=[State("B1", transitions=[OUT, ON]), State("B2")], default="B1"),
            ],
            parallel=True,
        ),
        State("Halted"),
    ],
    default="Run",
)
"""


def test_a_state_is_left_by_a_transition_of_another_region(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A2 was told as never left, as no transition begins in it or around it."""
    file = tmp_path / "both.py"
    file.write_text(TWO_REGIONS, encoding="utf-8")
    assert run(["lint", "--model", str(file), "--json"]) == Exit.AS_EXPECTED
    rows = json.loads(capsys.readouterr().out)["findings"]
    assert [row["what"] for row in rows if row["kind"] == "way out"] == ["Run.B.B2", "Halted"]


def test_conditions_of_imported_charts_that_always_hold_are_told(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """One that is never tested is told by its transition, not here."""
    model = WrittenModel("one", step="0.1")
    port, end = model.root.inport("u", 1, OutDataTypeStr="boolean"), model.root.outport("y", 1)
    block, chart = model.root.chart("C")
    chart.data("u", "input", "boolean")
    chart.data("y", "output", "boolean")
    a, b, c = (chart.state(f"{name}\nen: y = {value};") for name, value in zip("ABC", "010", strict=True))
    chart.transition(None, a)
    chart.transition(a, b, "[u]")
    chart.transition(b, a, "[u || y]")
    chart.transition(c, a, "[u]")
    model.root.line(port, block)
    model.root.line(block, end)
    assert run(["lint", "--model", str(model.save(tmp_path / "one.slx"))]) == Exit.FAILED
    said = " ".join(capsys.readouterr().out.split())
    assert said.count("always holds where it is tested") == 1
    assert "the condition of the transition `[u || y]`" in said and "state C is never active" in said


def test_the_document_is_as_published(model: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["lint", "--model", model, "--json"]) == Exit.FAILED
    told = json.loads(capsys.readouterr().out)
    Draft202012Validator(published("lint-1")).validate(told)
    found = {(row["kind"], row["found"]) for row in told["findings"]}
    assert found == {(kind, "never") for kind in ("state", "transition", "condition", "way out")} | {
        ("order", "happens")
    }
    assert told["systems"] == [
        {
            "system": "Lamp", "states": 5, "transitions": 7, "asked": True, "questions": 22, "answered": 22,
        },
    ]  # fmt: skip
    assert not told["interrupted"]


def test_charts_of_simulink_are_asked_by_their_paths(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["lint", "--model", str(package_of("2_microwave"))]) == Exit.AS_EXPECTED
    said = " ".join(capsys.readouterr().out.split())
    assert "`[door]` (SSID 18) and `[left == 0]/bell = true;` (SSID 19) from Oven/Cooking hold" in said
    assert "microwave: 5 states, 9 transitions, all of them can happen" in said


def test_of_the_rover_systems_are_named_and_runs_are_reproduced_on_the_board(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert run(["lint"]) == Exit.USAGE
    assert "name some with --system" in capsys.readouterr().err
    assert run(["lint", "--system", "relay"]) == Exit.AS_EXPECTED
    assert "✓ relay: 2 states, 3 transitions" in capsys.readouterr().out


def test_what_is_not_decided_is_told(model: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["lint", "--model", model, "--seconds", "1e-9"]) == Exit.INCONCLUSIVE
    assert "was not decided" in " ".join(capsys.readouterr().out.split())


def test_what_is_in_a_chart_that_another_calls_is_told_of_that(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Its transitions and conditions are those of the program of the other one."""
    made = Calling("A\ndu: n = int8(u > 0); F;", "F")
    block, chart = called_chart(made.root, "D", "P")
    one, two, three = chart.state("One"), chart.state("Two"), chart.state("Three")
    chart.transition(None, one)
    chart.transition(one, two, "[i >= 0]")
    chart.transition(two, one, "[i == 1]")
    chart.transition(two, three, "[i == 5]", 2)
    made.root.line(f"{made.block}/1", block)
    made.root.line(made.event(1), f"{block}#trigger")
    made.model.save(tmp_path / "one.slx")
    assert run(["lint", "--model", str(tmp_path / "one.slx")]) == Exit.FAILED
    said = " ".join(capsys.readouterr().out.split())
    assert "✗ one, D: state Three is never active." in said
    assert "✗ one, D: the condition of the transition `[i >= 0]` (SSID" in said
    assert "✗ one, C" not in said


GATE = ChartText(
    "gate",
    """
    in u int8
    in stop boolean
    out y int8
    -> Idle
    state Idle
    state Up: en: y = int8(1);
    state Down: en: y = int8(2);
    Idle -1-> Up: [u > 3]
    Idle -2-> Down: [stop]
    Idle -3-> Idle: after(5, sec)
    Up -1-> Idle: [u < 2]
    Up -2-> Down: [u >= 2 && stop]
    Down -1-> Idle: [u == 0]
    Down -2-> Up
    """,
    "MATLAB",
)


def test_overlapping_conditions_of_imported_charts_are_told_with_a_run(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Those that exclude each other, and a transition without a condition, are no overlap."""
    path = str(GATE.save(tmp_path, "R2024a"))
    assert run(["lint", "--model", path]) == Exit.AS_EXPECTED
    said = " ".join(capsys.readouterr().out.split())
    assert run(["lint", "--model", path, "--json"]) == Exit.AS_EXPECTED
    told = json.loads(capsys.readouterr().out)
    Draft202012Validator(published("lint-1")).validate(told)
    orders = {row["what"]: row for row in told["findings"] if row["kind"] == "order"}
    labels = ("[u > 3]", "[stop]", "after(5, sec)")
    up, down, later = (re.findall(rf"{re.escape(f'`{one}`')} \(SSID \d+\)", said)[0] for one in labels)
    pairs = [(up, down), (up, later), (down, later)]
    assert orders.keys() == {f"{one} and {other} from C/Idle" for one, other in pairs}
    one = orders[f"{up} and {down} from C/Idle"]
    assert (one["found"], one["chart"]) == ("happens", "C")
    assert re.fullmatch(r"tick 2: u = [4-9]\d*, stop = true", one["run"][-1])
    assert one["run"][-1] in said


def stopping(found: Iterable[Result], after: int) -> Iterator[Result]:
    yield from islice(found, after)
    raise KeyboardInterrupt


def test_what_was_found_before_an_interruption_is_told(
    model: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """After Ctrl-C nothing was told of what had been answered."""
    whole = results
    monkeypatch.setattr(lint_run, "results", lambda *given: stopping(whole(*given), 10))
    code = run(["lint", "--model", model, "--json"])
    told = json.loads(capsys.readouterr().out)
    Draft202012Validator(published("lint-1")).validate(told)
    [summary] = told["systems"]
    assert told["interrupted"] and summary["answered"] == 10 < summary["questions"]
    assert all(row["evidence"] for row in told["findings"])
    assert code == (Exit.FAILED if told["findings"] else Exit.INTERRUPTED)
    run(["lint", "--model", model])
    said = " ".join(capsys.readouterr().out.split())
    assert f"interrupted: 10 of {summary['questions']} questions about them are answered." in said
    monkeypatch.setattr(lint_run, "number_rows", lambda *given: stopping((), 0))
    assert run(["lint", "--model", model]) == Exit.INTERRUPTED
    assert "interrupted before they were asked about." in " ".join(capsys.readouterr().out.split())
