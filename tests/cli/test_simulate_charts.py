"""``simulate --model``: charts run on the inputs of a table."""

import json
from pathlib import Path

import pytest

from rovercheck.checker.cli import run
from rovercheck.checker.commands.shared.codes import Exit
from tests.model_files.files import CRITICAL_AT_59_5

LAMP = """from rovercheck import *

press, lit = flag("press"), flag("lit")
light = var("light", integer(0, 9), 0)
lamp = Chart("Lamp", [
    State("Off", entry=[assign(lit, False)], transitions=[to("On", when=press & (light < 5))]),
    State("On", entry=[assign(lit, True)], transitions=[to("Off", when=after(3 * tick))]),
], default="Off")
LIT = reachable("LIT", "It can be lit.", that=lit, covers=("R1",), on=lamp)
"""
VARIANT = """board = "Lamp"
[[change]]
kind = "limit"
chart = "Lamp"
at = "arrow/Off.1 guard"
from = "light < 5"
to = "light < 2"
"""

ROVER = 'board = "board1"\n' + CRITICAL_AT_59_5


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    Path("lamp.py").write_text(LAMP, encoding="utf-8")
    Path("variant.toml").write_text(VARIANT, encoding="utf-8")
    Path("inputs.csv").write_text("press,light,steps\n0,4,2\ntrue,,\nfalse,,5\n", encoding="utf-8")
    return tmp_path


def states(*more: str) -> list[str]:
    code = run(["simulate", "inputs.csv", "--model", "lamp.py", "-o", "run.json", *more])
    assert code == Exit.AS_EXPECTED
    document = json.loads(Path("run.json").read_text(encoding="utf-8"))
    return [state["after"]["Lamp"]["value"] for state in document["states"]]


@pytest.mark.usefixtures("place")
def test_each_row_is_given_for_its_steps_and_an_empty_cell_leaves_an_input() -> None:
    assert states() == ["Off", "Off", "On", "On", "On", "Off", "Off", "Off"]


@pytest.mark.usefixtures("place")
def test_charts_run_with_the_changes_of_a_variant() -> None:
    assert set(states("--variant", "variant.toml")) == {"Off"}


@pytest.mark.usefixtures("place")
def test_a_run_is_shown_as_a_trace_is(capfd: pytest.CaptureFixture[str]) -> None:
    assert run(["simulate", "inputs.csv", "--model", "lamp.py"]) == Exit.AS_EXPECTED
    assert "Lamp: Off → On" in capfd.readouterr().out
    for name in ("run.svg", "run.html", "run.vcd", "run.csv", "run.md"):
        assert run(["simulate", "inputs.csv", "--model", "lamp.py", "-o", name]) == Exit.AS_EXPECTED
        assert Path(name).stat().st_size > 100


@pytest.mark.usefixtures("place")
def test_a_system_of_the_rover_runs_on_inputs(capfd: pytest.CaptureFixture[str]) -> None:
    Path("hot.csv").write_text("temp_update,temp_reading,steps\n1,66,201\n", encoding="utf-8")
    assert run(["simulate", "hot.csv", "--system", "temperature"]) == Exit.AS_EXPECTED
    assert "TEMP_HEALTH_CRITICAL" in capfd.readouterr().out


@pytest.mark.usefixtures("place")
def test_a_run_of_changed_charts_of_the_rover_becomes_a_test() -> None:
    Path("warm.csv").write_text("temp_update,temp_reading,steps\n1,25,5\n1,59.5,210\n", encoding="utf-8")
    Path("rover.toml").write_text(ROVER, encoding="utf-8")
    asked = ["simulate", "warm.csv", "--system", "temperature", "--variant", "rover.toml"]
    assert run([*asked, "-o", "run.py"]) == Exit.AS_EXPECTED
    assert '"temp_status": 2' in Path("run.py").read_text(encoding="utf-8"), "critical at 59.5 °C"


WRONG = [
    ("press,night\n1,1\n", "the column 'night' is no input. Did you mean 'light'"),
    ("press,light\n1,12\n", "line 2: "),
    ("press,light\n1\n", "line 2: 1 cells under 2 columns"),
    ("press,steps\n1,many\n", "line 2: steps = 'many' is no number of steps"),
    ("press,steps\n1,30000\n", "is no number of steps from 1 to 20,000"),
    ("press,steps\n1,20000\n1,1\n", "line 3: 1 more steps are over 20,000"),
    ("press,press\n1,1\n", "has two columns of one name"),
    ("press\n", "holds no step"),
    ("", "holds no step"),
]


@pytest.mark.usefixtures("place")
@pytest.mark.parametrize(("table", "message"), WRONG, ids=[message for _, message in WRONG])
def test_a_table_without_meaning_gets_one_message(
    table: str, message: str, capfd: pytest.CaptureFixture[str]
) -> None:
    Path("odd.csv").write_text(table, encoding="utf-8")
    assert run(["simulate", "odd.csv", "--model", "lamp.py"]) == Exit.USAGE
    assert message in " ".join(capfd.readouterr().err.split())


@pytest.mark.usefixtures("place")
def test_what_excludes_each_other_is_said(capfd: pytest.CaptureFixture[str]) -> None:
    asked = ["simulate", "inputs.csv", "--model", "lamp.py"]
    for more, message in (
        (["--no-plot"], "go with a scenario of both boards"),
        (["-o", "run.xyz"], "No format has files like run.xyz"),
        (["--system", "Lump"], "There is no system 'Lump'. Did you mean 'Lamp'"),
    ):
        assert run([*asked, *more]) == Exit.USAGE
        assert message in " ".join(capfd.readouterr().err.split())
    assert run(["simulate", "inputs.csv", "--variant", "variant.toml"]) == Exit.USAGE
    assert "name those to run with --system" in " ".join(capfd.readouterr().err.split())
    assert run(["simulate", "none.csv", "--model", "lamp.py"]) == Exit.USAGE
    assert "Cannot read none.csv" in " ".join(capfd.readouterr().err.split())
