"""The cache written to by somebody without the user's secret: entries go missing, and no verdict changes."""

import hmac
import os
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from hashlib import sha256
from pathlib import Path

import pytest

from rovercheck.checker import cache
from rovercheck.checker.cache import CacheRefused, listening
from rovercheck.checker.encode.native import fingerprint
from rovercheck.checker.results.verdict import Answer, Reached, Unreachable
from rovercheck.spec_model.lang.action import Assign
from rovercheck.spec_model.lang.expr import flag
from tests.cache.test_cache import answers, compiled, folder, system

__all__ = ["compiled", "folder"]  # fixtures

posix = pytest.mark.skipif(not hasattr(os, "getuid"), reason="there are no owners and modes to look at")


@pytest.fixture
def secret(folder: Path) -> Path:
    """The file of the secret."""
    return cache.secret_place()


def refusals(name: str = "key") -> list[str]:
    """Why the cache is refused when an entry is written and read."""
    said: list[str] = []
    with listening(lambda what: said.append(what.why) if isinstance(what, CacheRefused) else None):
        cache.write(name, b"code")
        assert cache.read(name) is None
    return said


# --- the attack --------------------------------------------------------------------------------------

THIRD = system(3)
"""The goal is reached after some ticks."""
NEVER = replace(THIRD, step=(Assign(flag("end"), THIRD.var("count") == 29), *THIRD.step[1:]))
"""It is never reached."""
SEALS = {
    "as it is": lambda name, code, old: old,
    "as before secrets": lambda name, code, old: sha256(name.encode() + code).digest(),
    "without a secret": lambda name, code, old: hmac.digest(b"", name.encode() + code, "sha256"),
    "with a secret of zeros": lambda name, code, old: cache.sealed(name, code, bytes(32))[:32],
    "with another's secret": lambda name, code, old: cache.sealed(name, code, os.urandom(32))[:32],
    "with zeros": lambda name, code, old: bytes(32),
    "with nothing": lambda name, code, old: b"",
}


def searched(folder: Path) -> tuple[list[Answer], Path, Path]:
    """The answers of a search that finds a run, its code, and that of one that proves there is none."""
    proved = answers(NEVER)
    [other] = folder.glob("*-search-quick.o")
    truth = answers(THIRD)
    [victim] = set(folder.glob("*-search-quick.o")) - {other}
    assert isinstance(truth[0], Reached) and isinstance(proved[0], Unreachable)
    return truth, victim, other


@pytest.mark.parametrize("how", SEALS)
def test_the_code_of_another_search_under_the_name_of_this_one(
    how: str, folder: Path, compiled: list[object]
) -> None:
    """With this, what is violated was proved."""
    truth, victim, other = searched(folder)
    before, code = victim.read_bytes(), other.read_bytes()[32:]
    victim.write_bytes(SEALS[how](victim.stem, code, other.read_bytes()[:32]) + code)
    compiled.clear()
    assert answers(THIRD) == truth and len(compiled) == 1
    assert victim.read_bytes() == before, "compiled anew and kept"


def test_with_the_secret_it_would_be_believed(folder: Path) -> None:
    """The attack is a real one: it is the seal that stops it."""
    _, victim, other = searched(folder)
    code = other.read_bytes()[32:]
    victim.write_bytes(cache.sealed(victim.stem, code, cache.secret_place().read_bytes()))
    assert isinstance(answers(THIRD)[0], Unreachable)


@pytest.mark.parametrize("kind", ["search", "retrace"])
def test_code_without_the_functions_of_its_kind_is_made_anew(
    kind: str, folder: Path, compiled: list[object]
) -> None:
    """Well sealed code of another kind was taken, and the answer was that nothing is known."""
    truth, *_ = searched(folder)
    entries = {path: path.read_bytes()[32:] for path in folder.glob("*.o")}
    other = next(code for path, code in entries.items() if f"-{kind}-" not in path.name)
    wrong = [path for path in entries if f"-{kind}-" in path.name]
    for path in wrong:
        path.write_bytes(cache.sealed(path.stem, other, cache.secret_place().read_bytes()))
    compiled.clear()
    assert answers(THIRD) == truth and compiled
    assert any(path.read_bytes()[32:] == entries[path] for path in wrong), "compiled anew and kept"


