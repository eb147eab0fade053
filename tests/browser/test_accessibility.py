"""What axe-core finds on the review page, in light and dark, closed and opened, wide and narrow."""

from dataclasses import replace
from importlib.resources import files
from typing import Any

import pytest

from rovercheck.checker.render.review import render
from tests.browser.conftest import Show
from tests.render.test_review_cover import HAZARDS
from tests.render.toy_review import ALL, review

AXE = files("axe_playwright_python").joinpath("axe.min.js")
GRAVE = {"serious", "critical"}
SEVERITY = {"H-1": "catastrophic", "H-2": "marginal", "": "unrated"}


@pytest.fixture(scope="module")
def document() -> str:
    rated = tuple(
        replace(one, hazard=id, severity=SEVERITY[id], since="2026-03-01", lapsed=id == "H-2")
        for one, id in zip(ALL, ("H-1", "H-2", "", "H-1", "H-2", "", "H-1"), strict=True)
    )
    return render(replace(review(rated), hazards=HAZARDS))


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("width", [390, 1280])
def test_nothing_keeps_anybody_from_reading_the_page(
    show: Show, document: str, scheme: Any, width: int
) -> None:
    page = show(document)
    page.emulate_media(color_scheme=scheme)
    page.set_viewport_size({"width": width, "height": 900})
    page.evaluate(AXE.read_text(encoding="utf-8") + "; 0")
    assert graves(page) == []
    page.evaluate("document.querySelectorAll('details').forEach(d => d.open = true)")
    for id in ("T-1", "T-7"):
        page.locator(f"#{id} .tl").wait_for()
    assert graves(page) == []
    page.evaluate(
        "document.querySelector('.d-reviewer').closest('label').replaceWith(document.createElement('input'))"
    )
    assert [found[0] for found in graves(page)] == ["label"], "a field without a name is found"


def graves(page: Any) -> list[tuple[str, list[str]]]:
    """The violations that are grave, each with the elements."""
    found = page.evaluate("axe.run({ resultTypes: ['violations'] })")["violations"]
    return [
        (one["id"], [node["html"][:120] for node in one["nodes"]]) for one in found if one["impact"] in GRAVE
    ]
