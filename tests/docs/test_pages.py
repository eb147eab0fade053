"""Every command and every listing of the documents does what the page says."""

import re
import shlex
import tomllib
from collections.abc import Iterator
from pathlib import Path

import click
import pytest

from docs.reference.kept import KEPT
from docs.reference.listings import Listing, listings
from rovercheck.checker.cli import app
from rovercheck.checker.model.load import load
from tests.docs.elsewhere import BEFORE, COMMANDS, GIVEN, PROGRAMS, SHOWN
from tests.docs.reader import Reader, differs, session, typed

ROOT = Path(__file__).parents[2]
MADE = set(KEPT)
"""Pages whose examples are executed while they are made."""
PAGES = [
    "README.md",
    "CONTRIBUTING.md",
    *sorted(p.relative_to(ROOT).as_posix() for p in (ROOT / "docs").rglob("*.md") if p not in MADE),
    *sorted(p.relative_to(ROOT).as_posix() for p in (ROOT / "examples").rglob("*.md")),
]
PROGRAM = re.compile(
    r"(?:\w+=\S+ )?(?:\.venv/bin/)?"
    r"(rovercheck|pytest|make|cd|cc|python3?|pip|mkdir|printf|dask|berkeley-abc|spin|nuXmv:)(?= |$)|\. "
)
OPEN = re.compile(
    r"\[[A-Z-]|\.\.\.|\w\|\w|(?<!\S)(?:ID|WHAT|CHART|SYSTEM|SCENARIO|SHELL|FILE|DIR|FOLDER)(?!\S)"
)
"""What makes a line the form of a command and no command: `[ID...]`, `WHAT`, `a|b`."""
GREEN, FINDINGS = 0, 1


@pytest.fixture(scope="session")
def cache(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("cache")


@pytest.fixture
def reader(tmp_path: Path, cache: Path, monkeypatch: pytest.MonkeyPatch) -> Reader:
    """Somebody with the examples at hand, whose compiled searches are kept for the next page."""
    monkeypatch.setenv("ROVERCHECK_CACHE", str(cache))
    (tmp_path / "examples").symlink_to(ROOT / "examples")
    return Reader(tmp_path)


@pytest.mark.parametrize("page", [page for page in PAGES if listings(ROOT / page)])
def test_what_a_page_shows_is_so(page: str, reader: Reader) -> None:
    for command in BEFORE.get(page, []):
        assert reader.type(command)[0] == GREEN
    for name, text in GIVEN.get(page, {}).items():
        (reader.folder / name).write_text(text, encoding="utf-8")
    for listing in listings(ROOT / page, page):
        _done(listing, reader)


def _done(listing: Listing, reader: Reader) -> None:
    """A listing, done as a reader does it.  One that nobody knows what to do with fails."""
    if listing.title:
        reader.write(listing)
    elif listing.text.startswith("$ "):
        for command, shown in typed(listing.text):
            _typed(command, shown, reader, str(listing))
    else:
        for part in re.split(r"\n\s*\n", listing.text):
            _part(listing, part, reader)


def _part(listing: Listing, part: str, reader: Reader) -> None:
    first = part.split("\n", 1)[0].strip()
    if PROGRAM.match(first):
        for command in commands(part):
            _typed(command, None, reader, str(listing))
    elif kind := PROGRAMS.get((listing.page, listing.first)):
        _program(kind, listing, reader)
    elif (listing.page, listing.first) not in SHOWN:
        assert tomllib.loads(part), f"{listing} is no command, no file, no program and in no table"


def _program(kind: str, listing: Listing, reader: Reader) -> None:
    source = compile(listing.text, str(listing), "exec")
    if kind == "imports":
        exec("\n".join(line for line in listing.text.splitlines() if line.startswith("from ")), {})
    elif kind == "model":
        file = reader.folder / "model.py"
        file.write_text(listing.text, encoding="utf-8")
        assert load(file).properties
    assert source


def commands(part: str) -> Iterator[str]:
    """The commands of a block without ``$``: without what is said beside them, and checked if only a form."""
    verb = ""
    for line in part.splitlines():
        said = re.split(r"\s{2,}|\s#\s", line.strip())[0]
        if PROGRAM.match(line):
            words = said.split()
            verb = words[1] if words[0] == "rovercheck" else ""
            if not OPEN.search(said) or said in COMMANDS:
                yield said
                continue
        assert verb and _known(verb, line), f"`{line.strip()}` is no command, nor an option of {verb}"


def _known(verb: str, line: str) -> bool:
    """Whether the options that a line names are those of the verb, or of the verbs that the line names."""
    verbs = {verb, *re.findall(r"[a-z]+", line)} & app.commands.keys()
    options = {
        o for v in verbs for p in app.commands[v].params if isinstance(p, click.Option) for o in p.opts
    }
    return set(re.findall(r"(?<![\w-])--[a-z0-9-]+", re.split(r"\s{2,}", f"{line.strip()}  ")[0])) <= options


def _typed(command: str, shown: str | None, reader: Reader, place: str) -> None:
    """A command, or what the table says instead, and what it prints."""
    instead = COMMANDS.get(command)
    asked = command if instead is None else instead.command
    if asked is None:
        _understood(command)
        return
    if shown and "explore" in asked and "--script" not in asked and session(shown):
        (reader.at / "typed.txt").write_text(session(shown), encoding="utf-8")
        asked += " --script typed.txt"
    code, printed = reader.type(asked)
    assert code in (GREEN, FINDINGS), f"{place}: `{asked}` ends with {code}: {printed}"
    if shown is not None and instead is None:
        assert not (told := differs(shown, printed)), f"{place}: `{asked}`: {told}"
    elif shown:
        verdicts = [line for line in printed.splitlines() if line[:1] in ("✓", "✗")]
        assert verdicts and set(verdicts) <= set(shown.splitlines()), f"{place}: `{asked}` prints {verdicts}"


def _understood(command: str) -> None:
    """A command that is not run: a verb with its options, or a target of the Makefile."""
    match shlex.split(command.partition(" && ")[0]):
        case ["rovercheck", verb, *rest]:
            above = click.Context(
                app, **app.context_settings
            )  # click keeps the first names of --help it sees
            with app.commands[verb].make_context(verb, rest, parent=above):
                pass
        case ["make", target]:
            assert re.search(rf"(?m)^{target}:", (ROOT / "Makefile").read_text(encoding="utf-8"))


def test_the_tables_name_only_what_a_page_shows() -> None:
    found = [block for page in PAGES for block in listings(ROOT / page, page)]
    written = "\n".join(block.text for block in found)
    assert [command for command in COMMANDS if command not in written] == []
    places = {(block.page, block.first) for block in found}
    assert {*SHOWN, *PROGRAMS} <= places
    assert {*BEFORE, *GIVEN} <= set(PAGES)