def test_a_proof_is_not_had_by_exchanging_searches(folder: Path) -> None:
    """Every entry under every other name, one after the other."""
    violated, proved = THIRD, NEVER
    assert isinstance(answers(violated)[0], Reached) and isinstance(answers(proved)[0], Unreachable)
    whole = {path: path.read_bytes() for path in folder.iterdir()}
    for path in whole:
        for contents in whole.values():
            path.write_bytes(contents)
            assert isinstance(answers(violated)[0], Reached) and isinstance(answers(proved)[0], Unreachable)


def test_no_bit_of_an_entry_may_be_changed_and_no_byte_left_out(folder: Path) -> None:
    cache.write("key", b"some code")
    path = folder / "key.o"
    whole = path.read_bytes()
    for at in range(len(whole)):
        for bit in range(8):
            path.write_bytes(whole[:at] + bytes([whole[at] ^ 1 << bit]) + whole[at + 1 :])
            assert cache.read("key") is None
        path.write_bytes(whole[:at])
        assert cache.read("key") is None
        path.write_bytes(whole[:at] + whole[at + 1 :])
        assert cache.read("key") is None
    path.write_bytes(whole)
    assert cache.read("key") == b"some code"


def test_where_a_name_ends_and_contents_begin_is_sealed() -> None:
    key = os.urandom(32)
    seal = cache.sealed("name", b"s of code", key)[:32]
    assert cache.opened("names", seal + b" of code", key) is None
    assert cache.opened("name", seal + b"s of code", key) == b"s of code"


def test_an_entry_of_an_older_rovercheck_or_another_processor_is_never_asked_for(
    monkeypatch: pytest.MonkeyPatch, folder: Path, compiled: list[object]
) -> None:
    """It is well sealed; but its name says by what it was made, and that name is sealed."""
    monkeypatch.setattr(fingerprint, "processor", lambda: "another one")
    fingerprint.compiler.cache_clear()
    answers(THIRD)
    old = {path.name: path.read_bytes() for path in folder.iterdir()}
    monkeypatch.undo()
    monkeypatch.setenv(cache.VARIABLE, str(folder))
    monkeypatch.setenv(cache.SECRET, str(folder.parent / "state" / "secret"))
    fingerprint.compiler.cache_clear()
    truth = answers(THIRD)
    for path in set(folder.iterdir()) - {folder / name for name in old}:
        for contents in old.values():
            path.write_bytes(contents)
            assert cache.read(path.stem) is None
    assert answers(THIRD) == truth


@posix
@pytest.mark.parametrize("what", ["link", "link to nothing", "pipe", "folder", "endless", "huge"])
def test_what_is_no_file_is_no_entry(what: str, folder: Path, tmp_path: Path) -> None:
    """Nothing is waited for, and nothing is read without end."""
    cache.write("key", b"code")
    path = folder / "key.o"
    path.rename(tmp_path / "moved")
    match what:
        case "link":
            path.symlink_to(tmp_path / "moved")
        case "link to nothing":
            path.symlink_to(tmp_path / "nothing")
        case "pipe":
            os.mkfifo(path)
        case "folder":
            path.mkdir()
        case "endless":
            path.symlink_to("/dev/zero")
        case "huge":
            with path.open("wb") as file:
                file.truncate(1 << 40)
    assert cache.read("key") is None
    cache.write("key", b"more")
    assert cache.read("key") == (None if what == "folder" else b"more")
    assert (tmp_path / "moved").read_bytes().endswith(b"code"), "nothing was written through the link"


