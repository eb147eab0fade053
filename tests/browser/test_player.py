"""The player in a browser: buttons, keys, slider, what is marked, narrow screens, print; chart pictures."""

from dataclasses import replace

import pytest
from markupsafe import Markup
from playwright.sync_api import Page

from rovercheck.checker.render import player, trace_play
from rovercheck.checker.render.page import Part
from rovercheck.checker.render.page import page as whole
from rovercheck.checker.render.statechart_svg import render
from rovercheck.checker.results.trace import Trace
from rovercheck.spec_model.rover import charts
from tests.browser.conftest import Show
from tests.render.test_player import TOY, run, shining

LONG = [{"level": raw} for raw in (0, *[0] * 5, 150, 150, 250, 20)]


def long() -> Trace:
    return run(TOY, LONG)


def where(page: Page) -> str:
    return page.locator(".player-time").inner_text()


def active(page: Page) -> set[str]:
    found = page.locator("[data-chart=Lamp] .active")
    return set(found.evaluate_all("parts => parts.map(part => part.dataset.state.split('.').pop())"))


def marked(page: Page, kind: str) -> set[str]:
    found = page.locator(f"g.{kind}")
    return set(found.evaluate_all("parts => parts.map(part => part.dataset.arrow)"))


@pytest.fixture
def opened(show: Show) -> Page:
    return show(trace_play.render(long()))


def test_next_steps_from_transition_to_transition(opened: Page) -> None:
    assert where(opened) == "Before the first tick" and active(opened) == set()
    opened.locator(".player-next").click()
    assert where(opened) == "Tick 1 of 10 · 20 ms"
    assert active(opened) == {"Sensor", "Dark", "Light", "Off"}
    opened.locator(".player-next").click()
    assert where(opened) == "Tick 7 of 10 · 140 ms · step 1 of 3"
    assert active(opened) == {"Sensor", "Dark", "Light", "On", "Low"}
    assert marked(opened, "fired") == {"Light.Off#1", "Light.On*#1"} and marked(opened, "taken") == set()
    opened.locator(".player-next").click()
    assert active(opened) == {"Sensor", "Bright", "Light", "On", "Low"}
    assert marked(opened, "fired") == {"Sensor.Dark#1", "Sensor.seen#1"}
    assert marked(opened, "taken") == {"Light.Off#1", "Light.On*#1"}
    current = opened.locator(".player-transitions [aria-current]").all_inner_texts()
    assert len(current) == 1 and "Sensor.Dark → Sensor.Bright" in current[0]
    assert "alarm: false → true" in opened.locator(".player-changes").inner_text()
    opened.locator(".player-back").click()
    assert where(opened).endswith("step 1 of 3")


def test_slider_shows_quiet_ticks_and_the_last_event_faintly(opened: Page) -> None:
    opened.locator(".player-tick").focus()
    for _ in range(4):
        opened.keyboard.press("ArrowRight")
    assert where(opened) == "Tick 4 of 10 · 80 ms"
    assert active(opened) == {"Sensor", "Dark", "Light", "Off"}
    assert marked(opened, "fired") == set() and "Sensor*#1" in marked(opened, "taken")
    assert "ticks 2–6" in opened.locator(".player-note").inner_text()
    opened.locator(".player-back").click()
    assert where(opened).startswith("Tick 1 of"), "back to the event in which time stood still"


def test_keys(opened: Page) -> None:
    opened.locator(".player").focus()
    opened.keyboard.press("End")
    assert where(opened).startswith("Tick 10 of 10")
    assert "False now: !alarm" in opened.locator(".player-note").inner_text()
    opened.keyboard.press("ArrowLeft")
    assert not where(opened).startswith("Before")
    opened.keyboard.press("Home")
    assert where(opened) == "Before the first tick"


def test_play_goes_to_the_end_and_stops(opened: Page) -> None:
    opened.clock.install()
    opened.locator(".player-speed").select_option("fast")
    opened.locator(".player-play").click()
    assert opened.locator(".player-play").inner_text() == "Pause"
    assert opened.locator(".player-where").get_attribute("aria-live") == "off"
    opened.clock.run_for(60_000)
    assert where(opened).startswith("Tick 10 of 10")
    assert opened.locator(".player-play").inner_text() == "Play"
    assert opened.locator(".player-where").get_attribute("aria-live") == "polite"


def test_a_loop_is_played_again(show: Show) -> None:
    opened = show(trace_play.render(replace(shining(), loop=2)))
    opened.clock.install()
    opened.locator(".player-last").click()
    assert "Loop: back to tick 2" in opened.locator(".player-note").inner_text()
    opened.locator(".player-play").click()
    opened.clock.run_for(100)
    assert where(opened).startswith("Tick 3 of 4"), "the first tick after the one to which it returns"
    opened.clock.run_for(60_000)
    assert opened.locator(".player-play").inner_text() == "Pause", "for ever"


