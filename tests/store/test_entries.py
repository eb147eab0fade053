"""Ten thousand entries that nobody wrote: none is believed, and nothing crashes over one."""

import json
import os
import random
import shutil
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from rovercheck.checker.cache import entries
from rovercheck.checker.cache.secret_file import secret_place
from rovercheck.checker.certify.file import unpacked
from rovercheck.checker.certify.terms import Malformed
from rovercheck.checker.commands.check.unchanged import ToldModel, ToldProperty, ToldStore
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.commands.shared.told import ToldVerdict
from rovercheck.checker.results.gravity import Gravity
from rovercheck.checker.results.trace import NecessaryInputs, Needed
from rovercheck.checker.results.verdict import Exhausted, Proved, Run, StoredInvariant, StoredRun, Violated
from rovercheck.checker.store.verdict_json import Definite
from rovercheck.checker.store.verdicts import StoredVerdict, VerdictStore
from tests.store.lamps import ON, PROPERTIES, decided, lamp, of, store, told
from tests.store.test_forged import TRUTH

pytestmark = pytest.mark.usefixtures("no_child")
NAME = "ab" * 32 + "-verdict-json"
VERDICTS: tuple[Definite, ...] = (
    Proved(Exhausted(7, 20, 3, ("count", "beam"), True), "explicit", "what was shown"),
    Proved(StoredInvariant(12, 3), "pdr"),
    Violated(StoredRun(Run({"f": 1}, ({"go": 0}, {"go": 1}, {"go": 1})), 60, shortest=True), "bmc"),
    Violated(StoredRun(Run({}, ({"go": 0},) * 5), 100, loop=2, trapped=3), "bdd"),
)
JUNK: tuple[Any, ...] = (
    None, True, False, 0, -1, 1, 1e999, -1e999, float("nan"), 0.5, 10**30, -(10**30), 10**4000, "", "x",
    "proved",
    "\ud800", [], {}, [[]], [0], [1, 2, 3], {"a": 1}, [None], "\x00", [[10**9, {}]], [[1, {"go": 10**40}]],
)  # fmt: skip


@pytest.fixture
def kept(folder: Path) -> Iterator[VerdictStore]:
    assert not folder.exists()
    yield store()


def test_what_is_written_is_read(kept: VerdictStore) -> None:
    for verdict in VERDICTS:
        kept.write(NAME, verdict, ON, ("A", "B"))
        assert kept.read(NAME) == StoredVerdict(verdict, ON, ("A", "B"))
    needed = NecessaryInputs((Needed(3, "go", frozenset({0, 1})),), True, False)
    kept.write_necessary(NAME, needed)
    assert kept.necessary(NAME) == needed and kept.read(NAME) is None


# --- without the secret ------------------------------------------------------------------------------


def changed(whole: bytes, draw: random.Random) -> bytes:
    """Some bytes that are not those."""
    match draw.randrange(6):
        case 0:
            at = draw.randrange(len(whole))
            return whole[:at] + bytes([whole[at] ^ 1 << draw.randrange(8)]) + whole[at + 1 :]
        case 1:
            return whole[: draw.randrange(len(whole))]
        case 2:
            return whole + draw.randbytes(draw.randrange(1, 9))
        case 3:
            at = draw.randrange(len(whole))
            return whole[:at] + whole[at + 1 :]
        case 4:
            return draw.randbytes(draw.randrange(200))
        case _:
            return whole[:32] + json.dumps({"word": "proved", "because": {}}).encode()


def test_no_entry_of_thousands_that_were_changed_is_believed(kept: VerdictStore, folder: Path) -> None:
    draw = random.Random(7)
    for verdict in VERDICTS:
        kept.write(NAME, verdict, ON)
        file = folder / f"{NAME}.o"
        whole = file.read_bytes()
        for _ in range(2000):
            wrong = changed(whole, draw)
            file.write_bytes(wrong)
            assert wrong == whole or kept.read(NAME) is None
        file.write_bytes(whole)
        assert kept.read(NAME) is not None


def test_an_entry_under_the_name_of_another_one_is_missing(kept: VerdictStore, folder: Path) -> None:
    system = lamp()
    assert told(decided(system, kept)) == TRUTH
    files = sorted(folder.glob("*-verdict-json.o"))
    contents = {file: file.read_bytes() for file in files}
    assert len(files) >= 2 * len(PROPERTIES)
    for number, file in enumerate(files):
        file.write_bytes(contents[files[number - 1]])
    assert all(kept.read(file.stem) is None for file in files)
    assert told(decided(system, kept)) == TRUTH
    assert told(decided(system, kept, traces=True)) == TRUTH


