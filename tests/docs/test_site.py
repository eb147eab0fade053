"""The documentation site: it is built without a warning, fetches nothing, and its reference lacks no word."""

import inspect
import os
import re
import warnings
from hashlib import sha256
from operator import attrgetter
from pathlib import Path
from types import ModuleType
from unittest.mock import patch

import pytest
from mkdocs.commands.build import build
from mkdocs.config import load_config
from playwright.sync_api import Page

from docs.reference import forms, language
from docs.reference.listings import applied, listings
from rovercheck.checker.cli import app
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.spec_model.lang.errors import ModelError

ROOT = Path(__file__).parents[2]
FETCHES = re.compile(
    r'<(?:script|img|iframe|source)[^>]*src="(?:https?:)?//|<link[^>]*rel="?stylesheet"?[^>]*href="(?:https?:)?//'
)


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Built as ``make docs`` does, in a process that has read the rover for other tests already."""
    folder = tmp_path_factory.mktemp("site")
    with warnings.catch_warnings(), patch.dict(os.environ, NO_MKDOCS_2_WARNING="1"):
        warnings.simplefilter("ignore")  # of the libraries of MkDocs about each other
        config = load_config(str(ROOT / "mkdocs.yml"), site_dir=str(folder), strict=True)
        build(config)  # raises Abort after a warning of its own
    return folder


def test_every_page_is_there_and_fetches_nothing(site: Path) -> None:
    pages = {p.relative_to(site).as_posix(): p.read_text(encoding="utf-8") for p in site.rglob("*.html")}
    written = {
        p.relative_to(ROOT / "docs").with_suffix(".html").as_posix() for p in (ROOT / "docs").rglob("*.md")
    }
    assert written | {
        "reference/language.html",
        "reference/properties.html",
        "reference/commands.html",
    } <= set(pages)
    assert "project/CONTRIBUTING.html" in pages
    assert [name for name, text in pages.items() if FETCHES.search(text)] == []
    assert [name for name, text in pages.items() if "```" in text] == [], (
        "a listing is no listing on the site"
    )


def test_pictures_are_drawn_from_the_charts(site: Path) -> None:
    first, last = (
        (site / "pictures" / f"{n}.svg").read_text(encoding="utf-8") for n in ("pump", "pump-repaired")
    )
    assert "Pumping" in first and "Pumping" in last and first != last


def test_files_beside_the_documents_are_on_the_site(site: Path) -> None:
    workflow = "examples/ci/github-actions.yml"
    assert (site / "project" / workflow).read_bytes() == (ROOT / workflow).read_bytes()
    assert f'href="project/{workflow}"' in (site / "ci.html").read_text(encoding="utf-8")


def test_in_a_browser_from_the_disk_it_is_searched_and_fits_a_phone(site: Path, page: Page) -> None:
    page.goto((site / "index.html").as_uri())
    page.get_by_placeholder("Search").fill("counterexample")
    page.locator(".md-search-result__link", has_text="Read the counterexample").first.click()
    page.wait_for_url("**/tutorial.html*")
    page.set_viewport_size({"width": 390, "height": 800})
    for name in ("tutorial", "verdicts", "reference/language", "reference/commands", "simulate"):
        page.goto((site / f"{name}.html").as_uri())
        assert page.evaluate("document.documentElement.scrollWidth") == 390


def test_code_in_tables_shows_no_backslash(site: Path) -> None:
    assert "<code>|x@0|</code>" in (site / "certificates.html").read_text(encoding="utf-8")
    assert "bitwuzla|enumeration|both" in (site / "reference" / "commands.html").read_text(encoding="utf-8")


def test_the_script_of_others_is_the_one_it_says_it_is() -> None:
    folder = ROOT / "docs/reference/vendor/iframe-worker"
    version = (folder / "VERSION.txt").read_text(encoding="utf-8")
    assert sha256((folder / "shim.js").read_bytes()).hexdigest() in version
    assert "Permission is hereby granted" in (folder / "LICENSE.txt").read_text(encoding="utf-8")


def public(module: ModuleType) -> set[str]:
    """What a module defines for others, values as well as functions and classes."""
    tree = {n for n in vars(module) if not n.startswith("_") and not inspect.ismodule(getattr(module, n))}
    assigned = set(re.findall(r"(?m)^([A-Za-z]\w*)(?:: [^=\n]+)? = ", inspect.getsource(module)))
    return {n for n in tree if getattr(getattr(module, n), "__module__", "") == module.__name__} | (
        tree & assigned
    )


@pytest.mark.parametrize("name", language.MODULES)
def test_no_word_is_missing_from_the_reference(name: str) -> None:
    shown = {
        w
        for section in language.TABLE["section"]
        if section["module"] == name
        for w in section["words"]
        if "." not in w
    }
    hidden = set(language.TABLE["not_written"][name])
    assert not shown & hidden
    assert shown | hidden == public(language.module(name))


def test_every_word_has_a_text() -> None:
    for section in language.TABLE["section"]:
        for name, entry in section["words"].items():
            assert language.said(attrgetter(name)(language.module(section["module"])), entry), name


def test_every_form_is_in_the_reference() -> None:
    assert set(language.TABLE["forms"]) == set(forms.builders())
    page = forms.page()
    assert "Whenever fault becomes true, then in that step and each of the next 150" in page


def test_an_example_without_meaning_is_refused() -> None:
    with pytest.raises(ModelError):
        language.example('level == const(20, "°C")', language.words())


def test_the_label_of_an_example_is_shown() -> None:
    assert "On a transition: `duration(level > 80) >= 3 s`" in language.page()


def test_every_verb_and_option_is_in_the_reference(site: Path) -> None:
    page = (site / "reference" / "commands.html").read_text(encoding="utf-8")
    assert [verb for verb in app.commands if f'id="{verb}"' not in page] == []
    options = {o for verb in app.commands.values() for p in verb.params for o in p.opts if o.startswith("--")}
    assert [option for option in options if option not in page] == []


def test_every_exit_code_is_in_the_reference() -> None:
    page = (ROOT / "docs/reference/exit-codes.md").read_text(encoding="utf-8")
    assert [int(code) for code in Exit] == [int(n) for n in re.findall(r"(?m)^\| (\d+) \|", page)]


def test_listings_are_found_and_changes_fit(tmp_path: Path) -> None:
    page = tmp_path / "page.md"
    page.write_text(
        'Text\n\n    $ one\n    two\n\n- item\n\n    no listing\n\n```diff title="a.txt"\n-b\n+c\n```\n',
        encoding="utf-8",
    )
    assert [(b.line, b.language, b.title, b.text) for b in listings(page)] == [
        (3, "", "", "$ one\ntwo"),
        (10, "diff", "a.txt", "-b\n+c"),
    ]
    assert applied("a\nb\n", "-b\n+c") == "a\nc\n"
    with pytest.raises(ValueError, match="has 2 times"):
        applied("b\nb\n", "-b\n+c")
