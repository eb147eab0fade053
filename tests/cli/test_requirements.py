"""The requirement matrix: what covers a requirement, what a reason is for, and what the command says."""

import json
import re
from dataclasses import replace
from pathlib import Path

import pytest
from jsonschema import validate

from rovercheck.checker.cli import run
from rovercheck.checker.commands.report.causes import with_reasons
from rovercheck.checker.commands.reports.finding import CAUSE, NOT_ASKED
from rovercheck.checker.commands.reports.run import differences, pages_of_verdicts
from rovercheck.checker.commands.requirements.run import (
    DECIDED,
    EXPECTED,
    because,
    counts,
    page,
    show,
    words,
)
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.commands.shared.verdicts import results
from rovercheck.checker.model.rover import rover
from rovercheck.checker.verify.checked import CheckedProperty
from rovercheck.properties.catalogue import catalogue, expected
from rovercheck.properties.coverage import RequirementCoverage, matrix
from rovercheck.properties.forms import Property, always, reachable
from rovercheck.properties.requirements import Requirement, requirements
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import flag
from rovercheck.spec_model.rover import systems
from tests.schemas import published

ROOT = Path(__file__).parents[2]
x = flag("x")


def register(**reasons: str) -> dict[str, Requirement]:
    return {id: Requirement(id, "It is so.", "§1", "–", "invariant", "yes", r) for id, r in reasons.items()}


def demand(id: str, *covers: str) -> Property:
    return always(id, "It is so.", that=x, covers=covers, on="toy")


def possibility(id: str, *covers: str) -> Property:
    return reachable(id, "It can be so.", that=x, covers=covers, on="toy")


ROWS = matrix(
    [demand("A", "R1", "R2"), demand("B", "R2"), possibility("C", "R1", "R3", "R4")],
    register(R1="", R2="", R3="not modelled: the weather.", R4="", R5=""),
)
VERDICTS = {"A": "proved", "B": "violated", "C": "proved"}


# --- coverage ------------------------------------------------------------------------------------


def test_a_row_is_in_one_of_five_states() -> None:
    states = [row.state(VERDICTS) for row in ROWS]
    assert states == ["proved", "violated", "reason", "reached", "open"]


def test_that_a_state_can_be_reached_covers_nothing() -> None:
    assert [row.requirement.id for row in ROWS if row.open] == ["R4", "R5"]


@pytest.mark.parametrize("verdict", ["violated", "unknown"])
def test_the_worst_verdict_counts(verdict: str) -> None:
    assert ROWS[0].state({**VERDICTS, "A": verdict}) == verdict


def test_a_reason_on_a_covered_row_is_an_error() -> None:
    with pytest.raises(ModelError, match="says why no property covers R1, but A does; delete its reason"):
        matrix([possibility("C", "R1"), demand("A", "R1")], register(R1="by construction: so it is."))


def test_a_property_that_names_an_unknown_requirement_is_in_no_row() -> None:
    assert [row.properties for row in matrix([demand("A", "R9")], register(R1=""))] == [()]


# --- what is said --------------------------------------------------------------------------------


def test_a_row_groups_its_properties_by_what_is_known_of_them() -> None:
    assert [because(row, VERDICTS) for row in ROWS] == [
        "A; reached by C",
        "B; proved A",
        "not modelled: the weather; reached by C",
        "reached by C",
        "neither a property nor a reason",
    ]


def test_the_counts_say_what_is_open() -> None:
    assert counts(ROWS, VERDICTS) == (
        "5 requirements: 2 covered (1 by proved properties only; 1 by some violated property), "
        "1 with a reason instead (1 not modelled), 2 open.",
        "Open: R4, R5.",
    )


@pytest.mark.parametrize(("rows", "code"), [(ROWS, Exit.FAILED), (ROWS[:3], Exit.AS_EXPECTED)])
@pytest.mark.parametrize("as_json", [False, True])
def test_an_open_row_is_exit_code_1(
    rows: tuple[RequirementCoverage, ...], code: Exit, as_json: bool, capfd: pytest.CaptureFixture[str]
) -> None:
    assert show(rows, VERDICTS, EXPECTED, as_json) == code
    shown = capfd.readouterr().out
    assert EXPECTED in (json.loads(shown)["verdicts"] if as_json else shown)


# --- the command on the rover --------------------------------------------------------------------


def test_the_table_has_a_line_for_every_requirement(capfd: pytest.CaptureFixture[str]) -> None:
    run(["requirements"])
    shown = capfd.readouterr().out.splitlines()
    listed = [line.split()[0] for line in shown if re.match(r"B[12]-[A-Z]+-\d+ +[a-z]", line)]
    assert listed == list(requirements())


