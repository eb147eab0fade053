"""What the package says of itself, and what it carries for whoever has nothing else of it."""

import re
import zipfile
from email.message import Message
from email.parser import Parser
from pathlib import Path

import pytest

from rovercheck.checker.extras import EXTRAS
from tests.packaging.builds import ROOT, project, run_in


@pytest.fixture(scope="module")
def metadata(wheel: Path) -> Message:
    """The file METADATA of the wheel."""
    with zipfile.ZipFile(wheel) as files:
        [name] = (n for n in files.namelist() if n.endswith(".dist-info/METADATA"))
        return Parser().parsestr(files.read(name).decode())


def test_it_says_what_it_is_and_leaves_out_what_nobody_has_decided(metadata: Message) -> None:
    assert metadata["Summary"] and metadata["Keywords"] and metadata["Requires-Python"] == ">=3.11"
    assert metadata["Description-Content-Type"] == "text/markdown"
    assert set(metadata.get_all("Provides-Extra", [])) == {*EXTRAS, "all"}
    undecided = ("License", "License-Expression", "License-File", "Author", "Author-email", "Project-URL")
    assert [name for name in (*undecided, "Home-page") if name in metadata] == []
    assert not any(one.startswith("License ::") for one in metadata.get_all("Classifier", []))
    assert "the licence is the owner's to choose" in (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")


def test_it_names_the_kinds_that_an_index_knows(metadata: Message) -> None:
    from trove_classifiers import classifiers

    named = metadata.get_all("Classifier", [])
    assert named and set(named) <= classifiers
    assert "Typing :: Typed" in named


def test_it_carries_its_types_and_every_page(wheel: Path) -> None:
    with zipfile.ZipFile(wheel) as files:
        names = files.namelist()
        assert "rovercheck/py.typed" in names
        for page in run_in(ROOT, "git", "ls-files", "docs/*.md").split():
            assert files.read(f"rovercheck/{page}") == (ROOT / page).read_bytes()
    assert [n for n in names if n.startswith("rovercheck/docs/") and not n.endswith((".md", ".svg"))] == []


def test_the_pages_are_shown_from_the_installation(core: Path, tmp_path: Path) -> None:
    command = (str(core), "-m", "rovercheck", "docs")
    folder = Path(run_in(tmp_path, *command, "--path").strip())
    assert ROOT not in folder.parents and core.parent.parent in folder.parents
    listed = [line.split()[0] for line in run_in(tmp_path, *command).splitlines()[1:]]
    pages = {p.relative_to(ROOT / "docs").with_suffix("").as_posix() for p in (ROOT / "docs").rglob("*.md")}
    assert listed[0] == "index" and set(listed) == pages
    assert run_in(tmp_path, *command, "installation") == (ROOT / "docs/installation.md").read_text()
    told = run_in(tmp_path, *command, "installation", "--open", code=4)
    assert "No site is built" in told and "make docs" in told


def test_nothing_asks_an_index_for_what_it_does_not_have() -> None:
    """rovercheck is on none: whoever types such a line, or whose CI does, gets an error, or another's."""
    known = {*EXTRAS, "all"}
    wrong = []
    for file in run_in(ROOT, "git", "ls-files").split():
        path = ROOT / file
        if path.is_symlink() or path.suffix not in {".md", ".py", ".toml", ".yml", ".yaml", ".json", ""}:
            continue
        if path == Path(__file__):
            continue
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            wrong += [f"{file}:{number}: {word}" for word in _invented(line, known)]
    assert wrong == []


def _invented(line: str, extras: set[str]) -> list[str]:
    """What a line takes from an index or a server that has it not."""
    found = []
    if asked := re.search(r"\bpip3? install ((?:[^\s`]+ ?)+)", line):
        words = [w.strip("`'\"(),.;:") for w in asked[1].split()]
        for word in words:
            named = re.fullmatch(r"rovercheck(?:\[([^\]]*)\]?)?([=<>!~].*)?", word)
            if named and (named[2] or not named[1] or not _known(named[1], extras)):
                found.append(word)
    used = re.match(r"\s*(?:- )?uses: (\S+)", line)
    official = ("actions/", "github/", "./")
    if used and not used[1].startswith(official):
        found.append(used[1])
    found += re.findall(r"\brev: v[\d.]+|\brovercheck@\S+|\brovercheck:\d\S*|\bexample\.org/\S*", line)
    return found


def _known(named: str, extras: set[str]) -> bool:
    """Whether these are extras, or a place in a text where some are put in."""
    return set(named.split(",")) <= extras or bool(re.fullmatch(r"\$\w+|\{[\w.]+\}|\$EXTRAS", named))


@pytest.mark.parametrize(
    "line",
    [
        "pip install rovercheck",
        "run: python -m pip install --quiet rovercheck # from your package index",
        "`pip install 'rovercheck==0.1.0'`",
        "pip install 'rovercheck[plots]'",
        "    rev: v0.1.0",
        "- uses: rovercheck/action@v1",
        "image: rovercheck:1.0",
    ],
)
def test_such_a_line_is_noticed(line: str) -> None:
    assert _invented(line, {*EXTRAS, "all"})


def test_the_version_is_in_one_place() -> None:
    version = re.escape(str(project()["version"]))
    for place in ("action.yml", "Dockerfile", "examples/ci", "docs/installation.md"):
        top = ROOT / place
        for file in top.iterdir() if top.is_dir() else [top]:
            assert not re.search(rf"rovercheck\W+v?{version}", file.read_text(encoding="utf-8"))
