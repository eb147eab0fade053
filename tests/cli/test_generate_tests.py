"""``rovercheck generate-tests``: files, exact counts, exit codes."""

import json
from pathlib import Path
from typing import Any

import pytest
from jsonschema import Draft202012Validator

from rovercheck.checker.cli import run
from rovercheck.checker.commands.generate_tests import run as generating
from rovercheck.checker.commands.generate_tests.run import GenerationProgress
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.system.instrument.watch import watched
from rovercheck.checker.testgen.fingerprint import fingerprint
from rovercheck.checker.testgen.generate import Aim
from rovercheck.checker.testgen.keep import KeptTests, kept_of, written
from tests.schemas import published
from tests.testgen.cover_toys import SYSTEM, TOY

SCHEMA: Any = published("testgen-1")


def test_the_kept_tests_are_written_at_once(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    target = tmp_path / "new"
    code = run(["generate-tests", "--kept", "--system", "Relay", "--cover", "pairs", "-o", str(target)])
    said = capsys.readouterr().out
    assert code is Exit.AS_EXPECTED
    assert "pairs 3: 3 covered" in said and "0 proved uncoverable, 0 unknown" in said
    assert (tmp_path / "new" / "board1_goals.csv").exists()


def test_the_document_names_every_goal(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    run(["generate-tests", "--kept", "--system", "Relay", "--json", "--format", "c", "-o", str(tmp_path)])
    document = json.loads(capsys.readouterr().out)
    Draft202012Validator.check_schema(SCHEMA)
    Draft202012Validator(SCHEMA).validate(document)
    assert (document["schema"], document["exit"]) == ("rovercheck/testgen/1", 0)
    (board,) = document["boards"]
    assert board["board"] == "board1" and document["complete"]
    assert [g["verdict"] for g in board["goals"]] == ["covered"] * 3
    assert {g["test"] for g in board["goals"]} == {t["name"] for t in board["tests"]}
    assert sorted(board["files"]) == ["cover_board1.c", "cover_board1.h"]


def test_a_search_covers_a_block(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    arguments = ["--system", "checkStop", "--cover", "boundaries", "--ticks", "3000", "--format", "pytest"]
    code = run(["generate-tests", *arguments, "--jobs", "1", "-o", str(tmp_path)])
    said = capsys.readouterr().out
    assert code is Exit.AS_EXPECTED, said
    assert "boundaries 12: 12 covered" in said
    assert {p.name for p in tmp_path.iterdir()} == {"test_cover_board1.py", "conftest.py"}


def test_no_line_is_wider_than_the_terminal(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("COLUMNS", "80")
    monkeypatch.chdir(tmp_path)
    run(["generate-tests", "--kept", "--system", "board1", "-o", "tests"])
    assert max(map(len, capsys.readouterr().out.splitlines())) <= 80


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--system", "Rely"], "Relay"),
        (["--cover", "everything"], "everything"),
        (["--format", "xml"], "xml"),
        (["--timeout", "0"], "--timeout"),
    ],
)
def test_a_mistake_is_one_message(
    arguments: list[str], said: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["generate-tests", *arguments, "-o", str(tmp_path)]) is Exit.USAGE
    assert said in capsys.readouterr().err


def test_a_place_that_cannot_be_written_is_one_message(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "file").write_text("")
    code = run(["generate-tests", "--kept", "--system", "Relay", "-o", str(tmp_path / "file" / "in")])
    assert code in (Exit.USAGE, Exit.INCONCLUSIVE)
    assert len(capsys.readouterr().err.strip().splitlines()) == 1


def test_ctrl_c_writes_what_was_found(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def ctrl_c(say: GenerationProgress, doing: str) -> None:
        if say.coverage.covered:
            raise KeyboardInterrupt

    monkeypatch.setattr(GenerationProgress, "__call__", ctrl_c)
    arguments = ["--system", "checkStop", "--cover", "boundaries", "--ticks", "3000", "--timeout", "0.1"]
    assert run(["generate-tests", *arguments, "--jobs", "1", "-o", str(tmp_path)]) is Exit.INTERRUPTED
    said = capsys.readouterr().out
    assert "Interrupted: this is what was found so far." in said
    assert (tmp_path / "board1_001.csv").exists()


# --- a kept set goes on --------------------------------------------------------------------------------


@pytest.fixture
def toy_kept(monkeypatch: pytest.MonkeyPatch) -> None:
    """The toy board in place of the rover's; nothing is kept of it yet."""
    goals = watched(TOY.system).goals
    monkeypatch.setattr(generating, "aims", lambda names, kinds, boards: [Aim(TOY, goals)])
    monkeypatch.setattr(generating, "_model", lambda board, charts: SYSTEM)
    monkeypatch.setattr(generating, "kept_text", lambda name: written(TOY, KeptTests(())))


EFFORT = ["--ticks", "400", "--jobs", "1"]


@pytest.mark.usefixtures("toy_kept")
def test_a_set_is_kept_and_gone_on_from(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    place = tmp_path / "new" / "toy.json"
    assert run(["generate-tests", "--keep", str(tmp_path / "new"), *EFFORT]) is Exit.AS_EXPECTED
    first = place.read_text(encoding="utf-8")
    assert kept_of(TOY, first).charts == fingerprint(TOY, SYSTEM)
    said = capsys.readouterr().out
    assert f"{len(kept_of(TOY, first).tests)} tests of" in said and "in the set of" in said
    assert run(["generate-tests", "--keep", str(tmp_path / "new"), "--ticks", "0"]) is Exit.AS_EXPECTED
    assert place.read_text(encoding="utf-8") == first


@pytest.mark.usefixtures("toy_kept")
def test_a_set_that_is_none_is_left_as_it_is(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "toy.json").write_text("{}", encoding="utf-8")
    assert run(["generate-tests", "--keep", str(tmp_path), *EFFORT]) is Exit.USAGE
    assert "Cannot go on from" in capsys.readouterr().err
    assert (tmp_path / "toy.json").read_text(encoding="utf-8") == "{}"


def test_to_keep_and_to_write_what_is_kept_are_two_things(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["generate-tests", "--kept", "--keep", "somewhere"]) is Exit.USAGE
    assert "leave one out" in capsys.readouterr().err
