"""A slip in a file of properties is told as a mistake of that file, with its line."""

import subprocess
import sys
from pathlib import Path
from shutil import copy

import pytest

from rovercheck.checker.commands.shared.codes import Exit

ROOT = Path(__file__).parents[2]
AREA = "properties/areas/relay.py"


@pytest.mark.parametrize(
    ("right", "wrong", "said"),
    [
        ("then=~give_b2_actuation,", "then=~give_b2_actuatoin,", "NameError: name 'give_b2_actuatoin'"),
        ("import ticks", "import tikcs", "ImportError: cannot import name 'tikcs"),
        ("held(~critical, for_=", "held(~critical, fro_=", "TypeError: held() got an unexpected keyword"),
        ('ON = "relay"', 'ON = "relay', "SyntaxError: unterminated string literal"),
    ],
    ids=["name", "import", "argument", "syntax"],
)
def test_a_misspelt_name_is_a_mistake_of_its_file(tmp_path: Path, right: str, wrong: str, said: str) -> None:
    """It was reported as a bug of rovercheck."""
    house = tmp_path / "rovercheck"
    for package in ("checker", "properties", "spec_model"):
        copied(ROOT / package, house / package)
    for module in (ROOT / "rovercheck").glob("*.py"):
        copy(module, house)
    file = house / AREA
    text = file.read_text(encoding="utf-8")
    assert right in text
    file.unlink()
    file.write_text(text.replace(right, wrong), encoding="utf-8")
    command = [sys.executable, "-m", "rovercheck", "check", "PB1-14"]
    shown = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert shown.returncode == Exit.USAGE
    assert f"{AREA}:" in shown.stderr and said in " ".join(shown.stderr.split())
    assert "bug" not in shown.stderr


def copied(source: Path, target: Path) -> None:
    """The files of a package, linked: only one of them is another."""
    for file in source.rglob("*"):
        if file.is_file() and "__pycache__" not in file.parts:
            there = target / file.relative_to(source)
            there.parent.mkdir(parents=True, exist_ok=True)
            there.symlink_to(file)
