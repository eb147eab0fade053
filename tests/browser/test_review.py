"""The review page under a reader's hands: search, filters, deep links, timeline, player, phone, print."""

from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page, expect

from rovercheck.checker.render.review import render
from tests.browser.conftest import Show
from tests.render.toy_review import RUN, checked, review


@pytest.fixture(scope="module")
def document() -> str:
    return render(review())


@pytest.fixture
def opened(show, document: str) -> Page:
    page: Page = show(document)
    return page


def shown(page: Page) -> list[str]:
    """The ids of the entries that are not hidden."""
    found: list[str] = page.evaluate(
        "[...document.querySelectorAll('.entry')].filter(e => !e.closest('.hide')).map(e => e.id)"
    )
    return found


def test_no_text_of_the_model_ran(opened: Page) -> None:
    assert opened.title().startswith("Toys </script>")
    assert "broken" not in opened.title().partition("<script>")[0]


def test_search_finds_ids_and_texts_everywhere(opened: Page) -> None:
    field = opened.locator(".search input")
    opened.keyboard.press("/")
    expect(field).to_be_focused()
    field.fill("second")
    expect(opened.locator(".hits")).to_have_text(f"1 of {opened.locator('.entry').count()} entries")
    assert shown(opened) == ["requirement-R-2"]
    assert opened.locator("#section-charts").is_hidden()
    field.press("Escape")
    expect(opened.locator(".hits")).to_be_empty()
    assert len(shown(opened)) == opened.locator(".entry").count()


def test_enter_opens_the_entry_of_that_id(opened: Page) -> None:
    field = opened.locator(".search input")
    field.fill("t-5")
    field.press("Enter")
    assert opened.locator("#T-5").get_attribute("open") is not None
    expect(opened.locator("#T-5 summary")).to_be_focused()


def test_filters_by_verdict_area_and_system(opened: Page) -> None:
    opened.locator(".f-verdict").select_option("violated")
    assert shown(opened) == ["T-1", "T-2", "requirement-R-1"]
    opened.locator(".f-verdict").select_option("changed")
    assert shown(opened) == ["T-3"]
    opened.locator(".f-verdict").select_option("reason")
    assert shown(opened) == ["requirement-R-0"]
    opened.locator(".reset").click()
    opened.locator(".f-area").select_option("link")
    assert shown(opened) == ["T-4"]
    opened.locator(".reset").click()
    opened.locator(".f-system").select_option("other system")
    assert shown(opened) == ["T-4", "system-other system"]


def test_a_link_from_outside_opens_what_it_names(opened: Page) -> None:
    opened.goto(opened.url + "#system-toy")
    assert opened.locator("#system-toy").get_attribute("open") is not None
    opened.locator(".f-verdict").select_option("changed")
    opened.evaluate("location.hash = '#T-5'")
    expect(opened.locator("#T-5 .body")).to_be_visible()
    expect(opened.locator(".f-verdict")).to_have_value("")


def test_a_finding_is_played_on_its_charts(opened: Page) -> None:
    finding = opened.locator("#T-1")
    assert finding.locator(".tl, .player").count() == 0
    finding.locator("summary").first.click()
    expect(finding.locator(".tl")).to_be_visible()
    finding.locator(".player").scroll_into_view_if_needed()
    finding.locator(".player-next").click()
    finding.locator(".player-next").click()
    expect(finding.locator(".player svg .active").first).to_be_attached()
    before = finding.locator(".tl-now").inner_text()
    finding.locator(".tl-back").click()
    assert finding.locator(".tl-now").inner_text() != before


def test_a_state_graph_shows_valuations_runs_and_keeps_its_keys(opened: Page) -> None:
    entry = opened.locator("#graph-toy")
    entry.locator("summary").first.click()
    stage = entry.locator(".sg-live .sg-stage")
    stage.scroll_into_view_if_needed()
    entry.locator(".node").last.click()
    expect(entry.locator(".sg-node")).to_contain_text("A shortest run to a marked state")
    entry.locator(".sg-run").select_option("T-1")
    assert entry.locator(".node.on-path").count() == 2 and entry.locator(".edge.fired").count() == 1
    assert entry.locator(".node.last").get_attribute("data-node") == "1"
    entry.locator(".sg-run").select_option("")
    assert entry.locator(".on-path, .fired, .last").count() == 0
    stage.focus()
    opened.keyboard.press("/")
    expect(entry.locator(".sg-search")).to_be_focused()


def test_a_graph_that_is_closed_while_the_page_is_printed_is_there_again(opened: Page) -> None:
    entry = opened.locator("#graph-toy")
    entry.locator("summary").first.click()
    box = entry.locator(".node").last
    expect(box).to_be_visible()
    opened.wait_for_function("document.querySelector('#graph-toy .sg-world').style.transform !== 'none'")
    before = box.bounding_box()
    entry.locator("summary").first.click()
    for event in ("beforeprint", "afterprint"):
        opened.evaluate(f"dispatchEvent(new Event('{event}'))")
    entry.locator("summary").first.click()
    opened.wait_for_function("document.querySelector('#graph-toy .sg-world').style.transform !== 'none'")
    after = box.bounding_box()
    assert before and after and abs(before["width"] - after["width"]) < 2


