"""Code from the cache that crashes: it is removed, the search is done anew, and the verdict is right."""

import errno
import os
import platform
import signal
import subprocess
import sys
from collections.abc import Iterator, Mapping, Sequence
from contextlib import closing
from dataclasses import replace
from pathlib import Path

import pytest

from rovercheck.checker import cache
from rovercheck.checker.cache import CachedCodeUse
from rovercheck.checker.cache.listeners import unheard
from rovercheck.checker.encode.native.jit import OptimisationLevel, object_code
from rovercheck.checker.engines import Engine, Limits, Progress, explicit
from rovercheck.checker.process.pool import PoolEvent
from rovercheck.checker.results.verdict import Answer, Exhausted, Proved, Unknown, Violated
from rovercheck.checker.verify.result import Result
from rovercheck.checker.verify.search_worker import PropertyDecided
from rovercheck.checker.verify.searches import (
    MachineWarning,
    SearchEnd,
    SearchSettings,
    TaskEvent,
    _Returns,
    searches,
)
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.system import TransitionSystem
from tests.cache.test_cache import folder
from tests.verify.test_searches import Erratic, work

__all__ = ["folder"]  # a fixture
ROOT = Path(__file__).parents[2]

NAMES = ("search", "rehash", "known", "retrace", "successors")
TRAP = "call void @llvm.trap() unreachable"
ADDRESS = "%p = inttoptr i64 8 to i64* store volatile i64 1, i64* %p ret i64 0"
FAULTS = {
    how: "declare void @llvm.trap()\n" + "\n".join(f"define i64 @{name}() {{ {body} }}" for name in NAMES)
    for how, body in (("trap", TRAP), ("address", ADDRESS))
}
"""Code that crashes wherever it is called."""


class Late(Erratic):
    """Acts only when it has the answers, for which it took code from the cache."""

    def check(
        self, system: TransitionSystem, goals: Sequence[Var], limits: Limits, progress: Progress
    ) -> Mapping[str, Answer]:
        explicit.check(system, goals, replace(limits, seconds=None), progress)
        os.kill(os.getpid(), signal.SIGKILL if self.what == "kill" else signal.SIGSEGV)
        return {}


def heard(engine: str | Engine = "explicit", tasks: int = 1) -> list[TaskEvent]:
    """What is heard of a search in a child."""
    known = {task.system.name: task.system for task in work()[:tasks]}
    todo = work()[:tasks]
    with closing(searches(todo, known, SearchSettings(engine, Limits(memory=1 << 30), 1))) as said:
        return [one for one in said if isinstance(one, Result | MachineWarning | SearchEnd)]


def words(said: list[TaskEvent]) -> dict[str, str]:
    return {one.property.id: one.verdict.word for one in said if isinstance(one, Result)}


def warnings(said: list[TaskEvent]) -> list[str]:
    return [one.text for one in said if isinstance(one, MachineWarning)]


def spoil(folder: Path, code: bytes) -> list[Path]:
    """Put code that crashes, well sealed, into every entry."""
    files = list(folder.iterdir())
    for path in files:
        cache.write(path.stem, code)
    return files


@pytest.fixture
def truth(folder: Path) -> Iterator[dict[str, str]]:
    """The verdicts, the code of which is then in the cache."""
    first = heard()
    assert words(first) == {"one-a": "proved", "one-b": "violated"} and not warnings(first)
    yield words(first)


@pytest.mark.parametrize("how", FAULTS)
def test_it_is_searched_anew_and_the_cache_is_mended(how: str, folder: Path, truth: dict[str, str]) -> None:
    files = spoil(folder, object_code(FAULTS[how], OptimisationLevel.QUICK))
    said = heard()
    assert words(said) == truth and sum(isinstance(one, SearchEnd) for one in said) == 1
    [text] = warnings(said)
    for part in ("one one-a and 1 more", "ended by SIG", f"from the cache {folder}", "delete the files *.o",
                 "ROVERCHECK_CACHE="):  # fmt: skip
        assert part in text
    again = heard()
    assert words(again) == truth and not warnings(again)
    assert all(cache.read(path.stem) for path in files)


def test_code_that_cannot_be_loaded_is_compiled_anew(folder: Path, truth: dict[str, str]) -> None:
    files = spoil(folder, b"no code at all")
    assert words(heard()) == truth
    assert b"no code at all" not in {cache.read(path.stem) for path in files}


def test_what_crashes_anyhow_is_searched_twice_and_told(truth: dict[str, str]) -> None:
    """An engine that crashes itself, after it took code from the cache."""
    said = heard(Late("one", "crash"))
    [text] = {
        one.verdict.reason for one in said if isinstance(one, Result) and isinstance(one.verdict, Unknown)
    }
    assert "ended by SIGSEGV, with code compiled anew after a crash with code from the cache" in text
    assert len(warnings(said)) == 1 and sum(isinstance(one, SearchEnd) for one in said) == 1


def test_what_crashes_without_the_cache_is_not_searched_again(truth: dict[str, str]) -> None:
    said = heard(Erratic("one", "crash"))
    assert warnings(said) == [] and set(words(said).values()) == {"unknown"}


def test_a_search_that_is_killed_from_outside_is_not_searched_again(truth: dict[str, str]) -> None:
    said = heard(Late("one", "kill"))
    assert warnings(said) == [] and set(words(said).values()) == {"unknown"}


