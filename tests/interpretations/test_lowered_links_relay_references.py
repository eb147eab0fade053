"""Links, relay, masks and references can be checked under every choice of their interpretations (S34 to S66).

The default choices are those of every other test.
"""

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

RX, SUP = ["reception", "reception_exact", "reception_ms"], ["heartbeat", "heartbeat_exact", "heartbeat_ms"]
OWN = (
    ("S34", "S39", [*RX, *SUP]),
    ("S40", "S41", SUP),
    ("S43", "S46", ["relay", "relay_links"]),
    ("S48", "S49", ["safety", "references", "backward_frozen"]),
    ("S50", "S50", ["relay"]),
    ("S51", "S52", ["masks"]),
    ("S54", "S56", ["safety"]),
    ("S57", "S64", ["references", "references_executed"]),
    ("S65", "S65", ["temperature", "battery", "wheel_FL", *RX, *SUP]),
    ("S66", "S66", [*RX, *SUP]),
)
"""From which interpretation to which: the systems that show them."""

CHOICES = [
    (id, choice, names)
    for first, last, names in OWN
    for id, interpretation in ambiguities().items()
    if first <= id <= last
    for choice in interpretation.choices
    if choice not in (interpretation.default, *interpretation.not_modelled)
]


@cache
def _systems(id: str, choice: str) -> Mapping[str, System]:
    return systems({id: choice})


@pytest.mark.parametrize(("id", "choice"), [(id, choice) for id, choice, _ in CHOICES])
def test_the_board_can_be_lowered(id: str, choice: str) -> None:
    assert lower(_systems(id, choice)["board1"]).step


@pytest.mark.parametrize(
    ("id", "choice", "name"), [(id, choice, name) for id, choice, names in CHOICES for name in names]
)
@settings(examples(2), suppress_health_check=list(HealthCheck))
@given(data=st.data())
def test_interpreter_and_lowering_agree(id: str, choice: str, name: str, data: st.DataObject) -> None:
    system = _systems(id, choice)[name]
    compare(system, [inputs for inputs in data.draw(input_blocks(system)) for _ in range(10)])


@pytest.mark.parametrize(("id", "choice"), [("S36", "ARRIVAL"), ("S40", "COUNT-DELTA"), ("S37", "GE")])
@settings(examples(2), suppress_health_check=list(HealthCheck))
@given(data=st.data())
def test_they_agree_on_the_exact_records(id: str, choice: str, data: st.DataObject) -> None:
    system = _systems(id, choice)["heartbeat_ms_exact"]
    compare(system, [inputs for inputs in data.draw(input_blocks(system)) for _ in range(10)])
