"""The catalogue is well formed: known systems, known requirements, one sentence each."""

from functools import cache

import pytest

from rovercheck.checker.model.checks import property_faults, system_faults
from rovercheck.properties.catalogue import baseline, catalogue
from rovercheck.properties.forms import Property
from rovercheck.properties.reduce import reduce
from rovercheck.spec_model.lang.lower import lower
from rovercheck.spec_model.lang.system import TransitionSystem
from rovercheck.spec_model.rover import charts, systems

ALL = list(catalogue().values())


@cache
def lowered(name: str) -> TransitionSystem:
    return lower(systems()[name])


@pytest.mark.parametrize("prop", ALL, ids=lambda p: p.id)
def test_a_property_is_one_sentence_about_a_known_system(prop: Property) -> None:
    first = prop.text.split()[0]
    assert prop.text.endswith(".") and (first[0].isupper() or "_" in first or "." in first)
    assert prop.on in systems()
    assert reduce(lowered(prop.on), [prop]).goals[0].property is prop


def test_systems_and_properties_are_what_a_model_of_a_user_must_be() -> None:
    assert [fault for system in systems().values() for fault in system_faults(system, "here")] == []
    assert [fault for prop in ALL for fault in property_faults(prop, systems())] == []


def test_every_chart_is_spoken_of() -> None:
    spoken = {chart.name for prop in ALL for chart in systems()[prop.on].charts}
    assert spoken >= set(charts())


def test_the_three_demands_of_the_document_are_stated_in_several_forms() -> None:
    def covering(*ids: str) -> int:
        return sum(bool({*ids} & {*p.covers}) for p in ALL)

    assert covering("B2-OBS-01", "B2-OBS-11") >= 4, "an obstacle at 70 cm or less"
    assert covering("B1-REF-06") >= 4, "zero references when critical"
    assert covering("B1-REL-02") >= 3 and covering("B1-REL-04") >= 3, "relay given, relay returned"


def test_the_baseline_gives_a_reason_for_every_finding_and_for_proofs_that_notice_no_fault() -> None:
    assert all((entry.because or entry.no_fault).endswith(".") for entry in baseline().values())
