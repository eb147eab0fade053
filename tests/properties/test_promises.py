"""Promises speak of whole boards, and begin at what is measured, received or decided by who drives."""

import importlib
import pkgutil
import re

import pytest

import properties.promises as folder
from properties.catalogue import as_written, catalogue, expected
from properties.forms import Always, EntersOnlyIf, HoldsAfter, LeavesOnlyIf, Property, formulas
from properties.promises.promise import Promise
from spec_model.lang.chart import parts
from spec_model.lang.expr import Apply, Expr, Named
from spec_model.lang.operators import Op
from spec_model.lang.walk import variables
from spec_model.rover import systems
from spec_model.signals.common import PHASE

MODULES = [
    importlib.import_module(f"{folder.__name__}.{entry.name}")
    for entry in pkgutil.iter_modules(folder.__path__)
]
PROMISES = [thing for module in MODULES for thing in vars(module).values() if isinstance(thing, Promise)]
OWN = {p.id: p for p in as_written().values() if p.id.startswith("P-")}

MEASURED = {
    "temp_age", "temperature_degC", "batt_age", "battery_pct", "isMotionConsistent", "rx_age",
    "heartbeat_age", "cmd", "y_norm", "crit_mask_b2", "degr_mask_b2",
    "d1", "d2", "d3", "esp_age", "imu_age", "b1_sup_age", "B2.rx_age", "B2.crit_mask_b1", "B2.degr_mask_b1",
}  # fmt: skip
"""What the snapshots of the two boards hold: measured, or received in a frame."""

COVERED = {
    "give_b2_actuation": ["P-RELAY-OPENS", "P-RELAY-ONLY-THEN"],
    "autorized_to_send_command": ["P-RELAY-ASKED", "PB2-14d"],
    "critical_mask": ["P-SHOWN-TEMPERATURE", "P-SHOWN-BATTERY", "P-SHOWN-WHEELS", "P-SHOWN-LINK"],
    "is_rotating180": ["PB1-26h"],
    "actuate_emergency_stop": ["PB1-23a"],
    "B2.actuate_emergency_stop": ["PB2-16h"],
}
"""What a board computes and premises may begin at, and properties that say what it follows from."""


def test_every_statement_belongs_to_one_promise() -> None:
    said = [id for promise in PROMISES for id in (*(p.id for p in promise.holds), *promise.required)]
    assert sorted(id for id in said if id in OWN) == sorted(OWN)


@pytest.mark.parametrize("promise", PROMISES, ids=lambda p: p.id)
def test_what_is_required_is_a_property_and_what_holds_is_proved(promise: Promise) -> None:
    assert {expected(id).verdict for id in promise.required} <= {"violated", "proved"}
    assert {expected(p.id).verdict for p in promise.holds} == {"proved"}
    assert promise.source and promise.bound and promise.true_bound


@pytest.mark.parametrize("prop", OWN.values(), ids=lambda p: p.id)
def test_it_is_about_a_whole_board_or_both_with_stamps_between_the_steps(prop: Property) -> None:
    system = systems()[prop.on]
    if prop.on in ("board1_ms", "board2_ms"):
        assert not system.over and not system.under and prop.costly
        assert [v.name for v in system.frozen if v.domain == PHASE]
    else:
        assert system.under and {"Monitor_reception", "Monitors_2"} <= {c.name for c in system.charts}


@pytest.mark.parametrize("prop", OWN.values(), ids=lambda p: p.id)
def test_it_begins_at_nothing_that_a_board_computes_but_what_is_covered(prop: Property) -> None:
    begins = {v.name for premise in _premises(prop) for v in variables(premise).values()}
    computed = {
        name for name in begins & systems()[prop.on].written.keys() - MEASURED if not of_weather(name)
    }
    assert computed <= COVERED.keys()
    for name in computed:
        for id in COVERED[name]:
            assert name in variables(*formulas(catalogue()[id].form))


CONTRACT = re.compile(r"\b(?:PB\d|PSY)-\w+(?:-\w+)*")


@pytest.mark.parametrize("promise", PROMISES, ids=lambda p: p.id)
def test_a_chain_leads_from_one_board_to_the_other_and_rests_on_nothing_that_is_not_proved(
    promise: Promise,
) -> None:
    for chain in promise.chains:
        first, *between, last = (catalogue()[id] for id in chain)
        assert {first.on, last.on} == {"board1_ms", "board2_ms"}
        assert {expected(id).verdict for id in chain} == {"proved"}
        for link in between:
            system = systems()[link.on]
            assert system.over and system.tick_ms == 1
            named = {id for part in parts(system.components) for id in CONTRACT.findall(part.text)}
            assert named or link.on == "handover_fine"
            for id in named:
                [*stated] = [p for p in catalogue() if p == id or p.removesuffix("a") == id]
                assert stated and {expected(p).verdict for p in stated} == {"proved"}, id


def of_weather(name: str) -> bool:
    """Whether a variable says what has failed."""
    return name.endswith(".spell")


def _premises(prop: Property) -> list[Expr]:
    """Where a statement begins: the conditions that it demands something of."""
    match prop.form:
        case HoldsAfter(premise=premise):
            return [premise]
        case EntersOnlyIf(only_if=only_if) | LeavesOnlyIf(only_if=only_if):
            return [only_if]
        case Always(that=Apply(Op.OR, (first, *_))):  # an implication
            return [first]
        case Always(that=Named() | Apply()):
            return []
    raise AssertionError(f"{prop.id} has a form that no promise has")
