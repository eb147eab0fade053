"""Every command that takes a model of a user's own, from a folder that has nothing to do with rovercheck."""

import json
from pathlib import Path
from shlex import quote

import pytest

from rovercheck.checker.cli import run
from rovercheck.checker.commands.shared.codes import Exit
from tests.model_files.files import BASELINE, HEATER, START

EXAMPLES = Path(__file__).parents[2] / "examples"
WRITTEN = {"heater.py", "baseline.toml", "README.md", ".github/workflows/rovercheck.yml"}


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def said(capfd: pytest.CaptureFixture[str], *arguments: str, code: Exit = Exit.AS_EXPECTED) -> str:
    """What a command prints."""
    assert run([*arguments]) == code
    return capfd.readouterr().out


def test_init_writes_a_model_and_says_what_to_type(here: Path, capfd: pytest.CaptureFixture[str]) -> None:
    assert run(["init", "my model"]) == Exit.AS_EXPECTED
    told = capfd.readouterr().err
    assert "rovercheck check --model 'my model/heater.py'" in told
    files = {p.relative_to(here / "my model").as_posix() for p in here.rglob("*") if p.is_file()}
    assert files == WRITTEN


def test_init_overwrites_nothing(here: Path, capfd: pytest.CaptureFixture[str]) -> None:
    (here / "heater.py").write_text("mine")
    said(capfd, "init", ".", code=Exit.USAGE)
    assert [(p.name, p.read_text()) for p in here.iterdir()] == [("heater.py", "mine")]
    said(capfd, "init", "heater.py", code=Exit.USAGE)
    said(capfd, "init", "heater.py/below", code=Exit.USAGE)


def test_a_changed_verdict_is_told_with_the_command_that_shows_it(
    here: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    (here / "heater.py").write_text(HEATER)
    (here / "baseline.toml").write_text(BASELINE.replace("HEAT-3", "HEAT-1"))
    shown = said(capfd, "check", "--model", "heater.py", code=Exit.FAILED)
    assert "HEAT-1 is proved; expected: violated after 4 ticks." in shown
    assert "HEAT-3 is violated; expected: proved." in shown
    assert "See it whole: rovercheck trace HEAT-3 --model heater.py" in shown


def test_the_lift_of_the_examples_is_as_on_record(capfd: pytest.CaptureFixture[str]) -> None:
    shown = said(capfd, "check", "--json", "--model", str(EXAMPLES / "models" / "lift"))
    verdicts = {row["id"]: row["verdict"] for row in json.loads(shown)["results"]}
    proved = dict.fromkeys(("LIFT-1", "LIFT-2", "LIFT-4"), "proved")
    assert verdicts == {**proved, "LIFT-3": "violated"}


def test_what_a_model_holds_is_listed(capfd: pytest.CaptureFixture[str]) -> None:
    lists = {
        "properties": ("LIFT-3  lift    violated", "PB1-11"),
        "systems": ("The door of a lift", "relay"),
        "charts": ("Opens on a call at a floor", "Relay"),
        "requirements": ("Handbook, chapter 2", "B1-REL"),
        "assumptions": ("what is assumed", "A1"),
    }
    for name, (shown, hidden) in lists.items():
        listed = said(capfd, "list", name, "--model", str(EXAMPLES / "models" / "lift"))
        assert shown in listed and hidden not in listed
    english = said(capfd, "list", "properties", "HEAT-2", "--english", "--model", str(START))
    assert "one of the next 500 (10000 ms) heating is false" in " ".join(english.split())
    for name in ("interpretations", "repairs"):
        said(capfd, "list", name, "--model", str(START), code=Exit.USAGE)


def test_the_matrix_of_requirements_is_that_of_the_model(capfd: pytest.CaptureFixture[str]) -> None:
    matrix = json.loads(said(capfd, "requirements", "--json", "--model", str(START)))
    assert {r["id"]: r["state"] for r in matrix["requirements"]} == {"R1": "proved", "R2": "violated"}


def test_charts_and_properties_leave_in_other_forms(capfd: pytest.CaptureFixture[str]) -> None:
    assert "stateDiagram" in said(capfd, "graph", "Heater", "--format", "mermaid", "--model", str(START))
    assert said(capfd, "export", "HEAT-1", "--format", "btor2", "--model", str(START)).startswith("; ")


def test_what_graph_offers_can_be_typed_as_it_stands(capfd: pytest.CaptureFixture[str]) -> None:
    lift = str(EXAMPLES / "models" / "lift")
    told = said(capfd, "graph", "lift", "--model", lift)
    offered = [line for line in told.splitlines() if "rovercheck graph" in line]
    assert len(offered) > 4 and all(f"--model {quote(lift)}" in line for line in offered)