def test_the_json_says_of_each_property_what_is_on_record(capfd: pytest.CaptureFixture[str]) -> None:
    code = run(["requirements", "--json"])
    found = json.loads(capfd.readouterr().out)
    validate(found, published("requirements-1"))
    assert (found["schema"], found["exit"]) == ("rovercheck/requirements/1", int(code))
    [row] = [row for row in found["requirements"] if row["id"] == "B1-REL-04"]
    assert row["state"] == "violated"
    assert {"id": "PB1-15", "verdict": "violated", "covers": True} in row["properties"]
    assert {"id": "REACH-RELAY-RETURN", "verdict": "proved", "covers": False} in row["properties"]


def test_verdicts_can_be_decided_now(
    monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    some = {id: catalogue()[id] for id in ("PB1-11", "PB2-12-first")}
    model = replace(rover(), properties=some)
    monkeypatch.setattr("rovercheck.checker.commands.requirements.run.rover", lambda: model)
    code = run(["requirements", "--check", "--json"])
    found = json.loads(capfd.readouterr().out)
    assert (code, found["verdicts"]) == (Exit.FAILED, DECIDED)
    [row] = [row for row in found["requirements"] if row["id"] == "B2-OBS-04"]
    assert row["properties"] == [{"id": "PB2-12-first", "verdict": "violated", "covers": True}]


# --- the reasons ---------------------------------------------------------------------------------

REASONS = {id: item.reason for id, item in requirements().items() if item.reason}
PLACE = re.compile(r"((?:spec_model|properties|tests)/[\w/]+\.py): ([\w, ]+)")


def test_what_a_property_cannot_check_has_a_reason() -> None:
    rows = matrix(catalogue().values())
    assert [r.requirement.id for r in rows if r.open and not r.requirement.checkable.startswith("yes")] == []


@pytest.mark.parametrize("id", REASONS)
def test_a_reason_says_which_kind_it_is_and_names_what_exists(id: str) -> None:
    reason = REASONS[id]
    assert reason.startswith(("by construction: ", "not modelled: ")) and reason.endswith(".")
    places = PLACE.findall(reason)
    assert places or reason.startswith("not modelled: ")
    for file, names in places:
        text = (ROOT / file).read_text(encoding="utf-8")
        assert [n for n in names.split(", ") if not re.search(rf"\b(test_)?{n}(_|\b)", text)] == []


# --- the reports ---------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def found() -> list[CheckedProperty]:
    some = [catalogue()[id] for id in ("PB1-11", "PB2-12-first", "REACH-WHEEL-DEG")]
    return [CheckedProperty(r, expected(r.property.id)) for r in results(some, systems())]


def test_the_page_links_a_violation_to_its_finding(found: list[CheckedProperty]) -> None:
    rows = {line.split(" | ")[0].strip("| "): line for line in page(found).splitlines() if " | " in line}
    assert rows["B2-OBS-04"].endswith("| violated | [PB2-12-first](findings/PB2-12-first.md) |")
    assert rows["B1-REL-02"].endswith("| proved | PB1-11 |")
    assert rows["B1-WHL-01"].endswith("| reached | reached by REACH-WHEEL-DEG |")
    assert "| reason | by construction: " in rows["B1-GEN-01"]
    assert words(found)["PB2-12-first"] == "violated"


def test_the_reports_say_what_is_checked(found: list[CheckedProperty]) -> None:
    made = pages_of_verdicts(found)
    said = "Formally: In every step in which “nearest &lt;= 300” holds, B2DecDegraded is 6."
    meant = "“nearest &lt;= 300” means: d1 is at most 300 cm or d2 is at most 300 cm or d3 is at most 300 cm."
    assert f"</summary>{said}<br>{meant}</details>" in made["README.md"]
    assert f"\n> {said}\n>\n> {meant}\n" in made["findings/PB2-12-first.md"]
    assert "“a link is critical” means: rx_status is RX_CRITICAL or" in made["README.md"]


def test_a_finding_names_its_cause_and_that_is_not_looked_for_again(
    found: list[CheckedProperty], tmp_path: Path
) -> None:
    name, without = "findings/PB2-12-first.md", pages_of_verdicts(found)
    made = pages_of_verdicts(with_reasons(found, systems()))
    needed = (
        "| tick 1 | 20 ms | <code>d3 != 301 cm</code> |\n\nWhatever the other inputs are, every run of 1 tick"
    )
    assert f"\n{CAUSE}\n\n| Ticks | ms | Input |\n|---|---:|---|\n{needed}" in made[name]
    assert NOT_ASKED in without[name] and NOT_ASKED not in made[name]
    for file, text in made.items():
        (tmp_path / file).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / file).write_text(text, encoding="utf-8")
    assert list(differences(tmp_path, made)) == list(differences(tmp_path, without)) == []
    (tmp_path / name).write_text(made[name].replace(CAUSE, "## What"), encoding="utf-8")
    assert name in differences(tmp_path, without), "some answer must be there"
    (tmp_path / name).write_text(made[name].replace("d3 !=", "d2 !="), encoding="utf-8")
    assert name in differences(tmp_path, made)
