"""The Board 2 supervisor run step by step on its rows: limits at N-1, N, N+1, first executions, records."""

from collections.abc import Iterable, Sequence
from fractions import Fraction
from itertools import accumulate, pairwise
from random import Random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rovercheck.spec_model.ambiguity import fixed
from rovercheck.spec_model.board2 import acquisition, coherence
from rovercheck.spec_model.board2.monitor_systems import SYSTEMS as MONITORS
from rovercheck.spec_model.board2.monitors import from_critical
from rovercheck.spec_model.board2.slow2 import exact, runs
from rovercheck.spec_model.board2.supervisor_systems import SYSTEMS as OTHERS
from rovercheck.spec_model.lang.chart import Chart, State
from rovercheck.spec_model.lang.interpret import Interpreter
from rovercheck.spec_model.lang.system import System, in_order
from rovercheck.spec_model.signals import board2_motion as motion
from rovercheck.spec_model.signals import board2_supervisor as b2
from rovercheck.spec_model.signals.board2_supervisor import BLE, IMU, RX, SOURCES, SUP, SourceSignals
from tests.profiles import examples
from tests.test_lowering import compare

SYSTEM = {system.name: fixed({}).system(system) for system in (*MONITORS.values(), *OTHERS.values())}
Value = int | float | str
BY_REGION = {source.region: source for source in SOURCES}


class Run:
    """A system with inputs as people write them; what is not given is 0 or false."""

    def __init__(self, system: str | System) -> None:
        self.system = SYSTEM[system] if isinstance(system, str) else system
        self.rover = Interpreter(self.system)

    def step(self, **given: Value) -> "Run":
        named = {name.replace("__", "."): value for name, value in given.items()}
        assert named.keys() <= self.system.inputs.keys(), named.keys() - self.system.inputs.keys()
        self.rover.step({
            n: v.domain.raw(named[n]) if n in named else v.init for n, v in self.system.inputs.items()
        })  # fmt: skip
        return self

    def steps(self, count: int, **given: Value) -> "Run":
        for _ in range(count):
            self.step(**given)
        return self

    def __getitem__(self, name: str) -> str:
        return self.system.written[name].domain.show(self.rover.data[name])


# --- monitors ----------------------------------------------------------------------------------------


def statuses(source: SourceSignals, updates: Iterable[bool]) -> list[str]:
    """The level of the source after each step: OK, DEG or CRIT."""
    run, name = Run(f"monitors_2_{source.region}_exact"), source.update.name.replace(".", "__")
    shown = []
    for update in updates:
        run.step(**{name: update})
        shown.append(("OK", "DEG", "CRIT")[source.levels.index(run[source.status.name])])
    return shown


def stamps(*gaps: int) -> list[bool]:
    """An update after each gap, in ticks; the first gap counts from power-up."""
    return [last for gap in gaps for last in (*[False] * (gap - 1), True)]


@pytest.mark.parametrize(
    ("source", "first"), [(SUP, 8), (BLE, 7), (IMU, 11), (RX, 7)], ids=lambda p: getattr(p, "region", p)
)
def test_a_silent_source_is_critical_in_the_first_step_above_its_limit(
    source: SourceSignals, first: int
) -> None:
    shown = statuses(source, [False] * first)
    assert shown == ["OK"] * (first - 1) + ["CRIT"]


@pytest.mark.parametrize("region", BY_REGION)
def test_a_critical_source_returns_after_its_rest_whatever_its_age(region: str) -> None:
    source = BY_REGION[region]
    rest = from_critical(source).ticks(20)
    first = source.limit // 20 + 1
    shown = statuses(source, [False] * (first + rest + 3))
    assert set(shown[first - 1 : first + rest]) == {"CRIT"}
    assert shown[first + rest :] == ["OK", "CRIT", "CRIT"]


def test_rests_are_1_02_s_and_2_02_s() -> None:
    assert [from_critical(s).ticks(20) for s in (SUP, BLE, IMU, RX)] == [100, 50, 50, 50]


def test_the_first_question_in_step_2_takes_the_power_up_value_as_a_stamp() -> None:
    assert statuses(BLE, [*stamps(3), False])[-2:] == ["OK", "DEG"]  # one gap of 60 ms
    assert statuses(BLE, [*stamps(2), False, False])[-1] == "OK"  # stamp of step 2 is the first prev
    assert statuses(BLE, [*stamps(1, 2), False, False])[-1] == "OK"


def test_a_mean_on_the_limit_is_no_fault() -> None:
    assert "DEG" not in statuses(BLE, stamps(1, *[2] * 20))
    assert "DEG" in statuses(BLE, [*stamps(1, *[2] * 11, 3), False])
    assert "DEG" not in statuses(BLE, [*stamps(1, *[1] * 9, 6), False])
    assert "DEG" not in statuses(SUP, stamps(1, *[3] * 20))
    assert "DEG" not in statuses(IMU, stamps(1, *[5] * 20))
    assert "DEG" in statuses(IMU, [*stamps(1, 5, 6), False])


