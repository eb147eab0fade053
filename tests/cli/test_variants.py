"""Other interpretations, repairs and dropped assumptions on the command line."""

import json

import pytest

from rovercheck.checker.cli import run
from rovercheck.checker.commands.shared.codes import Exit

WRONG = [
    (["check", "PB1-11", "--interpret", "S43=XOR"], "S43 has no choice 'XOR'. Did you mean 'OR'"),
    (["check", "PB1-11", "--interpret", "S43"], "'S43' names no choice; write S43= and one of OR, AND, any."),
    (["check", "PB1-11", "--interpret", "S99=AND"], "There is no interpretation 'S99'. Did you mean"),
    (["check", "--interpret", "S25=VOLT"], "S25=VOLT is not modelled"),
    (["check", "--repair", "safety-first"], "There is no repair 'safety-first'. Did you mean"),
    (["check", "--without", "A99"], "There is no assumption 'A99'."),
]


@pytest.mark.parametrize(("arguments", "message"), WRONG, ids=[" ".join(a) for a, _ in WRONG])
def test_a_slip_gets_one_message(
    arguments: list[str], message: str, capfd: pytest.CaptureFixture[str]
) -> None:
    assert run(arguments) == Exit.USAGE
    assert message in " ".join(capfd.readouterr().err.split())


def test_another_reading_changes_a_verdict_and_says_so(capfd: pytest.CaptureFixture[str]) -> None:
    assert run(["check", "PB1-11", "--interpret", "S43=AND"]) == Exit.FAILED
    shown = " ".join(capfd.readouterr().out.split())
    assert "PB1-11 violated" in shown
    assert "under S43=AND; as specified it is proved" in shown


def test_a_verdict_can_hold_for_every_choice_of_a_reading(capfd: pytest.CaptureFixture[str]) -> None:
    assert run(["check", "PB1-12", "--interpret", "S43=any"]) == Exit.AS_EXPECTED
    assert "PB1-12" in capfd.readouterr().out


def test_what_is_violated_by_default_may_hold_under_another_reading(
    capfd: pytest.CaptureFixture[str],
) -> None:
    assert run(["check", "PB1-15", "--interpret", "S45=IMMEDIATE", "--json"]) == Exit.AS_EXPECTED
    found = json.loads(capfd.readouterr().out)
    assert found["variant"] == "under S45=IMMEDIATE"
    assert [row["verdict"] for row in found["results"]] == ["proved"]


def test_a_repair_is_checked_against_what_it_promises(capfd: pytest.CaptureFixture[str]) -> None:
    assert run(["check", "PB1-16a", "--repair", "safety-critical-first"]) == Exit.AS_EXPECTED
    assert "PB1-16a" in capfd.readouterr().out


def test_the_lists_explain_readings_repairs_and_assumptions(capfd: pytest.CaptureFixture[str]) -> None:
    for what, word in (
        ("interpretations", "STRICT-OK-KEPT"),
        ("repairs", "safety-critical-first"),
        ("assumptions", "A02"),
    ):
        assert run(["list", what]) == Exit.AS_EXPECTED
        shown = capfd.readouterr().out
        assert word in shown
