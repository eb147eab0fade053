"""Temperature, battery and wheels can be checked under every choice of their interpretations (S01 to S33)."""

from collections.abc import Mapping
from functools import cache

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from rovercheck.spec_model.ambiguity import ambiguities
from rovercheck.spec_model.lang.lower import lower
from rovercheck.spec_model.lang.system import System
from rovercheck.spec_model.rover import systems
from tests.profiles import examples
from tests.strategies import input_blocks
from tests.test_lowering import compare

OWN = (
    ("S01", "S14", ["temperature"]),
    ("S15", "S26", ["battery"]),
    ("S27", "S33", ["wheel_FL", "wheel_FR", "wheel_RL", "wheel_RR"]),
)
"""From which interpretation to which: the systems of their charts."""

BOARD = ["masks", "board1"]
"""All of them show on the board, that of S33 in the masks."""

CASES = [
    (id, choice, (*names, *BOARD))
    for first, last, names in OWN
    for id, interpretation in ambiguities().items()
    if first <= id <= last
    for choice in interpretation.choices
    if choice not in interpretation.not_modelled and choice != interpretation.default
]


@cache
def _systems(id: str, choice: str) -> Mapping[str, System]:
    return systems({id: choice})


@pytest.mark.parametrize(("id", "choice", "names"), CASES)
def test_the_systems_can_be_lowered(id: str, choice: str, names: tuple[str, ...]) -> None:
    for name in names:
        assert lower(_systems(id, choice)[name]).step


@pytest.mark.parametrize(("id", "choice", "names"), CASES)
@settings(examples(2), suppress_health_check=list(HealthCheck))
@given(data=st.data())
def test_interpreter_and_lowering_agree(
    id: str, choice: str, names: tuple[str, ...], data: st.DataObject
) -> None:
    system = _systems(id, choice)[names[0]]
    compare(system, [inputs for inputs in data.draw(input_blocks(system)) for _ in range(20)])
