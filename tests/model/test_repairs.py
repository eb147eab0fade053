"""Every finding has a proposed repair or a reason why none is proposed, and repairs repair."""

import pytest

from rovercheck.checker.commands.shared.verdicts import results
from rovercheck.checker.engines import Limits, Timers
from rovercheck.checker.model.variant import Variant
from rovercheck.checker.render.drawing.changes import changes
from rovercheck.checker.verify.searches import SearchSettings
from rovercheck.properties.catalogue import baseline, catalogue, expected
from rovercheck.spec_model.lang.chart import Chart, parts, to
from rovercheck.spec_model.lang.edit import also, begin
from rovercheck.spec_model.repairs import ALL, Repair, in_force, proposals, repaired, repairs
from rovercheck.spec_model.rover import charts, systems

SPECIFIED = systems()
EVERY = list(repairs().values())
CHEAP = (
    "battery-absent-slows",
    "battery-gap-releases",
    "degraded-first-step",
    "relay-without-delay",
    "temperature-absent-slows",
    "wheel-by-feedback",
)


def variant(repair: Repair) -> Variant:
    return Variant(repair.interpretations, repair)


def test_every_violation_on_record_has_a_repair_or_a_reason_why_none_is_proposed() -> None:
    repaired = {id for repair in EVERY for id in repair.fixes}
    violated = {id: entry for id, entry in baseline().items() if entry.verdict == "violated"}
    assert [id for id, entry in violated.items() if id not in repaired and not entry.no_repair] == []
    assert [id for id, entry in violated.items() if id in repaired and entry.no_repair] == []
    assert all(entry.no_repair.endswith(".") for entry in violated.values() if entry.no_repair)


@pytest.mark.parametrize("repair", EVERY, ids=lambda r: r.name)
def test_a_repair_is_about_violations_on_record_and_what_it_gives_up_holds_without_it(repair: Repair) -> None:
    assert repair.fixes and repair.text.endswith(".")
    assert [id for id in repair.fixes if expected(id).verdict == "proved"] == []
    assert [id for id in repair.gives_up if id not in catalogue() or expected(id).verdict != "proved"] == []
    assert all(why.endswith(".") for why in repair.gives_up.values())


@pytest.mark.parametrize(
    "repair", [r for r in proposals().values() if not r.interpretations], ids=lambda r: r.name
)
def test_a_repair_edits_parts_of_the_rover_and_leaves_their_states(repair: Repair) -> None:
    known = {part.name for system in SPECIFIED.values() for part in parts(system.components)}
    assert {*repair.charts, *repair.blocks} <= known
    changed = set()
    for system in SPECIFIED.values():
        edited = repaired(system, repair)
        for before, after in zip(system.charts, edited.charts, strict=True):
            assert list(before.states) == list(after.states)
        for old, new in zip(parts(system.components), parts(edited.components), strict=True):
            changed |= {old.name} if changes(old, new) else set()
    assert changed == {*repair.charts, *repair.blocks}


@pytest.mark.parametrize("repair", [r for r in EVERY if r.interpretations], ids=lambda r: r.name)
def test_a_reading_taken_as_a_repair_changes_the_rover(repair: Repair) -> None:
    assert any(map(variant(repair).concerns(), catalogue().values()))
    read = systems(repair.interpretations)
    assert any(
        changes(before, after)
        for name, system in SPECIFIED.items()
        for before, after in zip(parts(system.components), parts(read[name].components), strict=True)
    )


@pytest.mark.parametrize("name", CHEAP)
def test_what_a_repair_promises_is_proved(name: str) -> None:
    changed = variant(repairs()[name])
    wanted = [prop for id in repairs()[name].fixes if not (prop := changed.properties()[id]).costly]
    found = results(wanted, changed.systems(), SearchSettings(limits=Limits(timers=Timers.FREE)))
    assert {r.property.id: r.verdict.word for r in found} == {p.id: "proved" for p in wanted}


def test_all_repairs_together_are_those_that_edit_charts_in_the_order_of_their_names() -> None:
    first = Repair("first", "A.", ("P",), {"Relay": lambda c: also(c, "B1_actuating", to("B2_actuating"))})
    second = Repair(
        "second", "B.", ("Q",), {"Relay": lambda c: begin(c, [to("B2_actuating")])}, gives_up={"P": "C."}
    )
    other = Repair("other", "D.", ("R",), interpretations={"S45": "IMMEDIATE"})
    both = in_force([first, other, second])
    assert both.name == ALL and both.fixes == ("P", "Q") and not both.interpretations and not both.gives_up
    drawn = both.charts["Relay"](charts()["Relay"])
    assert isinstance(drawn, Chart)
    assert [c.place for c in changes(charts()["Relay"], drawn)] == [
        "default transition of Relay",
        "transitions of B1_actuating",
    ]
    assert len(drawn.states[("B1_actuating",)].transitions) == 2


def test_a_change_shows_both_versions_of_a_place() -> None:
    relay = charts()["Relay"]
    (change,) = changes(relay, also(relay, "B1_actuating", to("B2_actuating")))
    assert change.place == "transitions of B1_actuating"
    assert change.after == (*change.before, "2: → B2_actuating")
