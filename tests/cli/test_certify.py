"""Files of certificates and ``rovercheck certify``: written whole, read with suspicion, derived again."""

import gzip
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import cvc5
import jsonschema
import pytest
import z3

from rovercheck.checker import cli
from rovercheck.checker.certify.file import SCHEMA, Unwritable, read, write
from rovercheck.checker.certify.terms import Malformed
from rovercheck.checker.commands.certify.run import certify
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.properties.catalogue import catalogue
from tests.certificate_files import COUNTERS, WHEEL, changed, counters, two_searches, written
from tests.certifying import SOLVER
from tests.schemas import published

pytestmark = pytest.mark.usefixtures("no_child")


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the certificates of two searches."""
    return two_searches(tmp_path_factory.mktemp("certificates"))


def test_certificates_are_accepted(made: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.run(["certify", str(made)]) is Exit.AS_EXPECTED
    said = capsys.readouterr().out
    for id in (*COUNTERS, *WHEEL):
        assert f"✓ {id} " in said
    assert "Bitwuzla" in said and "3 properties in 2 files: 3 accepted." in said


def test_outcomes_for_machines_are_as_the_schema_says(
    made: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    schema = published("certify-1")
    changes: list[tuple[Callable[[Any], None], Exit, str]] = [
        (lambda _: None, Exit.AS_EXPECTED, "accepted"),
        (lambda d: d["certificates"][0].update(digest="0" * 64), Exit.FAILED, "rejected"),
        (lambda d: d["certificates"].clear(), Exit.INCONCLUSIVE, "undecided"),
    ]
    for change, code, word in changes:
        path = changed(counters(made), tmp_path, change)
        assert cli.run(["certify", str(path), "--solver", "bitwuzla", "--json"]) is code
        told = json.loads(capsys.readouterr().out)
        jsonschema.validate(told, schema)
        assert (told["exit"], [one["outcome"] for one in told["properties"]]) == (code, [word])


def test_every_outcome_names_its_file(made: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Of two files about one property nobody could tell which was rejected."""
    good = counters(made)
    bad = changed(good, tmp_path, lambda d: d["certificates"][0].update(digest="0" * 64))
    assert cli.run(["certify", str(good), str(bad), "--solver", "bitwuzla", "--json"]) is Exit.FAILED
    told = [(one["file"], one["outcome"]) for one in json.loads(capsys.readouterr().out)["properties"]]
    assert sorted(told) == sorted([(str(good), "accepted"), (str(bad), "rejected")])
    cli.run(["certify", str(good), str(bad), "--solver", "bitwuzla"])
    said = capsys.readouterr().out
    assert f"rejected  {bad}: " in said and str(good) not in said


def test_each_way_of_checking_alone(made: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.run(["certify", str(counters(made)), "--solver", "enumeration"]) is Exit.AS_EXPECTED
    assert "ticks tried" in capsys.readouterr().out
    assert cli.run(["certify", str(counters(made)), "--solver", "bitwuzla"]) is Exit.AS_EXPECTED
    assert "ticks tried" not in capsys.readouterr().out


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (b"", "it is not whole"),
        (b'{"schema": "rovercheck/certificate/1", "origin": {', "it is not whole"),
        (gzip.compress(b"{}" * 999, mtime=0)[:20], "it is not whole"),
        (b'{"schema": "rovercheck/check/1"}', "its schema is 'rovercheck/check/1'"),
        (b"[]", "its schema is None"),
        (json.dumps({"schema": SCHEMA}).encode(), "no list of certificates"),
        (json.dumps({"schema": SCHEMA, "certificates": []}).encode(), "in its origin"),
    ],
)
def test_what_is_no_file_of_certificates(
    content: bytes, said: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "c.json"
    path.write_bytes(content)
    assert cli.run(["certify", str(path)]) is Exit.USAGE
    assert said in capsys.readouterr().err


@pytest.mark.parametrize(
    "part", ["claims", "assume", "about", "digest", "question", "invariant", "found", "system"]
)
def test_a_malformed_certificate_is_none(part: str, made: Path, tmp_path: Path) -> None:
    def without(document: Any) -> None:
        del document["certificates"][0][part]

    def otherwise(document: Any) -> None:
        document["certificates"][0][part] = [[]]

    for change in (without, otherwise):
        with pytest.raises(Malformed):
            read(changed(counters(made), tmp_path, change))


def test_a_file_that_is_not_there(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.run(["certify", str(tmp_path / "none.json")]) is Exit.USAGE
    assert cli.run(["certify", str(tmp_path)]) is Exit.USAGE
    said = capsys.readouterr().err
    assert "Cannot read" in said and "holds no certificates" in said


def test_a_large_file_is_packed_and_replaces_the_plain_one(made: Path, tmp_path: Path) -> None:
    found = read(counters(made))
    plain = write(tmp_path, found.origin, found.certificates)
    assert plain.name == counters(made).name and read(plain) == found
    packed = write(tmp_path, found.origin, found.certificates * 200)
    assert packed.name == plain.name + ".gz" and not plain.exists()
    assert len(read(packed).certificates) == 200
    again = write(tmp_path / "again", found.origin, found.certificates * 200)
    assert again.read_bytes() == packed.read_bytes()


def test_where_nothing_can_be_written(made: Path, tmp_path: Path) -> None:
    found = read(counters(made))
    place = tmp_path / "taken"
    place.write_text("a file")
    with pytest.raises(Unwritable, match=r"Cannot write .*The verdicts stand"):
        write(place, found.origin, found.certificates)
    assert place.read_text() == "a file"


def test_a_proof_under_another_reading_is_derived_under_it(tmp_path: Path) -> None:
    path = written(tmp_path, *WHEEL, interpretations={"S27": "OK"})
    assert read(path).origin.interpretations == {"S27": "OK"}
    assert certify([path], SOLVER, None, False) is Exit.AS_EXPECTED
    otherwise = changed(path, tmp_path, lambda document: document["origin"].update(readings={}))
    assert certify([otherwise], SOLVER, None, False) is Exit.FAILED


def test_the_obligations_are_unsatisfiable_for_other_solvers_too(made: Path, tmp_path: Path) -> None:
    assert certify([made], SOLVER, tmp_path, False) is Exit.AS_EXPECTED
    scripts = sorted(tmp_path.glob("*.smt2"))
    assert {s.stem.rpartition("-")[2] for s in scripts} == {"initiation", "consecution", "domains", "safety"}
    for script in scripts:
        solver = z3.Solver()
        solver.from_string(script.read_text())
        assert solver.check() == z3.unsat
        assert _by_cvc5(script.read_text()) == "unsat"


def _by_cvc5(script: str) -> str:
    solver = cvc5.Solver(cvc5.TermManager())
    parser = cvc5.InputParser(solver)
    parser.setStringInput(cvc5.InputLanguage.SMT_LIB_2_6, script, "obligation")
    answers = ""
    while not (command := parser.nextCommand()).isNull():
        answers += str(command.invoke(solver, parser.getSymbolManager()))
    return answers.strip()


def test_the_properties_of_these_tests_exist() -> None:
    assert {*COUNTERS, *WHEEL} <= catalogue().keys()
