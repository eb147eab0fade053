"""Where entries are kept: whatever is wrong with the folder, every verdict is right."""

import os
import resource
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from pathlib import Path

import pytest

from rovercheck.checker.cache import entries
from rovercheck.checker.commands.check import unchanged
from rovercheck.checker.commands.check.unchanged import ToldStore
from rovercheck.checker.store import verdicts, versions
from rovercheck.checker.verify.result import Result
from rovercheck.checker.verify.searches import SearchSettings, events
from tests.store.lamps import GO, ON, PROPERTIES, PUSH, decided, lamp, of, store, told
from tests.store.naive_engine import NaiveEngine
from tests.store.test_entries import MODEL
from tests.store.test_forged import TRUTH

pytestmark = pytest.mark.usefixtures("no_child")
root = hasattr(os, "getuid") and os.getuid() == 0


def twice() -> int:
    """Decide the lamp twice with a store; how often an engine was asked the second time."""
    assert told(decided(lamp(), store())) == TRUTH
    engine = NaiveEngine()
    assert told(decided(lamp(), store(), engine=engine)) == TRUTH
    return len(engine.asked)


def test_in_a_folder_of_ones_own_nothing_is_asked_twice(folder: Path) -> None:
    assert twice() == 0
    assert all(path.stat().st_mode & 0o077 == 0 for path in folder.iterdir())


def test_a_file_in_the_place_of_the_folder(folder: Path) -> None:
    folder.write_text("mine", encoding="utf-8")
    assert twice() > 0 and folder.read_text(encoding="utf-8") == "mine"


def test_a_folder_that_others_may_write_to(folder: Path) -> None:
    folder.mkdir(mode=0o700)
    assert twice() == 0
    folder.chmod(0o777)
    assert twice() > 0
    folder.chmod(0o700)
    assert twice() == 0


@pytest.mark.skipif(root, reason="root may write anywhere")
def test_a_folder_that_is_read_only(folder: Path) -> None:
    folder.mkdir(mode=0o500)
    assert twice() > 0 and not list(folder.iterdir())


