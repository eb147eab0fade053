"""``rovercheck certify`` and files that somebody altered, made up, or put where nothing can be written."""

from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any

import pytest

from rovercheck.checker import cli
from rovercheck.checker.certify.file import CertificateFile, CertificateOrigin, read, write
from rovercheck.checker.certify.outcome import Rejected
from rovercheck.checker.certify.terms import Malformed
from rovercheck.checker.commands.certify import derive as deriving
from rovercheck.checker.commands.certify.derive import CertificateCheck, DerivedVerdict, derived_verdicts
from rovercheck.checker.commands.certify.run import certify
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.process.pool import Order, Pool, PoolEvent
from tests.certificate_files import COUNTERS, WHEEL, changed, counters, two_searches, written
from tests.certifying import SOLVER


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the certificates of two searches."""
    return two_searches(tmp_path_factory.mktemp("certificates"))


@pytest.mark.usefixtures("no_child")
def test_a_corrupted_invariant_is_rejected(
    made: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    def drop(document: Any) -> None:
        document["certificates"][0]["invariant"]["nodes"][-1][1:4] = []

    assert cli.run(["certify", str(changed(counters(made), tmp_path, drop))]) is Exit.FAILED
    assert f"✗ {COUNTERS[0]}" in capsys.readouterr().out


@pytest.mark.usefixtures("no_child")
def test_a_certificate_of_another_model_is_rejected(
    made: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    def other(document: Any) -> None:
        document["certificates"][0]["digest"] = "0" * 64

    assert cli.run(["certify", str(changed(counters(made), tmp_path, other))]) is Exit.FAILED
    assert "question: it is about another counters" in capsys.readouterr().out


def test_swapped_files_are_rejected(made: Path, tmp_path: Path) -> None:
    other = read(made / "wheel_FR-PB1-06a-FR.json")
    forged = write(tmp_path, read(counters(made)).origin, other.certificates)
    assert certify([forged], SOLVER, None, False) is Exit.INCONCLUSIVE


@pytest.mark.usefixtures("no_child")
def test_without_its_certificate_a_property_is_undecided(made: Path, tmp_path: Path) -> None:
    forged = changed(counters(made), tmp_path, lambda document: document["certificates"].clear())
    assert certify([forged], SOLVER, None, False) is Exit.INCONCLUSIVE


@pytest.mark.usefixtures("no_child")
def test_an_origin_that_does_not_exist_is_rejected(
    made: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    changes: list[Callable[[Any], None]] = [
        lambda d: d["origin"].update(system="nowhere"),
        lambda d: d["origin"].update(system="relay"),
        lambda d: d["origin"].update(repair="none"),
        lambda d: d["origin"].update(readings={"S0": "x"}),
        lambda d: d["origin"].update(timers="none"),
        lambda d: d["origin"].update(properties=["PX-1"], proved=["PX-1"]),
    ]
    for change in changes:
        assert certify([changed(counters(made), tmp_path, change)], SOLVER, None, False) is Exit.FAILED
        assert "rejected  origin" in capsys.readouterr().out


@pytest.mark.usefixtures("no_child")
def test_what_was_proved_is_said(made: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A verdict about other interpretations is not one about the charts as specified."""
    path = written(tmp_path, *WHEEL, interpretations={"S27": "OK"})
    assert certify([path, counters(made)], SOLVER, None, False) is Exit.AS_EXPECTED
    said = capsys.readouterr().out
    assert "accepted  proved of wheel_FR under S27=OK: 4 obligations" in said
    assert "accepted  proved of counters: 4 obligations" in said


def test_properties_with_and_without_a_bound_are_never_searched_together(tmp_path: Path) -> None:
    """As one about infinite runs, a property that one tick breaks would only need that no loop closes."""
    ids = "PB1-25-turned", "PSY-12"
    for order in (ids, ids[::-1]):
        path = write(tmp_path, CertificateOrigin("references_executed", order, order, {}), [])
        told = derived_verdicts(read(path), CertificateCheck("", SOLVER, None))
        assert [type(one.outcome) for one in told] == [Rejected, Rejected]


@pytest.mark.usefixtures("no_child")
def test_a_file_cannot_write_lines_of_its_own(
    made: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    def spoof(document: Any) -> None:
        id = "PX\n✓ PB1-15 accepted \x1b[2K\ud800"
        document["origin"].update(properties=[id], proved=[id])

    assert certify([changed(counters(made), tmp_path, spoof)], SOLVER, None, False) is Exit.FAILED
    said = capsys.readouterr().out
    assert "\n✓" not in said and "\x1b" not in said and r"\n✓ PB1-15" in said


def test_nothing_is_counted_twice(made: Path, tmp_path: Path) -> None:
    def twice(document: Any) -> None:
        document["origin"]["proved"] *= 2

    with pytest.raises(Malformed, match="twice"):
        read(changed(counters(made), tmp_path, twice))


def test_a_file_that_kills_its_reader_is_undecided(
    made: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def told(
        written: CertificateFile, checking: CertificateCheck, model: Path | None
    ) -> list[DerivedVerdict]:
        raise MemoryError if written.origin.system == "counters" else AssertionError("what is this")

    monkeypatch.setattr(deriving, "derived_verdicts", told)
    monkeypatch.setattr(Pool, "run", here)
    assert certify([made], SOLVER, None, False) is Exit.INCONCLUSIVE
    said = capsys.readouterr().out
    assert ": MemoryError" in said and ": AssertionError: what is this" in said


def here(pool: Pool, orders: Sequence[Order]) -> Iterator[PoolEvent]:
    """The orders of a pool, carried out in this process."""
    for number, order in enumerate(orders):
        sent: list[Any] = []
        failure = None
        try:
            pool.make(*pool.args)(sent.append, *order.args)
        except Exception as error:
            failure = f"{type(error).__name__}: {error}"
        yield from (PoolEvent(number, message) for message in sent)
        yield PoolEvent(number, done=True, failure=failure)


def test_a_folder_for_obligations_that_cannot_be_written(
    made: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "taken").write_text("a file")
    assert cli.run(["certify", str(counters(made)), "--smt2", str(tmp_path / "taken")]) is Exit.USAGE
    assert "Cannot write" in capsys.readouterr().err
    (tmp_path / "smt2" / "counters-PSY-21a-1.1-initiation.smt2").mkdir(parents=True)
    assert cli.run(["certify", str(counters(made)), "--smt2", str(tmp_path / "smt2")]) is Exit.USAGE
    assert "counters-PSY-21a-1.1-initiation.smt2: Is a directory" in capsys.readouterr().err


@pytest.mark.usefixtures("no_child")
def test_files_of_one_name_keep_their_obligations_apart(made: Path, tmp_path: Path) -> None:
    other = tmp_path / "[odd] név;$(x)"
    other.mkdir()
    copy = changed(counters(made), other, lambda document: None)
    assert certify([counters(made), copy], SOLVER, tmp_path / "smt2", False) is Exit.AS_EXPECTED
    names = {path.name.rpartition("-")[0] for path in (tmp_path / "smt2").iterdir()}
    stem = "counters-PSY-21a"
    assert names == {f"{stem}{more}-1.{i}" for more in ("", "-2") for i in (1, 2, 3, 4)}


def test_interrupted(made: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def stopped(pool: Pool, orders: Sequence[Order]) -> Iterator[PoolEvent]:
        yield from []
        raise KeyboardInterrupt

    monkeypatch.setattr(Pool, "run", stopped)
    assert cli.run(["certify", str(made)]) is Exit.INTERRUPTED
