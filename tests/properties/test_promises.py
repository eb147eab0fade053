"""Promises speak of whole boards, and begin at what is measured, received or decided by who drives."""

import re
from dataclasses import replace
from itertools import chain as joined
from itertools import product

import pytest

from rovercheck.checker.commands.check.chains import check, holes
from rovercheck.checker.model.variant import Variant
from rovercheck.properties.catalogue import as_written, catalogue, expected, promises
from rovercheck.properties.forms import Always, EntersOnlyIf, HoldsAfter, LeavesOnlyIf, Property, formulas
from rovercheck.properties.promises.promise import Chain, Promise
from rovercheck.spec_model.composition.contracts import Contract
from rovercheck.spec_model.composition.fine_systems import CONTRACTS
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.evaluate import evaluate
from rovercheck.spec_model.lang.expr import FALSE, TRUE, Apply, Expr, Named, implies
from rovercheck.spec_model.lang.interpret import Interpreter
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.system import in_order
from rovercheck.spec_model.lang.walk import variables
from rovercheck.spec_model.lang.words import previous
from rovercheck.spec_model.repairs import repairs
from rovercheck.spec_model.rover import systems
from rovercheck.spec_model.signals.board1 import give_b2_actuation
from rovercheck.spec_model.signals.common import PHASE, PHASE_CLASS

PROMISES = promises()
OWN = {p.id: p for p in as_written().values() if p.id.startswith("P-")}

MEASURED = {
    "rx_age_ms", "esp_age_ms", "imu_age_ms", "B2.rx_age_ms",
    "temp_age", "temperature_degC", "batt_age", "battery_pct", "isMotionConsistent", "rx_age",
    "heartbeat_age", "cmd", "y_norm", "crit_mask_b2", "degr_mask_b2",
    "d1", "d2", "d3", "esp_age", "imu_age", "b1_sup_age", "B2.rx_age", "B2.crit_mask_b1", "B2.degr_mask_b1",
    "ay_norm", "bx_norm",
}  # fmt: skip
"""What the snapshots of the two boards hold: measured, or received in a frame."""

