"""What a verdict depends on: of a run what another choice changes, of a proof what lies in its own cone."""

from functools import cache

import pytest

from rovercheck.checker.commands.shared.dependencies import of_verdict
from rovercheck.checker.commands.shared.verdicts import results
from rovercheck.checker.model.load import model
from rovercheck.checker.model.variant import Variant
from rovercheck.checker.results.trace import Trace
from rovercheck.checker.results.verdict import Run, Violated
from rovercheck.checker.system.cone import dependencies
from rovercheck.checker.system.lowering_cache import lowered
from rovercheck.checker.verify.checked import CheckedProperty
from rovercheck.checker.verify.runs.choices import needed
from rovercheck.checker.verify.runs.known_runs import reached, run_in
from rovercheck.properties.catalogue import as_written, catalogue, expected, read_by
from rovercheck.properties.forms import always
from rovercheck.spec_model.ambiguity import ambiguities, ambiguity
from rovercheck.spec_model.lang.chart import Chart, State, to
from rovercheck.spec_model.lang.expr import flag
from rovercheck.spec_model.lang.system import Assumption, in_order
from rovercheck.spec_model.rover import left_to_read, systems

AS_SPECIFIED = Variant({})


@cache
def decided(id: str) -> CheckedProperty:
    [result] = results([catalogue()[id]], systems())
    return CheckedProperty(result, expected(id))


@pytest.mark.parametrize("id", ["PB2-12-first", "PB1-30c-FL"])
def test_another_choice_of_what_a_run_depends_on_ends_it_and_of_nothing_else(id: str) -> None:
    compared = decided(id)
    found = of_verdict(compared, AS_SPECIFIED)
    assert found.assumptions == () and found.besides
    assert isinstance(compared.verdict, Violated) and isinstance(compared.verdict.because, Trace)
    run = run_in(compared.verdict.because)
    for name in (*found.interpretations, *found.besides):
        one = ambiguity(name)
        others = [c for c in one.choices if c != one.default and c not in one.not_modelled]
        still = [_breaks(compared, run, name, choice) for choice in others]
        assert all(still) == (name in found.besides), name


def _breaks(compared: CheckedProperty, run: Run, id: str, choice: str) -> bool:
    """Whether the inputs break the property under that choice, by the reference semantics."""
    variant = Variant({id: choice})
    prop = variant.properties()[compared.result.property.id]
    return prop.id in reached(variant.systems()[compared.result.system], [prop], [run])


def test_the_reading_that_a_finding_is_about_is_the_one_that_it_depends_on() -> None:
    assert of_verdict(decided("PB1-33b"), AS_SPECIFIED).interpretations == ("S13",)


def test_a_proof_depends_on_its_cone() -> None:
    compared = decided("PB1-11")
    found = of_verdict(compared, AS_SPECIFIED)
    assert found.besides == () and {"S43"} <= set(found.interpretations) <= read_by(catalogue()["PB1-11"])


def test_of_a_run_without_end_the_cone_is_named() -> None:
    found = of_verdict(decided("PB1-25"), AS_SPECIFIED)
    assert found.besides == () and "S62" in found.interpretations


def test_what_cannot_be_tried_is_not_told() -> None:
    compared = decided("PB1-33b")
    assert isinstance(compared.verdict, Violated) and isinstance(compared.verdict.because, Trace)
    run = run_in(compared.verdict.because)
    system, written = lowered(left_to_read("temperature")), as_written()["PB1-33b"]
    taken = {id: one.var.domain.raw(one.default) for id, one in ambiguities().items()}
    assert needed(system, written, run, taken, {}) == frozenset()
    short = type(run)(run.frozen, run.inputs[:-1])
    assert needed(system, written, short, taken, {}) is None
    assert (
        needed(lowered(left_to_read("references_executed")), as_written()["PB1-25"], run, taken, {}) is None
    )


def test_a_proof_depends_on_the_assumptions_about_what_it_reads_only() -> None:
    on, other = flag("on"), flag("other")
    chart = Chart(
        "Lamp",
        [State("Off", transitions=[to("On", when=on)]), State("On", transitions=[to("Off", when=other)])],
        default=[to("Off")],
    )
    second = Chart(
        "Fan",
        [State("Still", transitions=[to("Turns", when=flag("fan"))]), State("Turns")],
        default=[to("Still")],
    )
    system = in_order(
        "house", chart, second,
        assumptions=[Assumption("A-1", "It is never on.", ~on), Assumption("A-2", "No fan.", ~flag("fan"))],
    )  # fmt: skip
    prop = always("P-1", "The lamp is off.", that=chart.active("Off"), covers=["R-1"], on=system)
    whole = model(system, prop)
    own = whole.systems["house"]
    assert dependencies(own, lowered(own), whole.properties["P-1"]).assumptions == ("A-1",)
    [result] = results([whole.properties["P-1"]], whole.systems)
    compared = CheckedProperty(result, whole.expected("P-1"))
    assert of_verdict(compared, Variant({}, own=whole)).assumptions == ("A-1",)
    assert of_verdict(compared, Variant({}, None, frozenset({"A-1"}), whole)).assumptions == ()