def test_each_trace_has_pictures_of_its_own(opened: Page) -> None:
    opened.evaluate("document.querySelectorAll('.area').forEach(area => area.open = true)")
    for id in ("T-1", "T-2", "T-7"):
        opened.locator(f"#{id} summary").first.click()
        expect(opened.locator(f"#{id} .tl")).to_be_visible()
    now = [opened.locator(f"#{id} .tl-now") for id in ("T-1", "T-2")]
    assert now[0].inner_text() == now[1].inner_text()
    opened.locator("#T-2 .tl-first").click()
    assert "tick 153" in now[0].inner_text() and "tick 153" not in now[1].inner_text()
    expect(opened.locator("#T-7 .told")).to_be_visible()


def test_all_of_a_section_opens_and_closes(opened: Page) -> None:
    button = opened.locator("#section-charts .open-all")
    button.click()
    image = opened.locator("#chart-Relay img")
    expect(image).to_be_visible()
    assert image.evaluate("i => i.decode().then(() => i.naturalWidth)") > 300
    button.click()
    expect(image).to_be_hidden()


@pytest.mark.parametrize("width", [390, 1280])
def test_nothing_is_wider_than_the_window(opened: Page, width: int) -> None:
    opened.set_viewport_size({"width": width, "height": 844})
    opened.evaluate("document.querySelectorAll('details').forEach(d => d.open = true)")
    expect(opened.locator("#T-2 .tl")).to_be_visible()
    assert opened.evaluate("document.documentElement.scrollWidth") <= width


def test_on_paper_the_findings_are_open_and_the_controls_gone(opened: Page) -> None:
    opened.emulate_media(media="print")
    opened.evaluate("dispatchEvent(new Event('beforeprint'))")
    for id in ("T-1", "T-2", "T-3", "T-4"):
        expect(opened.locator(f"#{id} .body")).to_be_visible()
    assert opened.locator("#T-5 .body").is_hidden()
    assert opened.locator(".bar").is_hidden() and opened.locator(".filters").is_hidden()
    opened.evaluate("dispatchEvent(new Event('afterprint'))")
    assert opened.locator("#T-1").get_attribute("open") is None


def test_without_scripts_everything_but_the_moving_pictures_can_be_read(
    browser: Browser, tmp_path: Path, document: str
) -> None:
    file = tmp_path / "page.html"
    file.write_text(document, encoding="utf-8")
    context = browser.new_context(java_script_enabled=False)
    page = context.new_page()
    page.goto(file.as_uri())
    assert page.locator(".search").is_hidden() and page.locator(".filters").is_hidden()
    page.locator("#T-1 summary").first.click()
    expect(page.locator("#T-1 .told")).to_be_visible()
    context.close()


def test_words_without_end_are_broken(show: Show) -> None:
    long = "A" * 3000
    written = {"text": long, "english": (long,), "formula": (("that", long),), "because": long}
    one = checked("X" * 200, "violated", area="Z" * 150, trace=RUN, **written)
    page = show(render(review((one,))))
    page.set_viewport_size({"width": 390, "height": 844})
    page.evaluate("document.querySelectorAll('details').forEach(d => d.open = true)")
    expect(page.locator(".tl")).to_be_visible()
    assert page.evaluate("document.documentElement.scrollWidth") <= 390


def test_what_must_be_read_stands_out_in_the_dark_too(show: Show, document: str) -> None:
    for scheme in ("light", "dark"):
        page = show(document)
        page.emulate_media(color_scheme="dark" if scheme == "dark" else "light")
        page.evaluate("document.querySelectorAll('details').forEach(d => d.open = true)")
        expect(page.locator("#T-2 .tl")).to_be_visible()
        assert page.evaluate(PALE) == []
        page.add_style_tag(content=":root{--soft:#808080 !important}")
        assert page.evaluate(PALE), "grey on the panel is too pale in either scheme"


PALE = """() => {
  const numbers = (colour) => colour.match(/[\\d.]+/g).map(Number);
  const light = (colour) => colour.slice(0, 3).reduce((sum, part, i) => {
    const share = part / 255;
    return sum + [0.2126, 0.7152, 0.0722][i]
      * (share <= 0.04045 ? share / 12.92 : ((share + 0.055) / 1.055) ** 2.4);
  }, 0);
  const behind = (element) => {
    for (let at = element; at; at = at.parentElement) {
      const found = numbers(getComputedStyle(at).backgroundColor);
      if (found.length < 4 || found[3] === 1) return found;
    }
    return [255, 255, 255];
  };
  const told = (node) => node.nodeType === 3 && node.data.trim();
  const texts = [...document.querySelectorAll("body *:not(svg *, script, template)")].filter((element) =>
    element.getClientRects().length && [...element.childNodes].some(told));
  return texts.filter((element) => {
    const [a, b] = [numbers(getComputedStyle(element).color), behind(element)].map(light);
    return (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05) < 4.5;
  }).map((element) => element.outerHTML.slice(0, 80));
}"""
