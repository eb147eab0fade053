"""The policy of a page in a real browser: our scripts run, those in a text of a model do not."""

from markupsafe import Markup, escape
from playwright.sync_api import Page

from rovercheck.checker.render.page import Part, data, page

COUNTS = """'use strict';
const found = JSON.parse(document.querySelector('script.numbers').textContent);
document.querySelector('.sum').textContent = found.text + found.values.reduce((a, b) => a + b, 0);
"""
ATTACK = "document.title='broken into'"
EVIL = f'</script><img src=x onerror="{ATTACK}"><script>{ATTACK}</script>'


def test_our_scripts_run_and_read_their_data(show) -> None:
    part = Part(
        Markup('<p class="sum"></p>') + data({"text": EVIL, "values": [1, 2]}, "numbers"), (), (COUNTS,)
    )
    opened: Page = show(page(f"sums {EVIL}", [part, Part(escape(EVIL))]))
    assert opened.locator(".sum").inner_text() == f"{EVIL}3"
    assert opened.title() == f"sums {EVIL}"
    assert opened.locator("img").count() == 0


def test_a_script_that_was_not_named_does_not_run(browser, tmp_path) -> None:
    body = Markup(f'<script>{ATTACK}</script><p onclick="{ATTACK}">text</p>')
    file = tmp_path / "page.html"
    file.write_text(page("safe", [Part(body, (), (COUNTS.replace("found", "other"),))]), encoding="utf-8")
    context = browser.new_context()
    opened = context.new_page()
    refused: list[str] = []
    opened.on("console", lambda message: refused.append(message.text))
    opened.goto(file.as_uri())
    opened.locator("p").click()
    assert opened.title() == "safe"
    assert sum("Content Security Policy" in text for text in refused) >= 2
    context.close()