def test_the_other_searches_go_on(folder: Path, truth: dict[str, str]) -> None:
    code = object_code(FAULTS["trap"], OptimisationLevel.QUICK)
    every = words(heard(tasks=3))
    spoil(folder, code)
    said = heard(tasks=3)
    assert words(said) == every and len(every) == 6
    assert 1 <= len(warnings(said)) <= 3 and sum(isinstance(one, SearchEnd) for one in said) == 3


def test_what_was_said_before_a_crash_is_searched_again_and_must_be_so(folder: Path) -> None:
    """A proof that the crashed search gave is not kept when it is refuted."""
    [task] = work()[:1]
    back = _Returns(task, False, None)
    visited = Exhausted(1, 1, 1, ("a",))
    proved, run = Proved(visited, "explicit"), Unknown("late", 0, "none")
    told = [
        PropertyDecided("one-a", proved, "one"),
        CachedCodeUse("key"),
        PropertyDecided("one-b", proved, "one"),
    ]
    assert [len(list(back.on_event(PoolEvent(0, message)))) for message in told] == [1, 0, 1]
    order = back.again()
    assert order is not None and order.args == ("one", task.properties, task.recorded, True)
    assert not list(back.on_event(PoolEvent(0, PropertyDecided("one-a", proved, "one"))))
    assert not list(back.on_event(PoolEvent(0, PropertyDecided("one-a", run, "one"))))
    with pytest.raises(AssertionError, match="with code compiled anew it is violated"):
        list(back.on_event(PoolEvent(0, PropertyDecided("one-b", Violated(visited, "explicit"), "one"))))
    assert back.again() is None, "once"


@pytest.mark.skipif(sys.platform == "win32", reason="modes are not looked at")
def test_a_cache_that_is_refused_is_told_once(folder: Path, truth: dict[str, str]) -> None:
    folder.chmod(0o777)
    said = heard(tasks=3)
    assert len(words(said)) == 6
    assert warnings(said) == [
        "Nothing is kept for the next time, neither verdicts nor compiled searches. "
        f"Others may write to the folder {folder}: chmod go-w {folder}"
    ]


def test_a_place_that_is_no_folder_is_told_once(folder: Path) -> None:
    folder.write_text("")
    [told] = warnings([*heard(tasks=2), *heard(tasks=2)])
    assert f"Cannot write {folder}: File exists." in told and "ROVERCHECK_CACHE=" in told


def test_a_full_disk_is_told_once_by_who_leads_the_searches(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(source: object, target: object) -> None:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(os, "replace", full)
    cache.write("key", b"code")
    cache.write("key", b"code")
    assert not list(folder.glob("*.part")), "what was begun is removed"
    [why] = unheard()
    assert f"Cannot write {folder}: No space left on device." in why and not unheard()


def test_the_command_says_it_on_standard_error(folder: Path, tmp_path: Path) -> None:
    def check() -> subprocess.CompletedProcess[str]:
        command = [sys.executable, "-m", "rovercheck", "check", "PB1-11", "--engine", "explicit"]
        return subprocess.run(command, capture_output=True, text=True, timeout=300, check=False)

    first = check()
    spoil(folder, object_code(FAULTS["trap"], OptimisationLevel.QUICK))
    second = check()
    assert (second.returncode, second.stdout) == (first.returncode, first.stdout)
    assert f"from the cache {folder}" in " ".join(second.stderr.split()) and "cache" not in first.stderr


# --- in a process that nobody listens to, as `graph` is ----------------------------------------------

ALONE = """
from rovercheck.checker.cache import run_marks
from tests.cache.test_cache import answers, system
print(*answers(system()), len(run_marks._marks))
"""


def alone() -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-c", ALONE]
    return subprocess.run(command, cwd=ROOT, capture_output=True, text=True, timeout=300, check=False)


@pytest.mark.skipif(sys.platform == "win32", reason="nothing is marked there")
def test_after_a_crash_the_next_process_compiles_anew(folder: Path) -> None:
    truth = alone().stdout
    spoil(folder, object_code(FAULTS["trap"], OptimisationLevel.QUICK))
    assert alone().returncode < 0 and len(list(folder.glob("*.running"))) == 1
    # The search is made anew; the inputs of the run it finds crash, which is noted, too.
    assert alone().returncode < 0 and len(list(folder.glob("*.running"))) == 1
    assert alone().stdout.split(" ")[:-1] == truth.split(" ")[:-1]
    last = alone()
    assert last.returncode == 0 and last.stdout.split()[-1] == "2"
    assert not list(folder.glob("*.running"))


@pytest.mark.skipif(sys.platform == "win32", reason="nothing is marked there")
@pytest.mark.parametrize(
    "said", ["", "x", "elsewhere 1", "{node} 1", "{node} {own}", "{node} -1", "{node} 9" + 20 * "9"]
)
def test_a_mark_that_tells_of_no_crash(said: str, folder: Path) -> None:
    """Of another machine, of a process that runs, or of nobody."""
    cache.write("key", b"code")
    text = said.format(node=platform.node(), own=os.getpid())
    (folder / "key.running").write_text(text)
    assert cache.read("key") == b"code"


@pytest.mark.skipif(sys.platform == "win32", reason="nothing is marked there")
def test_a_mark_writes_through_no_link(folder: Path, tmp_path: Path) -> None:
    cache.write("key", b"code")
    other = tmp_path / "other"
    other.write_text("mine")
    (folder / "key.running").symlink_to(other)
    assert cache.read("key") == b"code" and other.read_text() == "mine"
