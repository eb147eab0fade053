"""The page of a trace in a browser: the cursor, the values beside it, narrow screens, dark, print."""

from dataclasses import replace

import pytest
from playwright.sync_api import Browser, Page

from rovercheck.checker.render import timeline, trace_html
from rovercheck.checker.render.page import page as whole
from tests import traces
from tests.browser.conftest import Show
from tests.render.test_periods import silent
from tests.render.test_timeline import drawn

NOW = ".tl-now"


def names(page: Page) -> list[str]:
    """The lanes that are seen, from top to bottom."""
    told = page.locator(".tl-lane:visible .tl-name").all_text_contents()
    return [name.replace("●", "").strip() for name in told]


def place(page: Page, selector: str) -> dict[str, float]:
    """Where the first such element stands, asked at once: between two questions a frame may replace it."""
    settled(page)
    box = page.evaluate(f"document.querySelector('{selector}').getBoundingClientRect().toJSON()")
    return {key: float(box[key]) for key in ("x", "y", "width", "height")}


def value(page: Page, lane: str, cursor: int = 0) -> str:
    """What stands beside the name of a lane."""
    cells = page.locator(".tl-lane").evaluate_all(
        "all => all.map(one => [...one.children].map(cell => cell.textContent.replace('●', '').trim()))"
    )
    return str({name: told for name, *told in cells}[lane][cursor])


def changed(page: Page) -> list[str]:
    return [
        told.replace("● ", "") for told in page.locator(".tl-lane:has(.tl-new) .tl-name").all_inner_texts()
    ]


@pytest.fixture
def opened(show: Show) -> Page:
    return show(trace_html.render(drawn()))


def test_opens_at_the_end(opened: Page) -> None:
    assert opened.locator(NOW).inner_text().split() == ["tick", "153", "3060", "ms"]
    assert value(opened, "mode") == "CRITICAL"
    assert opened.locator(".tl-plot .tl-cursor").is_visible()


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
    box = place(opened, ".tl-plot")
    box["y"] -= 40
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


def test_a_phone_sees_the_whole_run_and_scrolls_the_lanes_and_not_the_page(opened: Page) -> None:
    opened.set_viewport_size({"width": 390, "height": 844})
    seen = "[document.documentElement.scrollWidth, frame.scrollWidth - frame.clientWidth, frame.scrollLeft]"
    frame = "(() => { const frame = document.querySelector('.tl-frame'); return " + seen + "; })()"
    until(opened, f"{frame}[1] === 0")
    assert opened.evaluate(frame)[0] == 390, "it fits"
    for _ in range(6):
        opened.locator(".tl-in").click()
    opened.locator(".tl-first").click()
    places = [place(opened, one) for one in (".tl-names", ".tl-cell")]
    opened.locator(".tl-last").click()
    wide, more, left = opened.evaluate(frame)
    assert wide == 390 and more > 100 and left > 100
    assert [place(opened, one) for one in (".tl-names", ".tl-cell")] == places, "names and values stay"


