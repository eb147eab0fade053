"""The documentation in the terminal: laid out and paged for people, as it is written for programs."""

import sys
import webbrowser
from pathlib import Path

import pytest

from rovercheck.checker.cli import run
from rovercheck.checker.commands.docs import run as module
from rovercheck.checker.commands.docs.run import installed, pages, title
from rovercheck.checker.commands.shared.codes import Exit, UsageError
from tests.cli.terminal import Terminal

ROOT = Path(__file__).parents[2]
DOCS = (sys.executable, "-m", "rovercheck", "docs")


def test_every_page_is_listed_with_its_heading(capfd: pytest.CaptureFixture[str]) -> None:
    assert run(["docs"]) is Exit.AS_EXPECTED
    listed = dict(line.split(maxsplit=1) for line in capfd.readouterr().out.splitlines()[1:])
    known = pages(ROOT / "docs")
    assert listed == {name: title(file) for name, file in known.items()}
    assert next(iter(listed)) == "index" and all(listed.values())


@pytest.mark.parametrize("name", ["ci", "ci.md", "docs/ci.md", "ci.md#as-tests-of-pytest"])
def test_a_page_is_named_as_others_link_to_it(name: str, capfd: pytest.CaptureFixture[str]) -> None:
    assert run(["docs", name]) is Exit.AS_EXPECTED
    assert capfd.readouterr().out == (ROOT / "docs" / "ci.md").read_text(encoding="utf-8")


def test_a_page_of_the_reference_needs_no_folder_where_one_is_meant(
    capfd: pytest.CaptureFixture[str],
) -> None:
    assert run(["docs", "language", "--path"]) is Exit.AS_EXPECTED
    assert Path(capfd.readouterr().out.strip()) == ROOT / "docs" / "reference" / "language.md"
    assert run(["docs", "commands", "--path"]) is Exit.AS_EXPECTED, "two are called so"
    assert Path(capfd.readouterr().out.strip()) == ROOT / "docs" / "commands.md"


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["tutorail"], "Did you mean 'tutorial'?"),
        (["../README"], "There is no page '../README'."),
        (["/etc/passwd"], "There is no page '/etc/passwd'."),
        ([""], "There is no page ''."),
        (["ci", "--open", "--path"], "exclude each other"),
    ],
)
def test_a_page_that_there_is_not_is_told(
    arguments: list[str], said: str, capfd: pytest.CaptureFixture[str]
) -> None:
    assert run(["docs", *arguments]) is Exit.USAGE
    assert said in capfd.readouterr().err


@pytest.fixture
def site(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A clone whose site is built."""
    for name in ("docs/index.md", "docs/ci.md", "site/index.html", "site/ci.html"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text("# A page\n")
    monkeypatch.setattr(module, "installed", lambda: tmp_path / "docs")
    return tmp_path / "site"


@pytest.mark.parametrize(("arguments", "name"), [([], "index.html"), (["ci"], "ci.html")])
def test_the_site_is_opened_where_it_is_built(
    arguments: list[str], name: str, site: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    opened: list[str] = []
    monkeypatch.setattr(webbrowser, "open", lambda url: not opened.append(url))  # type: ignore[func-returns-value]
    assert run(["docs", *arguments, "--open"]) is Exit.AS_EXPECTED
    assert opened == [(site / name).as_uri()]


def test_without_a_browser_or_a_site_it_says_where_the_page_is_or_how_to_get_it(
    site: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(webbrowser, "open", lambda url: False)
    assert run(["docs", "ci", "--open"]) is Exit.USAGE
    assert "No browser is found." in capfd.readouterr().err
    (site / "ci.html").unlink()
    assert run(["docs", "ci", "--open"]) is Exit.USAGE
    assert "`make docs` builds it" in " ".join(capfd.readouterr().err.split())


def test_an_installation_without_pages_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "__file__", str(tmp_path / "a" / "b" / "c" / "run.py"))
    with pytest.raises(UsageError, match="not where they belong"):
        installed()


def test_on_a_terminal_a_short_page_is_laid_out() -> None:
    with Terminal([*DOCS, "exit-codes"], columns=72, lines=60) as terminal:
        assert terminal.ended() == Exit.AS_EXPECTED
        shown = terminal.shown()
    assert max(map(len, shown)) <= 72
    assert "# Exit codes" not in shown and any("Exit codes" in line for line in shown)
    assert not any(line.startswith("|---") for line in shown), "a table is one"


def test_on_a_terminal_a_long_page_is_paged(tmp_path: Path) -> None:
    pager = tmp_path / "pager"
    pager.write_text("#!/bin/sh\necho PAGED\nexec cat\n")
    pager.chmod(0o755)
    with Terminal([*DOCS, "ci"], lines=20, environment={"PAGER": str(pager)}) as terminal:
        terminal.until("PAGED")
        assert terminal.ended() == Exit.AS_EXPECTED
        shown = " ".join(" ".join(terminal.shown()).split())
    assert "In continuous integration" in shown and "ends, and compiles anew the next time" in shown
