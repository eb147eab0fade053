"""Every system that an interpretation of Board 2 (E01 to E32) changes is checked under each choice."""

from collections.abc import Mapping
from functools import cache

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from rovercheck.spec_model.ambiguity import ambiguities, fixed
from rovercheck.spec_model.lang.lower import lower
from rovercheck.spec_model.lang.system import System
from rovercheck.spec_model.rover import as_written, interpretations_of
from tests.profiles import examples
from tests.strategies import input_blocks
from tests.test_lowering import compare

ALSO = ("obstacles_free", "obstacles_heading")
NOT_OF_CHARTS = ("E11", "E12")


@cache
def _open() -> Mapping[str, System]:
    """Every system with its interpretations open, by name, made once for all choices."""
    return {system.name: system for system in as_written()}


@cache
def _reading(id: str) -> tuple[str, ...]:
    """The systems that change with an interpretation.

    Of the over-approximations of a system, and of its scenes, which hold the same charts, one is enough.
    """
    names = [s.name for s in _open().values() if not (s.concrete or s.under) or s.name in ALSO]
    once = [name for name in names if not name.startswith("rover_")]
    return tuple(name for name in once if id in interpretations_of(name))


@cache
def _smallest(id: str) -> str:
    """The system with the fewest variables among those that change with an interpretation."""
    interpretation = [s for s in _open().values() if id in interpretations_of(s.name)]
    return min(interpretation, key=lambda s: len(s.written) + len(s.inputs)).name


@cache
def _system(id: str, choice: str, name: str) -> System:
    """The system under a choice."""
    return fixed({id: choice}).system(_open()[name])


CASES = [
    (id, choice)
    for id, interpretation in ambiguities().items()
    if id.startswith("E") and id not in NOT_OF_CHARTS
    for choice in interpretation.choices
    if choice not in interpretation.not_modelled and choice != interpretation.default
]
"""Which systems each changes is found when they are tested: every process of the suite would wait for it."""


@pytest.mark.parametrize(("id", "choice"), CASES)
def test_the_systems_can_be_lowered(id: str, choice: str) -> None:
    names = _reading(id)
    assert names
    for name in names:
        assert lower(_system(id, choice, name)).step, name


@pytest.mark.parametrize("id", NOT_OF_CHARTS)
def test_no_chart_reads_the_others(id: str) -> None:
    assert id in ambiguities() and not _reading(id)


@pytest.mark.parametrize(("id", "choice"), CASES)
@settings(examples(2), suppress_health_check=list(HealthCheck))
@given(data=st.data())
def test_interpreter_and_lowering_agree(id: str, choice: str, data: st.DataObject) -> None:
    system = _system(id, choice, _smallest(id))
    compare(system, [inputs for inputs in data.draw(input_blocks(system)) for _ in range(20)])