def test_print_has_all_and_no_controls(opened: Page) -> None:
    opened.emulate_media(media="print")
    opened.set_viewport_size({"width": 1045, "height": 740})
    assert not opened.locator(".tl-tools").is_visible() and not opened.locator(".tl-overview").is_visible()
    opened.evaluate("window.dispatchEvent(new Event('beforeprint'))")
    plot = place(opened, ".tl-plot")
    assert plot["x"] + plot["width"] <= 1045
    assert opened.locator(".told-table").is_visible()
    opened.evaluate("window.dispatchEvent(new Event('afterprint'))")


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
  const bands = [...document.querySelectorAll(".tl-plot rect[class^=tl-is-]")];
  const over = (label) => bands.findLast((one) => one.compareDocumentPosition(label) & 4);
  return [...document.querySelectorAll(".tl-label")].map((label) => {
    const [a, b] = [label, over(label)].map((element) => light(getComputedStyle(element).fill));
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


# --- zoom, overview, signals, a second cursor ------------------------------------------------------


def settled(page: Page) -> None:
    """Waits until a page has drawn what was done to it: a click on what a frame replaces is lost."""
    page.evaluate("() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")


def edges(page: Page) -> tuple[float, float, float]:
    """How wide the lanes are, and which part of them is seen."""
    settled(page)
    wide, left, room = page.evaluate(
        """() => {
          const frame = document.querySelector(".tl-frame"), names = document.querySelector(".tl-names");
          const plot = document.querySelector(".tl-plot").getBoundingClientRect();
          return [plot.width, frame.scrollLeft, frame.clientWidth - names.offsetWidth];
        }"""
    )
    return wide, left, room


def until(page: Page, condition: str) -> None:
    """Waits for what comes with the next frame; a page allows no text to be run as a function in it."""
    for _ in range(200):
        if page.evaluate(condition):
            return
        page.wait_for_timeout(20)
    raise AssertionError(condition)


def test_it_fits_and_zooms_around_the_cursor(opened: Page) -> None:
    wide, _, room = edges(opened)
    assert 0.9 * room < wide <= room
    opened.locator(".tl-frame").focus()
    opened.keyboard.press("Home")
    for _ in range(4):
        opened.keyboard.press("+")
    zoomed, left, _ = edges(opened)
    assert zoomed > 1.5 * wide and left < 200, "the cursor is still seen"
    opened.keyboard.press("0")
    assert edges(opened)[0] == wide
    opened.locator(".tl-out").click()
    assert edges(opened)[0] == wide, "never less than the whole run"


def test_the_wheel_with_ctrl_zooms_what_is_under_the_pointer(opened: Page) -> None:
    box = place(opened, ".tl-plot")
    x, y = box["x"] + 0.1 * box["width"], box["y"] + 30
    opened.mouse.move(x, y)
    before = opened.locator(NOW).inner_text()
    opened.keyboard.down("Control")
    for _ in range(3):
        opened.mouse.wheel(0, -200)
    opened.keyboard.up("Control")
    until(opened, "document.querySelector('.tl-plot').getBoundingClientRect().width > 1500")
    opened.mouse.move(x + 1, y)
    assert opened.locator(NOW).inner_text() == before
    assert opened.evaluate("visualViewport.scale") == 1


def test_two_fingers_zoom_the_lanes_and_not_the_page(browser: Browser, show: Show, page: Page) -> None:
    context = browser.new_context(viewport={"width": 390, "height": 844}, has_touch=True, is_mobile=True)
    phone = context.new_page()
    show(trace_html.render(drawn()))
    phone.goto(page.url)
    wide = edges(phone)[0]
    box = place(phone, ".tl-frame")
    touch = context.new_cdp_session(phone)
    x, y = box["x"] + 260, box["y"] + 120

    def fingers(kind: str, *places: float) -> None:
        points = [{"x": x + dx, "y": y} for dx in places]
        touch.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})

    fingers("touchStart", -20, 20)
    for apart in (30, 45, 60, 80):
        fingers("touchMove", -apart, apart)
    fingers("touchEnd")
    assert edges(phone)[0] > 2 * wide
    assert phone.evaluate("[visualViewport.scale, document.documentElement.scrollWidth]") == [1, 390]
    context.close()


def test_the_overview_shows_the_part_that_is_seen_and_moves_it(opened: Page) -> None:
    def window() -> tuple[float, float]:
        box = place(opened, ".tl-window")
        return box["x"], box["width"]

    strip = place(opened, ".tl-overview")
    assert window()[1] > 0.98 * strip["width"]
    opened.locator(".tl-first").click()
    for _ in range(4):
        opened.locator(".tl-in").click()
    opened.mouse.click(strip["x"] + 1, strip["y"] + 10)
    until(opened, "document.querySelector('.tl-frame').scrollLeft < 300")
    left = window()
    assert left[1] < strip["width"]
    opened.mouse.click(strip["x"] + 0.99 * strip["width"], strip["y"] + 10)
    until(opened, "document.querySelector('.tl-frame').scrollLeft > 600")
    until(opened, f"document.querySelector('.tl-window').getBoundingClientRect().x > {left[0]}")


def test_signals_are_chosen_by_name(opened: Page) -> None:
    all_of_them = names(opened)
    opened.locator(".tl-choice summary").click()
    opened.locator(".tl-list li input").first.uncheck()
    assert names(opened) == all_of_them[1:]
    opened.locator(".tl-filter").fill("RELAY")
    assert opened.locator(".tl-list li:visible").count() == 2
    opened.locator(".tl-none").click()
    assert names(opened) == [n for n in all_of_them[1:] if "Relay" not in n]
    opened.locator(".tl-filter").fill("")
    opened.locator(".tl-every").click()
    assert names(opened) == all_of_them
    assert opened.locator(".tl-chosen").inner_text() == f"{len(all_of_them)} of {len(all_of_them)}"
    opened.locator(".tl-none").click()
    assert names(opened) == [] and opened.locator(".tl-head:visible").count() == 0


