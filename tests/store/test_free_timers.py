"""What is kept of a search whose timers may expire at any time."""

import pytest

from rovercheck.checker.engines import Limits, Timers
from rovercheck.properties.forms import always, never
from rovercheck.spec_model.lang.chart import Chart, State, to
from rovercheck.spec_model.lang.system import in_order
from rovercheck.spec_model.lang.time import ticks
from rovercheck.spec_model.lang.words import after
from tests.store.lamps import GO, ON, decided, store, told
from tests.store.naive_engine import NaiveEngine

pytestmark = pytest.mark.usefixtures("folder", "no_child")


def test_a_proof_with_free_timers_is_not_looked_for_again() -> None:
    """It is about another system, the one whose timers may expire at any time; a run is about this one."""
    chart = Chart(
        "Lamp",
        [
            State("Off", transitions=[to("On", when=GO)]),
            State("On", transitions=[to("Off", when=after(2 * ticks))]),
        ],
        default="Off",
    )
    timed, lit = in_order(ON, chart), chart.active("On")
    asked = [
        always("dark-proved", "", that=lit | chart.active("Off"), covers=["R"], on=ON, from_tick=2),
        never("lit-violated", "", that=lit, covers=["R"], on=ON),
    ]
    limits, engine = Limits(timers=Timers.FREE), NaiveEngine()
    first = decided(timed, store(), asked, engine=engine, limits=limits)
    assert {one.property.id: one.system for one in first} == {"dark-proved": f"{ON}~free", "lit-violated": ON}
    assert engine.asked
    engine.asked.clear()
    again = decided(timed, store(), asked, engine=engine, limits=limits)
    assert told(again) == told(first) == {"dark-proved": ("proved", None), "lit-violated": ("violated", 2)}
    assert engine.asked == [] and {one.system for one in again} == {f"{ON}~free", ON}
