"""Deviations of one cause are one finding, those of two causes never: by default, in every form."""

import json
from pathlib import Path
from typing import Any

import pytest

from rovercheck.checker.adapters import python
from rovercheck.checker.cli import VerbTable, run
from rovercheck.checker.compare import Allowance, cross_check, effort
from rovercheck.checker.compare.beside import rerun
from rovercheck.checker.compare.evidence_runs import EvidenceRuns
from rovercheck.checker.compare.run_follower import RecordedRun
from rovercheck.checker.compare.search import CompareSearch
from rovercheck.checker.compare.strategy import environment
from rovercheck.checker.compare.variants import of_model
from rovercheck.checker.conformance.deviations import Deviation
from rovercheck.checker.diagnosis.causes import by_itself, cause_groups, followed, split
from rovercheck.checker.diagnosis.search import SECONDS
from rovercheck.checker.model.load import load
from tests.model_files.files import FIRMWARE, heater_files

DEAF = """

class Deaf(Heater):
    "It does not read the door: it goes on when it must not, and does not go off when it must."

    def step(self, given):
        return super().step({**given, "door_open": False})
"""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    return heater_files(tmp_path, FIRMWARE + DEAF)


def asked(folder: Path, firmware: str, *more: str) -> list[str]:
    return [
        *("compare", "--model", str(folder / "heater.py"), "--impl"),
        *(f"python:{folder / 'firmware.py'}:{firmware}", "--examples", "5", "--mismatches", "0", *more),
    ]


def told(capsys: pytest.CaptureFixture[str], arguments: list[str]) -> Any:
    run([*arguments, "--json"])
    document = json.loads(capsys.readouterr().out)
    [row] = document["results"]
    shown = [one for cause in row["causes"] for one in cause["deviations"]]
    assert sorted(shown) == sorted(one["id"] for one in row["mismatches"]), "each is under one cause"
    assert len(document["campaign"]["findings"]) == len(row["causes"])
    return document


def test_every_deviation_is_under_one_cause_with_and_without_a_change(folder: Path) -> None:
    board = of_model(load(folder / "heater.py"))
    firmware = python.start(f"{folder / 'firmware.py'}:HotAndBrief", board, isolated=False)
    runs: list[RecordedRun] = []
    result = cross_check(board, firmware, effort("ci", 5), deviating=runs.append)
    recordings = [one.recording for one in runs]
    merged = cause_groups(followed(board, recordings), result.deviations, ["Heater"], 60)
    assert sorted(c.change.kind for c in merged.causes if c.change is not None) == ["limit", "timer"]
    for groups in (merged, by_itself(result.deviations)):
        scopes = [d.scope for cause in groups.causes for d in cause.deviations]
        assert sorted(scopes) == sorted(d.scope for d in result.deviations)
    assert all(cause.change is None for cause in by_itself(result.deviations).causes)


