"""The page of a state graph in a real browser: choosing, searching, filtering, moving, a phone, print."""

from playwright.sync_api import Page, expect

from rovercheck.checker.explore.graphs.construction import made
from rovercheck.checker.render.graph_html import render
from tests import toys
from tests.render.zoo import GRAPHS, ring

RELAY = render(made(toys.relay(), ["on", "hold"]).with_ways())


def place(page: Page) -> str:
    """Where the drawing is, two frames from now: what is moved is written in the next frame."""
    return str(
        page.locator(".sg-world").evaluate(
            "g => new Promise(done => requestAnimationFrame(() => requestAnimationFrame("
            "() => done(g.style.transform))))"
        )
    )


def moved(page: Page, since: str) -> str:
    """Where the drawing is, once that is not where it was."""
    page.wait_for_function("t => document.querySelector('.sg-world').style.transform !== t", arg=since)
    return place(page)


def test_a_click_shows_a_valuation_and_the_run_to_it(show) -> None:
    page = show(RELAY)
    expect(page.locator(".sg-hint")).to_be_visible()
    page.locator(".node[data-node='1']").click()
    panel = page.locator(".sg-panel")
    expect(panel.locator("h2")).to_have_text("on = true, hold = 0")
    expect(panel).to_contain_text("A shortest run to it: 1 tick of 20 ms")
    expect(panel).to_contain_text("in critical = true")
    assert page.locator(".node.chosen").count() == 1 and page.locator(".edge.near").count() > 0
    page.keyboard.press("Escape")
    expect(page.locator(".sg-hint")).to_be_visible()


def test_a_neighbour_is_chosen_from_the_panel(show) -> None:
    page = show(RELAY)
    page.locator(".node[data-node='0']").click()
    page.locator(".sg-panel li button").last.click()
    assert page.locator(".node.chosen").get_attribute("data-node") != "0"


def test_search_marks_the_hits_and_goes_from_one_to_the_next(show) -> None:
    page = show(RELAY)
    page.locator(".sg-search").fill("hold = 2")
    expect(page.locator(".sg-hits")).to_have_text("1 hit")
    assert page.locator(".node.hit").count() == 1
    assert page.locator(".node.dim").count() == page.locator(".node").count() - 1
    page.locator(".sg-search").press("Enter")
    expect(page.locator(".sg-panel h2")).to_have_text("on = true, hold = 2")
    page.locator(".sg-search").fill("nothing of the kind")
    expect(page.locator(".sg-hits")).to_have_text("0 hits")


def test_the_filter_keeps_a_component(show) -> None:
    page = show(render(GRAPHS["marked"]))
    page.locator(".sg-filter").select_option("marked")
    assert page.locator(".node:not(.dim)").count() == 1


def test_zooming_moving_and_fitting(show) -> None:
    page = show(render(ring(40)))
    page.wait_for_function("document.querySelector('.sg-world').style.transform.includes('scale')")
    page.locator(".sg-fit").click()
    whole = place(page)
    page.locator(".sg-in").click()
    moved(page, whole)
    page.locator(".sg-fit").click()
    page.wait_for_function("t => document.querySelector('.sg-world').style.transform === t", arg=whole)
    page.mouse.move(300, 400)
    page.mouse.wheel(0, -300)
    zoomed = moved(page, whole)
    page.mouse.down()
    page.mouse.move(360, 430)
    page.mouse.up()
    moved(page, zoomed)
    assert page.locator(".node.chosen").count() == 0


def test_the_keyboard_reaches_every_neighbour(show) -> None:
    page = show(render(ring(12)))
    page.locator(".sg-stage").focus()
    for _ in range(3):
        page.keyboard.press("ArrowRight")
    assert page.locator(".node.chosen").count() == 1
    page.keyboard.press("/")
    assert page.evaluate("document.activeElement.className") == "sg-search"


def test_it_fits_a_phone_and_prints_whole(show) -> None:
    page = show(RELAY)
    page.set_viewport_size({"width": 390, "height": 844})
    assert page.evaluate("document.documentElement.scrollWidth") <= 390
    page.emulate_media(media="print")
    page.evaluate("window.dispatchEvent(new Event('beforeprint'))")
    assert page.locator(".sg-svg").get_attribute("viewBox")
    assert page.locator(".sg-bar").is_hidden() and page.locator(".sg-panel").is_hidden()
