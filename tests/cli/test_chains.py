"""Chains across the link where charts are changed: which links are asked again, and what is told of them."""

import json
from dataclasses import replace

import pytest

from rovercheck.checker.cli import run
from rovercheck.checker.commands.check import chain_status
from rovercheck.checker.commands.check.chain_status import Chains
from rovercheck.checker.commands.check.further import CheckExtras
from rovercheck.checker.commands.check.run import CheckOutput, CheckRequest, check
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.commands.shared.verdicts import results
from rovercheck.checker.model.variant import Variant
from rovercheck.checker.verify.checked import CheckedProperty
from rovercheck.properties.catalogue import promises
from rovercheck.properties.promises.promise import Promise
from rovercheck.spec_model.repairs import repairs
from rovercheck.spec_model.rover import systems

RELAY = next(promise for promise in promises() if promise.id == "RELAY")

[LINK] = RELAY.chains


@pytest.mark.parametrize(
    ("promise", "hole"),
    [
        (
            replace(RELAY, chains=(replace(LINK, last=""),)),
            "handover_fine has no contracts; write first= and last=",
        ),
        (
            replace(RELAY, chains=(replace(LINK, first="PSY-03d"),)),
            "rests on a chain itself, which is a circle",
        ),
    ],
    ids=["hole", "circle"],
)
def test_a_hole_and_a_circle_are_told_with_place_before_anything_is_searched(
    promise: Promise, hole: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(chain_status, "promises", lambda: (promise,))
    assert run(["check", "--repair", "wheel-by-feedback"]) == Exit.USAGE
    shown = capsys.readouterr()
    said = " ".join(shown.err.split())
    assert "composition_fine.py:" in said and hole in said and "RELAY over PSY-03d" in said
    assert not shown.out


def test_a_repair_asks_again_what_its_charts_can_change() -> None:
    """Other links of the boards that it edits are about slices that are written alike."""
    chains = Chains(Variant({}, repairs()["safety-critical-first"]))
    assert set(chains.links) == {"P-STOP-OBEYED", "PSY-10m"}
    assert {one.holds for one in chains.standings([])} == {True, None}
    undecided = {one.chain.across for one in chains.standings([]) if one.holds is None}
    assert undecided == {"PSY-10e", "PSY-10o"}


def test_a_reading_asks_again_what_it_makes_another_sentence() -> None:
    """S19 says whether 15 % is in the critical range of the battery."""
    links = Chains(Variant({"S19": "UNIFORM-OPEN"})).links
    assert "P-SHOWN-BATTERY" in links and not links.keys() & {"P-STOP-NEAR", "P-RELAY-ASKED", "PSY-10m"}


def test_a_link_that_a_repair_breaks_breaks_its_chain() -> None:
    variant = Variant({}, repairs()["safety-critical-first"])
    prop = variant.properties()["PSY-10m"]
    [found] = results([prop], variant.systems())
    told = Chains(variant).standings([CheckedProperty(found, variant.expected(prop.id), variant.name)])
    [stop] = [one for one in told if one.chain.across == "PSY-10e"]
    assert stop.holds is False and stop.text == "STOP over PSY-10e does not hold: PSY-10m is violated."


def test_what_becomes_of_chains_is_told_after_the_verdicts(capsys: pytest.CaptureFixture[str]) -> None:
    chains = Chains(Variant({}))
    [first, *others] = chains.standings([])
    broken = replace(first, holds=False, failing=("PSY-10m",))
    further = CheckExtras(chains=lambda _: [broken, *(replace(o, holds=True, failing=()) for o in others)])
    for as_json in (False, True):
        capsys.readouterr()
        prop = chains.variant.properties()["PB1-12"]
        request = CheckRequest([prop], systems(), further=further)
        assert check(request, CheckOutput(as_json)) == Exit.AS_EXPECTED
        said = capsys.readouterr().out
        if as_json:
            assert json.loads(said)["chains"][0] == {
                "promise": "STOP", "over": "PSY-10e", "holds": False, "failing": ["PSY-10m"],
            }  # fmt: skip
        else:
            assert f"{len(others)} of {len(others) + 1} chains across the link hold" in said
            assert "\n  STOP over PSY-10e does not hold: PSY-10m is violated.\n" in said


def test_a_chain_that_rests_on_a_repair_is_told_with_it_only() -> None:
    without = {one.chain.across for one in Chains(Variant({})).standings([])}
    assert "PSY-10u" not in without and "PSY-10e" in without
    repaired = Chains(Variant({}, repairs()["stop-unconditional"]))
    assert "PSY-10u" in {chain.across for _, chain in repaired.chosen} and "PB1-23f" in repaired.links


def test_what_a_repair_repairs_is_decided_with_it_however_long_it_takes() -> None:
    promised = Variant({}, repairs()["monitor-critical-by-age"]).promised()
    assert {p.id for p in promised if p.costly} == {
        "P-WEATHER-LINK12-2", "P-WEATHER-JOYSTICK-2", "P-WEATHER-IMU-2",
    }  # fmt: skip
