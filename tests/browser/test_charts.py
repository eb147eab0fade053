"""Charts on pages: they fit when the page opens, zoom, and unfold their long lists of actions."""

import pytest
from playwright.sync_api import Browser, Page

from rovercheck.checker.render import statechart_html
from rovercheck.checker.render.drawing.folding import shortened
from rovercheck.checker.render.drawing.labels import action_lines
from rovercheck.checker.render.statechart_svg import render as whole_picture
from rovercheck.spec_model import rover
from tests.browser.conftest import Show

MONITORS = rover.charts()["Monitors_2"]
LONG = action_lines(MONITORS.states[("IMU", "OK")])


def test_a_shift_register_is_one_line_and_the_rest_is_as_it_was() -> None:
    lines = ("entry:", "  c := b", "  b := a", "  a := x", "  x := y", "  q := 1", "  q := x")
    assert shortened(lines) == ("entry:", "  shift y → x → … → c", "  q := 1", "  q := x", "▸ all 7 lines")
    for others in (
        ("  c := b", "  b := a", "  a := x"),
        ("  c := b", "  a := b", "  b := c", "  a := d", "  e := f"),
        ("  a := 1", "  b := a + 1"),
        (),
    ):
        assert shortened(others) == others, "no register, or a short one"
    swap = ("a := b", "b := a") * 3
    assert shortened(swap)[0].startswith("shift") and shortened(swap)[-1] == "▸ all 6 lines"


def test_of_a_long_list_the_first_lines_are_shown() -> None:
    lines = tuple(f"x{i} := {i}" for i in range(20))
    assert shortened(lines) == (*lines[:9], "…", "▸ all 20 lines")
    assert shortened(lines[:10]) == lines[:10]


def test_a_picture_as_a_file_has_every_action() -> None:
    told = whole_picture(MONITORS)
    assert "imu_gap7 := imu_gap6" in told and "all 17 lines" not in told


@pytest.fixture
def opened(show: Show) -> Page:
    return show(statechart_html.render(MONITORS))


def test_a_click_unfolds_and_another_one_folds(opened: Page) -> None:
    folded = opened.locator(".folded[data-actions='IMU.OK']")
    whole = opened.locator(".all-actions[data-actions='IMU.OK']")
    assert not whole.is_visible() and folded.get_attribute("aria-expanded") == "false"
    folded.click()
    told = " ".join(whole.locator("text").all_text_contents())
    assert whole.is_visible() and folded.get_attribute("aria-expanded") == "true"
    assert all(" ".join(line.split()) in " ".join(told.split()) for line in LONG)
    assert opened.locator(".all-actions.open").count() == 1
    whole.click()
    assert not whole.is_visible()
    folded.focus()
    opened.keyboard.press("Enter")
    assert whole.is_visible()
    opened.keyboard.press(" ")
    assert not whole.is_visible()


def test_everything_that_unfolds_lies_in_the_picture(opened: Page) -> None:
    outside = """() => {
      const svg = document.querySelector(".drawn svg"), box = svg.getBoundingClientRect();
      for (const one of svg.querySelectorAll(".all-actions")) one.classList.add("open");
      const places = [...svg.querySelectorAll(".all-actions")].map((one) => one.getBoundingClientRect());
      const beside = (one) => one.left < box.left - 1 || one.right > box.right + 1;
      const across = (one) => one.top < box.top - 1 || one.bottom > box.bottom + 1;
      return places.filter((one) => beside(one) || across(one)).length;
    }"""
    assert opened.locator(".all-actions").count() == 12 and opened.evaluate(outside) == 0


@pytest.mark.parametrize("wide", [390, 1280])
def test_it_fits_on_opening_and_zooms_in_its_frame(opened: Page, wide: int) -> None:
    opened.set_viewport_size({"width": wide, "height": 844})
    opened.reload()
    sizes = """() => {
      const frame = document.querySelector(".drawn");
      return [document.documentElement.scrollWidth, frame.scrollWidth - frame.clientWidth];
    }"""
    assert opened.evaluate(sizes) == [wide, 0]
    opened.locator(".drawn").hover(position={"x": 100, "y": 100})
    opened.keyboard.down("Control")
    opened.mouse.wheel(0, -300)
    opened.keyboard.up("Control")
    for _ in range(100):
        if opened.evaluate(sizes)[1] > 100:
            break
        opened.wait_for_timeout(20)
    assert opened.evaluate(sizes)[0] == wide and opened.evaluate(sizes)[1] > 100


def test_two_fingers_zoom_the_chart_and_not_the_page(browser: Browser, opened: Page) -> None:
    context = browser.new_context(viewport={"width": 390, "height": 844}, has_touch=True, is_mobile=True)
    phone = context.new_page()
    phone.goto(opened.url)
    touch = context.new_cdp_session(phone)
    for kind, apart in (("touchStart", 20), ("touchMove", 40), ("touchMove", 70), ("touchEnd", 0)):
        points = [{"x": 190 + dx, "y": 300} for dx in (-apart, apart)] if apart else []
        touch.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})
    wide, scale, page = phone.evaluate(
        "[document.querySelector('.drawn svg').getBoundingClientRect().width, visualViewport.scale,"
        " document.documentElement.scrollWidth]"
    )
    assert wide > 900 and (scale, page) == (1, 390)
    context.close()
