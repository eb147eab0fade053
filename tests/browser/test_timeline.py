"""The page of a trace in a browser: the cursor, the values beside it, narrow screens, dark, print."""

from dataclasses import replace

import pytest
from playwright.sync_api import Browser, Page

from rovercheck.checker.render import timeline, trace_html
from rovercheck.checker.render.page import page as whole
from tests import traces
from tests.browser.conftest import Show
from tests.render.test_timeline import drawn

NOW = ".tl-now"


def value(page: Page, lane: str) -> str:
    """What the table says of a lane."""
    rows = page.locator(".tl-table tr:not(:has(.tl-same))")
    told = rows.evaluate_all("rows => rows.map(row => [...row.cells].map(cell => cell.textContent))")
    return str(dict(told)[lane])


def changed(page: Page) -> list[str]:
    return page.locator(".tl-table tr.tl-new th").all_inner_texts()


@pytest.fixture
def opened(show: Show) -> Page:
    return show(trace_html.render(drawn()))


def test_opens_at_the_end(opened: Page) -> None:
    assert opened.locator(NOW).inner_text().split() == ["tick", "153", "3060", "ms"]
    assert value(opened, "mode") == "CRITICAL"
    assert opened.locator(".tl-cursor").is_visible()


def test_keys_move_the_cursor(opened: Page) -> None:
    opened.locator(".tl-frame").focus()
    opened.keyboard.press("Home")
    assert opened.locator(NOW).inner_text().startswith("tick 1\n")
    opened.keyboard.press("ArrowRight")
    assert value(opened, "level") == "100" and "level" in changed(opened)
    opened.keyboard.press("ArrowDown")
    opened.keyboard.press("ArrowDown")
    assert opened.locator(NOW).inner_text().startswith("tick 153\n"), "from change to change"
    opened.keyboard.press("ArrowLeft")
    assert value(opened, "Relay.Theirs.duration1") == "3 s"


def test_counts_are_told_in_between(opened: Page) -> None:
    opened.locator(".tl-first").click()
    for _ in range(12):
        opened.locator(".tl-next").click()
    assert opened.locator(NOW).inner_text().startswith("tick 13\n")
    assert value(opened, "Relay.Theirs.duration1") == "220 ms"
    opened.locator(".tl-back").click()
    assert value(opened, "Relay.Theirs.duration1") == "200 ms"
    opened.locator(".tl-last").click()
    assert value(opened, "never_critical") == "false"


def test_the_mouse_shows_and_a_click_holds(opened: Page) -> None:
    box = opened.locator(".tl-plot").bounding_box()
    assert box is not None
    opened.mouse.move(box["x"] + 2, box["y"] + 70)
    assert opened.locator(NOW).inner_text().startswith("tick 1\n")
    opened.mouse.click(box["x"] + 2, box["y"] + 70)
    opened.mouse.move(box["x"] + 300, box["y"] + 70)
    assert opened.locator(NOW).inner_text().startswith("tick 1\n")


def test_two_timelines_on_a_page_are_apart(show: Show) -> None:
    page = show(whole("two", [timeline.part(drawn()), timeline.part(drawn(5))]))
    page.locator(".tl-first").nth(1).click()
    first, second = page.locator(NOW).all_inner_texts()
    assert first.startswith("tick 153\n") and second.startswith("tick 1\n")


def test_a_phone_scrolls_the_lanes_and_not_the_page(opened: Page) -> None:
    opened.set_viewport_size({"width": 390, "height": 844})
    wide, frame = opened.evaluate(
        "[document.documentElement.scrollWidth, document.querySelector('.tl-frame').scrollWidth]"
    )
    assert wide == 390 and frame > 600
    opened.locator(".tl-first").click()
    names = opened.locator(".tl-names").bounding_box()
    opened.locator(".tl-last").click()
    assert opened.locator(".tl-frame").evaluate("frame => frame.scrollLeft") > 100
    assert opened.locator(".tl-names").bounding_box() == names, "the names stay"


def test_print_has_all_and_no_controls(opened: Page) -> None:
    opened.emulate_media(media="print")
    opened.set_viewport_size({"width": 1045, "height": 740})
    assert not opened.locator(".tl-side").is_visible()
    plot = opened.locator(".tl-plot").bounding_box()
    assert plot is not None and plot["x"] + plot["width"] <= 1045
    assert opened.locator(".told-table").is_visible()


def test_what_never_changes_is_printed_too(show: Show) -> None:
    trace = traces.changed(drawn(), relevant=frozenset({"mode", "level", "speed"}))
    still = replace(trace, ticks=tuple(replace(t, after={**t.after, "speed": 0}) for t in trace.ticks))
    page = show(trace_html.render(traces.changed(still, false_parts=still.property.false_parts[:1])))
    told = page.locator(".tl-same p")
    assert not told.is_visible()
    page.evaluate("window.dispatchEvent(new Event('beforeprint'))")
    assert told.is_visible() and told.inner_text() == "speed = 0 m/s"
    page.evaluate("window.dispatchEvent(new Event('afterprint'))")
    assert not told.is_visible()


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_labels_stand_out_from_their_bands(browser: Browser, show: Show, page: Page, scheme: str) -> None:
    page.emulate_media(color_scheme="dark" if scheme == "dark" else "light")
    show(trace_html.render(drawn(10)))
    ratios = page.evaluate(CONTRAST)
    assert ratios and min(ratios) >= 4.5


CONTRAST = """() => {
  const light = (colour) => {
    const [r, g, b] = colour.match(/[\\d.]+/g).map((part) => {
      const share = part / 255;
      return share <= 0.04045 ? share / 12.92 : ((share + 0.055) / 1.055) ** 2.4;
    });
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };
  return [...document.querySelectorAll(".tl-label")].map((label) => {
    const band = label.previousElementSibling.matches("rect") ? label.previousElementSibling
      : label.previousElementSibling.previousElementSibling;
    const [a, b] = [label, band].map((element) => light(getComputedStyle(element).fill));
    return (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
  });
}"""


def test_thousands_of_ticks_stay_usable(show: Show) -> None:
    page = show(trace_html.render(traces.changed(drawn(5000), id="LONG")))
    assert page.locator(".tl-plot rect").count() < 200
    page.locator(".tl-frame").focus()
    page.keyboard.press("ArrowLeft")
    assert page.locator(NOW).inner_text().startswith("tick 5002\n")
    assert value(page, "Relay.Theirs.duration1") == "100 s"