def test_a_stamp_in_a_step_with_a_transition_is_seen_at_the_next_question() -> None:
    # Gap of 3 at the first stamp; DEG in step 4, whose stamp merges with that of step 5: gaps 3, 2, 1.
    shown = statuses(BLE, [*stamps(3), *[True] * 60])
    assert shown[:4] == ["OK", "OK", "OK", "DEG"]
    # The mean is (3 + 2 + 1) / 3 = 2 in step 6, so the rest of 51 steps ends in step 57.
    assert shown[3:56] == ["DEG"] * 53
    assert shown[56] == "OK"


def test_a_degraded_source_that_falls_silent_is_critical() -> None:
    shown = statuses(BLE, [*stamps(3), *[False] * 8])
    assert shown[3:9] == ["DEG"] * 6
    assert shown[9] == "CRIT"  # 140 ms after the stamp of step 3


def test_degradation_comes_before_silence_and_a_slow_critical_source_stays_critical() -> None:
    shown = statuses(BLE, [*[False] * 7, *stamps(*[3] * 60)])
    assert shown[6] == "CRIT"
    assert set(shown[8:]) == {"CRIT"}


def lone(source: SourceSignals, record: Sequence[object]) -> System:
    """The record questioned in every step but the first, as a region that never takes a transition does."""
    slow2 = exact(source) if record == [exact] else runs(source)
    chart = Chart("EngineQuery", [State("OK", during=slow2.ask)], default="OK")
    return in_order("ask", slow2.note, chart)


gaps = st.lists(st.tuples(st.integers(1, 14), st.integers(1, 12)), min_size=1, max_size=6)


def by_time_stamps(updates: Sequence[bool], mean: int) -> list[bool]:
    """The definition: stamps in ms read in every step from 2 on, the mean of at most ten gaps."""
    at, latest, seen, found = 0, [0], [], []
    for tick, update in enumerate(updates, start=1):
        at = tick * 20 if update else at
        if tick == 2:
            latest = [at]
        if tick > 2 and at != latest[-1]:
            latest.append(at)
        seen = [later - earlier for earlier, later in pairwise(latest)][-10:]
        found.append(bool(seen) and Fraction(sum(seen), len(seen)) > mean)
    return found


@pytest.mark.parametrize("source", [SUP, BLE, IMU], ids=lambda s: s.region)
@given(sequence=gaps)
def test_the_exact_record_computes_the_mean_of_the_time_stamps(
    source: SourceSignals, sequence: list[tuple[int, int]]
) -> None:
    updates = stamps(*(gap for gap, times in sequence for _ in range(times)))
    run, found = Run(lone(source, [exact])), []
    for update in updates:
        run.step(**{source.update.name: update})
        found.append(run[source.deg.name] == "true")
    assert found == by_time_stamps(updates, source.mean)


@given(sequence=gaps)
def test_every_answer_of_the_exact_record_is_one_of_the_rows_of_gaps(
    sequence: list[tuple[int, int]],
) -> None:
    updates = stamps(*(gap for gap, times in sequence for _ in range(times)))
    run = Run(lone(BLE, [runs]))
    for update, slow in zip(updates, by_time_stamps(updates, BLE.mean), strict=True):
        run.step(esp_update=update, esp_mean_slow=slow)
        assert (run["deg_ble"] == "true") == slow


# --- authorisation, safety state, obstacle command ------------------------------------------------------


def test_authorised_at_once_and_given_up_after_3_02_s() -> None:
    run = Run("check_board1").step(B2__crit_mask_b1=4)
    assert run["autorized_to_send_command"] == "false"  # first execution
    assert run.step(B2__crit_mask_b1=4)["autorized_to_send_command"] == "true"
    assert run.steps(151)["autorized_to_send_command"] == "true"  # the cause is gone from the first of them
    assert run.step()["autorized_to_send_command"] == "false"


@pytest.mark.parametrize("cause", [dict(B2__crit_mask_b1=128), dict(B2__rx_status="RX_CRITICAL"),
                                   dict(b1_sup_status="SUP_CRITICAL")])  # fmt: skip
def test_each_cause_authorises_and_interrupts_the_return(cause: dict[str, Value]) -> None:
    run = Run("check_board1").step().step(**cause)
    assert run["autorized_to_send_command"] == "true"
    assert run.steps(149).step(**cause).steps(151)["autorized_to_send_command"] == "true"
    assert run.step()["autorized_to_send_command"] == "false"


