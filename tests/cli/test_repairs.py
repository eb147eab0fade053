"""``--repair`` and ``list repairs``: proposed changes of the charts on the command line."""

from pathlib import Path

import pytest

from rovercheck.checker.cli import run
from rovercheck.checker.commands.reports.promises import page
from rovercheck.checker.commands.reports.repairs import Proof, repair_pages, sections
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.commands.shared.verdicts import results
from rovercheck.checker.model.variant import Variant
from rovercheck.properties.catalogue import expected, promises
from rovercheck.spec_model.repairs import repairs


def shown(capfd: pytest.CaptureFixture[str]) -> str:
    found = capfd.readouterr()
    return " ".join((found.out + found.err).split())


def test_with_its_repair_a_finding_is_proved(capfd: pytest.CaptureFixture[str]) -> None:
    assert run(["check", "PB2-12-first", "--repair", "degraded-first-step"]) == Exit.AS_EXPECTED
    assert "✓ PB2-12-first proved" in shown(capfd)


def test_a_property_that_a_repair_gives_up_is_violated_as_promised(capfd: pytest.CaptureFixture[str]) -> None:
    assert run(["check", "PB1-03", "--repair", "temperature-absent-stops"]) == Exit.AS_EXPECTED
    assert "✗ PB1-03 violated" in shown(capfd)


def test_a_chart_is_drawn_with_its_repair(tmp_path: Path) -> None:
    plain, repaired = tmp_path / "plain.svg", tmp_path / "repaired.svg"
    assert run(["graph", "ObstaclesDegraded", "-o", str(plain)]) == Exit.AS_EXPECTED
    assert run(["graph", "ObstaclesDegraded", "--repair", "degraded-first-step", "-o", str(repaired)]) == 0
    assert plain.read_text() != repaired.read_text()


def test_an_unknown_repair_is_a_slip_with_a_near_name(capfd: pytest.CaptureFixture[str]) -> None:
    assert run(["check", "--repair", "degraded-first-stp"]) == Exit.USAGE
    assert "There is no repair 'degraded-first-stp'. Did you mean 'degraded-first-step'" in shown(capfd)


def test_every_repair_is_listed_with_what_it_repairs(capfd: pytest.CaptureFixture[str]) -> None:
    assert run(["list", "repairs"]) == Exit.AS_EXPECTED
    listed = shown(capfd)
    assert all(name in listed for name in (*repairs(), "all"))


def test_the_pages_show_the_changed_transitions_and_the_picture_of_the_repaired_chart() -> None:
    proof = Proof(repairs()["battery-gap-releases"], ())
    page = "\n".join(sections("PB1-29", expected("PB1-29"), [proof]))
    assert "[Monitor_battery, repaired](../repairs/battery-gap-releases/Monitor_battery.svg)" in page
    assert "| transitions of Batt_CRIT | <code>1: → decide</code> |" in page and "2: → Batt_DEG" in page
    made = repair_pages([proof])
    assert set(made) == {"repairs/README.md", "repairs/battery-gap-releases/Monitor_battery.svg"}


def test_the_page_of_promises_says_what_holds_with_each_repair() -> None:
    """Decided now, or as expected, which ``check --repair NAME`` decides again."""
    repair = repairs()["relay-without-delay"]
    variant = Variant(repair.interpretations, repair)
    decided = results([variant.properties()["PB1-15"]], variant.systems())
    text = page([], [Proof(repair, tuple(decided))])
    rows = [row.split(" | ") for row in text.splitlines() if row.startswith("| [")]
    told = {(row[0].partition("]")[0][3:], row[1]): row[2] for row in rows}
    assert told["relay-without-delay", "PB1-15"] == "proved"
    assert told["monitor-critical-by-age", "P-WEATHER-IMU-2"] == "proved for a restricted model*"
    for promise in promises():
        for id in promise.required:
            for name in (name for name, one in repairs().items() if id in one.fixes):
                assert (name, id) in told


def test_the_page_of_promises_says_which_chains_a_repair_breaks() -> None:
    tree = page([]).partition("- PSY-10e ")[2].partition("\n- ")[0]
    assert "no longer holds with a repair that gives up a link: " in tree
    assert "[safety-critical-first](repairs/README.md#safety-critical-first) (PSY-10m)" in tree


def test_a_finding_without_a_repair_says_why() -> None:
    page = sections("PB1-33d", expected("PB1-33d"), [])
    assert page[2] == f"None. {expected('PB1-33d').no_repair}"
