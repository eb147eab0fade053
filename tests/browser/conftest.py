"""A headless Chromium for the tests of pages: console errors and network requests fail the test."""

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page

LOCAL = ("file:", "data:", "blob:", "about:")

Show = Callable[[str], Page]
"""Opens a document from a file, as a reader would, and returns the page."""


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