def test_one_chart_can_be_shown_or_followed(opened: Page) -> None:
    figures = opened.locator(".player-chart")
    assert figures.evaluate_all("all => all.map(one => one.hidden)") == [False, False]
    opened.get_by_role("button", name="Relay").click()
    assert figures.evaluate_all("all => all.map(one => one.hidden)") == [True, False]
    opened.get_by_role("button", name="Follow").click()
    opened.locator(".player-last").click()
    moving = opened.locator(".player-choice .moves").all_inner_texts()
    seen = figures.evaluate_all("all => all.filter(one => !one.hidden).map(one => one.dataset.chart)")
    assert len(moving) == 1 and seen == moving


def test_every_control_has_a_name_and_the_tick_is_announced(opened: Page) -> None:
    for name in ("First", "Previous", "Play", "Next", "Last"):
        assert opened.get_by_role("button", name=name, exact=True).count() == 1
    assert opened.get_by_role("slider", name="Tick").count() == 1
    assert opened.get_by_role("combobox", name="Speed").count() == 1
    opened.locator(".player-next").click()
    assert "default" in (opened.get_by_role("status").text_content() or "")


def test_two_players_are_apart(show: Show) -> None:
    trace = long()
    parts = [player.gallery([trace]), player.part(trace, pictures=False), player.part(trace, pictures=False)]
    opened = show(whole("Two", parts))
    first, second = opened.locator(".player").all()
    second.scroll_into_view_if_needed()
    second.locator(".player-last").click()
    assert second.locator("svg .active").count() > 0
    assert first.locator(".player-time").inner_text() == "Before the first tick"
    assert first.locator("svg .active").count() == 0 and first.locator("svg").count() == 2


def test_a_player_that_is_added_later_plays(show: Show) -> None:
    trace = long()
    gallery, part = player.gallery([trace]), player.part(trace, pictures=False)
    opened = show(
        whole("Late", [gallery, Part(Markup('<div class="late"></div>'), part.styles, part.scripts)])
    )
    add = """([place, body]) => {
      place.innerHTML = body;
      place.dispatchEvent(new Event("page:added", { bubbles: true }));
    }"""
    opened.evaluate(add, [opened.locator(".late").element_handle(), str(part.body)])
    opened.locator(".player-ready .player-last").click()
    assert opened.locator("svg .active").count() > 0


def test_a_phone_shows_the_chart_that_moves_and_scrolls_inside_it(show: Show) -> None:
    opened = show(trace_play.render(long()))
    opened.set_viewport_size({"width": 390, "height": 800})
    opened.reload()
    opened.locator(".player-last").click()
    assert opened.evaluate("document.documentElement.scrollWidth <= 390")
    assert opened.locator(".player-chart:visible").count() == 1


def test_print_shows_the_end_and_a_table(opened: Page) -> None:
    opened.evaluate("window.dispatchEvent(new Event('beforeprint'))")
    opened.emulate_media(media="print")
    assert where(opened).startswith("Tick 10 of 10")
    assert opened.locator(".player-printed").is_visible()
    assert not opened.locator(".player-bar").is_visible()
    printed = opened.locator(".player-printed tbody td:first-child").all_inner_texts()
    assert printed[:2] == ["1", "7"] and printed[-1] == "10"


CLASHES = """svg => {
  const texts = [...svg.querySelectorAll("text")].map(text => [text.textContent, text.getBBox()]);
  const beside = (a, b) => a.x + a.width <= b.x || b.x + b.width <= a.x;
  const below = (a, b) => a.y + a.height <= b.y + 4;
  const clash = (a, b) => !(beside(a, b) || below(a, b) || below(b, a));
  const pairs = texts.flatMap(([a, p], i) => texts.slice(i + 1).map(([b, q]) => [a, b, clash(p, q)]));
  const { width, height } = svg.viewBox.baseVal;
  const outside = p => p.x < 0 || p.y < 0 || p.x + p.width > width || p.y + p.height > height;
  return [pairs.filter(pair => pair[2]), texts.filter(([_, p]) => outside(p))];
}"""


def test_texts_of_every_chart_lie_apart_as_the_browser_sets_them(show: Show) -> None:
    """The widths that the layout reserves are those of real letters, or more."""
    opened = show("".join(render(chart) for chart in charts().values()))
    assert opened.locator("svg").evaluate_all(f"all => all.map({CLASHES})") == [[[], []]] * len(charts())