@pytest.mark.parametrize("how", ["another's secret", "no secret", "a new secret", "zeros", "compiled code"])
def test_what_another_sealed_is_missing(how: str, kept: VerdictStore, folder: Path) -> None:
    kept.write(NAME, VERDICTS[0], ON)
    file = folder / f"{NAME}.o"
    contents = file.read_bytes()[32:]
    match how:
        case "another's secret":
            file.write_bytes(entries.sealed(NAME, contents, os.urandom(32)))
        case "no secret":
            secret_place().unlink()
        case "a new secret":
            secret_place().unlink()
            entries.write("cd" * 32 + "-verdict-json", b"{}")
        case "zeros":
            file.write_bytes(entries.sealed(NAME, contents, bytes(32)))
        case _:
            file.write_bytes(
                entries.sealed("ab" * 32 + "-search-quick", contents, secret_place().read_bytes())
            )
    assert kept.read(NAME) is None
    kept.write(NAME, VERDICTS[1], ON)
    assert kept.read(NAME) == StoredVerdict(VERDICTS[1], ON)


@pytest.mark.skipif(not hasattr(os, "getuid") or os.getuid() != 0, reason="only root can give files away")
def test_a_folder_of_another_user_is_not_read(kept: VerdictStore, folder: Path) -> None:
    kept.write(NAME, VERDICTS[0], ON)
    os.chown(folder, 12345, 12345)
    assert kept.read(NAME) is None
    kept.write(NAME, VERDICTS[1], ON)
    os.chown(folder, os.getuid(), os.getgid())
    assert kept.read(NAME) == StoredVerdict(VERDICTS[0], ON)


@pytest.mark.parametrize("what", ["folder", "link", "pipe", "large"])
def test_what_is_no_file_is_not_waited_for(what: str, kept: VerdictStore, folder: Path) -> None:
    kept.write(NAME, VERDICTS[0], ON)
    file = folder / f"{NAME}.o"
    whole = file.read_bytes()
    file.unlink()
    match what:
        case "folder":
            file.mkdir()
        case "link":
            (folder / "elsewhere").write_bytes(whole)
            file.symlink_to(folder / "elsewhere")
        case "pipe":
            os.mkfifo(file)
        case _:
            with file.open("wb") as large:
                large.truncate(entries.MOST_BYTES + 1)
    assert kept.read(NAME) is None
    assert told(decided(lamp(), kept)) == TRUTH
    kept.remove(NAME)
    if what == "folder":
        shutil.rmtree(file)
    kept.write(NAME, VERDICTS[0], ON)
    assert kept.read(NAME) == StoredVerdict(VERDICTS[0], ON)


# --- with the secret ---------------------------------------------------------------------------------


def spoiled(value: Any, draw: random.Random) -> Any:
    """The same JSON with another value somewhere in it."""
    if draw.randrange(4) == 0 or not isinstance(value, dict | list) or not value:
        return draw.choice(JUNK)
    if isinstance(value, list):
        at = draw.randrange(len(value))
        if draw.randrange(3) == 0:
            return value[:at] + value[at + 1 :]
        return [*value[:at], spoiled(value[at], draw), *value[at + 1 :]]
    key = draw.choice(sorted(value))
    if draw.randrange(4) == 0:
        return {k: v for k, v in value.items() if k != key}
    return {**value, key: spoiled(value[key], draw)}


def texts(whole: Any, draw: random.Random, number: int) -> Iterator[bytes]:
    """JSON of other shapes, and what is no JSON."""
    yield from (b"", b"null", b"[]", b"{}", b"0", b'"proved"', b"{", b"\xff\xfe", b"[" * 200_000, b"nan")
    yield b'{"a":' * 100_000
    yield b"9" * 10_000
    for _ in range(number):
        yield json.dumps(spoiled(whole, draw)).encode()


