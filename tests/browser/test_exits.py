"""The exits of one violated property that people open in a browser: Chromium shows each of them."""

import re
from pathlib import Path

import pytest
from playwright.sync_api import Page

from tests.cli.test_trace_exits import written

WIDTHS = (1280, 390)


@pytest.mark.parametrize("name", ["html", "play", "svg", "sequence"])
def test_chromium_shows_it(name: str, page: Page, tmp_path: Path) -> None:
    """The page watches for errors and requests; nothing has to be moved sideways to be read."""
    page.goto(written(name, tmp_path).as_uri())
    said = page.locator(":root").text_content() or ""
    assert "PB1-15" in said and "B2_actuating" in said
    if name in ("html", "play"):
        for width in WIDTHS:
            page.set_viewport_size({"width": width, "height": 800})
            assert page.evaluate("document.documentElement.scrollWidth") <= width
        page.get_by_role("button", name=re.compile("^Last$")).click()
        assert "tick 8" in page.inner_text("body").lower()
    else:
        assert page.evaluate("document.documentElement.viewBox.baseVal.width > 100")
