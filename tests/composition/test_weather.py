"""The rover under weather: what its scenes leave out is without effect, and nothing else is left out."""

from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rovercheck.spec_model.board2.supervisor_systems import coherence_exact
from rovercheck.spec_model.composition.weather import FIRST_HEARD, HEARD, SECOND, SYSTEMS, with_another
from rovercheck.spec_model.composition.world import FAULTS, stick, which
from rovercheck.spec_model.lang.evaluate import evaluate
from rovercheck.spec_model.lang.interpret import Interpreter
from rovercheck.spec_model.lang.lower import lower
from rovercheck.spec_model.lang.system import System
from rovercheck.spec_model.rover import systems
from rovercheck.spec_model.signals import board1 as b1
from rovercheck.spec_model.signals import board2_motion as motion
from rovercheck.spec_model.signals import board2_supervisor as b2
from rovercheck.spec_model.signals.board2 import d1, d2, d3
from rovercheck.spec_model.signals.common import PHASE, PHASE_CLASS

HELD = [s.name for s in SYSTEMS.values() if "stick" not in s.inputs and "new_ay_norm" not in s.inputs]
ALONE = [systems()[n] for n in HELD if "other" not in {v.name for v in systems()[n].frozen}]
STEERED = [systems()[s.name] for s in SYSTEMS.values() if "stick" in s.inputs]


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


@pytest.mark.parametrize("system", [*ALONE, *STEERED], ids=lambda s: s.name)
def test_the_rover_drives_at_full_speed_until_something_fails(system: System) -> None:
    rover = Interpreter(system)
    for tick in range(1, 40):
        rover.step(dict.fromkeys(system.inputs, 0))
        assert tick == 1 or (rover.data["v_ref"], rover.data["motors.zero"]) == (b1.v_ref.domain.raw(1), 0)


def test_every_fault_is_there_alone_and_most_as_a_second_one() -> None:
    assert [s.name for s in ALONE] == [f"weather_{f.name}" for f in FAULTS]
    assert {f.name for f in FAULTS} - {f.name for f in SECOND} == {"sonars", "temperature", "battery", "near"}


def test_second_faults_with_which_board_2_hears_board_1_are_all_but_those_that_silence_it() -> None:
    assert {f.name for f in SECOND} - {*HEARD} == {"link12", "power", "supervisor1"}
    assert {f.name for f in FIRST_HEARD} == {"near", "hot", "flat", "link21"}


def test_a_pair_of_named_faults_meets_no_other_second_one() -> None:
    fault = FIRST_HEARD[0]
    allowed = {f.name for f in SECOND if _possible(with_another(fault, "imu", "hot"), f.name)}
    assert allowed == {"imu", "hot"}


def _possible(system: System, second: str) -> bool:
    domain = next(v.domain for v in system.frozen if v.name == "other")
    phases = {v.name: 0 for v in system.frozen if v.name != "other"}
    return bool(evaluate(system.assume, {**phases, "other": domain.raw(second)}))


@pytest.mark.parametrize("part", range(4), ids=b1.WHEELS)
def test_any_wheel_may_be_the_one_without_feedback(part: int) -> None:
    rover = _after_a_fault("wheel", part)
    bits = [int(rover.data[b1.degraded_mask.name]) >> i & 1 for i in range(3, 7)]
    assert bits == [int(i == part) for i in range(4)]


@pytest.mark.parametrize("part", range(3), ids=["middle", "left", "right"])
def test_any_sonar_may_be_the_one_that_measures_70_cm(part: int) -> None:
    rover = _after_a_fault("near", part)
    near = [rover.data[d.name] == d.domain.raw(70) for d in (d2, d1, d3)]
    assert near == [i == part for i in range(3)]


def _after_a_fault(name: str, part: int) -> Interpreter:
    system = systems()[f"weather_{name}"]
    rover = Interpreter(system, {**{v.name: 0 for v in system.frozen}, which[name].name: part})
    for _ in range(2):
        rover.step({**dict.fromkeys(system.inputs, 0), f"{name}.begins": 1})
    return rover


def test_the_heading_follows_the_motors_and_stays_while_they_stand() -> None:
    system = systems()["weather_near_steered"]
    rover = Interpreter(system)

    def steps(where: str, count: int) -> list[float]:
        """The headings while the stick is held there."""
        inputs = dict.fromkeys(system.inputs, 0) | {"turns": 1, stick.name: stick.domain.raw(where)}
        seen = []
        for _ in range(count):
            rover.step(inputs)
            seen.append(rover.data[motion.yaw.name] / motion.yaw.domain.raw(45) * 45)
        return seen

    assert {*steps("centre", 5)} == {0}
    turning = steps("left", 12)
    assert {*turning} == {*range(0, 360, 45)}
    assert all((after - before) % 360 == 315 for before, after in pairwise(turning[4:]))
    assert len({*steps("centre", 20)[5:]}) == 1


@pytest.mark.parametrize("name", ["board1_ms", "weather_link21"])
def test_no_monitor_reads_an_age_that_nothing_writes_there_under_any_reading(name: str) -> None:
    """With S31=IGNORE the wheels did: the age on the grid was an input."""
    inputs = {v.name for v in lower(systems({"S31": "IGNORE"})[name]).inputs}
    assert not {"rx_age", "rx_age_ms", "heartbeat_age"} & inputs