def test_a_folder_that_is_read_only_is_read(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """As where files are restored and the disk is mounted read-only, for root too."""
    assert twice() == 0

    def refused(*_: object, **__: object) -> None:
        raise PermissionError(30, "Read-only file system")

    for name in ("utime", "replace"):
        monkeypatch.setattr(os, name, refused)
    monkeypatch.setattr(tempfile, "mkstemp", refused)
    assert twice() == 0
    before = {path.name for path in folder.iterdir()}
    assert told(decided(lamp(GO & PUSH), store()))
    assert {path.name for path in folder.iterdir()} == before


def test_no_folder_at_all(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ROVERCHECK_CACHE", "")
    assert twice() > 0


def test_a_folder_that_is_deleted_meanwhile(folder: Path) -> None:
    heard: list[Result] = []
    settings = SearchSettings(NaiveEngine(), jobs=1, store=store())
    for one in events(PROPERTIES, {ON: lamp()}, settings):
        if isinstance(one, Result):
            heard.append(one)
            shutil.rmtree(folder, ignore_errors=True)
    assert told(heard) == TRUTH
    assert twice() == 0


@contextmanager
def files_of_at_most(size: int) -> Iterator[None]:
    """A disk that is full: no file can be longer (``SIGXFSZ`` is ignored by Python)."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)


@pytest.mark.parametrize("size", [0, 1, 40, 200])
def test_a_full_disk_leaves_no_half_entry(size: int, folder: Path) -> None:
    store()  # loads what it needs
    twice()
    shutil.rmtree(folder)
    with files_of_at_most(size):
        assert told(decided(lamp(), store())) == TRUTH
    assert not list(folder.glob("*.part"))
    for path in folder.glob("*-verdict-json.o"):
        assert store().read(path.stem) is not None
    assert twice() == 0


def test_two_checks_at_a_time_in_one_folder(folder: Path) -> None:
    """In threads here; entries appear at once, whoever writes them."""

    def often(_: int) -> None:
        for _ in range(5):
            kept, systems = store(), {ON: lamp()}
            for prop in PROPERTIES:
                name = kept.question(prop, systems)
                found = kept.read(name)
                assert found is None or found.verdict.word == TRUTH[prop.id][0]
                kept.write(name, verdict_of[prop.id], ON)
                assert kept.read(name) is not None

    verdict_of = {one.property.id: one.verdict for one in decided(lamp())}
    with ThreadPoolExecutor(4) as pool:
        list(pool.map(often, range(8)))
    assert not list(folder.glob("*.part"))
    assert told(decided(lamp(), store(), engine=NaiveEngine())) == TRUTH


HALL = """
from rovercheck import Block, always, assign, flag, in_order, never

go, lit = flag("go"), flag("lit")
hall = in_order("hall", Block("Light", [assign(lit, go)]))
SYSTEMS = [hall]
PROPERTIES = [
    always("YES", "Yes.", that=lit | ~lit, covers=["R"], on="hall"),
    never("NO", "No.", that=lit, covers=["R"], on="hall"),
]
"""


def test_two_commands_at_a_time_in_one_folder(folder: Path, tmp_path: Path) -> None:
    model = tmp_path / "hall.py"
    model.write_text(HALL, encoding="utf-8")
    command = [sys.executable, "-m", "rovercheck", "check", "--model", str(model), "--json"]
    runs = [
        subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=os.environ)
        for _ in range(2)
    ]
    said = {run.communicate()[0] for run in runs}
    codes = {run.returncode for run in runs}
    assert len(codes) == 1 and len(said) == 1, (codes, said)
    assert '"violated"' in next(iter(said)) and not list(folder.glob("*.part"))
    for path in folder.glob("*-verdict-json.o"):
        assert entries.read(path.stem, code=False) is not None


# --- files that change meanwhile ---------------------------------------------------------------------


def test_where_what_decides_has_changed_nothing_is_kept(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def changed() -> str:
        raise versions.ChangedMeanwhile("one.py has changed since it was loaded.")

    monkeypatch.setattr(verdicts, "deciding", changed)
    assert store().question(of("lit-violated"), {ON: lamp()}) is None
    assert store().slice(of("lit-violated"), {ON: lamp()}) is None
    assert twice() > 0 and not list(folder.glob("*-verdict-json.o"))


def test_where_it_changes_during_a_search_nothing_is_kept(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(verdicts, "as_loaded", lambda: False)
    assert twice() > 0 and not list(folder.glob("*-verdict-json.o"))


def test_another_version_of_what_decides_does_not_see_what_is_kept(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert twice() == 0
    monkeypatch.setattr(verdicts, "deciding", lambda: "another version")
    engine = NaiveEngine()
    decided(lamp(), store(), engine=engine)
    assert engine.asked
    monkeypatch.undo()


def test_what_was_told_while_a_file_changed_is_not_kept(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(unchanged, "tree_key", lambda: "before")
    kept = ToldStore("before", "ef" * 32 + "-told-json")
    for now in ("after", None):

        def tree(now: str | None = now) -> str:
            if now is None:
                raise FileNotFoundError("a folder is gone")
            return now

        monkeypatch.setattr(unchanged, "tree_key", tree)
        kept.add(MODEL)
        assert kept.read() is None
    monkeypatch.setattr(unchanged, "tree_key", lambda: "before")
    kept.add(MODEL)
    assert kept.read() == MODEL


def test_a_change_and_back_brings_the_old_answers_back(folder: Path) -> None:
    """As ``git stash`` and ``git stash pop`` do."""
    engine, asked = NaiveEngine(), list[int]()
    for guard in (GO, GO & PUSH, GO, GO & PUSH):
        decided(lamp(guard), store(), engine=engine)
        asked.append(len(engine.asked))
    assert 0 < asked[0] < asked[1] == asked[2] == asked[3], "each was decided once"
