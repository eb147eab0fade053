"""Proofs of cases that never occur: told by `check`, an error with `--strict`."""

import json
from collections.abc import Generator, Iterable, Sequence
from pathlib import Path
from typing import Any

import pytest

from rovercheck.checker.cli import run
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.commands.shared.verdicts import results
from rovercheck.checker.verify.checked import CheckedProperty, PremiseCase
from rovercheck.checker.verify.result import Result
from rovercheck.properties.forms import Property
from tests.cli.test_report import EMPTY

pytestmark = pytest.mark.usefixtures("no_child")


@pytest.fixture
def hall(tmp_path: Path) -> Path:
    file = tmp_path / "hall.py"
    file.write_text(EMPTY, encoding="utf-8")
    return file


def checked(hall: Path, *options: str) -> Exit:
    return Exit(run(["check", "--model", str(hall), *options]))


def test_a_proof_of_nothing_is_told(hall: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert checked(hall) == Exit.AS_EXPECTED
    said = capsys.readouterr().out
    assert "Vacuous proofs, whose premise never occurs:\n  EMPTY, hall: Nothing." in said
    assert "FULL, hall" not in said


def test_with_strict_it_is_an_error(hall: Path, capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    junit = tmp_path / "verdicts.xml"
    assert checked(hall, "--strict", "--quiet", "--junit", str(junit)) == Exit.FAILED
    assert "EMPTY, hall: Nothing." in capsys.readouterr().out
    whole = junit.read_text(encoding="utf-8")
    assert 'failures="1"' in whole
    assert "EMPTY is proved, vacuously" in whole
    assert checked(hall, "--strict", "FULL") == Exit.AS_EXPECTED
    assert "1 proof has a premise (whenever ..., then ...): it occurs." in capsys.readouterr().out


def test_what_is_not_known_is_no_pass_with_strict(hall: Path, capsys: pytest.CaptureFixture[str]) -> None:
    from rovercheck.checker.commands.check import premises

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(premises, "cases", lambda *_, **__: {"FULL": PremiseCase(None, "not known")})
        assert checked(hall) == Exit.AS_EXPECTED
        assert checked(hall, "--strict") == Exit.INCONCLUSIVE
    assert "unknown whether the premise occurs: FULL." in capsys.readouterr().out


def test_json_has_the_case(hall: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert checked(hall, "--json") == Exit.AS_EXPECTED
    rows = json.loads(capsys.readouterr().out)["results"]
    assert {row["id"]: row["case"] for row in rows} == {"EMPTY": "never", "FULL": "occurs"}
    assert checked(hall, "--json", "--no-premises") == Exit.AS_EXPECTED
    assert {row["case"] for row in json.loads(capsys.readouterr().out)["results"]} == {None}


def test_runs_are_kept_and_gone_through_again(hall: Path, capsys: pytest.CaptureFixture[str]) -> None:
    from rovercheck.checker.commands.check import premises

    kept = hall.with_name("premises.json")
    assert checked(hall, "--record-premises") == Exit.AS_EXPECTED
    assert set(json.loads(kept.read_text(encoding="utf-8"))["runs"]) == {"FULL"}
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(premises, "results", lambda *_, **__: pytest.fail("searched, though a run is recorded"))
        assert checked(hall, "FULL") == Exit.AS_EXPECTED
    capsys.readouterr()


def test_a_run_that_shows_its_case_no_more_is_searched_anew(
    hall: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    from rovercheck.checker.commands.check import premises

    searched = list[int]()

    def counted(asked: Sequence[Property], *rest: Any, **more: Any) -> Generator[Result, None, None]:
        searched.append(len(asked))
        return results(asked, *rest, **more)

    kept = hall.with_name("premises.json")
    checked(hall, "--record-premises")
    right = kept.read_text(encoding="utf-8")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(premises, "results", counted)
        for old, new in (
            ('"button":1', '"button":0'),
            ('"button":1', '"button":77'),
            ('"button"', '"knob"'),
            ('"hall"', '"cellar"'),
        ):
            kept.write_text(right.replace(old, new), encoding="utf-8")
            assert checked(hall, "--strict", "FULL") == Exit.AS_EXPECTED
    assert searched == [1, 1, 1, 1]
    capsys.readouterr()


def test_a_run_on_record_is_gone_through_once_when_its_proof_is_heard_of(
    hall: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    from rovercheck.checker.commands.check import premises

    checked(hall, "--record-premises")
    again, told, order = premises.KnownCases.shown, premises.cases, list[str]()

    def noted(cases: Any, found: Iterable[CheckedProperty]) -> Any:
        of = list(found)
        order.extend(one.result.property.id for one in of)
        return again(cases, of)

    def at_the_end(*rest: Any) -> Any:
        order.append("end")
        return told(*rest)

    monkeypatch.setattr(premises.KnownCases, "shown", noted)
    monkeypatch.setattr(premises, "cases", at_the_end)
    assert checked(hall, "FULL") == Exit.AS_EXPECTED
    assert order == ["FULL", "end"]
    capsys.readouterr()


def test_runs_of_others_stay(hall: Path, capsys: pytest.CaptureFixture[str]) -> None:
    kept = hall.with_name("premises.json")
    checked(hall, "--record-premises")
    before = kept.read_bytes()
    assert checked(hall, "--record-premises", "EMPTY") == Exit.AS_EXPECTED
    assert kept.read_bytes() == before
    capsys.readouterr()


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (["--strict", "--no-premises"], "--no-premises leaves out what --strict needs"),
        (["--record-premises", "--no-premises"], "--no-premises leaves out what --record-premises needs"),
        (
            ["--record-premises", "--interpret", "S43=AND"],
            "--record-premises keeps runs of the charts as they are",
        ),
    ],
)
def test_what_contradicts_itself_is_told(
    options: list[str], said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["check", "PB1-11", *options]) == Exit.USAGE
    assert said in " ".join(capsys.readouterr().err.split())


def test_a_broken_file_of_runs_is_told_before_anything_is_searched(
    hall: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    hall.with_name("premises.json").write_text("{", encoding="utf-8")
    assert checked(hall) == Exit.USAGE
    said = capsys.readouterr()
    assert "holds no runs" in " ".join(said.err.split())
    assert "proved" not in said.out