def test_two_differences_in_one_part_are_two_findings(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    document = told(capsys, asked(folder, "HotAndBrief"))
    causes = document["results"][0]["causes"]
    assert sorted(one["change"]["kind"] for one in causes) == ["limit", "timer"]
    assert all(one["complete"] for one in causes)


def test_one_difference_that_shows_in_two_ways_is_one_finding_in_every_form(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    page, text = folder / "o.html", folder / "o.md"
    document = told(capsys, asked(folder, "Deaf", "--html", str(page), "--markdown", str(text)))
    [result] = document["results"]
    [cause] = result["causes"]
    assert len(result["mismatches"]) > 1 and cause["change"]["at"] == "signal/door_open"
    assert cause["runs"] >= max(one["runs"] for one in result["mismatches"])
    [finding] = document["campaign"]["findings"]
    assert finding["cause"] == cause["says"]
    others = [one for one in finding["evidence"] if one["label"] == "also"]
    assert len(others) == len(result["mismatches"]) - 1
    assert "door_open is not read" in page.read_text("utf-8")
    assert "door\\_open is not read" in text.read_text("utf-8")
    assert run(asked(folder, "Deaf")) == 1
    said = " ".join(capsys.readouterr().out.split())
    ways = len(result["mismatches"])
    assert f"does not conform (1 finding, which shows in {ways} ways)" in said
    assert f"it shows in {ways - 1} other way" in said and "cause: Heater behaves as if door_open" in said


def test_without_causes_each_is_told_by_itself(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    [result] = told(capsys, asked(folder, "Deaf", "--no-causes"))["results"]
    assert len(result["causes"]) == len(result["mismatches"]) > 1
    assert not any(one["says"] for one in result["causes"])


def test_the_only_deviation_of_a_part_has_a_cause_where_it_is_asked_for(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for more, says in (((), ""), (("--causes",), "with a limit of")):
        [result] = told(capsys, asked(folder, "Hot", *more))["results"]
        [cause] = result["causes"]
        assert says in cause["says"] and bool(says) == bool(cause["change"])


def test_what_is_known_is_told_apart_from_what_is_new_of_one_cause(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    known = folder / "known.toml"
    run(asked(folder, "Deaf", "--write-known", str(known)))
    head, *records = known.read_text("utf-8").split("[[deviation]]")
    assert len(records) > 1
    known.write_text("[[deviation]]".join([head, records[0]]), encoding="utf-8")
    capsys.readouterr()
    [result] = told(capsys, asked(folder, "Deaf", "--known", str(known)))["results"]
    words = {one["id"]: one["known"] for one in result["mismatches"]}
    assert [{words[id] for id in one["deviations"]} for one in result["causes"]] in (
        [{"known"}, {"new"}],
        [{"new"}, {"known"}],
    )
    assert len({one["says"] for one in result["causes"]}) == 1
    run(asked(folder, "Deaf", "--write-known", str(known)))
    capsys.readouterr()
    assert run(asked(folder, "Deaf", "--known", str(known))) == 0, "with its cause all is decided"
    assert "known deviations and no other:" in " ".join(capsys.readouterr().out.split())


def test_a_search_that_the_time_ends_says_so(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    document = told(capsys, asked(folder, "Deaf", "--seconds", "1e-9"))
    [result] = document["results"]
    [cut] = result["causes_cut"]
    assert cut["part"] == "Heater" and len(result["causes"]) == len(result["mismatches"])
    assert any("--seconds" in note for note in document["campaign"]["notes"])
    run(asked(folder, "Deaf", "--seconds", "1e-9"))
    assert "not all; more with --seconds S." in " ".join(capsys.readouterr().out.split())


ODD = """

class Odd(Heater):
    "In step 3 one output is wrong, and in a warm room the other one."

    def step(self, given):
        self.step_number = getattr(self, "step_number", 0) + 1
        right = super().step(given)
        if self.step_number != 3:
            return right
        return right | ({"Heater": 3} if given["temperature"] >= 20 else {"heating": not right["heating"]})
"""


def test_of_runs_of_one_origin_each_deviation_is_told_in_its_own(folder: Path) -> None:
    """Fixed runs of one purpose have one name: of two that differ in one step one was told of the other."""
    with (folder / "firmware.py").open("a", encoding="utf-8") as file:
        file.write(ODD)
    env = environment(of_model(load(folder / "heater.py")))
    firmware = python.start(f"{folder / 'firmware.py'}:Odd", env.board, isolated=False)
    rooms = (
        [{"now_ms": 20 * n, "door_open": False, "temperature": t} for n in range(1, 5)] for t in (10, 20)
    )
    runs = [("rooms", rerun(env.board, room)) for room in rooms]
    search = CompareSearch(env, firmware, effort("ci", 0), allowance=Allowance(mismatches=0))
    found = {one.differences[0].name: one for one in search.run(runs).mismatches}
    told = {name: (one.origin, one.steps[-1].inputs["temperature"]) for name, one in found.items()}
    assert told == {"heating": ("rooms", 10), "Heater": ("rooms (2)", 20)}
    assert all(one.differences[0].actual != one.differences[0].expected for one in found.values())


def test_runs_beyond_what_is_kept_are_counted(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from rovercheck.checker.compare import evidence_runs

    monkeypatch.setattr(evidence_runs, "MOST_STEPS", 0)
    board = of_model(load(folder / "heater.py"))
    firmware = python.start(f"{folder / 'firmware.py'}:Deaf", board, isolated=False)
    kept: list[EvidenceRuns] = []

    def leading(found: object, runs: EvidenceRuns) -> list[Deviation]:
        kept.append(runs)
        return []

    result = cross_check(board, firmware, effort("ci", 5), leading=leading)
    [runs] = kept
    assert runs.of == result.notable.deviating > len(runs.runs) >= len(result.deviations)
    groups = by_itself(result.deviations)
    assert split(groups.causes, lambda one: True) == groups.causes


@pytest.mark.parametrize("verb", ["compare", "check-log", "diagnose"])
def test_every_verb_looks_for_causes_as_long_as_the_pages_say(verb: str) -> None:
    """The command line had half of the time that docs/compare.md gives."""
    [option] = [one for one in VerbTable()[verb].params if one.name == "seconds"]
    assert option.default == SECONDS == 300
