"""Links of every document lead somewhere where files are read: on the disk, or on a repository's page."""

import re
from collections import Counter
from collections.abc import Iterator
from difflib import unified_diff
from functools import cache
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote

import markdown
import pytest

from docs.reference.kept import KEPT, stale
from rovercheck.checker.cli import app

ROOT = Path(__file__).parents[2]
BUILT = {"site", "build", "dist", "node_modules"}
PAGES = sorted(
    place.relative_to(ROOT).as_posix()
    for place in ROOT.rglob("*.md")
    if not any(part.startswith(".") or part in BUILT for part in place.relative_to(ROOT).parts)
)
ELSEWHERE = re.compile(r"[a-z][a-z0-9+.-]*:|//")
HEADING = re.compile(r"h[1-6]")


class Document(HTMLParser):
    """What a page links to, and the anchors of its headings, as the web pages of repositories name them."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.targets: list[str] = []
        self.anchors: set[str] = set()
        self._heading: list[str] | None = None
        self._taken: Counter[str] = Counter()
        self.feed(markdown.markdown(text, extensions=["tables", "pymdownx.superfences"]))

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        found = dict(attributes)
        self.targets += [value for name in ("href", "src") if (value := found.get(name))]
        self.anchors |= {value for name in ("id", "name") if (value := found.get(name))}
        if HEADING.fullmatch(tag):
            self._heading = []

    def handle_data(self, data: str) -> None:
        if self._heading is not None:
            self._heading.append(data)

    def handle_endtag(self, tag: str) -> None:
        if self._heading is not None and HEADING.fullmatch(tag):
            words = re.sub(r"[^\w\- ]", "", "".join(self._heading).strip().lower()).replace(" ", "-")
            self.anchors.add(f"{words}-{self._taken[words]}" if self._taken[words] else words)
            self._taken[words] += 1
            self._heading = None


@cache
def document(place: Path) -> Document:
    return Document(place.read_text(encoding="utf-8"))


def broken(page: str) -> Iterator[str]:
    """The links of a page that lead nowhere."""
    place = ROOT / page
    for link in document(place).targets:
        if ELSEWHERE.match(link):
            continue
        path, _, anchor = unquote(link).partition("#")
        target = place.parent / path if path else place
        inside = target.exists() and target.resolve().is_relative_to(ROOT)
        heading = not anchor or target.suffix != ".md" or (inside and anchor in document(target).anchors)
        if not (inside and heading):
            yield link


@pytest.mark.parametrize("page", PAGES)
def test_every_link_leads_to_a_file_and_a_heading(page: str) -> None:
    assert list(broken(page)) == []


def test_a_link_that_leads_nowhere_is_seen(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("tests.docs.test_links.ROOT", tmp_path)
    (tmp_path / "there.md").write_text("# Some `words`\n\n## Twice\n\n## Twice\n", encoding="utf-8")
    links = ["there.md", "there.md#some-words", "there.md#twice-1", "https://a.b/c", "#here"]
    wrong = ["gone.md", "there.md#gone", "there.md#Twice", "../beside.md", "picture.svg"]
    text = "# Here\n\n" + "\n".join(f"[a]({link})" for link in [*links, *wrong[:-1]])
    code = "\n\n    [a](code.md)\n\n```\n[a](fence.md)\n```\n\n`[a](inline.md)` ![p](picture.svg)\n"
    (tmp_path / "page.md").write_text(text + code, encoding="utf-8")
    assert list(broken("page.md")) == wrong


def test_what_is_generated_and_kept_is_as_the_sources_are_today(monkeypatch: pytest.MonkeyPatch) -> None:
    for verb in app.commands.values():  # click remembers the first help option that was asked of a verb alone
        monkeypatch.setattr(verb, "_help_option", None)
    for file, content in stale():
        kept = file.read_text(encoding="utf-8").splitlines()
        changes = "\n".join(unified_diff(kept, content.splitlines(), "kept", "generated", n=0, lineterm=""))
        raise AssertionError(f"{file}: run `make docs` and commit\n{changes}")
    assert all(file.is_file() for file in KEPT)


def test_the_readme_leads_to_the_documentation_near_its_top() -> None:
    top = (ROOT / "README.md").read_text(encoding="utf-8").partition("\n    $ make check\n")[0]
    assert {"docs/tutorial.md", "docs/index.md", "docs/compare.md"} <= set(Document(top).targets)
    assert len(top.splitlines()) < 25


def test_every_page_of_the_documentation_is_reached_from_the_readme() -> None:
    seen, todo = set[Path](), [ROOT / "README.md"]
    while todo:
        place = todo.pop()
        seen.add(place)
        links = (
            place.parent / link.partition("#")[0]
            for link in document(place).targets
            if not ELSEWHERE.match(link)
        )
        todo += {p.resolve() for p in links if p.suffix == ".md" and p.exists()} - seen
    assert [p for p in PAGES if p.startswith("docs/") and ROOT / p not in seen] == []
