"""Output that cannot be written: never a pass, never a violation, never taken for a bug of ours."""

import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from checker.cli import run
from checker.commands.codes import Exit

COMMANDS = [["check", "PB1-11"], ["check", "PB1-11", "--json"], ["list", "properties"]]


@pytest.fixture
def unread() -> Iterator[int]:
    """A pipe that nobody reads."""
    reading, writing = os.pipe()
    os.close(reading)
    yield writing
    os.close(writing)


def ended(arguments: list[str], target: int, errors: int = subprocess.PIPE) -> tuple[int, str]:
    """The exit code and what standard error says, with standard output going to the target."""
    command = [sys.executable, "-m", "checker", *arguments]
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


def test_certificates_that_cannot_be_written_are_a_mistake_of_the_user(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "file").touch()
    assert run(["check", "PB1-11", "--certificates", str(tmp_path / "file" / "folder")]) == Exit.USAGE
    said = capfd.readouterr().err
    assert said.startswith("Cannot write") and "bug" not in said
