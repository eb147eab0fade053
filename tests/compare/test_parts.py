"""Part by part: several faults at once are all told, each once and where it arises, in runs to their end."""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from functools import cache
from itertools import islice

import pytest

from rovercheck.checker.adapters import python
from rovercheck.checker.adapters.implementation import Implementation, Values
from rovercheck.checker.compare import CompareResult, RecordedRun, effort
from rovercheck.checker.compare.beside import Run, answers, played
from rovercheck.checker.compare.recorded_runs import counterexamples
from rovercheck.checker.compare.result import Allowance
from rovercheck.checker.compare.run_follower import RunFollower
from rovercheck.checker.compare.search import CompareSearch
from rovercheck.checker.compare.stimulus import InputBlock, Stimulus
from rovercheck.checker.compare.strategy import ENVIRONMENTS
from rovercheck.checker.conformance.decoder import InputDecoder
from rovercheck.checker.conformance.deviations import scope_of
from rovercheck.checker.conformance.signals import Vocabulary
from rovercheck.spec_model.abstraction import boards
from tests.compare.scenes import scenes

OURS = {
    "board1": "rovercheck.supervisor.board1:Board1",
    "board2": "rovercheck.supervisor.board2.board:Board2",
}
Fault = Callable[[dict[str, float], Values, int], None]
"""Changes the outputs of a step, given its inputs and its number."""
Misreading = Callable[[dict[str, float]], None]
"""Changes the inputs of a step, as the firmware reads them: what follows, follows."""


class Changed:
    """A supervisor of the project, with faults in what it reads and in what it gives."""

    def __init__(self, board: str, *faults: Fault, reads: Iterable[Misreading] = ()) -> None:
        self._right = python.start(OURS[board], boards()[board], isolated=False)
        self._faults, self._reads, self._step = faults, tuple(reads), 0

    def reset(self) -> None:
        self._right.reset()
        self._step = 0

    def step(self, inputs: Values) -> Values:
        self._step += 1
        read = dict(inputs)
        for misread in self._reads:
            misread(read)
        found = dict(self._right.step(read))
        for fault in self._faults:
            fault(found, inputs, self._step)
        return found

    def close(self) -> None:
        self._right.close()


@cache
def runs(board: str) -> tuple[Run, ...]:
    """Scenes with a part of the board each, and some runs of the model checker."""
    env = ENVIRONMENTS[board]
    return (*scenes(env), *islice(counterexamples(env.board), 15))


def search(
    board: str,
    implementation: Implementation,
    *,
    mismatches: int = 0,
    examples: int = 0,
    of: Iterable[Run] | None = None,
    deviating: Callable[[RecordedRun], None] = lambda run: None,
) -> CompareResult:
    allowance = Allowance(mismatches, budget=2_000)
    return CompareSearch(
        ENVIRONMENTS[board],
        implementation,
        effort("ci", examples),
        allowance=allowance,
        deviating=deviating,
    ).run(runs(board) if of is None else of)


def outputs(result: CompareResult) -> set[tuple[str, ...]]:
    return {one.scope.outputs for one in result.deviations}


# --- faults -------------------------------------------------------------------------------------


def first_step(found: dict[str, float], inputs: Values, step: int) -> None:
    """Wrong in the first step of every run, which hides what comes after from whoever stops there."""
    if step == 1:
        found["omega_user"] = found["omega_user"] + 0.5


def half_speed(found: dict[str, float], inputs: Values, step: int) -> None:
    found["v_ref"] = found["v_ref"] / 2


def never_warm(read: dict[str, float]) -> None:
    read["temperature_degC"] = min(read["temperature_degC"], 54.0)


def never_empty(read: dict[str, float]) -> None:
    read["battery_pct"] = max(read["battery_pct"], 30.0)


def wheel_always_heard(read: dict[str, float]) -> None:
    read["hasNoFeedback_FL"] = False


# --- tests --------------------------------------------------------------------------------------


def test_faults_hidden_by_one_in_the_first_step_are_all_told_and_each_where_it_arises() -> None:
    faulty = Changed("board1", first_step, half_speed, reads=[never_warm, never_empty, wheel_always_heard])
    result = search("board1", faulty)
    assert {(one.scope.part, one.scope.outputs) for one in result.deviations} == {
        ("Monitor_temperature", ("temp_status",)),
        ("Monitor_battery", ("batt_status",)),
        ("Monitor_wheel_FL", ("wheel_status_FL",)),
        ("Motion_Supervision", ("omega_user",)),
        ("Motion_Supervision", ("v_ref",)),
    }
    assert result.compared == result.coverage.steps, "every run goes to its end"
    assert [d.runs for d in result.deviations] == sorted((d.runs for d in result.deviations), reverse=True)
    of_first = [d for d in result.deviations if d.scope.outputs == ("omega_user",)]
    assert sum(d.runs for d in of_first) == result.coverage.runs


@pytest.mark.parametrize(
    ("misread", "status"),
    [(never_warm, "temp_status"), (never_empty, "batt_status"), (wheel_always_heard, "wheel_status_FL")],
)
def test_a_fault_upstream_is_told_there_only(misread: Misreading, status: str) -> None:
    """What is downstream goes by what the implementation itself gives there."""
    result = search("board1", Changed("board1", reads=[misread]))
    assert outputs(result) == {(status,)}


