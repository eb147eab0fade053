"""Output that cannot be written: never a pass, never a violation, never taken for an internal error."""

import json
import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from rovercheck.checker.cli import run
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.commands.shared.output import write
from rovercheck.checker.commands.trace import run as tracing

COMMANDS = [["check", "PB1-11"], ["check", "PB1-11", "--json"], ["list", "properties"]]


@pytest.fixture
def unread() -> Iterator[int]:
    """A pipe that nobody reads."""
    interpretation, writing = os.pipe()
    os.close(interpretation)
    yield writing
    os.close(writing)


def ended(arguments: list[str], target: int, errors: int = subprocess.PIPE) -> tuple[int, str]:
    """The exit code and what standard error says, with standard output going to the target."""
    command = [sys.executable, "-m", "rovercheck", *arguments]
    shown = subprocess.run(command, stdout=target, stderr=errors, text=True, check=False)
    return shown.returncode, shown.stderr or ""


@pytest.mark.parametrize("arguments", COMMANDS, ids=" ".join)
def test_nobody_reads_on(arguments: list[str], unread: int) -> None:
    assert ended(arguments, unread) == (Exit.INTERRUPTED, "")


def test_nobody_reads_anything(unread: int) -> None:
    assert ended(["check", "PB1-11"], unread, unread) == (Exit.INTERRUPTED, "")


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="a device that is always full")
@pytest.mark.parametrize("arguments", COMMANDS, ids=" ".join)
def test_there_is_no_room(arguments: list[str]) -> None:
    with Path("/dev/full").open("wb") as full:
        code, said = ended(arguments, full.fileno())
    assert code == Exit.INCONCLUSIVE
    assert "No space left on device" in said and "bug" not in said and "Traceback" not in said


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="a device that is always full")
def test_there_is_no_room_in_a_file(capsys: pytest.CaptureFixture[str]) -> None:
    """It is the same code as for standard output: nothing is wrong with the command line."""
    assert run(["graph", "Relay", "--output", "/dev/full"]) == Exit.INCONCLUSIVE
    said = capsys.readouterr().err
    assert said.splitlines()[-1].startswith("Cannot write /dev/full: No space left on device.")


@pytest.mark.parametrize(
    ("place", "why"),
    [
        ("missing/x.svg", "No such file or directory"),
        (".", "Is a directory"),
        ("file/x.svg", "Not a directory"),
    ],
)
def test_a_place_that_cannot_be_written_is_a_mistake_of_the_user(
    place: str, why: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "file").touch()
    assert run(["graph", "Relay", "-o", str(tmp_path / place)]) == Exit.USAGE
    assert f": {why}. Choose another file." in " ".join(capsys.readouterr().err.split())
    assert {p.name for p in tmp_path.iterdir()} == {"file"}


@pytest.mark.parametrize(("place", "why"), [("missing/x.svg", "is no folder. Make it first."),
                                            (".", "it is a folder. Name a file in it.")])  # fmt: skip
def test_no_run_is_searched_for_a_place_that_cannot_be_written(
    place: str, why: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(tracing, "results", None)
    assert run(["trace", "PB1-15", "-o", str(tmp_path / place)]) == Exit.USAGE
    assert why in " ".join(capsys.readouterr().err.split())


def test_a_path_that_is_no_text_is_written_all_the_same(tmp_path: Path) -> None:
    path = os.fsdecode(b"/models/\xff.py")
    write(json.dumps({"file": path}, ensure_ascii=False), tmp_path / "x.json")
    assert json.loads((tmp_path / "x.json").read_text(encoding="utf-8")) == {"file": path}


def test_a_folder_for_certificates_is_tried_before_anything_is_searched(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    """Nothing is proved here, so nothing would be written."""
    (tmp_path / "file").touch()
    assert run(["check", "PB1-15", "--certificates", str(tmp_path / "file" / "folder")]) == Exit.USAGE
    assert capfd.readouterr().out == ""


def test_certificates_that_cannot_be_written_are_a_mistake_of_the_user(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "file").touch()
    assert run(["check", "PB1-11", "--certificates", str(tmp_path / "file" / "folder")]) == Exit.USAGE
    said = capfd.readouterr().err
    assert said.startswith("Cannot write") and "bug" not in said
