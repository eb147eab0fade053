"""The live page in a browser: exploring, searching, what is saved meanwhile, a server that has ended."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.serving import LAMP, Served, serving_model

TWO = (
    LAMP.replace(
        "LAMP_1 =",
        """bell = flag("bell")
door = Chart(
    "Door",
    [State("Shut", transitions=[to("Open", when=bell)]), State("Open", transitions=[to("Shut", when=~bell)])],
    default="Shut",
    text="<img src=x onerror=alert(1)> & <b>bold</b>",
)
house = in_order("house", lamp, door, text="<script>alert(2)</script> Both.")
LAMP_1 =""",
    )
    .replace("flag, sec", "flag, in_order, sec")
    .replace('on="Lamp"', 'on="house"')
)


@dataclass
class Visit:
    """Somebody who looks at a page; ``wrong`` is what must not be at the end."""

    page: Page
    served: Served
    wrong: list[str] = field(default_factory=list)

    def open(self, name: str = "house") -> None:
        self.page.locator("#filter").fill(name)
        self.page.locator("#list .row").first.click()
        expect(self.page.locator("#title")).to_have_text(name)

    def step(self, title: str) -> None:
        self.page.locator(".step button", has_text=title).first.click()

    def at(self, text: str) -> None:
        expect(self.page.locator("#where")).to_contain_text(text)

    def active(self, chart: str) -> set[str]:
        found = self.page.locator(f"[data-chart={chart}] .active")
        return set(found.evaluate_all("parts => parts.map(part => part.dataset.state)"))


PATIENCE = 30_000
"""Milliseconds that a test waits for what must come, on a busy machine."""


@pytest.fixture
def visit(browser: Browser, tmp_path: Path) -> Iterator[Visit]:
    with serving_model(tmp_path / "model", TWO) as served:
        context = browser.new_context(viewport={"width": 1280, "height": 900})
        context.set_default_timeout(PATIENCE)
        expect.set_options(timeout=PATIENCE)
        page = context.new_page()
        one = Visit(page, served)
        page.on("console", lambda m: one.wrong.append(m.text) if m.type in ("error", "warning") else None)
        page.on("pageerror", lambda error: one.wrong.append(f"uncaught: {error}"))
        page.on("dialog", lambda dialog: one.wrong.append(f"dialog: {dialog.message}"))
        own = (served.server.url, "blob:", "data:")
        page.on("request", lambda r: None if r.url.startswith(own) else one.wrong.append(f"request: {r.url}"))
        page.goto(served.server.url)
        expect(page.locator("#list .row").first).to_be_visible()
        yield one
        context.close()
        assert one.wrong == []


def test_a_click_takes_a_step_and_keys_go_back(visit: Visit) -> None:
    visit.open()
    visit.page.keyboard.press("s")
    visit.at("Tick 1 of 1 executed · 20 ms")
    assert visit.active("Lamp") == {"Off"} and visit.active("Door") == {"Shut"}
    rise = visit.page.locator(".step button", has_text="Off → On")
    expect(rise).to_contain_text("by switch = true")
    rise.hover()
    assert visit.page.locator("[data-chart=Lamp] .offered").count() > 0
    rise.click()
    visit.at("Tick 2 of 2")
    assert visit.active("Lamp") == {"On"}
    assert visit.page.locator("[data-chart=Lamp] .fired").count() > 0
    visit.page.keyboard.press("ArrowLeft")
    visit.at("Tick 1 of 2")
    assert visit.active("Lamp") == {"Off"}
    visit.page.keyboard.press("End")
    visit.at("Tick 2 of 2")


def test_steps_of_two_charts_happen_together(visit: Visit) -> None:
    visit.open()
    visit.page.keyboard.press("s")
    visit.at("Tick 1 ")
    visit.page.get_by_label("Lamp: Off → On, together with others").check()
    visit.page.get_by_label("Door: Shut → Open, together with others").check()
    expect(visit.page.locator(".together")).to_contain_text("Lamp: Off → On; Door: Shut → Open")
    visit.page.locator(".together").get_by_text("Take").click()
    visit.at("Tick 2 ")
    assert visit.active("Lamp") == {"On"} and visit.active("Door") == {"Open"}


def test_everything_can_be_done_with_the_keyboard(visit: Visit) -> None:
    page = visit.page
    page.locator("#filter").focus()
    page.keyboard.type("house")
    page.keyboard.press("Tab")
    page.keyboard.press("Enter")
    expect(page.locator("#title")).to_have_text("house")
    page.locator("#condition").focus()
    page.keyboard.type("Lamp.On and Door.Open")
    page.keyboard.press("Enter")
    expect(page.locator("#said")).to_contain_text("Reached in 2 ticks by a run that explicit found")
    page.locator(".step button").first.focus()
    page.keyboard.press("Enter")
    visit.at("Tick 3 ")


def test_that_there_is_no_run_is_said_and_breaks_stop(visit: Visit) -> None:
    visit.open()
    page = visit.page
    page.locator("#condition").fill("Lamp.On and Lamp.Off")
    page.get_by_text("Find a run").click()
    expect(page.locator("#job")).to_contain_text("Never, from tick 0 on: all")
    page.locator("#condition").fill("Lamp.On")
    page.get_by_role("button", name="Break").click()
    expect(page.locator("#breaks")).to_contain_text("break: Lamp.On")
    page.get_by_label("switch", exact=True).select_option("true")
    page.get_by_text("50 ticks").click()
    expect(page.locator("#said")).to_contain_text("break: Lamp.On")
    page.get_by_role("button", name="Remove").click()
    expect(page.locator("#breaks")).to_be_empty()


def test_what_makes_no_sense_is_one_message_and_goes_again(visit: Visit) -> None:
    visit.open()
    visit.page.locator("#condition").fill("Lamp.Onn")
    visit.page.get_by_text("Find a run").click()
    expect(visit.page.locator("#error")).to_contain_text("Onn")
    visit.page.locator("#step").click()
    visit.at("Tick 1 ")
    expect(visit.page.locator("#error")).to_be_hidden()
    assert all("400" in one for one in visit.wrong)
    visit.wrong.clear()


def test_a_counterexample_is_decided_loaded_and_left_for_another_step(visit: Visit) -> None:
    page = visit.page
    page.get_by_role("tab", name="Properties").click()
    row = page.locator("#list [data-property=LAMP-1]")
    expect(row).to_contain_text("proved on record")
    row.get_by_text("Decide").click()
    expect(row).to_contain_text("violated, decided now")
    page.get_by_label("findings only").check()
    row.get_by_text("Explore its run").click()
    visit.at("Tick 2 of 2")
    assert visit.active("Lamp") == {"On"}
    page.locator("#back").click()
    visit.at("Tick 1 of 2")
    page.get_by_label("switch", exact=True).select_option("false")
    visit.step("Shut → Open")
    expect(page.locator("#said")).to_contain_text("A new branch: 1 tick after tick 1 forgotten.")
    assert visit.active("Lamp") == {"Off"}, "what if the switch had stayed off"
    expect(page.locator("[data-chart=Lamp] figcaption")).to_have_text("1 property speaks of Lamp, 1 violated")
    with page.context.expect_page() as opened:
        row.get_by_text("Trace").click()
    expect(opened.value.locator("h1")).to_have_text("LAMP-1")


def test_a_saved_model_is_shown_at_once_and_half_a_file_loses_nothing(visit: Visit) -> None:
    visit.open()
    visit.page.get_by_label("switch", exact=True).select_option("true")
    visit.page.keyboard.press("Escape")
    visit.page.locator("#step").click()
    visit.page.locator("#step").click()
    visit.at("Tick 2 of 2")
    assert visit.active("Lamp") == {"On"}
    visit.served.save(TWO[: len(TWO) // 2])
    expect(visit.page.locator("#problem")).to_contain_text("this is not Python")
    visit.page.locator("#step").click()
    visit.at("Tick 3 of 3")
    visit.served.save(TWO.replace('to("On", when=switch)', 'to("On", when=~switch)'))
    expect(visit.page.locator("#problem")).to_be_hidden()
    expect(visit.page.locator("#said")).to_have_text("The model was saved: 3 ticks are executed again on it.")
    assert visit.active("Lamp") == {"Off"}
    expect(visit.page.locator("[data-chart=Lamp]")).to_contain_text("[!switch]")


def test_a_closed_page_finds_its_session_again(visit: Visit) -> None:
    visit.open()
    visit.step("default → Off")
    visit.at("Tick 1 of 1")
    visit.page.reload()
    visit.at("Tick 1 of 1")
    other = visit.page.context.new_page()
    other.goto(visit.served.server.url)
    other.get_by_text("Go on with house at tick 1").click()
    expect(other.locator("#where")).to_contain_text("Tick 1 of 1")


def test_a_server_that_has_ended_is_one_message_and_the_run_can_be_saved(visit: Visit) -> None:
    visit.open()
    visit.page.locator("#step").click()
    visit.at("Tick 1 of 1")
    visit.served.end()
    visit.page.locator("#step").click()
    expect(visit.page.locator("#error")).to_contain_text("The server does not answer")
    expect(visit.page.locator("#connection")).to_have_text("not connected")
    with visit.page.expect_download() as found:
        visit.page.locator("#save").click()
    assert "# rovercheck explore house" in found.value.path().read_text(encoding="utf-8")
    visit.wrong[:] = [
        one for one in visit.wrong if "ERR_CONNECTION" not in one and "ERR_INCOMPLETE" not in one
    ]


def test_texts_of_a_model_are_shown_and_never_run(visit: Visit) -> None:
    expect(visit.page.locator("#list")).to_contain_text("<script>alert(2)</script> Both.")
    visit.open()
    expect(visit.page.locator("[data-chart=Door]")).to_contain_text("<img src=x onerror=alert(1)>")
    assert visit.page.locator("img").count() == 0


@pytest.mark.parametrize("width", [390, 1280])
def test_it_fits_the_screen(visit: Visit, browser: Browser, width: int) -> None:
    context = browser.new_context(viewport={"width": width, "height": 844})
    page = context.new_page()
    page.goto(visit.served.server.url)
    page.locator("#list .row", has_text="house").click()
    expect(page.locator(".step").first).to_be_visible()
    assert page.evaluate("document.documentElement.scrollWidth") == width
    assert page.locator("#list").is_visible() is (width > 760), "on a narrow screen the list makes room"
    page.get_by_role("tab", name="Properties").click()
    expect(page.locator("#list")).to_be_visible()
    context.close()
