"""A headless Chromium for the tests of pages: console errors and network requests fail the test."""

import os
import shutil
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page, sync_playwright

LOCAL = ("file:", "data:", "blob:", "about:")
NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome")
FLAGS = ("--no-sandbox", "--disable-gpu", "--disable-background-networking", "--disable-component-update")

Show = Callable[[str], Page]
"""Opens a document from a file, as a reader would, and returns the page."""


def chromium() -> str | None:
    """The browser to use, if any is installed: ``$CHROMIUM``, or the first of the usual names."""
    return os.environ.get("CHROMIUM") or next(filter(None, map(shutil.which, NAMES)), None)


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    """One browser for all tests."""
    program = chromium()
    if program is None:
        pytest.skip("No Chromium is installed: apt-get install chromium, or name one in $CHROMIUM.")
    with sync_playwright() as playwright:
        started = playwright.chromium.launch(executable_path=program, args=list(FLAGS))
        yield started
        started.close()


@pytest.fixture
def page(browser: Browser) -> Iterator[Page]:
    """An empty page, 1280 pixels wide; whatever goes wrong in it fails the test at its end."""
    wrong: list[str] = []
    context = browser.new_context(viewport={"width": 1280, "height": 900})
    context.set_default_timeout(10_000)
    opened = context.new_page()
    opened.on("console", lambda m: wrong.append(f"{m.type}: {m.text}") if m.type in LOUD else None)
    opened.on("pageerror", lambda error: wrong.append(f"uncaught: {error}"))
    opened.on("request", lambda r: None if r.url.startswith(LOCAL) else wrong.append(f"request: {r.url}"))
    yield opened
    context.close()
    assert wrong == []


LOUD = ("error", "warning")


@pytest.fixture
def show(page: Page, tmp_path: Path) -> Show:
    def shown(document: str) -> Page:
        file = tmp_path / "page.html"
        file.write_text(document, encoding="utf-8")
        page.goto(file.as_uri())
        return page

    return shown
