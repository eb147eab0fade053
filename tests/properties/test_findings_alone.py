"""Every finding can be read alone: what goes wrong, why, since when, without looking up another one."""

import re

import pytest

from rovercheck.properties.catalogue import baseline, catalogue
from rovercheck.properties.expected import Acceptance, Expected, on_record
from rovercheck.properties.forms import Never
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.repairs import repairs

FINDINGS = {id: entry for id, entry in baseline().items() if entry.verdict != "proved"}
ELSEWHERE = re.compile(
    r"^(As|Like|See|Likewise|The same|After such)\b"
    r"|\b(as|see|like)( for| in)? P(B|S|-)[\w-]+(?=[.,;:)]|$)"
    r"|\bsee (above|below|also)\b|\bas above\b|\bditto\b",
    re.IGNORECASE,
)
"""What refers to a text that is not there."""


@pytest.mark.parametrize("id", FINDINGS)
def test_a_finding_says_what_goes_wrong_in_one_sentence(id: str) -> None:
    effect = FINDINGS[id].effect
    assert effect and effect[0].isupper() and effect.endswith(".")
    assert effect.count(". ") == 0, "one sentence"
    assert effect != catalogue()[id].text, "what is demanded is not what goes wrong"
    assert not re.search(r"\b(must not|should|shall)\b", effect), "what happens, not what ought"


def test_no_two_findings_say_the_same() -> None:
    said = [entry.effect for entry in FINDINGS.values()]
    assert len(set(said)) == len(said)


@pytest.mark.parametrize("id", FINDINGS)
def test_a_finding_needs_no_other_text(id: str) -> None:
    entry = FINDINGS[id]
    for text in (catalogue()[id].text, entry.effect, entry.because, entry.no_repair):
        assert not ELSEWHERE.search(text), text


def test_no_property_leans_on_the_one_before() -> None:
    assert [p.id for p in catalogue().values() if ELSEWHERE.search(p.text)] == []


@pytest.mark.parametrize(
    "text",
    ["The same for a forward command.", "As PB1-16a: transition 1.", "After such a window it is so.",
     "Late, as PB2-13a-0.", "It is bad, see above.", "See PB1-15."],
)  # fmt: skip
def test_what_refers_elsewhere_is_found(text: str) -> None:
    assert ELSEWHERE.search(text)


def test_what_must_never_be_is_not_stated_as_if_it_were_wanted() -> None:
    """``never`` is given the bad event: its sentence denies it, or bounds it."""
    denied = re.compile(r"\b(no|not|never|neither|nor|at most|only|ends)\b", re.IGNORECASE)
    asked = [prop for prop in catalogue().values() if isinstance(prop.form, Never)]
    assert len(asked) > 10
    assert [prop.id for prop in asked if not denied.search(prop.text)] == []


def test_it_is_known_since_when_and_which_finding_has_the_cause_too() -> None:
    assert all(entry.since is not None for entry in FINDINGS.values())
    for id, entry in FINDINGS.items():
        seen = [id]
        while (cause := FINDINGS[seen[-1]].same_cause) and cause not in seen:
            seen.append(cause)
        assert not cause, f"{id} leads round in a circle"
        assert entry.because, id


def test_what_no_repair_mends_says_why() -> None:
    mended = {id for one in repairs().values() for id in one.fixes}
    assert [id for id, entry in FINDINGS.items() if id not in mended and not entry.no_repair] == []


ENTRY = 'because = "So."\nverdict = "violated"\n'


@pytest.mark.parametrize(
    ("row", "said"),
    [
        ({"hazard": "H-2"}, ": A-1 names 'H-2', no hazard. Did you mean 'H-1'?"),
        ({"same_cause": "A-9"}, ": A-1 names 'A-9' as the finding with the same cause, which is no other"),
        ({"same_cause": "A-1"}, ": A-1 names 'A-1' as the finding with the same cause, which is no other"),
        ({"since": "2026-03-01"},
         ": A-1 has since = '2026-03-01'; write a date such as 2026-03-01, without quotes."),
        ({"accepted": "yes"}, ": A-1 has accepted = 'yes'; write a table."),
        ({"accepted": {"because": " "}},
         ": A-1 is accepted without a reason; write because = in its table .accepted."),
        ({"accepted": {"because": "So.", "till": 1}}, ": A-1, accepted, has no 'till'."),
        ({"accepted": {"because": "So.", "until": "soon"}},
         ": A-1, accepted, has until = 'soon'; write a date such as 2026-03-01, without quotes."),
        ({"effect": 3}, ": A-1 has effect = 3; write a text."),
    ],
)  # fmt: skip
def test_what_an_entry_says_without_meaning_is_told(row: dict[str, object], said: str) -> None:
    whole = {"A-1": {"verdict": "violated", "because": "So.", **row}, "A-2": {"no_fault": "None."}}
    with pytest.raises(ModelError) as raised:
        on_record(whole, ["A-1", "A-2"], "b.toml", ["H-1"])
    [line] = str(raised.value).splitlines()
    assert line.startswith(f"b.toml{said}")


def test_a_hazard_without_a_file_of_hazards_is_told() -> None:
    with pytest.raises(ModelError, match=r"there is none; write hazards.toml beside the model"):
        on_record({"A-1": {"verdict": "violated", "because": "So.", "hazard": "H"}}, ["A-1"], "b.toml")


def test_an_acceptance_is_reason_enough_for_an_entry() -> None:
    row = {"verdict": "violated", "accepted": {"because": "So."}}
    assert on_record({"A-1": row}, ["A-1"], "b.toml") == {
        "A-1": Expected("violated", accepted=Acceptance("So."))
    }
