"""The cache of compiled code: it saves compiling, never changes an answer, and never stands in the way."""

import os
import subprocess
import sys
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path

import pytest

from rovercheck.checker import cache
from rovercheck.checker.cache.listeners import unheard
from rovercheck.checker.encode import native
from rovercheck.checker.encode.counters import counters
from rovercheck.checker.encode.native import NativeSearch, NativeTask, fingerprint, jit, layout, shifts
from rovercheck.checker.encode.native.jit import OptimisationLevel
from rovercheck.checker.engines import Limits, explicit, quiet
from rovercheck.checker.engines.explicit import levels
from rovercheck.checker.results.verdict import Answer, Reached, Unreachable
from rovercheck.spec_model.lang.action import Assign, If
from rovercheck.spec_model.lang.domain import chosen, integer
from rovercheck.spec_model.lang.expr import Var, flag, ite, var
from rovercheck.spec_model.lang.system import TransitionSystem
from rovercheck.spec_model.lang.words import minimum

ROOT = Path(__file__).parents[2]


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A cache and a secret of its own for each test."""
    made = tmp_path / "cache"
    monkeypatch.setenv(cache.SECRET, str(tmp_path / "state" / "secret"))
    monkeypatch.setenv(cache.VARIABLE, str(made))
    yield made
    unheard()


def system(top: int = 9, init: int = 0, low: int = 0) -> TransitionSystem:
    go, count, end = flag("go"), var("count", integer(low, 30), init), flag("end")
    step = (Assign(end, count == top), If(go, (Assign(count, minimum(count + 1, top)),)))
    return TransitionSystem("counting", (go,), (), (count, end), (), step)


def key(number: int) -> str:
    """The name of an entry."""
    return f"{number:064x}-search-quick"


def answers(made: TransitionSystem) -> list[Answer]:
    return list(explicit.check(made, [made.var("end")], Limits(), quiet).values())


def task(made: TransitionSystem, skip: bool = False) -> NativeTask:
    packing = layout(made.variables)
    moved = shifts(packing, counters(made)) if skip else ()
    return NativeTask(made, packing, (made.var("end"),), moved)


@pytest.fixture
def compiled(monkeypatch: pytest.MonkeyPatch) -> Iterator[list[OptimisationLevel]]:
    """The levels at which something is compiled from now on."""
    done: list[OptimisationLevel] = []
    real = jit.object_code

    def noted(text: str, level: OptimisationLevel) -> bytes:
        done.append(level)
        return real(text, level)

    monkeypatch.setattr(native, "object_code", noted)
    yield done


# --- it saves compiling ------------------------------------------------------------------------------


def test_the_second_run_compiles_nothing(compiled: list[OptimisationLevel]) -> None:
    first = answers(system())
    assert compiled == [
        OptimisationLevel.QUICK,
        OptimisationLevel.QUICK,
    ]  # the search, and the inputs of the run it found
    assert answers(system()) == first
    assert len(compiled) == 2


def test_better_code_is_kept_too(compiled: list[OptimisationLevel]) -> None:
    NativeSearch.compile(task(system())).improve()
    assert compiled == [OptimisationLevel.QUICK, OptimisationLevel.FAST]
    again = NativeSearch.compile(task(system()))
    assert again.level is OptimisationLevel.FAST and len(compiled) == 2


def test_a_long_search_is_compiled_well_and_answers_the_same(
    compiled: list[OptimisationLevel], monkeypatch: pytest.MonkeyPatch
) -> None:
    plain = answers(system())
    monkeypatch.setattr(levels, "QUICK_TRANSITIONS", 2)
    monkeypatch.setenv(cache.VARIABLE, "")
    assert answers(system()) == plain
    assert OptimisationLevel.FAST in compiled


def test_switched_off_by_an_empty_variable(
    compiled: list[OptimisationLevel], monkeypatch: pytest.MonkeyPatch, folder: Path
) -> None:
    monkeypatch.setenv(cache.VARIABLE, "")
    assert answers(system()) == answers(system())
    assert len(compiled) == 4 and not folder.exists()


def test_the_users_folder_by_default(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.delenv(cache.VARIABLE)
    monkeypatch.delenv(cache.SECRET)
    for name in ("XDG_CACHE_HOME", "XDG_STATE_HOME", "LOCALAPPDATA", "APPDATA"):
        monkeypatch.setenv(name, "not/absolute")  # to be ignored, says their standard
    for name in ("HOME", "USERPROFILE"):
        monkeypatch.setenv(name, str(tmp_path))
    cache.write("key", b"code")
    assert cache.read("key") == b"code"
    assert [p.parent.name for p in tmp_path.rglob("key.o")] == ["rovercheck"]
    assert [p.parent.name for p in tmp_path.rglob("cache-secret")] == ["rovercheck"]


# --- the key says all that matters -------------------------------------------------------------------


def test_what_differs_has_another_key() -> None:
    made = system()
    other_goal = replace(task(made), goals=(made.var("count"),))
    no_inputs = replace(made, inputs=())
    assumed = replace(made, assume=flag("go"))
    sparse = replace(made, variables=(var("count", chosen([0, 1, 30])), made.variables[1]))
    other_values = ite(flag("go"), made.var("count"), made.var("count"))
    other_step = replace(made, step=(*made.step, Assign(Var("count", integer(0, 30)), other_values)))
    tasks = [task(s) for s in (made, system(8), system(9, 1), no_inputs, assumed, other_step, sparse)]
    keys = [t.key for t in (*tasks, task(made, skip=True), other_goal)]
    assert len(set(keys)) == len(keys)


def test_the_same_system_has_the_same_key() -> None:
    assert task(system()).key == task(system()).key


def test_the_processor_is_part_of_the_key(monkeypatch: pytest.MonkeyPatch) -> None:
    before = task(system()).key
    monkeypatch.setattr(fingerprint, "processor", lambda: "another one")
    fingerprint.compiler.cache_clear()
    assert task(system()).key != before
    fingerprint.compiler.cache_clear()


def test_code_made_by_sources_that_were_changed_meanwhile_is_not_kept(
    monkeypatch: pytest.MonkeyPatch, folder: Path
) -> None:
    """Their new text would be in the key of code that the old one has made."""
    monkeypatch.setattr(fingerprint, "_LOADED", 0.0)
    fingerprint.compiler.cache_clear()
    with pytest.raises(OSError, match="has changed since it was loaded"):
        fingerprint.compiler()
    assert isinstance(answers(system())[0], Reached) and not folder.exists()


def test_every_module_that_takes_part_is_in_the_key() -> None:
    """The modules of the project that are loaded for compiling, seen in a process of its own."""
    script = (
        "import sys, rovercheck.checker.encode.native\n"
        "print(*(f for m in sys.modules.values() if (f := getattr(m, '__file__', None))), sep='\\n')"
    )
    out = subprocess.run([sys.executable, "-c", script], cwd=ROOT, check=True, capture_output=True, text=True)
    loaded = {Path(line) for line in out.stdout.splitlines()}
    ours = tuple(ROOT / "rovercheck" / name for name in ("checker", "spec_model"))
    own = {p for p in loaded if any(map(p.is_relative_to, ours))}
    assert own and own <= set(fingerprint.sources())


# --- damage ------------------------------------------------------------------------------------------


def _damage(path: Path, how: str) -> None:
    whole = path.read_bytes()
    match how:
        case "cut":
            path.write_bytes(whole[: len(whole) // 2])
        case "empty":
            path.write_bytes(b"")
        case "flipped":
            middle = len(whole) // 2
            path.write_bytes(whole[:middle] + bytes([whole[middle] ^ 1]) + whole[middle + 1 :])
        case "longer":
            path.write_bytes(whole + b"\0")


@pytest.mark.parametrize("how", ["cut", "empty", "flipped", "longer"])
def test_a_damaged_file_is_compiled_again(how: str, folder: Path, compiled: list[OptimisationLevel]) -> None:
    first = answers(system())
    files = sorted(folder.iterdir())
    good = [path.read_bytes() for path in files]
    for path in files:
        _damage(path, how)
    assert answers(system()) == first
    assert len(compiled) == 4
    assert [path.read_bytes()[:32] for path in files] != [b""] * len(files)
    assert [cache.read(path.stem) is not None for path in files] == [True] * len(good)


def test_the_code_of_another_key_is_not_taken(folder: Path) -> None:
    cache.write("one", b"code")
    os.replace(folder / "one.o", folder / "other.o")
    assert cache.read("other") is None


# --- it never stands in the way ----------------------------------------------------------------------


def test_a_folder_that_cannot_be_made(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    (tmp_path / "file").write_text("no folder")
    monkeypatch.setenv(cache.VARIABLE, str(tmp_path / "file" / "cache"))
    assert isinstance(answers(system())[0], Reached)


@pytest.mark.parametrize("failing", ["replace", "fdopen"])
def test_a_full_disk(failing: str, monkeypatch: pytest.MonkeyPatch, folder: Path) -> None:
    def full(*_: object, **__: object) -> None:
        raise OSError("no space left on device")

    monkeypatch.setattr(os, failing, full)
    assert isinstance(answers(system())[0], Reached)
    assert list(folder.iterdir()) == []


@pytest.mark.skipif(not hasattr(os, "getuid"), reason="there are no modes of folders to look at")
def test_a_folder_that_others_may_write_to_is_not_used(
    folder: Path, compiled: list[OptimisationLevel]
) -> None:
    answers(system())
    folder.chmod(0o777)
    answers(system())
    assert len(compiled) == 4


def test_its_size_is_bounded_and_the_longest_unused_go_first(
    monkeypatch: pytest.MonkeyPatch, folder: Path
) -> None:
    monkeypatch.setattr(cache.entries, "MOST_BYTES", 1000)
    for number in range(20):
        cache.write(key(number), bytes(100))
        os.utime(folder / f"{key(number)}.o", (number, number))
        assert sum(p.stat().st_size for p in folder.iterdir()) <= 1000
    assert cache.read(key(19)) is not None and cache.read(key(0)) is None


def test_what_else_lies_in_the_folder_is_never_removed(monkeypatch: pytest.MonkeyPatch, folder: Path) -> None:
    """Somebody names a folder in which there is more than the cache."""
    monkeypatch.setattr(cache.entries, "MOST_BYTES", 1000)
    folder.mkdir()
    kept = [folder / name for name in ("firmware.o", "rovercheck-report.html", f"{key(1)}.c", "notes")]
    for file in kept:
        file.write_bytes(bytes(5000))
        os.utime(file, (0, 0))
    for number in range(20):
        cache.write(key(number), bytes(100))
    assert all(file.exists() for file in kept) and cache.read(key(19)) is not None


def test_a_folder_that_may_only_be_read_is_used(
    monkeypatch: pytest.MonkeyPatch, compiled: list[OptimisationLevel]
) -> None:
    first = answers(system())
    compiled.clear()

    def refused(*_: object) -> None:
        raise PermissionError

    for name in ("utime", "replace"):
        monkeypatch.setattr(os, name, refused)
    assert answers(system()) == first and not compiled


def test_what_is_used_is_not_the_first_to_go(monkeypatch: pytest.MonkeyPatch, folder: Path) -> None:
    monkeypatch.setattr(cache.entries, "MOST_BYTES", 1000)
    for number in range(7):
        cache.write(key(number), bytes(100))
        os.utime(folder / f"{key(number)}.o", (number, number))
    assert cache.read(key(0)) is not None
    cache.write(key(7), bytes(100))
    assert cache.read(key(0)) is not None and cache.read(key(1)) is None


def test_many_at_once() -> None:
    def use(number: int) -> bool:
        cache.write("key", bytes([number % 3]) * 5000)
        found = cache.read("key")
        return found is not None and found in {bytes([n]) * 5000 for n in range(3)}

    with ThreadPoolExecutor(4) as pool:
        assert all(pool.map(use, range(200)))


def test_two_searches_at_once_use_one_cache() -> None:
    with ThreadPoolExecutor(3) as pool:
        found = list(pool.map(lambda _: answers(system()), range(9)))
    assert all(f == found[0] for f in found)
    never = replace(system(), step=(Assign(flag("end"), system().var("count") == 29), *system().step[1:]))
    assert isinstance(answers(never)[0], Unreachable)