# --- a folder from elsewhere -------------------------------------------------------------------------


def test_a_folder_brought_from_another_machine_is_empty_and_then_of_use(
    monkeypatch: pytest.MonkeyPatch, folder: Path, tmp_path: Path, compiled: list[object]
) -> None:
    truth = answers(THIRD)
    shutil.copytree(folder, tmp_path / "restored")
    monkeypatch.setenv(cache.VARIABLE, str(tmp_path / "restored"))
    assert answers(THIRD) == truth and len(compiled) == 2, "with its secret it is as good as here"
    monkeypatch.setenv(cache.SECRET, str(tmp_path / "elsewhere" / "secret"))
    said: list[object] = []
    with listening(said.append):
        assert answers(THIRD) == truth and len(compiled) == 4 and said == [], "quietly"
        assert answers(THIRD) == truth and len(compiled) == 4 and len(said) == 2


# --- the secret --------------------------------------------------------------------------------------


def test_the_secret_is_made_once_and_is_for_the_user_alone(folder: Path, secret: Path) -> None:
    assert cache.read("key") is None and not secret.exists(), "what only reads makes nothing"
    cache.write("key", b"code")
    made = secret.read_bytes()
    assert len(made) == 32 and len(set(made)) > 4
    if hasattr(os, "getuid"):
        assert secret.stat().st_mode & 0o777 == 0o600 and secret.parent.stat().st_mode & 0o777 == 0o700
    cache.write("other", b"code")
    assert secret.read_bytes() == made and list(secret.parent.iterdir()) == [secret]
    assert made not in b"".join(p.read_bytes() for p in folder.iterdir())


def test_two_processes_that_start_at_once_make_one_secret(folder: Path, secret: Path) -> None:
    script = (
        "import sys; from rovercheck.checker import cache\n"
        "sys.stdin.readline()\n"
        "cache.write(sys.argv[1], b'code'); print(cache.read(sys.argv[1]) == b'code')"
    )
    begun = [
        subprocess.Popen([sys.executable, "-c", script, f"key{n}"], stdin=subprocess.PIPE,
                         stdout=subprocess.PIPE, text=True)
        for n in range(6)
    ]  # fmt: skip
    for process in begun:
        assert process.stdin is not None
        process.stdin.write("\n")
        process.stdin.flush()
    assert [process.communicate(timeout=60)[0].strip() for process in begun] == ["True"] * 6
    assert [cache.read(f"key{n}") for n in range(6)] == [b"code"] * 6
    assert list(secret.parent.iterdir()) == [secret]


@pytest.mark.parametrize("links", [True, False])
def test_many_threads_make_one_secret(
    links: bool, monkeypatch: pytest.MonkeyPatch, tmp_path: Path, folder: Path
) -> None:
    def none(*_: object) -> None:
        raise OSError("no hard links here")

    if not links:
        monkeypatch.setattr(os, "link", none)
        cache.write("first", b"code")
    with ThreadPoolExecutor(8) as pool:
        list(pool.map(lambda n: cache.write(f"key{n}", b"code"), range(64)))
    assert [cache.read(f"key{n}") for n in range(64)] == [b"code"] * 64


@posix
@pytest.mark.parametrize("mode", [0o644, 0o640, 0o660, 0o602])
def test_a_secret_that_others_may_have_read_is_not_used(mode: int, secret: Path) -> None:
    cache.write("key", b"code")
    secret.chmod(mode)
    [why] = refusals()
    assert f"{secret}, can be read or written by others: delete it, and a new one is made." in why
    secret.unlink()
    cache.write("key", b"code")
    assert cache.read("key") == b"code"