def test_one_difference_is_one_group_over_all_runs_with_its_counts() -> None:
    every: list[RecordedRun] = []
    result = search("board1", Changed("board1", first_step), deviating=every.append)
    assert len(every) == result.coverage.runs and all(run.outputs and len(run.outputs) > 0 for run in every)
    assert sum(one.runs for one in result.deviations) == result.coverage.runs == len(every)
    assert all(one.count == one.runs and one.first.tick == 1 for one in result.deviations)
    assert len({one.scope for one in result.deviations}) == len(result.deviations)


def test_a_block_is_looked_through_to_the_chart_that_decides() -> None:
    def other_way(found: dict[str, float], inputs: Values, step: int) -> None:
        if found["esp_status"] == 0 and found["cmd"] == 6:
            found["cmd"] = 0

    def never_speeds(found: dict[str, float], inputs: Values, step: int) -> None:
        found["current_action"] = (int(found["current_action"]) + 1) % 2

    result = search("board2", Changed("board2", other_way, never_speeds))
    told = {one.first.decided_by for one in result.deviations}
    assert "Motion_Supervision_2" in told
    assert all("block" not in one for one in told)
    of_cmd = [one for one in result.deviations if one.scope.outputs == ("cmd",)]
    assert {one.first.decided_by for one in of_cmd} <= {"ObstaclesDriving, which Obstacle_command passes on"}


def test_two_faults_of_one_chart_are_told_apart() -> None:
    """Four monitors are parallel states of one chart: each has its own."""

    def both(found: dict[str, float], inputs: Values, step: int) -> None:
        if step > 2:
            found["esp_status"] = 2 - int(found["esp_status"])
            found["imu_status"] = 2 - int(found["imu_status"])

    result = search("board2", Changed("board2", both))
    regions: dict[tuple[str, ...], str] = {
        ("esp_status",): "Monitors_2.BLE",
        ("imu_status",): "Monitors_2.IMU",
    }
    assert set(regions) <= outputs(result)
    for one in result.deviations:
        region = regions.get(one.outputs)
        if region:
            assert all(move.startswith(region) for move in one.scope.charts)


def test_what_is_no_value_is_told_and_what_reads_it_goes_on() -> None:
    def nonsense(found: dict[str, float], inputs: Values, step: int) -> None:
        if step == 2:
            found["temp_status"] = 77
        if step == 3:
            found["v_ref"] = float("nan")
        if step == 4:
            del found["batt_status"]

    result = search("board1", Changed("board1", nonsense))
    told = {d for one in result.deviations for d in one.scope.differences}
    assert told == {
        ("temp_status", "a value", "77"),
        ("v_ref", "a value", "nan"),
        ("batt_status", "a value", "missing"),
    }
    assert not result.undecided


def test_an_output_that_nobody_requires_may_be_missing() -> None:
    """Without authority Board 2 sends no speeds; it was told as a deviation wherever something else was."""
    env = ENVIRONMENTS["board2"]

    def unasked(read: dict[str, float]) -> None:
        read["crit_mask_b1"] = 0 if read["now_ms"] > 1200 else read["crit_mask_b1"]

    driven = Stimulus((InputBlock(3, env.at_rest), InputBlock(300, (("crit_mask_b1", 4),))))
    run = "driven", played(env.board, env.fields, driven)
    assert {"left_rpm"} <= {name for name, value in run[1][-1].expected.items() if value is not None}
    result = search("board2", Changed("board2", reads=[unasked]), of=[run])
    told = {d for one in result.deviations for d in one.scope.differences}
    assert ("b1_requests_switch", "true", "false") in told
    assert not any(actual == "missing" for _, _, actual in told)


def test_the_small_run_has_the_same_difference_and_budgets_are_kept() -> None:
    implementation = Changed("board1", first_step, reads=[never_warm])
    result = search("board1", implementation, mismatches=10)
    assert result.small == len(result.mismatches)
    for one in result.mismatches:
        assert one.deviation is not None
        inputs = [step.inputs for step in one.steps]
        given = answers(inputs, implementation)
        found = RunFollower(one.board).first(inputs, given, scope_of(one.deviation.first))
        assert found is not None and found.tick == one.tick
    spent = replace(Allowance(10, budget=2_000), total=0)
    poor = CompareSearch(ENVIRONMENTS["board1"], implementation, effort("ci", 0), allowance=spent)
    assert not any(one.small for one in poor.run(runs("board1")).mismatches)


def test_a_deviating_run_is_a_recording_that_others_can_follow() -> None:
    every: list[RecordedRun] = []
    search("board1", Changed("board1", reads=[never_warm]), deviating=every.append)
    board = boards()["board1"]
    run = every[0]
    decoder = InputDecoder(Vocabulary(board), frozenset(run.block.values), from_power_up=True)
    seen = decoder.decode(run.block)
    assert len(run.block) == len(run.steps) == len(run.outputs)
    assert set(seen) == set(Vocabulary(board).sights) and all(None not in cells for cells in seen.values())
    assert RunFollower(board).behaviour(run).deviations


@pytest.mark.parametrize("board", ["board1", "board2"])
def test_nothing_is_told_of_what_conforms_even_where_it_is_followed(board: str) -> None:
    right: Iterator[Run] = iter(runs(board))
    found = CompareSearch(
        ENVIRONMENTS[board],
        Changed(board),
        effort("ci", 0),
        watched=True,
    ).run(right)
    assert found.conforms and not found.undecided and found.situations
