"""Certificates of the command line: written, checked again, and loud when one is rejected."""

import json
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path

import pytest

from rovercheck.checker.certify.file import read
from rovercheck.checker.certify.outcome import Accepted, Outcome, Rejected, Undecided
from rovercheck.checker.certify.record import Recorder
from rovercheck.checker.cli import run
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.engines import Limits, quiet
from rovercheck.checker.verify.certificates import Certification
from rovercheck.checker.verify.decide import decide
from rovercheck.checker.verify.portfolio.question import Callbacks
from rovercheck.checker.verify.result import Result
from rovercheck.checker.verify.searches import searches as honest
from rovercheck.checker.verify.tasks import tasks
from rovercheck.properties.catalogue import catalogue
from rovercheck.spec_model.rover import systems


def test_every_proof_is_certified_and_written(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    arguments = ["check", "PB1-11", "PB1-30c-FL", "--certify", "--certificates", str(tmp_path), "--json"]
    assert run(arguments) == Exit.AS_EXPECTED
    rows = {row["id"]: row for row in json.loads(capfd.readouterr().out)["results"]}
    assert rows["PB1-11"]["certificate"]["outcome"] == "accepted"
    assert rows["PB1-30c-FL"]["certificate"] is None, "a run is replayed, not certified"
    [file] = tmp_path.iterdir()
    written = read(file)
    assert written.origin.proved == ("PB1-11",)
    assert any("PB1-11" in one.claims for one in written.certificates)


def test_a_verdict_tells_that_it_is_certified(capfd: pytest.CaptureFixture[str]) -> None:
    assert run(["check", "PB1-11", "--certify"]) == Exit.AS_EXPECTED
    shown = " ".join(capfd.readouterr().out.split())
    assert "of relay, certified" in shown and "1 proof certified." in shown


def test_a_verdict_tells_why_it_is_not(capfd: pytest.CaptureFixture[str]) -> None:
    asked = ["check", "PB1-11", "--engine", "explicit", "--timers", "skip", "--certify"]
    assert run(asked) == Exit.AS_EXPECTED
    shown = " ".join(capfd.readouterr().out.split())
    assert "not certified: explicit wrote no certificate of all" in shown and "(quiet ticks skipped)" in shown


@pytest.mark.parametrize("known", [True, False])
def test_a_proof_stands_that_is_too_large_for_a_certificate(
    known: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Two promises ended as unknown when diagrams were made of their 20 to 40 million states."""

    def no_room(*_: object) -> None:
        raise MemoryError

    if known:
        monkeypatch.setattr("rovercheck.checker.certify.certificate.MOST", 1)
    else:
        monkeypatch.setattr("rovercheck.checker.certify.certificate.diagram", no_room)
    [task] = tasks([catalogue()["PB1-11"]], systems())
    recorder = Recorder()
    told = Callbacks(on_answer=recorder.answered)
    found = list(decide(task, systems(), "explicit", Limits(), told))
    [result] = found
    assert result.verdict.word == "proved" and recorder.made == []
    outcomes = Certification(again=True).outcomes(task, systems(), Limits(), found, recorder.made, quiet)
    assert isinstance(outcome := outcomes["PB1-11"], Undecided)
    assert "explicit wrote no certificate of all" in outcome.reason and "too many" in outcome.reason


def test_certifying_within_little_memory(monkeypatch: pytest.MonkeyPatch) -> None:
    """It was said that the engine had given no certificate."""

    def no_room(*_: object) -> Outcome:
        raise MemoryError

    monkeypatch.setattr("rovercheck.checker.verify.certificates.check", no_room)
    [task] = tasks([catalogue()["PB1-11"]], systems())
    recorder = Recorder()
    told = Callbacks(on_answer=recorder.answered)
    found = list(decide(task, systems(), "explicit", Limits(), told))
    outcome = Certification(again=True).outcomes(task, systems(), Limits(), found, recorder.made, quiet)[
        "PB1-11"
    ]
    assert outcome == Undecided("the memory limit is reached")


@pytest.mark.parametrize(
    ("outcome", "code", "said"),
    [
        (Accepted("3 obligations"), Exit.AS_EXPECTED, ", certified"),
        (Undecided("too large"), Exit.AS_EXPECTED, ", not certified: too large"),
        (Rejected("consecution", "x = 1"), Exit.INTERNAL, "CERTIFICATE REJECTED (consecution)"),
    ],
)
def test_what_comes_of_a_certificate_is_shown(
    outcome: Outcome,
    code: Exit,
    said: str,
    monkeypatch: pytest.MonkeyPatch,
    capfd: pytest.CaptureFixture[str],
) -> None:
    def searches(*arguments: Sequence[object]) -> Iterator[object]:
        for heard in honest(*arguments):  # type: ignore[arg-type]
            yield replace(heard, certificate=outcome) if isinstance(heard, Result) else heard

    monkeypatch.setattr("rovercheck.checker.verify.searches.searches", searches)
    assert run(["check", "PB1-11"]) == code
    shown = capfd.readouterr()
    assert said in shown.out
    assert ("please report it" in " ".join(shown.err.split())) == (code is Exit.INTERNAL)


def test_a_folder_that_cannot_be_written_any_more(
    tmp_path: Path, capfd: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("rovercheck.checker.commands.check.certificates.writable", lambda folder: None)
    (tmp_path / "taken").write_text("a file")
    assert run(["check", "PB1-11", "--certificates", str(tmp_path / "taken" / "in")]) == Exit.USAGE
    shown = capfd.readouterr()
    assert "PB1-11" in shown.out and "The verdicts stand." in shown.err and "Internal error" not in shown.err


def test_no_folder_is_left_where_nothing_is_proved(tmp_path: Path) -> None:
    """It was made before the search, and stayed empty."""
    folder = tmp_path / "new" / "certificates"
    asked = ["--certificates", str(folder)]
    assert run(["check", "PB1-15", *asked]) == Exit.AS_EXPECTED
    assert not folder.parent.exists()
    assert run(["check", "PB1-11", *asked]) == Exit.AS_EXPECTED
    assert list(folder.glob("relay-*.json*"))
