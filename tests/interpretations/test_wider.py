"""A wider domain adds values and changes nothing for the others."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rovercheck.spec_model.lang.domain import Domain, fixed
from rovercheck.spec_model.rover import systems
from rovercheck.spec_model.signals.board1 import DEGREES_C, PERCENT
from tests.interpretations.scenario import Blocks, shown
from tests.interpretations.wider import widened
from tests.profiles import examples

TENTHS, HUNDREDTHS = fixed(-20, 70, "0.1", "°C"), fixed(-1, 100, "0.01", "%")


@pytest.mark.parametrize(
    ("name", "update", "reading", "value", "few", "many"),
    [
        ("temperature", "temp_update", "temp_reading", "temperature_degC", DEGREES_C, TENTHS),
        ("battery", "batt_update", "batt_reading", "battery_pct", PERCENT, HUNDREDTHS),
    ],
    ids=["temperature", "battery"],
)
@examples(5)
@given(data=st.data())
def test_the_values_of_the_model_show_the_same(
    name: str, update: str, reading: str, value: str, few: Domain, many: Domain, data: st.DataObject
) -> None:
    system = systems()[name]
    values = st.sampled_from([few.show(raw) for raw in few.values])
    drawn = data.draw(
        st.lists(st.tuples(st.sampled_from([20, 500, 6000]), st.booleans(), values), max_size=5)
    )
    blocks: Blocks = [(ms, {update: arrives, reading: at}) for ms, arrives, at in drawn]
    watched = [value, *system.written]
    wide = widened(system, {reading: many, value: many})
    assert list(shown(wide, blocks, watched)) == list(shown(system, blocks, watched))