COVERED = {
    "give_b2_actuation": ["P-RELAY-OPENS", "P-RELAY-ONLY-THEN"],
    "autorized_to_send_command": ["P-RELAY-ASKED", "PB2-14d"],
    "critical_mask": ["P-SHOWN-TEMPERATURE", "P-SHOWN-BATTERY", "P-SHOWN-WHEELS", "P-SHOWN-LINK"],
    "B2.critical_mask": ["PB1-10d"],
    "B2.degraded_mask": ["PB1-10e"],
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
    elif prop.on == "rover_ms":
        assert not system.over and not system.under and prop.costly
        assert len([v.name for v in system.frozen if v.domain == PHASE_CLASS]) == 4
    else:
        assert system.under and {"Monitor_reception", "Monitors_2"} <= {c.name for c in system.charts}


@pytest.mark.parametrize("prop", OWN.values(), ids=lambda p: p.id)
def test_it_begins_at_nothing_that_a_board_computes_but_what_is_covered(prop: Property) -> None:
    computed = _computed(prop)
    assert computed <= COVERED.keys()
    for name in computed:
        for id in COVERED[name]:
            assert name in variables(*formulas(catalogue()[id].form))


@pytest.mark.parametrize("name", ["b1_critical", "rover_safety_state", "temp_status", "v_user"])
def test_a_statement_that_begins_at_what_a_chart_computes_is_found(name: str) -> None:
    """Cut the block that computes it from what is measured, and such a statement stays proved."""
    begun = systems()["board1_ms"].written[name]
    form = Always(implies(begun == previous(begun), ~give_b2_actuation))
    bad = replace(OWN["P-LIMITS-ESTOP-1"], id="P-BAD", form=form)
    assert _computed(bad) == {name} and not _computed(bad) <= COVERED.keys()


def test_each_link_of_a_chain_begins_at_what_is_measured_or_covered() -> None:
    links = {id for chain in CHAINS for id in (chain.first, chain.last, *chain.by.values()) if id}
    for prop in (catalogue()[id] for id in sorted(links - OWN.keys())):
        assert _computed(prop) <= COVERED.keys(), prop.id


CHAINS = [chain for promise in PROMISES for chain in promise.chains]


@pytest.mark.parametrize("chain", CHAINS, ids=lambda c: "-".join(c.properties))
def test_a_chain_has_no_hole_and_rests_on_what_is_proved(chain: Chain) -> None:
    assert not list(holes(chain))
    variant = Variant({}, repairs()[chain.under] if chain.under else None)
    assert {variant.expected(id).verdict for id in chain.properties} == {"proved"}
    system = systems()[catalogue()[chain.across].on]
    assert system.over and system.tick_ms == 1


def test_the_users_three_promises_have_a_chain_across_the_link() -> None:
    assert {p.id for p in PROMISES if p.chains} == {"STOP", "CRITICAL", "RELAY"}


STOP, CRITICAL, RELAY = (next(p for p in PROMISES if p.id == id) for id in ("STOP", "CRITICAL", "RELAY"))


@pytest.mark.parametrize(
    ("chain", "hole"),
    [
        (replace(STOP.chains[0], by={"SUP2.contract": "P-STOP-NEAR"}), "no property proves SUP1.contract"),
        (
            replace(STOP.chains[0], by={**STOP.chains[0].by, "SUP2.contract": "P-STOP-WHILE-2-DRIVES"}),
            "P-STOP-WHILE-2-DRIVES needs 2 ticks",
        ),
        (
            replace(STOP.chains[0], by={**STOP.chains[0].by, "SUP2.contract": "P-STOP-DEGRADED"}),
            "P-STOP-DEGRADED demands nothing where",
        ),
        (
            replace(STOP.chains[0], by={**STOP.chains[0].by, "SUP2.contract": "PSY-14a"}),
            "PSY-14a, which is to prove SUP2.contract, rests on a chain; take one about a board",
        ),
        (
            replace(STOP.chains[0], by={**STOP.chains[0].by, "SUP2.contract": "PSY-10e"}),
            "PSY-10e, which is to prove SUP2.contract, rests on a chain itself, which is a circle",
        ),
        (replace(RELAY.chains[0], first="PSY-03d"), "PSY-03d, which is to prove first, .* is a circle"),
        (replace(RELAY.chains[0], last="PSY-03a"), "PSY-03a, which is to prove last, rests on a chain"),
        (replace(RELAY.chains[0], first="P-SHOWN-LINKS"), "P-SHOWN-LINKS is no property. Did you mean"),
        (replace(RELAY.chains[0], across="PSY-03z"), "PSY-03z is no property. Did you mean"),
        (replace(RELAY.chains[0], across="P-STOP-NEAR"), "P-STOP-NEAR is about board2_ms, no chain of tasks"),
        (replace(STOP.chains[0], by={**STOP.chains[0].by, "SUP9": "PSY-10m"}), "has no contract 'SUP9'"),
        (replace(STOP.chains[0], by={**STOP.chains[0].by, "SUP1.contract": "P-1"}), "P-1 is no property"),
        (replace(CRITICAL.chains[0], assuming=TRUE), "critical_received, .* is not what the frame carries"),
        (
            replace(CRITICAL.chains[0], by={**CRITICAL.chains[0].by, "Sender.contract": "P-SHOWN-BATTERY"}),
            "P-SHOWN-BATTERY does not say that",
        ),
        (replace(RELAY.chains[0], cause=TRUE), r"P-SHOWN-LINK does not say that bit\(critical_mask, 2\)"),
        (replace(RELAY.chains[0], last=""), "handover_fine has no contracts; write first= and last="),
        (replace(RELAY.chains[0], last="P-RELAY-CLOSES"), "P-RELAY-CLOSES says nothing of the same step"),
        (replace(RELAY.chains[0], last="P-SHOWN-LINK"), "P-SHOWN-LINK does not say that autorized"),
        (replace(RELAY.chains[0], cause=FALSE), "nothing is asked of P-SHOWN-LINK: false is never so"),
        (
            replace(STOP.chains[0], stands={**STOP.chains[0].stands, "near": FALSE}),
            "nothing is asked of P-STOP-NEAR: .* is never so",
        ),
        (
            replace(STOP.chains[0], stands={**STOP.chains[0].stands, "v_positive": FALSE}),
            "nothing is asked of PSY-10m: .* is always so",
        ),
        (replace(RELAY.chains[0], across="P-RELAY-OPENS"), "P-RELAY-OPENS says nothing of what lasts"),
    ],
)
def test_holes_are_told(chain: Chain, hole: str) -> None:
    assert re.search(hole, "\n".join(holes(chain)))


def test_a_link_that_begins_later_than_what_rests_on_it_is_a_hole(monkeypatch: pytest.MonkeyPatch) -> None:
    """The first execution of a sender was taken for granted; the properties of its mask say nothing of it."""
    say, obey = CONTRACTS["critical_1_to_2"]
    assert say.begins == 2
    everywhere = {**CONTRACTS, "critical_1_to_2": (replace(say, first=True), obey)}
    monkeypatch.setattr("rovercheck.checker.commands.check.chains.CONTRACTS", everywhere)
    hole = "P-SHOWN-TEMPERATURE says nothing before step 2; Sender.contract does"
    assert hole in "\n".join(holes(CRITICAL.chains[0]))


def test_a_hole_ends_the_page_with_the_place_of_the_statement() -> None:
    broken = replace(RELAY, chains=(replace(RELAY.chains[0], cause=TRUE),))
    with pytest.raises(ModelError, match=r"composition_fine\.py:\d+: .* over PSY-03d has a hole"):
        check(broken)


def test_a_chain_that_does_not_say_what_a_variable_stands_for_is_refused() -> None:
    with pytest.raises(ModelError, match="does not say what near stands for"):
        list(holes(replace(STOP.chains[0], stands={})))


@pytest.mark.parametrize(
    "contract", dict.fromkeys(joined.from_iterable(CONTRACTS.values())), ids=lambda c: c.name
)
def test_a_contract_does_all_that_it_allows_and_nothing_else(contract: Contract) -> None:
    own = next(iter(variables(contract.then).values()))
    inputs = list(variables(contract.premise, contract.before).values())
    met, seen_first = False, set[tuple[tuple[int, ...], int, int]]()
    for values in product((0, 1), repeat=2 * len(inputs) + 1):
        seen = set()
        for free in (0, 1):
            block = Interpreter(in_order("alone", contract.block))
            first = dict(zip((v.name for v in inputs), values, strict=False))
            second = dict(zip((v.name for v in inputs), values[len(inputs) :], strict=False))
            block.step({**first, contract.free.name: values[-1]})
            begun = evaluate(contract.premise, first) and contract.begins == 1
            assert not begun or evaluate(contract.then, {own.name: block.data[own.name]})
            seen_first.add((tuple(first.values()), values[-1], int(block.data[own.name])))
            block.step({**second, contract.free.name: free})
            demanded = evaluate(contract.premise, second) and evaluate(contract.before, first)
            assert not demanded or evaluate(contract.then, {own.name: block.data[own.name]})
            seen.add(int(block.data[own.name]))
        assert len(seen) == (1 if demanded else 2)
        met = met or bool(demanded)
    assert met
    if contract.begins == 2:
        given = {at for at, _, _ in seen_first}
        assert len({(at, own) for at, _, own in seen_first}) == 2 * len(given), "nothing is said of the first"


def of_weather(name: str) -> bool:
    """Whether a variable says what has failed."""
    return name.endswith((".spell", ".runs"))


def _computed(prop: Property) -> set[str]:
    """What a statement begins at and a board computes."""
    begins = {v.name for premise in _premises(prop) for v in variables(premise).values()}
    written = systems()[prop.on].written.keys()
    return {name for name in begins & written - MEASURED if not of_weather(name)}


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
