"""Every system that reads an obstacle sentence can be checked under every choice of its readings (E01 to E32)."""

from functools import cache
from importlib import import_module

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from spec_model.lang.lower import lower
from spec_model.lang.system import System
from spec_model.readings import readings
from spec_model.rover import BOARDS, systems
from tests.strategies import input_blocks
from tests.test_lowering import compare


@cache
def _reading(id: str) -> tuple[str, ...]:
    """The systems that change with a reading: it is still an input of theirs as they are written.

    Of the over-approximations, which hold the same charts, one is enough.
    """
    written = [system for module in BOARDS for system in import_module(module).SYSTEMS]
    exact = [system for system in written if not system.concrete or system.name == "obstacles_free"]
    return tuple(system.name for system in exact if id in system.inputs)


@cache
def _systems(id: str, choice: str) -> dict[str, System]:
    return systems({id: choice})


CASES = [
    (id, choice, name)
    for id, reading in readings().items()
    if id.startswith("E")
    for choice in reading.choices
    if choice not in reading.not_modelled and choice != reading.default
    for name in _reading(id)
]


@pytest.mark.parametrize(("id", "choice", "name"), CASES)
def test_the_systems_can_be_lowered(id: str, choice: str, name: str) -> None:
    assert lower(_systems(id, choice)[name]).step


@pytest.mark.parametrize(("id", "choice"), dict.fromkeys((id, choice) for id, choice, _ in CASES))
@settings(max_examples=2, suppress_health_check=list(HealthCheck))
@given(data=st.data())
def test_interpreter_and_lowering_agree(id: str, choice: str, data: st.DataObject) -> None:
    name = data.draw(st.sampled_from(_reading(id)))
    system = _systems(id, choice)[name]
    compare(system, [inputs for inputs in data.draw(input_blocks(system)) for _ in range(20)])