@pytest.mark.parametrize("mask", [0, 1, 2, 8, 16, 32, 64])
def test_other_bits_of_board_1_do_not_authorise(mask: int) -> None:
    assert Run("check_board1").steps(5, B2__crit_mask_b1=mask)["autorized_to_send_command"] == "false"


def test_the_first_authorised_step_ignores_masks_and_distances() -> None:
    given: dict[str, Value] = dict(autorized_to_send_command=True, B2__crit_mask_b1=1)
    run = Run("safety_2").step(**given)  # the distances are 0
    assert (run["B2.rover_safety_state"], run["B2.cmd"]) == ("SAFETY_DEGRADED", "CMD_NORMAL")
    run.step(**given)
    assert (run["B2.rover_safety_state"], run["B2.cmd"]) == ("SAFETY_CRITICAL", "CMD_ESTOP")
    run.steps(3, d1=301, d2=301, d3=301)  # not authorised: frozen
    assert (run["B2.rover_safety_state"], run["B2.cmd"]) == ("SAFETY_CRITICAL", "CMD_ESTOP")
    run.step(autorized_to_send_command=True, d1=301, d2=301, d3=301)
    assert (run["B2.rover_safety_state"], run["B2.cmd"]) == ("SAFETY_DEGRADED", "CMD_NORMAL")


# --- coherence ------------------------------------------------------------------------------------------


def inconsistent(run: Run, count: int, **given: Value) -> list[int]:
    """The steps, counted from 1, in which the motion is inconsistent."""
    return [i for i in range(1, count + 1) if run.step(**given)["B2.isMotionConsistent"] == "false"]


SPIN: dict[str, Value] = dict(imu_update=True, IMU__gz_dps=10)
CREEP: dict[str, Value] = dict(imu_update=True, IMU__gz_dps=2)


def test_short_windows_of_one_degree_are_hits_and_eight_of_them_count() -> None:
    found = inconsistent(Run("coherence"), 60, **SPIN)
    assert found == [41, 46, 51, 56]  # window ends 6, 11, ... : the eighth is 41


def test_less_than_one_degree_is_no_hit() -> None:
    assert inconsistent(Run("coherence"), 140, imu_update=True, IMU__gz_dps=9) == []


def test_a_long_window_ends_after_3_s_and_only_its_step_is_inconsistent() -> None:
    assert inconsistent(Run("coherence"), 305, **CREEP) == [151, 301]


def test_wheels_that_explain_the_rotation_are_coherent() -> None:
    # 10 rpm of difference turn 9.17 degrees per second, 60 rpm turn 55.
    left: dict[str, Value] = dict(b1_sup_update=True, B2__wheel_speed_rpm_FL=60, B2__wheel_speed_rpm_RL=60)
    assert inconsistent(Run("coherence"), 40, imu_update=True, IMU__gz_dps=60, **left) == []
    assert inconsistent(Run("coherence"), 60, imu_update=True, IMU__gz_dps=-60, **left) == [41, 46, 51, 56]


def test_the_rotation_of_the_wheels_is_exact() -> None:
    # The stamp of step 2 comes 40 ms after power-up, the others 20 ms after one another.
    run = Run("coherence").step().steps(4, b1_sup_update=True, B2__wheel_speed_rpm_FL=60)
    odometry = Fraction(run["odo_long"])
    assert odometry == 60 * 5 * Fraction(1, 50)
    assert odometry * coherence.DEGREES_PER_RPM_S / 2 == Fraction(1743, 1900) * 30 * Fraction(5, 50)


@pytest.mark.parametrize(("gap", "counts"), [(4, True), (5, False)])
def test_a_gap_of_a_tenth_of_a_second_is_not_counted(gap: int, counts: bool) -> None:
    run = Run("coherence").step(b1_sup_update=True).steps(gap - 1)
    run.step(b1_sup_update=True, B2__wheel_speed_rpm_FL=60)
    assert (run["odo_long"] != "0") == counts


# --- motor commands ----------------------------------------------------------------------------------------


def test_the_ramp_the_limit_and_a_new_authorisation() -> None:
    full: dict[str, Value] = dict(autorized_to_send_command=True, v_ref_actuation=0.5)
    run = Run("actuation_2").step(**full)
    assert (run["B2.left_rpm"], run["B2.sends_speeds"], run["B2.stop_pin"]) == ("0", "false", "true")
    left = [run.step(**full)["B2.left_rpm"] for _ in range(22)]
    assert left == [str(min(80, rpm)) for rpm in accumulate([4] * 22)]
    assert run["B2.stop_pin"] == "false"
    run.step(v_ref_actuation=0.5)
    assert (run["B2.left_rpm"], run["B2.sends_speeds"]) == ("80", "false")
    assert run.step(**full)["B2.left_rpm"] == "4"