@posix
@pytest.mark.parametrize("what", ["link", "short", "long", "empty", "folder", "pipe"])
def test_what_is_no_secret_is_not_used(what: str, secret: Path, tmp_path: Path) -> None:
    cache.write("key", b"code")
    secret.rename(tmp_path / "moved")
    match what:
        case "link":
            secret.symlink_to(tmp_path / "moved")
        case "short" | "long" | "empty":
            secret.touch(mode=0o600)
            secret.write_bytes(bytes({"short": 31, "long": 33, "empty": 0}[what]))
        case "folder":
            secret.mkdir(mode=0o700)
        case "pipe":
            os.mkfifo(secret, 0o600)
    [why] = refusals()
    assert str(secret) in why and "delete it" in why


@posix
def test_a_secret_of_another_user_is_not_used(monkeypatch: pytest.MonkeyPatch, secret: Path) -> None:
    cache.write("key", b"code")
    real, own = os.fstat, secret.stat().st_ino

    def of_another(handle: int) -> os.stat_result:
        found = list(real(handle))
        if found[1] == own:
            found[4] += 1
        return os.stat_result(found)

    monkeypatch.setattr(os, "fstat", of_another)
    [why] = refusals()
    assert "belongs to another user" in why


@posix
@pytest.mark.parametrize("which", ["secret", "cache"])
def test_folders_that_others_may_write_to_are_told(which: str, secret: Path, folder: Path) -> None:
    cache.write("key", b"code")
    wrong = secret.parent if which == "secret" else folder
    wrong.chmod(0o770)
    assert refusals() == [f"Others may write to the folder {wrong}: chmod go-w {wrong}"]
    wrong.chmod(0o700)
    assert cache.read("key") == b"code"


@pytest.mark.parametrize("inside", ["secret", "deeper/secret", "../cache/secret"])
def test_a_secret_inside_the_cache_would_be_restored_with_it(
    inside: str, monkeypatch: pytest.MonkeyPatch, folder: Path
) -> None:
    monkeypatch.setenv(cache.SECRET, str(folder / inside))
    [why] = refusals()
    assert "would be inside the cache" in why and not any(folder.rglob("*"))


def test_without_a_home_there_is_no_cache_and_no_failure(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, compiled: list[object]
) -> None:
    monkeypatch.delenv(cache.VARIABLE)
    monkeypatch.delenv(cache.SECRET)
    monkeypatch.chdir(tmp_path)
    for name in ("XDG_CACHE_HOME", "XDG_STATE_HOME", "LOCALAPPDATA", "APPDATA"):
        monkeypatch.delenv(name, raising=False)
    for home in ("", "~", "/", str(tmp_path / "nowhere"), "relative"):
        monkeypatch.setenv("HOME", home)
        monkeypatch.setenv("USERPROFILE", home)
        compiled.clear()
        assert isinstance(answers(THIRD)[0], Reached) and len(compiled) == 2
        assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("failing", ["mkstemp", "mkdir", "fsync"])
def test_a_home_that_may_only_be_read_means_no_cache_and_no_failure(
    failing: str, monkeypatch: pytest.MonkeyPatch, secret: Path, folder: Path
) -> None:
    def refused(*_: object, **__: object) -> None:
        raise PermissionError("read-only file system")

    owner = {
        "mkstemp": "rovercheck.checker.cache.secret_file.tempfile",
        "mkdir": "pathlib.Path",
        "fsync": "os",
    }[failing]
    monkeypatch.setattr(f"{owner}.{failing}", refused)
    said: list[object] = []
    with listening(said.append):
        assert isinstance(answers(THIRD)[0], Reached)
    [told] = said
    assert isinstance(told, CacheRefused) and "read-only file system" in told.why and not secret.exists()
    assert not folder.exists() or not any(folder.iterdir())


def test_switched_off_with_the_secret(
    monkeypatch: pytest.MonkeyPatch, folder: Path, compiled: list[object]
) -> None:
    monkeypatch.setenv(cache.SECRET, "")
    first: list[Answer] = answers(THIRD)
    assert answers(THIRD) == first and len(compiled) == 4
    assert not folder.exists() or not any(folder.iterdir())
