"""Is a log a run of the charts: good logs are, planted faults are found, each once, and nothing else is."""

from collections.abc import Iterable
from pathlib import Path
from random import Random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rovercheck.checker.conformance.cones import LogCone, cones
from rovercheck.checker.conformance.deviations import Deviation
from rovercheck.checker.conformance.follower import Behaviour
from rovercheck.checker.conformance.program import NeededInputs
from rovercheck.checker.conformance.signals import Vocabulary
from rovercheck.checker.logs import ColumnMap, examine
from rovercheck.checker.logs.mapping import Column
from rovercheck.spec_model.abstraction import boards
from rovercheck.spec_model.lang.evaluate import step
from rovercheck.spec_model.lang.interpret import Interpreter
from tests.logs.recorded import Row, copied, frozen, late, long_log, record, swapped, written
from tests.profiles import examples

SECOND = 50


def rows_of(board: str = "board1", count: int = 12 * SECOND) -> list[Row]:
    return copied(long_log(board)[:count])


def behaviour(
    folder: Path, rows: list[Row], without: Iterable[str] = (), how: ColumnMap | None = None
) -> Behaviour:
    return examine(written(folder, rows, without), how or ColumnMap()).behaviour


def only(found: Behaviour) -> Deviation:
    assert found.undecided == ()
    (one,) = found.deviations
    return one


def other(row: Row, output: str) -> None:
    """Another value of an output with a few values."""
    row[output] = (int(row[output]) + 1) % 2 if isinstance(row[output], bool) else (int(row[output]) + 1) % 3


# --- the step of a part -----------------------------------------------------------------------------


def everything(board: str) -> tuple[LogCone, ...]:
    """The parts of a board of which all is logged."""
    one = boards()[board]
    return cones(one, frozenset(Vocabulary(one).sights), frozenset(o.name for o in one.outputs))


@pytest.mark.parametrize("board", ["board1", "board2"])
@examples(5)
@given(random=st.randoms(use_true_random=False))
def test_the_compiled_step_is_that_of_the_transition_system(board: str, random: Random) -> None:
    """Every part, in runs with any values of the domains."""
    for part in everything(board):
        system = part.system
        at = {v.name: v.init for v in system.variables}
        for _ in range(15):
            inputs = {v.name: random.choice(v.domain.values) for v in system.inputs}
            after, _ = part.step(tuple(at.values()), tuple(inputs.values()))
            wanted = step(system, at, inputs)
            at = {name: wanted[name] for name in at}
            assert after == tuple(at.values())


def test_a_step_asks_only_for_what_it_reads() -> None:
    parts = {
        c.name: c for c in cones(boards()["board1"], frozenset(), frozenset({"temp_status", "batt_status"}))
    }
    temperature = parts["Monitor_temperature"]
    unknown = (None,) * len(temperature.system.inputs)
    with pytest.raises(NeededInputs) as needed:
        temperature.step(tuple(v.init for v in temperature.system.variables), unknown)
    assert needed.value.name in {"temperature_degC", "temp_age"}


@pytest.mark.parametrize("board", ["board1", "board2"])
def test_parts_share_nothing_that_is_not_logged(board: str) -> None:
    one, parts = boards()[board], everything(board)
    assert sorted(o.name for p in parts for o in p.outputs) == sorted(o.name for o in one.outputs)
    told = {*Vocabulary(one).sights, *(o.var.name for o in one.outputs)}
    assert all({v.name for v in p.system.inputs} <= told for p in parts)
    assert len(parts) >= 10


# --- good logs --------------------------------------------------------------------------------------


@pytest.mark.parametrize("board", ["board1", "board2"])
def test_the_executable_supervisors_run_as_the_charts(board: str, tmp_path: Path) -> None:
    found = behaviour(tmp_path, copied(long_log(board)))
    assert (found.deviations, found.undecided, found.left_out) == ((), (), ())
    assert len(found.compared) == len(boards()[board].outputs)


