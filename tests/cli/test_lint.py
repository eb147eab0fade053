"""``rovercheck lint``: what can never happen in charts."""

import json
from pathlib import Path

import pytest
from jsonschema import Draft202012Validator

from rovercheck.checker.cli import run
from rovercheck.checker.commands.shared.codes import Exit
from tests.schemas import published
from tests.simulink.samples import package_of

LAMP = """from rovercheck import Chart, State, flag, to

lit, broken = flag("lit"), flag("broken")
lamp = Chart(
    "Lamp",
    [
        State("Off", transitions=[to("On", when=lit), to("Burnt", when=lit)]),
        State("On", transitions=[to("Off", when=~lit)]),
        State("Burnt"),
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
    assert "Off -> On" not in said and "3 states, 4 transitions, 2 of them as above" in said
    assert "reachable states of Lamp" in said


def test_the_document_is_as_published(model: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["lint", "--model", model, "--json"]) == Exit.FAILED
    told = json.loads(capsys.readouterr().out)
    Draft202012Validator(published("lint-1")).validate(told)
    assert {row["found"] for row in told["findings"]} == {"never"}
    assert told["systems"] == [{"system": "Lamp", "states": 3, "transitions": 4}]


def test_charts_of_simulink_are_asked_by_their_paths(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["lint", "--model", str(package_of("2_microwave"))]) == Exit.AS_EXPECTED
    assert "✓ microwave: 5 states" in capsys.readouterr().out


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
