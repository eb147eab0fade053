"""``import`` of a machine: as JSON, and with domains proposed for what is computed."""

import json
import shutil
from pathlib import Path

import pytest
from jsonschema import Draft202012Validator

from rovercheck import xstate_model
from rovercheck.checker.cli import run
from rovercheck.checker.commands.shared.codes import Exit
from tests.schemas import published

EXAMPLES = Path(__file__).parents[2] / "examples"
MACHINE = Draft202012Validator(published("import-machine-1"))


@pytest.mark.parametrize(
    ("name", "format"), [("scxml/door.scxml", "SCXML"), ("xstate/vending.json", "XState 5")]
)
def test_a_machine_as_json_keeps_to_its_schema(
    name: str, format: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["import", "--json", str(EXAMPLES / name)]) == Exit.AS_EXPECTED
    said = json.loads(capsys.readouterr().out)
    MACHINE.validate(said)
    assert said["format"] == format and said["refused"] == "" and said["steps_compared"] > 0


def test_what_cannot_be_checked_is_said_in_json(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for part in ("vending.json", "vending.bindings.toml"):
        shutil.copy(EXAMPLES / "xstate" / part, tmp_path)
    assert run(["import", "--json", str(tmp_path / "vending.json")]) == Exit.INCONCLUSIVE
    said = json.loads(capsys.readouterr().out)
    MACHINE.validate(said)
    assert "no domain is given for coins" in said["refused"] and said["variables"] == 0


def test_domains_are_proposed_from_what_data_are_compared_with(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for part in ("vending.json", "vending.bindings.toml"):
        shutil.copy(EXAMPLES / "xstate" / part, tmp_path)
    file = tmp_path / "vending.json"
    assert run(["import", "--propose-domains", str(file)]) == Exit.AS_EXPECTED
    assert "1 domain to check" in " ".join(capsys.readouterr().out.split())
    written = (tmp_path / "vending.domains.toml").read_text(encoding="utf-8")
    assert "coins = { low = 0, high = 3 }" in written and str(xstate_model(file)["coins"]) == "coins"
    assert run(["import", "--propose-domains", str(file)]) == Exit.AS_EXPECTED
    assert "needs no domains" in " ".join(capsys.readouterr().out.split())


def test_what_a_machine_in_scxml_computes_is_proposed_too(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "count.scxml"
    file.write_text(
        "<scxml xmlns='http://www.w3.org/2005/07/scxml' datamodel='ecmascript'>"
        "<datamodel><data id='n' expr='-2'/><data id='m' expr='0'/></datamodel><state id='a'>"
        "<transition event='e' cond='n &lt; 7'><assign location='n' expr='n + 1'/></transition>"
        "<transition event='e'><assign location='n' expr='true ? 0 : n'/></transition></state></scxml>",
        encoding="utf-8",
    )
    assert run(["import", "--propose-domains", str(file)]) == Exit.AS_EXPECTED
    assert "n = { low = -3, high = 8 }" in (tmp_path / "count.domains.toml").read_text(encoding="utf-8")
    (tmp_path / "count.domains.toml").write_text("[domains]\n", encoding="utf-8")
    assert run(["import", "--propose-domains", str(file)]) == Exit.USAGE
    assert "write --force" in " ".join(capsys.readouterr().err.split())
