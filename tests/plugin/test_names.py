"""Packages of others that bear our names: each process and each moment has its own."""

import subprocess
import sys
from importlib import import_module
from pathlib import Path

import pytest

import properties
from rovercheck import NAMES, _finder, claim, own


@pytest.fixture
def theirs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder, first on the search path, with a package of another one for each name of ours."""
    for name in NAMES:
        (tmp_path / name).mkdir()
        (tmp_path / name / "__init__.py").write_text("mine = True\n")
    monkeypatch.syspath_prepend(str(tmp_path))
    return tmp_path


def test_ours_are_left_as_they_are_if_nobody_else_has_the_names() -> None:
    before = {n: m for n, m in sys.modules.items() if n.partition(".")[0] in NAMES}
    with own(), own():
        assert import_module("properties") is properties
    assert before.items() <= sys.modules.items()


@pytest.mark.usefixtures("theirs")
def test_a_name_means_ours_inside_and_theirs_outside(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in [n for n in sys.modules if n.partition(".")[0] == "supervisor"]:
        monkeypatch.delitem(sys.modules, name)  # as if it had not been imported yet
    other = import_module("supervisor")
    with own():
        ours = import_module("supervisor")
        deeper = import_module("supervisor.board1")
        with own():
            assert import_module("supervisor") is ours
    assert import_module("supervisor") is other and other.mine
    assert "supervisor.board1" not in sys.modules
    with own():
        assert import_module("supervisor.board1") is deeper, "the same the next time"
    assert sys.modules["supervisor"] is other


def test_a_process_of_ours_has_ours_for_good(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "meta_path", list(sys.meta_path))
    claim()
    claim()
    assert sys.meta_path.count(_finder) == 1 and sys.meta_path[0] is _finder


def test_the_command_works_where_the_names_are_taken(theirs: Path) -> None:
    command = [sys.executable, "-m", "rovercheck", "list", "engines"]
    done = subprocess.run(command, cwd=theirs, capture_output=True, text=True, check=True)
    assert "explicit" in done.stdout