def test_a_turn_is_limited_on_the_fast_side() -> None:
    run = Run("actuation_2").steps(
        40, autorized_to_send_command=True, v_ref_actuation=0.5, omega_ref_actuation=0.5
    )
    assert (run["B2.left_rpm"], run["B2.right_rpm"]) == ("0", "80")


# --- acquisition -------------------------------------------------------------------------------------


def scan(*channels: int, late: int = 0) -> Run:
    """A scan in which the channels given capture 70 cm in the tick after the trigger, then ``late`` ticks."""
    run = Run("acquisition_sonar").steps(2)
    edges = {f"both_edges{i}": True for i in channels}
    return run.step(**edges).steps(late)


def test_three_channels_notify_and_publish_at_once() -> None:
    run = scan(1, 2, 3)
    assert (run["sonar_count"], run["sonar_notified"], run["sonar_published"]) == ("3", "true", "true")
    assert [run[d.name] for d in acquisition.distance] == ["70", "70", "70"]


def test_a_missing_echo_waits_for_20_ms_and_reads_301() -> None:
    assert scan(1, 2, late=18)["sonar_published"] == "false"
    run = scan(1, 2, late=19)
    assert (run["sonar_published"], run["sonar_notified"]) == ("true", "false")
    assert [run[d.name] for d in acquisition.distance] == ["70", "70", "301"]


def test_scans_come_every_60_ms_and_clear_the_flags() -> None:
    run = scan(1, 2, late=58)
    assert (run["flag1"], run["sonar_count"]) == ("true", "2")
    run.step()
    assert (run["flag1"], run["sonar_count"]) == ("false", "0")


@pytest.mark.parametrize(
    ("raw", "axis"), [(0, -1), (229, Fraction(-26, 255)), (230, 0), (255, 0), (280, 0),
                      (281, Fraction(26, 255)), (510, 1), (511, 1)]
)  # fmt: skip
def test_the_dead_zone_and_the_ends_of_an_axis(raw: int, axis: Fraction) -> None:
    run = Run("acquisition_joystick").step(ble_complete=True, raw_y=raw)
    assert run.rover.data["ble_y"] == axis * 255


def test_an_incomplete_read_keeps_the_data_and_renews_the_last_run() -> None:
    run = Run("acquisition_joystick").step(ble_complete=True, raw_y=510).steps(2, raw_y=0)
    assert (run["ble_y"], run["ble_last_valid"], run["ble_last_run"]) == ("1", "1", "3")


# --- the whole ---------------------------------------------------------------------------------------


def test_board_2_drives_when_board_1_never_sends() -> None:
    run = Run("board2")
    given: dict[str, Value] = dict(esp_update=True, imu_update=True, new_ay_norm=1, sonar_update=True,
                 new_d1=301, new_d2=301, new_d3=301)  # fmt: skip
    run.steps(6, **given)
    assert run["autorized_to_send_command"] == "false"
    run.step(**given)  # 140 ms without a frame
    assert (run["B2.rx_status"], run["autorized_to_send_command"]) == ("RX_CRITICAL", "true")
    assert (run["B2.critical_mask"], run["B2.sends_speeds"]) == ("4", "false")
    run.step(**given)
    assert (run["v_ref_actuation"], run["B2.left_rpm"], run["DEG_B1"]) == ("0.5", "4", "true")
    assert run["B2Dec"] == "5"


def test_the_decision_reads_the_authorisation_of_the_step_before() -> None:
    run = Run("board2").steps(2, sonar_update=True, new_d1=301, new_d2=301, new_d3=301)
    run.step(B2__rx_update=True, new_B2__crit_mask_b1=4)
    assert (run["autorized_to_send_command"], run["DEG_B1"]) == ("true", "true")  # by the mask itself
    run.step(B2__rx_update=True)
    assert (run["autorized_to_send_command"], run["DEG_B1"]) == ("true", "true")  # by the authorisation


def test_names_are_those_of_the_other_files() -> None:
    assert motion.v_ref_actuation.name in SYSTEM["actuation_2"].inputs
    assert b2.cmd.name in SYSTEM["safety_2"].written


AGREE = [n for n in SYSTEM if n not in ("board2", "board2_ms", "board2_on_its_own") and "exact" not in n]


@pytest.mark.parametrize("name", AGREE)
@settings(examples(3), deadline=None)
@given(seed=st.integers(0, 10_000))
def test_the_lowered_system_steps_as_the_interpreter_does(name: str, seed: int) -> None:
    draw, system = Random(seed), SYSTEM[name]
    held = {n: draw.choice(v.domain.values) for n, v in system.inputs.items()}
    ticks = []
    for _ in range(60):
        held |= {n: draw.choice(v.domain.values) for n, v in system.inputs.items() if draw.random() < 0.3}
        ticks.append(dict(held))
    compare(system, ticks)
