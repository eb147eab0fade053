"""Hazards beside a model: read as its requirements are, and what has no meaning is said in one line."""

import json
from pathlib import Path

import pytest

from rovercheck.checker.cli import run
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.model.load import load
from rovercheck.properties.hazards import Severity
from rovercheck.spec_model.lang.errors import ModelError
from tests.model_files.files import BASELINE, HEATER

RATED = '[H-1]\ntext = "It burns."\nseverity = "critical"\nbecause = "§1 says so."\nrequirements = {}\n'


@pytest.fixture
def heater(tmp_path: Path) -> Path:
    """The model, with its finding under a hazard."""
    (tmp_path / "heater.py").write_text(HEATER, encoding="utf-8")
    (tmp_path / "baseline.toml").write_text(BASELINE, encoding="utf-8")
    covers = list(load(tmp_path / "heater.py").properties["HEAT-3"].covers)
    (tmp_path / "hazards.toml").write_text(RATED.format(covers), encoding="utf-8")
    return tmp_path / "heater.py"


def test_hazards_are_read_beside_a_model(heater: Path, capsys: pytest.CaptureFixture[str]) -> None:
    [hazard] = load(heater).hazards.values()
    assert (hazard.id, hazard.severity) == ("H-1", Severity.CRITICAL)
    assert run(["check", "--model", str(heater)]) is Exit.AS_EXPECTED
    said = capsys.readouterr().out.splitlines()
    assert said[said.index("Violated:") + 1] == "  critical, H-1: It burns."
    assert said[said.index("Violated:") + 2].startswith("    HEAT-3, Heater: ")
    assert run(["requirements", "--model", str(heater), "--json"]) is Exit.AS_EXPECTED
    rows = json.loads(capsys.readouterr().out)["requirements"]
    assert {row["severity"] for row in rows} == {"critical", "unrated"}
    assert [row["hazards"] for row in rows if row["severity"] == "critical"] == [["H-1"]]


def test_without_hazards_nothing_is_said_of_them(heater: Path, capsys: pytest.CaptureFixture[str]) -> None:
    heater.with_name("hazards.toml").unlink()
    assert run(["check", "--model", str(heater)]) is Exit.AS_EXPECTED
    assert "unrated" not in capsys.readouterr().out


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (RATED.format(["NO-SUCH"]), "hazards.toml: H-1 names 'NO-SUCH', no requirement."),
        (RATED.format([]), "hazards.toml: H-1 has requirements = []"),
        ("[H-1", "hazards.toml is no TOML"),
        ("H-1 = 3", "hazards.toml: H-1 is 3; write a table with text, severity, because, requirements."),
    ],
)
def test_a_file_without_meaning_is_said(text: str, said: str, heater: Path) -> None:
    heater.with_name("hazards.toml").write_text(text, encoding="utf-8")
    with pytest.raises(ModelError) as raised:
        load(heater)
    [line] = str(raised.value).splitlines()
    assert said in line


def test_a_baseline_names_hazards_that_there_are(heater: Path) -> None:
    heater.with_name("baseline.toml").write_text(BASELINE + 'hazard = "H-2"\n', encoding="utf-8")
    with pytest.raises(ModelError, match=r"HEAT-3 names 'H-2', no hazard\. Did you mean 'H-1'"):
        load(heater)
