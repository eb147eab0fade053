"""``check --record-invariants``: proofs kept beside the baseline, shown again without a search."""

import json
from pathlib import Path

import pytest

from rovercheck.checker.cli import run
from rovercheck.checker.commands.shared.codes import Exit

TWINS = """
from rovercheck.properties.forms import never
from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Chart, State, to
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.expr import flag, var
from rovercheck.spec_model.lang.system import in_order
from rovercheck.spec_model.lang.words import minimum, modulo

button = flag("button")
first = [var(f"a{i}", integer(0, 4000)) for i in range(12)]
second = [var(f"b{i}", integer(0, 4000)) for i in range(12)]
more = [assign(v, minimum(v + 1, 4000)) for pair in zip(first, second) for v in pair]
on = State("On", during=more, transitions=[to("Off", when=button)])
off = State("Off", transitions=[to("On", when=button)])
chart = Chart("Counts", [off, on], default="Off")
twins = in_order("twins", chart, text="Pairs of counters that count alike.")
ALIKE = never("ALIKE", "The first two differ.", that=first[0] != second[0], covers=["R"], on="twins")
ODD = modulo(first[11] + second[11], 2) == 1
LAST = never("LAST", "The last two have an odd sum.", that=ODD, covers=["R"], on="twins")
FIVE = never("FIVE", "One counts to five.", that=first[0] == 5, covers=["R"], on="twins")
"""
FIVE = '[FIVE]\nverdict = "violated"\nbecause = "It counts."\n'


@pytest.fixture
def model(tmp_path: Path) -> Path:
    (tmp_path / "twins.py").write_text(TWINS, encoding="utf-8")
    (tmp_path / "baseline.toml").write_text(FIVE, encoding="utf-8")
    return tmp_path / "twins.py"


def checked(model: Path, *options: str) -> Exit:
    return Exit(run(["check", "--model", str(model), "--no-premises", *options]))


def recorded(model: Path, *options: str) -> Exit:
    """Proofs of an engine that finds invariants: so few states would be enumerated."""
    return checked(model, "--record-invariants", "--engine", "kinduction", *options)


def record(model: Path) -> Path:
    return model.with_name("invariants.json")


def kept(model: Path) -> dict[str, list[object]]:
    found: dict[str, list[object]] = json.loads(record(model).read_text(encoding="utf-8"))["invariants"]
    return found


def test_proofs_are_kept_and_certified_when_they_are_shown_again(
    model: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert recorded(model) == Exit.AS_EXPECTED
    assert "2 invariants are recorded for what was checked." in capsys.readouterr().err
    assert kept(model).keys() == {"ALIKE", "LAST"} and kept(model)["LAST"] != []
    assert checked(model, "--certify") == Exit.AS_EXPECTED
    said = capsys.readouterr().out
    assert "induction" in said and "reachable states" not in said and "2 proofs certified." in said


def test_those_of_others_stay_and_those_of_no_proof_go(
    model: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    recorded(model)
    before = kept(model)
    assert recorded(model, "LAST") == Exit.AS_EXPECTED
    assert kept(model)["ALIKE"] == before["ALIKE"] and "LAST" in kept(model)
    model.write_text(TWINS.replace("that=first[0] != second[0]", "that=first[0] != second[1]"), "utf-8")
    assert recorded(model, "ALIKE") == Exit.AS_EXPECTED  # these two count alike as well
    model.write_text(TWINS.replace("that=first[0] != second[0]", "that=first[0] > 3"), "utf-8")
    assert recorded(model, "ALIKE") == Exit.FAILED
    assert kept(model).keys() == {"LAST"}
    capsys.readouterr()


def test_a_record_that_is_out_of_date_or_wrong_changes_no_verdict(
    model: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    wrong = {"ALIKE": [["==", "a0", 0], ["<=", "gone", 1], "On"], "LAST": [], "FIVE": [["!=", "a0", 5]]}
    record(model).write_text(
        json.dumps({"schema": "rovercheck/invariants/1", "invariants": wrong}), encoding="utf-8"
    )
    assert checked(model) == Exit.AS_EXPECTED
    assert "3 demands: 2 proved, 1 violated." in capsys.readouterr().out


def test_formulas_that_are_too_large_to_keep_are_told(
    model: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("rovercheck.checker.model.kept_invariants.MOST_NODES", 0)
    assert recorded(model) == Exit.AS_EXPECTED
    assert "LAST" not in kept(model)
    said = " ".join(capsys.readouterr().err.split())
    assert "are not kept: those of" in said and "LAST" in said


@pytest.mark.parametrize(
    ("written", "said"),
    [
        ("[]", "holds no invariants"),
        ('{"schema": "rovercheck/premises/1", "invariants": {}}', "its schema is 'rovercheck/premises/1'"),
        (
            '{"schema": "rovercheck/invariants/1", "invariants": {"ALIKE": 3}}',
            "ALIKE has 3, no list of formulas",
        ),
        ('{"schema": "rovercheck/invariants/1"}', "KeyError: 'invariants'"),
    ],
)
def test_a_file_with_something_else_is_told(
    model: Path, written: str, said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    record(model).write_text(written, encoding="utf-8")
    assert checked(model) == Exit.USAGE
    told = " ".join(capsys.readouterr().err.split())
    assert said in told and "`rovercheck check --record-invariants` writes it anew." in told


def test_charts_that_are_changed_leave_no_record(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["check", "PB1-11", "--record-invariants", "--interpret", "S43=AND"]) == Exit.USAGE
    said = " ".join(capsys.readouterr().err.split())
    assert "--record-invariants keeps invariants of the charts as they are" in said
