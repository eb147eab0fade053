"""``check --watch`` on a real terminal: what each save of a file changes."""

import shutil
import sys
from pathlib import Path

import pytest

from rovercheck.checker.cli import run
from rovercheck.checker.commands.shared.codes import Exit
from tests.cli.terminal import Terminal

CLOSED = "door_open | (temperature > 22)"
OPEN = "temperature > 22"


@pytest.fixture
def heater(tmp_path: Path) -> Path:
    """The model that ``init`` writes."""
    assert run(["init", str(tmp_path / "heater")]) is Exit.AS_EXPECTED
    return tmp_path / "heater" / "heater.py"


def watching(heater: Path) -> Terminal:
    words = ["check", "--model", str(heater), "--watch"]
    return Terminal([sys.executable, "-m", "rovercheck", *words], 120)


def saved(heater: Path, old: str, new: str) -> None:
    heater.write_text(heater.read_text(encoding="utf-8").replace(old, new), encoding="utf-8")


def test_every_save_is_checked_and_half_a_file_loses_nothing(heater: Path) -> None:
    whole = heater.read_text(encoding="utf-8")
    with watching(heater) as terminal:
        terminal.until("Ctrl-C ends")
        saved(heater, CLOSED, OPEN)
        terminal.until("proved → violated")
        heater.write_text(whole[:700], encoding="utf-8")
        terminal.until("the verdicts of before stand")
        heater.write_text(whole, encoding="utf-8")
        terminal.until("Better:")
        terminal.type("\x03")
        assert terminal.ended() == Exit.INTERRUPTED


def test_a_folder_that_vanishes_ends_it(heater: Path) -> None:
    with watching(heater) as terminal:
        terminal.until("Ctrl-C ends")
        shutil.rmtree(heater.parent)
        terminal.until("nothing to watch any")
        assert terminal.ended() == Exit.USAGE


def test_it_writes_no_file(heater: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["check", "--model", str(heater), "--watch", "--junit", "x.xml"]) is Exit.USAGE
    assert "--watch tells what changes and writes no file" in capsys.readouterr().err