def test_two_cursors_tell_what_lies_between_them(opened: Page) -> None:
    opened.locator(".tl-frame").focus()
    opened.keyboard.press("Home")
    for _ in range(12):
        opened.keyboard.press("ArrowRight")
    opened.keyboard.press("b")
    opened.keyboard.press("End")
    told = opened.locator(".tl-difference")
    assert told.inner_text() == "B tick 13, 260 ms; A − B = 140 ticks, 2800 ms"
    assert value(opened, "Relay.Theirs.duration1", 1) == "220 ms"
    assert value(opened, "mode") == "CRITICAL"
    opened.keyboard.press("Escape")
    assert told.inner_text() == "" and value(opened, "mode", 1) == ""
    box = place(opened, ".tl-plot")
    opened.mouse.click(box["x"] + 3, box["y"] + 30)
    opened.keyboard.down("Shift")
    opened.mouse.click(box["x"] + box["width"] - 3, box["y"] + 30)
    opened.keyboard.up("Shift")
    assert told.inner_text() == "B tick 153, 3060 ms; A − B = -152 ticks, -3040 ms"


# --- repeated periods ------------------------------------------------------------------------------


@pytest.fixture
def silence(show: Show) -> Page:
    return show(trace_html.render(silent(3003)))


def test_a_repeated_period_is_a_box_that_opens_by_a_click(silence: Page) -> None:
    wide, _, room = edges(silence)
    assert wide <= room, "3,003 ticks fit"
    words = silence.locator(".tl-axis").text_content() or ""
    assert "× 56" in words and "67–2978" in words and "1320–59560" in words
    silence.locator(".tl-plot .tl-fold").click()
    assert silence.locator(".tl-fold-button").get_attribute("aria-expanded") == "true"
    assert edges(silence)[0] > 5_000
    assert silence.locator(".tl-plot rect").count() < 300, "only what is seen is drawn"
    mark = "document.querySelector('.tl-axis .tl-handle')"
    silence.evaluate(f"{mark}.dispatchEvent(new MouseEvent('click', {{bubbles: true}}))")
    assert edges(silence)[0] == wide
    silence.locator(".tl-fold-button").click()
    assert edges(silence)[0] > 5_000


def test_a_mark_that_is_drawn_anew_under_the_mouse_can_be_clicked(silence: Page) -> None:
    """Scrolling draws the marks anew; between press and release a click on one was lost."""
    wide = edges(silence)[0]
    silence.locator(".tl-fold-button").click()
    box = place(silence, ".tl-axis .tl-handle")
    assert box["x"] < 700, "the axis stands above the lanes, however wide they are"
    silence.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    silence.mouse.down()
    silence.evaluate("document.querySelector('.tl-frame').scrollLeft += 1")
    settled(silence)
    silence.mouse.up()
    assert edges(silence)[0] == wide
    box = place(silence, ".tl-plot .tl-fold")
    silence.mouse.click(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    assert edges(silence)[0] > 5_000, "one click is one click"


def test_every_value_within_a_box_is_known(silence: Page) -> None:
    silence.locator(".tl-frame").focus()
    silence.keyboard.press("End")
    for _ in range(40):
        silence.keyboard.press("ArrowLeft")
    assert silence.locator(NOW).inner_text() == "tick 2963\n59260 ms"
    count = silent(3003).ticks[2962].after["Monitors_2.IMU.CRIT.duration1"]
    assert value(silence, "Monitors_2.IMU.CRIT.duration1") == f"{20 * count} ms"


def test_the_table_shows_by_a_click_what_is_repeated(silence: Page) -> None:
    inside = silence.locator(".told-inside tr")
    assert inside.count() == 56 * 3 and not inside.first.is_visible()
    silence.locator(".told-more").click()
    assert inside.first.is_visible() and inside.last.is_visible()
    silence.locator(".told-more").click()
    assert not inside.first.is_visible()


# --- beside the charts -----------------------------------------------------------------------------


def test_lanes_and_charts_are_side_by_side_on_one_screen(silence: Page) -> None:
    lanes, charts = (place(silence, one) for one in (".tl-frame", ".player-charts"))
    assert lanes["x"] + lanes["width"] <= charts["x"] and charts["x"] + charts["width"] <= 1280
    assert max(box["y"] + box["height"] for box in (lanes, charts)) <= 900
    assert silence.evaluate("document.documentElement.scrollWidth") == 1280


def test_without_scripts_the_picture_is_there(browser: Browser, show: Show, page: Page) -> None:
    show(trace_html.render(drawn()))
    context = browser.new_context(java_script_enabled=False)
    plain = context.new_page()
    plain.goto(page.url)
    assert plain.locator("noscript svg").get_by_text("false here").is_visible()
    assert not plain.locator(".tl-tools").is_visible()
    context.close()
