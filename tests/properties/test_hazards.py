"""Hazards: those of the rover rate every finding, and a faulty file of them gets one clear message each."""

from typing import Any

import pytest

from rovercheck.checker.model.rover import rover
from rovercheck.properties.catalogue import baseline, catalogue
from rovercheck.properties.hazards import RATED, UNRATED, Severity, gravest_of, hazards, hazards_in
from rovercheck.properties.requirements import requirements
from rovercheck.spec_model.lang.errors import ModelError

KNOWN = ["R-1", "R-2", "R-3"]
GOOD: dict[str, Any] = {
    "text": "It bites.", "severity": "critical", "because": "§1 says so.", "requirements": ["R-1"],
}  # fmt: skip


def test_every_requirement_that_a_property_covers_is_rated() -> None:
    rated = {id for one in hazards().values() for id in one.requirements}
    assert {id for prop in catalogue().values() for id in prop.covers} <= rated <= requirements().keys()


def test_the_hazards_of_the_rover_quote_the_document() -> None:
    assert rover().hazards == hazards()
    assert all("§" in one.because and one.because.endswith(".") for one in hazards().values())
    assert [one.severity.rank for one in hazards().values()] == sorted(
        one.severity.rank for one in hazards().values()
    )
    assert next(iter(hazards().values())).severity is Severity.CATASTROPHIC


def test_a_finding_has_the_gravest_hazard_of_its_requirements_or_the_one_it_names() -> None:
    known = hazards()
    assert gravest_of(["B1-REF-05", "B1-REF-06"], known).id == "H-CRITICAL-MOTION"
    assert gravest_of(["B1-REF-05", "B1-REF-06"], known, "H-DISOBEYED").id == "H-DISOBEYED"
    assert gravest_of(["no such"], known) is UNRATED and gravest_of([], {}) is UNRATED


def test_no_hazard_is_named_that_would_be_taken_anyway() -> None:
    for id, entry in baseline().items():
        if entry.hazard:
            assert gravest_of(catalogue()[id].covers, hazards()).id != entry.hazard, id


def test_what_nobody_rated_stands_before_what_was_rated_negligible() -> None:
    assert list(Severity)[-2:] == [Severity.UNRATED, Severity.NEGLIGIBLE] and Severity.UNRATED not in RATED


def test_hazards_are_in_the_order_of_severity_and_then_of_the_file() -> None:
    rows = {
        "H-3": {**GOOD, "severity": "negligible"}, "H-1": {**GOOD, "severity": "critical"},
        "H-0": {**GOOD, "severity": "catastrophic"}, "H-2": {**GOOD, "severity": "critical"},
    }  # fmt: skip
    assert list(hazards_in(rows, KNOWN, "h.toml")) == ["H-0", "H-1", "H-2", "H-3"]


@pytest.mark.parametrize(
    ("row", "said"),
    [
        ("R-1", "h.toml: H-1 is 'R-1'; write a table with text, severity, because, requirements."),
        ({**GOOD, "severity": "severe"},
         "h.toml: H-1 has severity = 'severe'; write catastrophic, critical, marginal or negligible."),
        ({**GOOD, "severity": "unrated"},
         "h.toml: H-1 has severity = 'unrated'; write catastrophic, critical, marginal or negligible."),
        ({**GOOD, "severity": ["critical"]},
         "h.toml: H-1 has severity = ['critical']; write catastrophic, critical, marginal or negligible."),
        ({**GOOD, "text": " "}, "h.toml: H-1 has text = ' '; write a sentence."),
        ({**GOOD, "because": 3}, "h.toml: H-1 has because = 3; write a sentence."),
        ({**GOOD, "requirements": []},
         "h.toml: H-1 has requirements = []; write the ids of one at least, in a list."),
        ({**GOOD, "requirements": "R-1"},
         "h.toml: H-1 has requirements = 'R-1'; write the ids of one at least, in a list."),
        ({**GOOD, "requirements": ["R-9"]}, "h.toml: H-1 names 'R-9', no requirement."),
        ({**GOOD, "requirements": ["R-1", "R-2", "R-1"]}, "h.toml: H-1 names R-1 twice; delete one."),
        ({**GOOD, "requirement": ["R-1"]}, "h.toml: H-1 has no 'requirement'. Did you mean 'requirements'?"),
    ],
)  # fmt: skip
def test_what_has_no_meaning_is_said(row: Any, said: str) -> None:
    with pytest.raises(ModelError) as raised:
        hazards_in({"H-0": GOOD, "H-1": row}, KNOWN, "h.toml")
    [line] = str(raised.value).splitlines()
    assert line.startswith(said)


def test_every_fault_of_a_file_is_said_at_once() -> None:
    with pytest.raises(ModelError) as raised:
        hazards_in({"H-1": {}, "H-2": {**GOOD, "severity": ""}}, KNOWN, "h.toml")
    assert len(str(raised.value).splitlines()) == 5
