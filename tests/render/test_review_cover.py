"""The first pages of a review: the worst findings, totals that add up, and what is open."""

from dataclasses import replace

from rovercheck.checker.render.review import render
from rovercheck.checker.render.review.cover import (
    WORST,
    decision_state,
    hazard_totals,
    identity,
    open_points,
    worst,
)
from rovercheck.checker.render.review.model import HazardRow
from tests.render.toy_review import BROKEN, CHANGED, EVIL, FINE, OPEN, SAME, checked, review

HAZARDS = {
    "H-1": HazardRow("H-1", "It bites.", "catastrophic", "§1 says so."),
    "H-2": HazardRow("H-2", EVIL, "marginal", EVIL),
}


def test_the_worst_findings_are_the_gravest_one_for_each_cause() -> None:
    graver = replace(SAME, place=0, effect="It bites.")
    found = worst(review((replace(BROKEN, place=1), graver, replace(OPEN, place=2), FINE)))
    assert [(one.finding.id, one.same) for one in found] == [("T-2", 1), ("T-4", 0)]
    many = tuple(checked(f"T-{n}", "violated", place=n) for n in reversed(range(WORST + 3)))
    assert [one.finding.id for one in worst(review(many))] == [f"T-{n}" for n in range(WORST)]
    shown = render(review(many))
    assert f"The {WORST} worst findings <small>of {WORST + 3}</small>" in shown
    assert f"All {WORST + 3} findings" in shown


def test_totals_of_hazards_count_every_property_once() -> None:
    kinds = (
        replace(BROKEN, hazard="H-1"),
        replace(SAME, hazard="H-1", accepted=True),
        replace(OPEN, hazard="H-2"),
        FINE,
    )
    made = replace(review(kinds), hazards=HAZARDS)
    rows = {one.hazard.id: one for one in hazard_totals(made)}
    assert list(rows) == ["H-1", "H-2", ""]
    one = rows["H-1"]
    assert (one.violated, one.accepted, one.unknown, one.proved) == (2, 1, 0, 0)
    assert sum(row.violated + row.unknown + row.proved for row in rows.values()) == len(kinds)
    none_left = replace(made, properties=kinds[:3])
    assert [row.hazard.id for row in hazard_totals(none_left)] == ["H-1", "H-2"]


def test_what_is_open_is_named_and_what_is_accepted_is_not() -> None:
    over = replace(SAME, lapsed=True, decision="accepted until 2026-01-01, which is over: x")
    accepted = replace(BROKEN, accepted=True)
    found = open_points(review((accepted, over, CHANGED, OPEN, FINE)))
    assert [(says, [p.id for p in of]) for says, of in found.named] == [
        ("not as expected", ["T-3"]),
        ("not decided within the limits", ["T-4"]),
        ("accepted until a day that is over", ["T-2"]),
        ("violated, and nobody has accepted it", ["T-2"]),
    ]
    assert found.count == 3
    states = [decision_state(one) for one in (accepted, over, OPEN, FINE)]
    assert states == ["accepted", "expired", "open", ""]


def test_the_cover_says_who_reviews_what() -> None:
    made = replace(
        review().origin, document=EVIL, commit="0123456789", reviewer="A. Rossi", date="2026-03-01"
    )
    shown = render(replace(review(), origin=made))
    start = shown.index('id="section-cover"')
    cover = shown[start : shown.index("</section>", start)]
    for said in ("0123456789", "A. Rossi", "2026-03-01", "Python 3", "Exit code 1: changed"):
        assert said in cover
    assert "<script>document" not in cover


def test_decisions_of_another_page_are_not_taken_for_those_of_this_one() -> None:
    one = review()
    other = replace(one, origin=replace(one.origin, digests=(("toy", "cd34" * 16),)))
    assert identity(one) == identity(replace(one, properties=())) != identity(other)