def test_sealed_entries_of_other_shapes_are_missing_or_have_a_meaning(
    kept: VerdictStore, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    contents: dict[str, bytes] = {}
    monkeypatch.setattr(entries, "read", lambda name, code: contents[name])
    draw, accepted = random.Random(11), list[StoredVerdict]()
    for verdict in VERDICTS:
        kept.write(NAME, verdict, ON, ("A",))
        whole = json.loads((folder / f"{NAME}.o").read_bytes()[32:])
        for text in texts(whole, draw, 700):
            contents[NAME] = text
            found = kept.read(NAME)
            if found is not None:
                accepted.append(found)
    assert accepted, "a name that is another text has a meaning"
    for one in accepted:
        assert isinstance(one.verdict, Proved | Violated) and isinstance(one.system, str)
        match one.verdict.because:
            case Exhausted(states, tried, depth, names):
                assert min(states, tried, depth) >= 0 and all(isinstance(name, str) for name in names)
            case StoredInvariant(count, ticks):
                assert min(count, ticks) >= 0
            case StoredRun(run, ms, loop, trapped, shortest):
                assert ms >= 0 and isinstance(shortest, bool)
                assert 0 <= (loop or 0) <= len(run) and 0 <= (trapped or 0) <= len(run)
            case other:
                raise AssertionError(other)


def test_nothing_crashes_over_what_has_a_meaning(kept: VerdictStore, folder: Path) -> None:
    """Under the name of a question: replayed, or told as it is."""
    draw, system = random.Random(13), lamp()
    for id in ("lit-violated", "count-proved", "lit-proved"):
        decided(system, kept, [of(id)])
        name = kept.question(of(id), {ON: system})
        assert name is not None
        whole = json.loads((folder / f"{name}.o").read_bytes()[32:])
        for _ in range(60):
            entries.write(name, json.dumps(spoiled(whole, draw)).encode())
            [plain] = decided(system, kept, [of(id)])
            assert plain.verdict.word in ("proved", "violated")
            entries.write(name, json.dumps(spoiled(whole, draw)).encode())
            [again] = decided(system, replace(kept, recheck=True), [of(id)], traces=True)
            assert again.verdict.word == TRUTH[id][0]


def test_necessary_inputs_of_other_shapes_are_missing(kept: VerdictStore, folder: Path) -> None:
    draw = random.Random(17)
    kept.write_necessary(NAME, NecessaryInputs((Needed(3, "go", frozenset({0, 1})),), True, False))
    whole = json.loads((folder / f"{NAME}.o").read_bytes()[32:])
    for text in texts(whole, draw, 500):
        entries.write(NAME, text)
        found = kept.necessary(NAME)
        assert found is None or all(isinstance(one.number, int) for one in found.needed)


def test_certificates_of_other_shapes_are_malformed() -> None:
    draw = random.Random(19)
    for text in (*texts({"a": 1}, draw, 20), *(draw.randbytes(50) for _ in range(200))):
        with pytest.raises(Malformed):
            unpacked(text)


# --- what was told of the rover ----------------------------------------------------------------------

TOLD = ToldVerdict(
    "P", "Text.", ("R",), False, "relay", "relay", "violated", False, "bmc", "after 2 ticks", "a run", 2,
    "violated", "violated", "", True, Exit.AS_EXPECTED, Exit.AS_EXPECTED,
    Gravity(0, 1, 2, (False, -1, 2, "P")),
    "H-1", "critical, H-1: It breaks.", "critical", "It breaks.", "It breaks.", "2026-11-21",
    {"state": "open", "because": "", "owner": "", "on": None, "until": None}, "",
)  # fmt: skip
MODEL = ToldModel({"P": ToldProperty("relay", False)}, ["relay"], {"P": TOLD})


@pytest.fixture
def said(folder: Path, monkeypatch: pytest.MonkeyPatch) -> ToldStore:
    from rovercheck.checker.commands.check import unchanged

    monkeypatch.setattr(unchanged, "tree_key", lambda: "tree")
    return ToldStore("tree", "ef" * 32 + "-told-json")


def test_what_was_told_is_read_again(said: ToldStore) -> None:
    said.add(MODEL)
    assert said.read() == MODEL


def test_what_was_told_in_other_shapes_is_missing_or_can_be_told(said: ToldStore, folder: Path) -> None:
    from rovercheck.checker.commands.check.document import document
    from rovercheck.checker.commands.check.text import line
    from rovercheck.checker.commands.shared.options import SelectionOptions

    said.add(MODEL)
    whole = json.loads((folder / f"{said.name}.o").read_bytes()[32:])
    draw, accepted = random.Random(23), 0
    for text in texts(whole, draw, 1500):
        entries.write(said.name, text)
        found = said.read()
        if found is None:
            continue
        accepted += 1
        for chosen in (SelectionOptions(), SelectionOptions(("P",)), SelectionOptions((), ("relay",))):
            for one in found.chosen(chosen) or ():
                assert isinstance(line(one), str) and isinstance(one.exit, Exit)
                json.dumps(document([one], chains=(), faulty=False))
    assert accepted