@examples(8)
@given(
    seed=st.integers(0, 10**6),
    board=st.sampled_from(["board1", "board2"]),
    restless=st.sampled_from([0.02, 0.2]),
)
def test_parts_explain_what_the_interpreter_does(
    tmp_path_factory: pytest.TempPathFactory, seed: int, board: str, restless: float
) -> None:
    """A log of the interpreter itself, with measurements between the representative values."""
    one = boards()[board]
    reader, charts, rows = one.reader(), Interpreter(one.system, measured=True), list[Row]()
    for row in record(one, 80, seed, restless):
        inputs = {s.name: row[s.name] for s in one.inputs}
        charts.step(reader.step(inputs))
        rows.append({**inputs, **one.expected(charts.data)})
    assert behaviour(tmp_path_factory.mktemp("log"), rows).deviations == ()


NOT_LOGGED = [
    ("board1", ["btn1", "btn2"]),
    ("board1", ["hasNoFeedback_FL", "hasNoFeedback_FR", "crit_mask_b2"]),
    ("board1", ["x_norm", "y_norm", "current_yaw"]),
    ("board1", ["last_valid_b2_ms", "b2_data_last_valid_ms", "now_ms"]),
    ("board1", ["rx_status", "critical_mask", "current_action"]),
    ("board2", ["btn1", "crit_mask_b1", "ble_last_valid_ms"]),
    ("board2", ["esp_status", "rover_safety_state", "DEG_B1"]),
]


@pytest.mark.parametrize(("board", "missing"), NOT_LOGGED)
def test_what_is_not_logged_is_inferred(board: str, missing: list[str], tmp_path: Path) -> None:
    assert behaviour(tmp_path, rows_of(board), missing).deviations == ()


@pytest.mark.parametrize("board", ["board1", "board2"])
def test_a_log_without_any_input_is_no_deviation_and_mostly_no_pass(board: str, tmp_path: Path) -> None:
    found = behaviour(tmp_path, rows_of(board), [s.name for s in boards()[board].inputs])
    assert found.deviations == ()
    assert found.undecided and all(u.because for u in found.undecided)


def test_a_log_may_begin_late_and_lose_rows(tmp_path: Path) -> None:
    rows = rows_of(count=1000)
    found = behaviour(tmp_path, rows[300:420] + rows[422:600] + rows[690:])
    assert found.deviations == ()


def test_numbers_within_the_tolerance_of_the_map_are_no_deviation(tmp_path: Path) -> None:
    rows = rows_of()
    for row in rows:
        row["v_ref"] = round(row["v_ref"] + 0.004, 2)
    assert {"v_ref"} == {n for d in behaviour(tmp_path, rows).deviations for n in d.outputs}
    how = ColumnMap(columns={"v_ref": Column("v_ref", tolerance=0.011)})
    assert behaviour(tmp_path, rows, how=how).deviations == ()


# --- planted faults ---------------------------------------------------------------------------------


def test_a_changed_cell_is_found_where_it_is(tmp_path: Path) -> None:
    rows = rows_of()
    other(rows[300], "temp_status")
    one = only(behaviour(tmp_path, rows))
    assert (one.kind, one.outputs, one.first.tick, one.first.line, one.count) == (
        "value",
        ("temp_status",),
        301,
        302,
        1,
    )
    assert one.first.moves and set(one.first.inputs) == {"temperature_degC", "temp_age"}


def test_a_late_output_is_one_deviation(tmp_path: Path) -> None:
    rows = copied(long_log("board1"))
    late(rows, "rover_safety_state")
    one = only(behaviour(tmp_path, rows))
    assert (one.kind, one.outputs) == ("late", ("rover_safety_state",)) and one.times > 1


def test_swapped_columns_are_one_deviation(tmp_path: Path) -> None:
    rows = rows_of()
    swapped(rows, "wheel_status_FL", "wheel_status_RR")
    one = only(behaviour(tmp_path, rows))
    assert one.kind == "swapped" and set(one.outputs) == {"wheel_status_FL", "wheel_status_RR"}


def test_a_stale_block_is_one_deviation(tmp_path: Path) -> None:
    rows = rows_of()
    outputs = [o.name for o in boards()["board1"].outputs]
    frozen(rows, outputs, 200, 300)
    found = behaviour(tmp_path, rows)
    assert found.deviations and all(200 < d.first.tick <= 300 and d.last <= 301 for d in found.deviations)
    assert [d.kind for d in found.deviations] in (["frozen"], ["value"])


