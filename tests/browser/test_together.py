"""A run over time and on its charts on one page: a tick that is chosen in one is shown in the other."""

import pytest
from playwright.sync_api import Page

from rovercheck.checker.render import player, timeline, trace_html
from rovercheck.checker.render.page import page as whole
from tests.browser.conftest import Show
from tests.browser.test_player import long, where


@pytest.fixture
def opened(show: Show) -> Page:
    return show(trace_html.render(long()))


def now(page: Page) -> str:
    return " ".join(page.locator(".tl-now").inner_text().split())


def test_the_player_follows_the_cursor_and_the_cursor_the_player(opened: Page) -> None:
    opened.locator(".tl-frame").focus()
    for key in ("Home", "ArrowRight", "ArrowRight", "ArrowRight"):
        opened.keyboard.press(key)
    opened.locator(".player").scroll_into_view_if_needed()
    assert opened.locator(".player-ready").count() == 1, "built when it is seen, and where the cursor is"
    assert where(opened) == "Tick 4 of 10 · 80 ms"
    opened.locator(".player").focus()
    opened.keyboard.press("ArrowRight")
    assert where(opened).startswith("Tick 7 of 10") and now(opened) == "tick 7 140 ms"
    opened.locator(".tl-last").click()
    assert where(opened).startswith("Tick 10 of 10")
    opened.locator(".player-first").click()
    assert now(opened) == "before the first tick"
    assert set(opened.locator(".tl-cell").all_inner_texts()) == {""}
    opened.locator(".tl-back").click()
    assert now(opened) == "tick 1 20 ms" and where(opened).startswith("Tick 1 of")


def test_both_begin_at_the_end_of_the_run(opened: Page) -> None:
    opened.locator(".player").scroll_into_view_if_needed()
    assert where(opened).startswith("Tick 10 of") and now(opened) == "tick 10 200 ms"


def test_the_cursor_moves_along_with_what_is_played(opened: Page) -> None:
    opened.locator(".player").scroll_into_view_if_needed()
    opened.clock.install()
    opened.locator(".player-play").click()
    opened.clock.run_for(1_000)
    assert now(opened) == "tick 1 20 ms" and opened.locator(".tl-now").get_attribute("aria-live") == "off"
    opened.locator(".tl-plot").click(position={"x": 200, "y": 60})
    assert opened.locator(".player-play").inner_text() == "Play", "who chooses a tick wants to stay there"
    assert where(opened).split(" of ")[0].lower() == " ".join(now(opened).split()[:2])


def test_printing_leaves_both_where_they_were(opened: Page) -> None:
    opened.locator(".player").scroll_into_view_if_needed()
    opened.locator(".player-first").click()
    opened.locator(".player-next").click()
    opened.evaluate("window.dispatchEvent(new Event('beforeprint'))")
    assert where(opened).startswith("Tick 10 of") and now(opened) == "tick 1 20 ms"
    opened.evaluate("window.dispatchEvent(new Event('afterprint'))")
    assert where(opened).startswith("Tick 1 of") and now(opened) == "tick 1 20 ms"


def test_what_is_not_put_together_is_apart(show: Show) -> None:
    page = show(whole("apart", [timeline.part(long()), player.part(long())]))
    page.locator(".player-next").click()
    assert now(page) == "tick 10 200 ms"
