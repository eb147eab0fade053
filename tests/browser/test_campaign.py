"""The page of a campaign under a reader's hands: a finding is chosen, on a phone, on paper."""

from dataclasses import replace

import pytest
from playwright.sync_api import Page, expect

from rovercheck.checker.render.campaign import campaign_page
from rovercheck.checker.results.campaign import (
    OF_LOGS,
    CampaignFinding,
    CampaignOccurrence,
    CampaignRecord,
    CampaignRecording,
    CampaignSighting,
    OutputLane,
    OutputMoment,
)

LONG = "<script>document.title='broken'</script>_" + "a_very_long_name_of_a_log" * 4 + ".csv"
A4 = 718
"""Pixels of CSS between margins of 1 cm."""


def finding(number: int) -> CampaignFinding:
    first = CampaignOccurrence(LONG, 60 + number, 1_200, 61 + number)
    worst = replace(first, tick=100, ms=2_000, ticks=1_204)
    moments = tuple(
        OutputMoment(
            t, "WHEEL_DEGRADED_ENCODER", "WHEEL_OK" if t == 61 else "WHEEL_DEGRADED_ENCODER", t == 61
        )
        for t in range(50, 90)
    )
    return CampaignFinding(
        f"board1-wheel-{number}", "board1", "new", f"Monitor_wheel: wheel_status_{number} is WHEEL_OK",
        (("inputs", ", ".join(f"input_{n} = true" for n in range(30))),),
        (CampaignSighting(LONG, first, worst, 1_000_000, 3),),
        (OutputLane(f"wheel_status_{number}", moments),),
    )  # fmt: skip


RECORD = CampaignRecord(
    "logs",
    OF_LOGS,
    "",
    [
        CampaignRecording(LONG, "board1", "deviates", "1,000,000 ticks = 20000 s"),
        CampaignRecording("other.csv", "", "not read", "", "line 3: no number", (("a" * 300, "unknown"),)),
    ],
    [finding(n) for n in range(1, 31)],
)


@pytest.fixture
def opened(show) -> Page:
    page: Page = show(campaign_page(RECORD))
    return page


def test_a_finding_that_is_chosen_shows_its_timeline(opened: Page) -> None:
    assert opened.title() == "logs"
    figure = opened.locator("#f23 figure")
    expect(figure).not_to_be_in_viewport()
    opened.get_by_role("link", name="#23", exact=True).click()
    expect(figure).to_be_in_viewport()
    expect(figure.locator("figcaption")).to_contain_text("wheel_status_23, ticks 50 to 89")
    wrong = figure.locator(".differs")
    expect(wrong).to_have_count(2)
    expect(wrong.last).to_have_attribute("title", "WHEEL_OK, 1 tick")
    expect(figure.locator(".told")).to_be_hidden()


def test_on_a_phone_only_the_tables_scroll(opened: Page) -> None:
    opened.set_viewport_size({"width": 390, "height": 800})
    assert opened.evaluate("document.documentElement.scrollWidth") <= 390
    told = opened.locator("#f1 .told")
    expect(told).to_contain_text("tick 61: WHEEL_DEGRADED_ENCODER, logged WHEEL_OK")


@pytest.mark.parametrize("width", [A4, 690])
def test_on_paper_nothing_is_cut(opened: Page, width: int) -> None:
    opened.set_viewport_size({"width": width, "height": 1_000})
    opened.emulate_media(media="print")
    beyond = opened.evaluate(
        "[...document.querySelectorAll('body *')].filter(e => e.getBoundingClientRect().right >"
        " document.documentElement.clientWidth + 1).map(e => e.outerHTML.slice(0, 80))"
    )
    assert beyond == []
    expect(opened.locator("#f30 .told")).to_be_visible()
    assert opened.pdf(format="A4").startswith(b"%PDF-")


def test_all_findings_are_columns_of_some_table(opened: Page) -> None:
    heads = opened.locator("thead a").all_inner_texts()
    assert heads == [f"#{n}" for n in range(1, 31)]
    links = opened.locator("td a")
    expect(links).to_have_count(30)