def test_what_was_wrong_before_and_goes_on_is_not_a_stale_block(tmp_path: Path) -> None:
    """Faults of several parts were one deviation, "they stay", in whatever steps no output changed."""
    rows = rows_of()
    for row in rows[200:260]:
        row["temp_status"], row["batt_status"] = 2 - row["temp_status"], 2 - row["batt_status"]
    found = behaviour(tmp_path, rows).deviations
    assert {d.kind for d in found} == {"value"}
    assert {d.outputs for d in found} >= {("temp_status",), ("batt_status",)}


def test_rounding_is_found(tmp_path: Path) -> None:
    rows = rows_of()
    for row in rows:
        row["v_ref"] = round(row["v_ref"], 1) if row["v_ref"] != 0.4 else 0.4
    rows[-1]["v_ref"] = rows[-1]["v_ref"] + 0.01
    assert {"v_ref"} == {n for d in behaviour(tmp_path, rows).deviations for n in d.outputs}


def test_a_long_series_of_one_cause_is_one_deviation(tmp_path: Path) -> None:
    rows = rows_of()
    for row in rows[100:500]:
        row["batt_status"] = 1 if row["batt_status"] != 1 else 2
    found = behaviour(tmp_path, rows).deviations
    assert {d.outputs for d in found} == {("batt_status",)} and len(found) <= 3
    assert sum(d.count for d in found) <= 400


def test_lost_rows_without_times_are_found(tmp_path: Path) -> None:
    """Where no time is logged, every row is taken for the next step: a timer then runs too fast."""
    rows = copied(long_log("board1"))
    assert behaviour(tmp_path, rows, ["now_ms"]).deviations == ()
    start = next(i for i, r in enumerate(rows) if r["give_b2_actuation"])
    back = next(i for i in range(start, len(rows)) if not rows[i]["give_b2_actuation"])
    found = behaviour(tmp_path, rows[: back - 30] + rows[back - 10 :], ["now_ms"])
    assert ("give_b2_actuation",) in {d.outputs for d in found.deviations}


def test_three_faults_are_three_deviations(tmp_path: Path) -> None:
    rows = copied(long_log("board1"))
    late(rows, "rover_safety_state")
    swapped(rows, "wheel_status_FL", "wheel_status_FR")
    for place in (700, 900, 1100):
        rows[place]["backward_enabled"] = not rows[place]["backward_enabled"]
    found = behaviour(tmp_path, rows).deviations
    assert len(found) == 3
    assert {(d.kind, frozenset(d.outputs)) for d in found} == {
        ("late", frozenset({"rover_safety_state"})),
        ("swapped", frozenset({"wheel_status_FL", "wheel_status_FR"})),
        ("value", frozenset({"backward_enabled"})),
    }
    assert next(d for d in found if d.outputs == ("backward_enabled",)).times == 3


@pytest.mark.parametrize(("missing", "fault"), [
    (["btn1", "btn2"], "backward_enabled"),
    (["hasNoFeedback_FL", "crit_mask_b2"], "temp_status"),
    (["last_valid_b2_ms", "isMotionConsistent"], "give_b2_actuation"),
])  # fmt: skip
def test_a_fault_is_found_though_inputs_are_not_logged(
    missing: list[str], fault: str, tmp_path: Path
) -> None:
    rows = rows_of()
    other(rows[2], fault)
    found = behaviour(tmp_path, rows, missing)
    assert [d.outputs for d in found.deviations] == [(fault,)] and found.deviations[0].first.tick == 3


def test_a_fault_after_a_fault_is_found(tmp_path: Path) -> None:
    """After a deviation the charts are found again, and go on being compared."""
    rows = rows_of("board2", 2000)
    other(rows[400], "esp_status")
    other(rows[900], "imu_status")
    other(rows[1500], "autorized_to_send_command")
    found = behaviour(tmp_path, rows).deviations
    assert [d.first.tick for d in found] == [401, 901, 1501]
