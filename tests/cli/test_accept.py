"""``rovercheck accept``: decisions on findings, in the baseline and nowhere else, all of them or none."""

import json
import tomllib
from datetime import date, timedelta
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import pytest
from jsonschema import Draft202012Validator

from rovercheck.checker.cli import run
from rovercheck.checker.commands.accept import AcceptOptions
from rovercheck.checker.commands.accept.run import accept
from rovercheck.checker.commands.shared.codes import Exit, UsageError
from rovercheck.checker.model.baseline_edit import edited, file_of
from rovercheck.checker.model.load import load
from rovercheck.checker.model.rover import rover
from rovercheck.properties.expected import Acceptance
from rovercheck.spec_model.lang.errors import ModelError
from tests.schemas import published

TODAY = date.today()
LATER = TODAY + timedelta(days=90)
BEFORE = TODAY - timedelta(days=1)
ENTRY = """\
# Kept by hand.

["HEAT-3"]   # the one that is known
verdict = 'violated'
depth    = 4
because  = "Only Pause waits."

# --- what comes next stays where it is ---
["HEAT-1"]
no_fault = "It is a toy."
"""


@pytest.fixture
def heater(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> Path:
    """A model with one finding, on record."""
    run(["init", str(tmp_path / "h")])
    (tmp_path / "h/baseline.toml").write_text(ENTRY, encoding="utf-8")
    capsys.readouterr()
    return tmp_path / "h/heater.py"


def baseline(heater: Path) -> dict[str, Any]:
    return tomllib.loads((heater.parent / "baseline.toml").read_text(encoding="utf-8"))


def accepting(heater: Path, *words: str) -> Exit:
    return run(["accept", *words, "--model", str(heater)])


def test_an_acceptance_is_written_below_its_entry_and_all_else_stays(heater: Path) -> None:
    words = ["--because", 'Kept "until"\nthe valve comes – °C.', "--owner", "A. Rossi", "--until", str(LATER)]
    assert accepting(heater, "HEAT-3", *words) is Exit.AS_EXPECTED
    text = (heater.parent / "baseline.toml").read_text(encoding="utf-8")
    assert baseline(heater)["HEAT-3"]["accepted"] == {
        "because": 'Kept "until" the valve comes – °C.', "owner": "A. Rossi", "on": TODAY, "until": LATER,
    }  # fmt: skip
    lines = text.splitlines()
    assert [line for line in ENTRY.splitlines() if line not in lines] == []
    assert lines.index('["HEAT-3".accepted]') < lines.index("# --- what comes next stays where it is ---")
    assert load(heater).expected("HEAT-3").accepted == Acceptance(
        'Kept "until" the valve comes – °C.', "A. Rossi", TODAY, LATER
    )


def test_a_later_decision_takes_the_place_of_the_first_and_withdrawing_leaves_no_trace(heater: Path) -> None:
    accepting(heater, "HEAT-3", "--because", "So.", "--owner", "A", "--until", str(LATER))
    assert accepting(heater, "HEAT-3", "--because", "Otherwise.") is Exit.AS_EXPECTED
    assert baseline(heater)["HEAT-3"]["accepted"] == {"because": "Otherwise.", "on": TODAY}
    assert accepting(heater, "HEAT-3", "--withdraw") is Exit.AS_EXPECTED
    assert (heater.parent / "baseline.toml").read_text(encoding="utf-8") == ENTRY


def test_the_line_ends_of_the_file_are_kept(heater: Path) -> None:
    file = heater.parent / "baseline.toml"
    file.write_bytes(ENTRY.replace("\n", "\r\n").encode())
    accepting(heater, "HEAT-3", "--because", "So.")
    assert file.read_bytes().count(b"\n") == file.read_bytes().count(b"\r\n") > ENTRY.count("\n")


def test_a_finding_that_is_not_on_record_is_decided_and_gets_an_entry(
    heater: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The file is named as the model: ``baseline.toml`` would speak of all models of the folder."""
    (heater.parent / "baseline.toml").unlink()
    assert accepting(heater, "HEAT-3", "--because", "So.") is Exit.AS_EXPECTED
    file = heater.parent / "heater.baseline.toml"
    assert tomllib.loads(file.read_text(encoding="utf-8")) == {
        "HEAT-3": {"verdict": "violated", "since": TODAY, "accepted": {"because": "So.", "on": TODAY}}
    }
    assert run(["check", "HEAT-3", "--model", str(heater)]) is Exit.AS_EXPECTED
    assert accepting(heater, "HEAT-3", "--withdraw") is Exit.AS_EXPECTED, "the entry had no other reason"
    assert run(["check", "HEAT-3", "--model", str(heater)]) is Exit.FAILED
    assert file_of(load(heater.parent)).name == "baseline.toml", "a folder is one model"


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ([], "Nothing is named: write an ID with --because, or --from with a file of decisions."),
        (["HEAT-3"], "There is no reason: write --because with a sentence that says why it is accepted."),
        (["HEAT-3", "--because", " \n"], "There is no reason: write --because"),
        (["HEAT-3", "--because", "So.", "--until", str(BEFORE)], f"{BEFORE} is over; name a day from"),
        (["HEAT-3", "--because", "So.", "--until", "31.12.2030"], "'31.12.2030' is no day; write it as"),
        (["HEAT-3", "--because", "So.", "--until", "2030-02-30"], "'2030-02-30' is no day"),
        (["HEAT-33", "--because", "So."], "There is no property 'HEAT-33'. Did you mean 'HEAT-3'"),
        (["HEAT-3", "HEAT-9", "--because", "So."], "There is no property 'HEAT-9'."),
        (["HEAT-3", "--because", "a\x1b[31mred"], "has signs that cannot be shown"),
        (["HEAT-3", "--because", "So.", "--owner", "\u202eissoR"], "has signs that cannot be shown"),
        (["HEAT-1", "--because", "So."], "HEAT-1 is proved: there is nothing to accept."),
        (["HEAT-3", "HEAT-2", "--because", "So."], "HEAT-2 is proved: there is nothing to accept."),
        (["HEAT-3", "--withdraw"], "HEAT-3 is not accepted: there is nothing to take back."),
        (["HEAT-3", "--withdraw", "--because", "So."], "--withdraw takes no --because, --until or --owner"),
        (["--from", "no such.json"], "no such.json"),
    ],
)  # fmt: skip
def test_what_cannot_be_accepted_is_said_and_nothing_is_written(
    words: list[str], said: str, heater: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert accepting(heater, *words) is Exit.USAGE
    assert said in " ".join(capsys.readouterr().err.split())
    assert (heater.parent / "baseline.toml").read_text(encoding="utf-8") == ENTRY


def test_the_last_day_is_still_one(heater: Path) -> None:
    assert accepting(heater, "HEAT-3", "--because", "So.", "--until", str(TODAY)) is Exit.AS_EXPECTED
    assert not Acceptance("So.", until=TODAY).expired and Acceptance("So.", until=BEFORE).expired
    assert not Acceptance("So.").expired


def test_a_baseline_that_is_a_folder_is_said(heater: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (heater.parent / "baseline.toml").unlink()
    (heater.parent / "baseline.toml").mkdir()
    assert accepting(heater, "HEAT-3", "--because", "So.") is Exit.USAGE
    assert "baseline.toml cannot be read" in capsys.readouterr().err


def test_a_baseline_that_is_no_toml_is_left_alone(heater: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (heater.parent / "baseline.toml").write_bytes(b"\xff = 1")
    assert accepting(heater, "HEAT-3", "--because", "So.") is Exit.USAGE
    assert (heater.parent / "baseline.toml").read_bytes() == b"\xff = 1"
    with pytest.raises(ModelError, match="is no TOML"):
        edited(heater.parent / "baseline.toml", {}, {}, TODAY)


# --- decisions as JSON -----------------------------------------------------------------------------------


def decisions(*rows: Any, **more: Any) -> dict[str, Any]:
    return {"schema": "rovercheck/decisions/1", "decisions": list(rows), **more}


ACCEPTED = {"id": "HEAT-3", "decision": "accepted", "because": "So.", "owner": "B", "until": str(LATER)}


def from_file(heater: Path, document: Any) -> Exit:
    file = heater.parent / "decisions.json"
    file.write_text(document if isinstance(document, str) else json.dumps(document), encoding="utf-8")
    return accepting(heater, "--from", str(file))


def test_decisions_of_a_file_are_written_and_taken_back(heater: Path) -> None:
    document = decisions(ACCEPTED)
    judge = Draft202012Validator(published("decisions-1"))
    assert judge.is_valid(document) and judge.is_valid(decisions({"id": "HEAT-3", "decision": "open"}))
    assert from_file(heater, document) is Exit.AS_EXPECTED
    assert baseline(heater)["HEAT-3"]["accepted"] == {
        "because": "So.", "owner": "B", "on": TODAY, "until": LATER,
    }  # fmt: skip
    assert from_file(heater, decisions({"id": "HEAT-3", "decision": "open"})) is Exit.AS_EXPECTED
    assert (heater.parent / "baseline.toml").read_text(encoding="utf-8") == ENTRY


@pytest.mark.parametrize(
    ("document", "said"),
    [
        ("{", "is no JSON"),
        ("[" * 100_000, "is no JSON"),
        ([], 'holds no decisions: "schema" is None'),
        ({**decisions(ACCEPTED), "schema": "rovercheck/check/1"}, "\"schema\" is 'rovercheck/check/1'"),
        (decisions(), "write one decision at least"),
        (decisions(ACCEPTED, more=1), "and nothing else"),
        (decisions("HEAT-3"), "decision 1: 'HEAT-3' is no object with an id and a decision."),
        (decisions(ACCEPTED, {"id": "", "decision": "open"}), "decision 2: it names no property; write its"),
        (decisions({**ACCEPTED, "decision": "no"}), "decision is 'no'; write \"accepted\" or \"open\"."),
        (decisions({**ACCEPTED, "until": "soon"}), "until is 'soon', no day; write it as 2027-03-01."),
        (decisions({**ACCEPTED, "until": 2027}), "until is 2027; write a text."),
        (decisions({**ACCEPTED, "reason": "So."}), "there is no 'reason'."),
        (decisions({**ACCEPTED, "because": ""}), "HEAT-3: There is no reason"),
        (decisions({**ACCEPTED, "until": str(BEFORE)}), f"HEAT-3: {BEFORE} is over"),
        (decisions(ACCEPTED, ACCEPTED), "decides HEAT-3 twice; delete one."),
        (decisions(ACCEPTED, {**ACCEPTED, "id": "HEAT-7"}), "There is no property 'HEAT-7'."),
        (decisions(ACCEPTED, {**ACCEPTED, "id": "HEAT-1"}), "HEAT-1 is proved: there is nothing to accept."),
    ],
)  # fmt: skip
def test_a_file_without_meaning_is_said_and_nothing_is_written(
    document: Any, said: str, heater: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert from_file(heater, document) is Exit.USAGE
    assert said in " ".join(capsys.readouterr().err.split())
    assert (heater.parent / "baseline.toml").read_text(encoding="utf-8") == ENTRY


def test_a_file_decides_alone(heater: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (heater.parent / "d.json").write_text(json.dumps(decisions(ACCEPTED)), encoding="utf-8")
    assert accepting(heater, "HEAT-3", "--from", str(heater.parent / "d.json")) is Exit.USAGE
    assert "leave out what else is written" in capsys.readouterr().err


# --- what is over ----------------------------------------------------------------------------------------


def over(heater: Path) -> None:
    (heater.parent / "baseline.toml").write_text(
        ENTRY.replace(
            '"Only Pause waits."\n',
            '"Only Pause waits."\n\n["HEAT-3".accepted]\nbecause = "For now."\n'
            'owner = "B"\nuntil = 2020-01-31\n',
        ),
        encoding="utf-8",
    )


def test_an_acceptance_that_is_over_is_told_and_with_strict_an_error(
    heater: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    over(heater)
    words = ["check", "HEAT-3", "--model", str(heater)]
    told = "  HEAT-3: accepted by B until 2020-01-31: For now."
    assert run(words) is Exit.AS_EXPECTED
    assert told in capsys.readouterr().out.splitlines()
    assert run([*words, "--quiet"]) is Exit.AS_EXPECTED
    assert told in capsys.readouterr().out.splitlines()
    assert run([*words, "--strict"]) is Exit.FAILED
    assert told in capsys.readouterr().out.splitlines()
    assert accepting(heater, "HEAT-3", "--because", "Once more.", "--until", str(LATER)) is Exit.AS_EXPECTED
    capsys.readouterr()
    assert run([*words, "--strict", "--no-premises"]) is Exit.USAGE
    assert run(words) is Exit.AS_EXPECTED and "No longer accepted" not in capsys.readouterr().out


def test_machines_are_told_too(heater: Path, capsys: pytest.CaptureFixture[str]) -> None:
    over(heater)
    junit, sarif = heater.parent / "j.xml", heater.parent / "s.json"
    words = [
        "check",
        "HEAT-3",
        "--model",
        str(heater),
        "--json",
        "--junit",
        str(junit),
        "--sarif",
        str(sarif),
    ]
    assert run(words) is Exit.AS_EXPECTED
    document = json.loads(capsys.readouterr().out)
    Draft202012Validator(published("check-1")).validate(document)
    [row] = document["results"]
    assert row["decision"] == {
        "state": "expired", "because": "For now.", "owner": "B", "on": None, "until": "2020-01-31",
    }  # fmt: skip
    assert (row["severity"], row["hazard"], row["place"]) == ("unrated", "", 1)
    [case] = ElementTree.parse(junit).iter("testcase")
    assert case.find("failure") is None and "accepted by B until 2020-01-31, which is over" in "".join(
        case.itertext()
    )
    [result] = json.loads(sarif.read_text())["runs"][0]["results"]
    assert result["level"] == "warning" and "suppressions" not in result and "rank" not in result
    assert run([*words, "--strict"]) is Exit.FAILED
    [case] = ElementTree.parse(junit).iter("testcase")
    failure = case.find("failure")
    assert failure is not None and failure.get("message", "").endswith("accepted by B until 2020-01-31 only")
    [result] = json.loads(sarif.read_text())["runs"][0]["results"]
    assert result["level"] == "error" and result["baselineState"] == "unchanged"


def test_what_is_accepted_is_suppressed_in_sarif_and_a_note(heater: Path) -> None:
    accepting(heater, "HEAT-3", "--because", "So.", "--owner", "B", "--until", str(LATER))
    covered = list(load(heater).properties["HEAT-3"].covers)
    rated = f'[H-1]\ntext = "It burns."\nseverity = "critical"\nbecause = "§1."\nrequirements = {covered}\n'
    (heater.parent / "hazards.toml").write_text(rated, encoding="utf-8")
    sarif = heater.parent / "s.json"
    assert run(["check", "HEAT-3", "--model", str(heater), "--sarif", str(sarif)]) is Exit.AS_EXPECTED
    [result] = json.loads(sarif.read_text())["runs"][0]["results"]
    assert result["level"] == "note" and result["rank"] == 75.0
    assert result["suppressions"] == [
        {"kind": "external", "status": "accepted", "justification": "So.",
         "properties": {"owner": "B", "on": str(TODAY), "until": str(LATER)}},
    ]  # fmt: skip
    assert result["properties"]["severity"] == "critical"
    assert result["properties"]["hazard"] == "H-1 It burns."


def test_the_rover_can_be_decided_upon_too(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """In a copy of its baseline."""
    from rovercheck.checker.commands.accept import run as module

    copy = tmp_path / "baseline.toml"
    copy.write_bytes(file_of(rover()).read_bytes())
    monkeypatch.setattr(module, "file_of", lambda model: copy)
    before = copy.read_text(encoding="utf-8")
    one = AcceptOptions(("PB1-15", "PSY-19"), "So.", LATER, "B")
    assert accept(one, None, TODAY) is Exit.AS_EXPECTED
    after = tomllib.loads(copy.read_text(encoding="utf-8"))
    assert {id for id, row in after.items() if "accepted" in row} == {"PB1-15", "PSY-19"}
    undone = edited(copy, {"PB1-15": None, "PSY-19": None}, {}, TODAY)
    assert undone == before
    with pytest.raises(UsageError, match="PB1-11 is proved"):
        accept(AcceptOptions(("PB1-11",), "So."), None, TODAY)
