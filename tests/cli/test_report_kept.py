"""What a review page keeps between commands, and the commit that its cover names."""

import subprocess
from dataclasses import dataclass
from pathlib import Path

import pytest

from rovercheck.checker.cache import entries
from rovercheck.checker.commands.report.kept_parts import NOT_KEPT, PageParts
from rovercheck.checker.commands.shared.revisions import commit_of
from rovercheck.checker.store.verdicts import VerdictStore
from rovercheck.spec_model.rover import systems


@pytest.fixture(autouse=True)
def own_cache(tmp_path_factory: pytest.TempPathFactory, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ROVERCHECK_CACHE", str(tmp_path_factory.mktemp("cache")))


@dataclass(frozen=True)
class Part:
    """A part of a page."""

    text: str


class Maker:
    """Makes parts, and counts them."""

    def __init__(self) -> None:
        self.made = 0

    def __call__(self) -> Part:
        self.made += 1
        return Part(f"the {self.made}th")


def lasting(_: Part) -> bool:
    return True


def test_a_part_is_made_once_for_the_same_question() -> None:
    parts, make, relay = PageParts(VerdictStore("auto kept")), Maker(), systems()["relay"]
    first = parts.made(Part, make, lasting, relay, "A-1")
    assert parts.made(Part, make, lasting, relay, "A-1") == first and make.made == 1
    assert parts.made(Part, make, lasting, relay, "A-2") != first
    assert parts.made(Part, make, lasting, systems()["safety"], "A-1") != first and make.made == 3


def test_what_would_be_other_again_and_what_nobody_keeps_is_made_each_time() -> None:
    parts, make = PageParts(VerdictStore("auto fleeting")), Maker()
    for _ in range(2):
        parts.made(Part, make, lambda _: False, "A-1")
        NOT_KEPT.made(Part, make, lasting, "A-1")
    assert make.made == 4


def test_an_entry_without_a_meaning_is_made_anew() -> None:
    parts, make = PageParts(VerdictStore("auto broken")), Maker()
    parts.made(Part, make, lasting, "A-1")
    name = parts._name("Part", ("A-1",))
    assert name is not None
    for contents in (b"", b"no pickle", b"\x80\x04N."):
        entries.write(name, contents)
        assert parts.made(Part, make, lasting, "A-1").text == f"the {make.made}th"
    assert make.made == 4


def git(folder: Path, *words: str) -> None:
    name = "-c", "user.name=A", "-c", "user.email=a@example.org"
    subprocess.run(["git", "-C", str(folder), *name, *words], check=True, capture_output=True)


def test_the_commit_of_a_model_is_named_and_that_it_has_changed(tmp_path: Path) -> None:
    model, other = tmp_path / "door.py", tmp_path / "other.py"
    for file in (model, other):
        file.write_text("x = 1\n", encoding="utf-8")
    assert commit_of(model) == ""
    git(tmp_path, "init", "-q")
    git(tmp_path, "add", "door.py")
    git(tmp_path, "commit", "-q", "-m", "A door.")
    name = commit_of(model)
    assert len(name) >= 10 and set(name) <= set("0123456789abcdef")
    assert commit_of(other) == "", "a file that git does not keep has no commit"
    model.write_text("x = 2\n", encoding="utf-8")
    assert commit_of(model) == f"{name}, with changes that are not committed"
