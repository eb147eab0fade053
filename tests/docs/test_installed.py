"""Whoever installs the wheel, and has nothing else of ours, has all that a model of their own needs."""

import os
import subprocess
import sys
import zipfile
from collections.abc import Mapping
from pathlib import Path

import pytest

from rovercheck.checker.commands.shared.codes import Exit

ROOT = Path(__file__).parents[2]
INSTALLED = """
import sys
from rovercheck.__main__ import __file__ as place, main
assert place.startswith(sys.path[0]), place
main()
"""


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the files of the wheel."""
    folder = tmp_path_factory.mktemp("wheel")
    build = [sys.executable, "-m", "hatchling", "build", "--target", "wheel", "--directory", str(folder)]
    subprocess.run(build, cwd=ROOT, check=True, capture_output=True)
    [built] = folder.glob("*.whl")
    with zipfile.ZipFile(built) as files:
        files.extractall(folder / "site")
    return folder / "site"


def typed(command: str, wheel: Path, folder: Path) -> str:
    """What a command prints that ends as expected, of the program in the wheel."""
    known: Mapping[str, str] = {**os.environ, "PYTHONPATH": str(wheel), "COLUMNS": "80"}
    done = subprocess.run(
        [sys.executable, "-P", "-c", INSTALLED, *command.split()],
        cwd=folder, env=known, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode == Exit.AS_EXPECTED, done.stdout + done.stderr
    return done.stdout


def test_a_model_is_begun_checked_and_reviewed_with_what_is_in_the_wheel(wheel: Path, tmp_path: Path) -> None:
    typed("init heater", wheel, tmp_path)
    said = typed("report --model heater/heater.py -o review.html", wheel, tmp_path)
    assert "3 demands: 2 proved, 1 violated." in said
    assert "</html>" in (tmp_path / "review.html").read_text(encoding="utf-8")
