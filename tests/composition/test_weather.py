"""The rover under weather: what its scenes leave out is without effect, and nothing else is left out."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from spec_model.board2.supervisor_systems import coherence_exact
from spec_model.composition.weather import FAULTS, SECOND, SYSTEMS
from spec_model.lang.interpret import Interpreter
from spec_model.lang.lower import lower
from spec_model.lang.system import System
from spec_model.rover import systems
from spec_model.signals import board1 as b1
from spec_model.signals import board2_supervisor as b2
from spec_model.signals.common import PHASE, PHASE_CLASS

ALONE = [systems()[s.name] for s in SYSTEMS if "other" not in {v.name for v in s.frozen}]


@pytest.mark.parametrize("limit", [120, *(s.limit for s in b2.SOURCES_MS if s.phase is not None)])
def test_all_phases_of_a_class_pass_the_limit_in_one_step(limit: int) -> None:
    start, between = (int(PHASE_CLASS.show(raw).split()[0]) for raw in PHASE_CLASS.values)
    assert start == 0
    for age in range(0, limit + 40, 20):
        passed = {phase: age + phase > limit for phase in PHASE.values}
        assert {passed[phase] for phase in PHASE.values if phase > 0} == {passed[between]}


@given(st.lists(st.tuples(st.booleans(), st.booleans()), max_size=200))
def test_a_rover_that_does_not_turn_is_coherent_in_every_step(stamps: list[tuple[bool, bool]]) -> None:
    rover = Interpreter(coherence_exact)
    still = dict.fromkeys((b2.gz_dps.name, *(v.name for v in b2.wheel_speed_rpm.values())), 0)
    for imu, supervisor in stamps:
        rover.step({b2.imu_update.name: int(imu), b2.sup_update.name: int(supervisor), **still})
        assert rover.data[b2.is_motion_consistent.name]


@pytest.mark.parametrize("system", ALONE, ids=lambda s: s.name)
def test_the_rover_drives_at_full_speed_until_something_fails(system: System) -> None:
    rover = Interpreter(system)
    for tick in range(1, 40):
        rover.step(dict.fromkeys(system.inputs, 0))
        assert tick == 1 or (rover.data["v_ref"], rover.data["motors.zero"]) == (b1.v_ref.domain.raw(1), 0)


def test_every_fault_is_there_alone_and_most_as_a_second_one() -> None:
    assert [s.name for s in ALONE] == [f"weather_{f.name}" for f in FAULTS]
    assert {f.name for f in FAULTS} - {f.name for f in SECOND} == {"sonars", "temperature", "battery", "near"}


@pytest.mark.parametrize("name", ["board1_ms", "weather_link21"])
def test_no_monitor_reads_an_age_that_nothing_writes_there_under_any_reading(name: str) -> None:
    """With S31=IGNORE the wheels did: the age on the grid was an input."""
    inputs = {v.name for v in lower(systems({"S31": "IGNORE"})[name]).inputs}
    assert not {"rx_age", "rx_age_ms", "heartbeat_age"} & inputs
