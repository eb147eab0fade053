"""Decisions on findings: made on the page, saved with it, and exported as ``accept --from`` reads them."""

import json
from dataclasses import replace
from pathlib import Path

import pytest
from playwright.sync_api import Page, expect

from rovercheck.checker.commands.accept.document import SCHEMA, read
from rovercheck.checker.render.review import render
from tests.browser.conftest import Show
from tests.render.toy_review import ALL, BROKEN, EVIL, review

OVER = "accepted until 2026-01-01, which is over: x"


@pytest.fixture(scope="module")
def document() -> str:
    return render(review(tuple(replace(p, lapsed=True, decision=OVER) if p.id == "T-2" else p for p in ALL)))


@pytest.fixture
def opened(show: Show, document: str) -> Page:
    return show(document)


def decide(page: Page, id: str, decision: str, because: str = "", owner: str = "", until: str = "") -> None:
    """Decide as a reader does: open the finding, choose, write."""
    finding = page.locator(f"#{id}")
    if finding.get_attribute("open") is None:
        finding.locator("summary").first.click()
    choice = finding.locator(f".decide input[value={decision}]")
    choice.press("Space")  # by the keyboard: a click misses it where the page still moves
    expect(choice).to_be_checked()
    for name, text in (("because", because), ("owner", owner), ("until", until)):
        if text:
            finding.locator(f".d-{name}").fill(text)


def downloaded(page: Page, button: str, to: Path) -> Path:
    with page.expect_download() as coming:
        page.locator(button).click()
    coming.value.save_as(to)
    return to


def state(page: Page, id: str) -> str:
    return page.locator(f"tr[data-finding='{id}'] .d-state").inner_text()


def test_an_acceptance_is_exported_as_the_command_reads_it(opened: Page, tmp_path: Path) -> None:
    decide(opened, "T-1", "accepted", f" Known {EVIL} ", "A. Rossi", "2999-12-31")
    decide(opened, "T-2", "repair", "The chart is wrong.")
    decide(opened, "T-3", "reject", "It is no fault.")
    file = downloaded(opened, ".d-export", tmp_path / "decisions.json")
    assert json.loads(file.read_text(encoding="utf-8"))["schema"] == SCHEMA
    assert read(file) == [
        {
            "id": "T-1",
            "decision": "accepted",
            "because": f"Known {EVIL}",
            "owner": "A. Rossi",
            "until": "2999-12-31",
        },
        {"id": "T-2", "decision": "open", "because": "The chart is wrong."},
    ]
    expect(opened.locator(".d-status")).to_contain_text("1 to be repaired or rejected")


@pytest.mark.parametrize(
    ("because", "until", "says"), [("", "", "Write why"), ("So.", "2020-01-01", "is over")]
)
def test_what_the_command_would_refuse_is_not_exported(
    opened: Page, because: str, until: str, says: str
) -> None:
    decide(opened, "T-1", "accepted", because, until=until)
    expect(opened.locator("#T-1 .d-fault")).to_contain_text(says)
    opened.locator(".d-export").click()
    expect(opened.locator(".d-status")).to_contain_text("Nothing to export")
    for said in ("T-1", says, "No reviewer is named."):
        expect(opened.locator(".d-status")).to_contain_text(said)


def test_a_decision_is_shown_in_the_finding_until_it_is_taken_back(opened: Page) -> None:
    shown = opened.locator("dd[data-decision='T-2']")
    decide(opened, "T-2", "repair", "The chart is wrong.")
    expect(shown).to_have_text("to be repaired, on this page")
    opened.locator("#T-2 .d-clear").click()
    expect(shown).to_have_text(OVER)


def test_a_page_that_is_saved_has_its_decisions_and_can_be_saved_again(
    opened: Page, tmp_path: Path, document: str
) -> None:
    decide(opened, "T-1", "accepted", EVIL)
    opened.locator(".d-reviewer").fill("A. Rossi")
    opened.locator("#table-findings th button").first.click()
    opened.locator(".search input").fill("second")
    expect(opened.locator(".hits")).not_to_be_empty()
    opened.keyboard.press("Escape")
    saved = downloaded(opened, ".d-save", tmp_path / "saved.html")
    browser = opened.context.browser
    assert browser is not None
    other = browser.new_context().new_page()
    wrong: list[str] = []
    other.on("pageerror", lambda error: wrong.append(str(error)))
    other.on("console", lambda m: wrong.append(m.text))
    other.goto(saved.as_uri())
    assert state(other, "T-1") == "to be accepted"
    expect(other.locator(".reviewer")).to_have_text("A. Rossi")
    other.locator("#T-1 summary").first.click()
    assert other.locator("#T-1 .d-because").input_value() == EVIL
    expect(other.locator("#T-1 .tl")).to_be_visible()
    assert other.locator("#T-1 .decide").count() == 1 and other.locator("th button button").count() == 0
    again = downloaded(other, ".d-save", tmp_path / "again.html")
    size = len(saved.read_text(encoding="utf-8"))
    assert abs(len(again.read_text(encoding="utf-8")) - size) <= 1
    assert abs(size - len(document)) < 2000
    assert "broken" not in other.title().partition("<script>")[0] and wrong == []
    other.context.close()


def test_decisions_outlive_the_page_in_the_browser_until_they_are_taken_back(opened: Page) -> None:
    decide(opened, "T-1", "repair", "Later.")
    opened.reload()
    assert state(opened, "T-1") == "to be repaired"
    expect(opened.locator(".decided-here")).to_have_text("; 1 decided on this page")
    opened.locator("#T-1 summary").first.click()
    opened.locator("#T-1 .d-clear").click()
    assert state(opened, "T-1") == "open"
    opened.reload()
    assert state(opened, "T-1") == "open"


def test_where_the_browser_keeps_nothing_that_is_said(opened: Page) -> None:
    opened.evaluate("void (Storage.prototype.setItem = () => { throw new DOMException('full') })")
    decide(opened, "T-1", "repair")
    expect(opened.locator(".d-status")).to_contain_text("save it before you close it")


def test_tables_are_sorted_by_the_keyboard_and_say_so(opened: Page) -> None:
    def ids() -> list[str]:
        found: list[str] = opened.locator("#table-findings tbody tr").evaluate_all(
            "rows => rows.map((row) => row.dataset.finding)"
        )
        return found

    head = opened.locator("#table-findings th", has_text="finding")
    head.locator("button").focus()
    opened.keyboard.press("Enter")
    assert head.get_attribute("aria-sort") == "ascending" and ids() == ["T-1", "T-2", "T-3", "T-4"]
    opened.keyboard.press("Enter")
    assert head.get_attribute("aria-sort") == "descending" and ids() == ["T-4", "T-3", "T-2", "T-1"]
    opened.locator("#table-findings th button", has_text="no.").click()
    assert head.get_attribute("aria-sort") is None


def test_a_filter_leaves_the_rows_with_all_its_words(opened: Page) -> None:
    field = opened.locator(".table-filter[data-table=table-requirements]")
    field.fill("R-2 second")
    assert opened.locator("#table-requirements tbody tr:visible").count() == 1
    field.fill("")
    assert opened.locator("#table-requirements tbody tr:visible").count() == 3


def test_what_a_proof_rests_on_is_filled_in_when_it_is_opened(opened: Page) -> None:
    opened.goto(opened.url + "#T-7")
    entry = opened.locator("#T-7")
    expect(entry.locator(".body dl")).to_be_visible()
    expect(entry.locator(".tl")).to_be_visible()
    assert opened.locator("#T-5 dl").count() == 0
    assert BROKEN.id == "T-1" and opened.locator("#T-1 dl").count() == 1
