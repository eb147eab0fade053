"""The cross-check: our supervisors conform, planted faults are found and become tests."""

import os
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import replace
from itertools import islice
from pathlib import Path

import pytest

from rovercheck.checker.adapters import python
from rovercheck.checker.adapters.implementation import Implementation, ImplementationError, Values
from rovercheck.checker.compare import StepMismatch, cross_check, effort, quick_check
from rovercheck.checker.compare.beside import Run, compared, rerun
from rovercheck.checker.compare.check import RunCache, recorded_suite
from rovercheck.checker.compare.coverage import transitions
from rovercheck.checker.compare.recorded_runs import counterexamples
from rovercheck.checker.compare.reproduce import file_name, reproduction, script_of
from rovercheck.checker.compare.result import ALLOWED, FIXED, RANDOM, Allowance
from rovercheck.checker.compare.search import CompareSearch
from rovercheck.checker.compare.smaller import Budget, smaller
from rovercheck.checker.compare.strategy import ENVIRONMENTS
from rovercheck.checker.testgen.scripts import blocks, steps
from rovercheck.spec_model.abstraction import boards
from tests.compare import cross_faults
from tests.compare.cross_faults import FAULTS
from tests.faults import FaultSuite

EXAMPLES = {"board1": 5, "board2": 10}
"""Random runs beside the fixed ones: enough for these faults."""
BUDGET = 8_000
"""Steps for making one mismatch small."""
OURS = {
    "board1": "rovercheck.supervisor.board1:Board1",
    "board2": "rovercheck.supervisor.board2.board:Board2",
}
HERE = Path(cross_faults.__file__)
PLANTED = tuple(f"{board} {fault.__name__}" for board, faults in FAULTS.items() for fault in faults)


def running(board: str, target: str) -> Implementation:
    """A supervisor in this process."""
    return python.start(target, boards()[board], isolated=False)


@pytest.mark.long
@pytest.mark.parametrize("board", ["board2", "board1"])
def test_our_supervisor_conforms(board: str) -> None:
    assert quick_check(board, running(board, OURS[board]), examples=EXAMPLES[board]) is None
    suite = recorded_suite(board, "ci", EXAMPLES[board])
    assert suite.steps > 5_000 and len(suite.runs) > EXAMPLES[board]


class TestPlanted(FaultSuite):
    """Supervisors with a fault each, on their boards."""

    FAULTS = PLANTED

    def killed(self, fault: str, patch: pytest.MonkeyPatch) -> bool:
        board, name = fault.split()
        found = quick_check(board, running(board, f"{HERE}:{name}"), examples=EXAMPLES[board])
        return isinstance(found, StepMismatch) and bool(found.differences)


def made_small(board: str, fault: str) -> StepMismatch:
    """The mismatch of a fault, as the command shows it."""
    faulty = running(board, f"{HERE}:{fault}")
    found = quick_check(board, faulty, examples=EXAMPLES[board])
    assert found is not None
    return smaller(ENVIRONMENTS[board], found, faulty, Budget(BUDGET))


def test_a_mismatch_is_small_and_becomes_a_test_that_fails_until_the_fault_is_gone(tmp_path: Path) -> None:
    address = f"python:{HERE}:LateReception"
    mismatch = made_small("board1", "LateReception")
    assert mismatch.differences[0].name == "rx_status"
    assert mismatch.tick <= 8 and len(blocks(mismatch.board, script_of(mismatch))) <= 3
    file = tmp_path / file_name(mismatch)
    file.write_text(reproduction(mismatch, address), encoding="utf-8")
    said = said_by_pytest(file, {})
    assert "1 failed" in said and f"step {mismatch.tick} (" in said and "'rx_status': (" in said
    assert "1 passed" in said_by_pytest(file, {"ROVERCHECK_IMPL": f"python:{OURS['board1']}"})


def said_by_pytest(file: Path, more: dict[str, str]) -> str:
    """What pytest says of a file, away from this project's own configuration."""
    command = [sys.executable, "-m", "pytest", "-q", "-c", os.devnull, "-p", "no:cacheprovider", str(file)]
    environment = {**os.environ, "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1", **more}
    found = subprocess.run(
        command, capture_output=True, text=True, check=False, cwd=file.parent, env=environment, timeout=300
    )
    return found.stdout


def test_a_deep_mismatch_is_small_and_names_the_transition() -> None:
    mismatch = made_small("board1", "LateRelay")
    assert mismatch.tick < 400
    assert mismatch.transitions[0].chart == "Relay" and mismatch.transitions[0].target == ("B1_actuating",)
    again = steps(mismatch.board, script_of(mismatch), int(mismatch.steps[0].inputs["now_ms"]))
    faulty = running("board1", f"{HERE}:LateRelay")
    assert compared(mismatch.board, rerun(mismatch.board, again), faulty) == replace(
        mismatch, origin="", small=False
    )


def test_a_mismatch_of_random_runs_alone_is_shrunk() -> None:
    result = cross_check(
        "board2",
        running("board2", f"{HERE}:SwappedSonars"),
        effort("ci", 10),
        allowance=Allowance(budget=3000),
    )
    assert result.mismatches and min(m.tick for m in result.mismatches) < 20


def test_the_same_profile_tries_the_same() -> None:
    first, second = (
        cross_check("board2", running("board2", OURS["board2"]), effort("ci", 4, 9)) for _ in range(2)
    )
    assert first.coverage.steps == second.coverage.steps and first.coverage.taken == second.coverage.taken
    assert first.conforms and first.transitions[1] == len(transitions(first.board))
    other = cross_check("board2", running("board2", OURS["board2"]), effort("ci", 4, 10))
    assert other.coverage.steps != first.coverage.steps


class Silent:
    """Has no outputs."""

    def reset(self) -> None: ...

    def step(self, inputs: object) -> dict[str, float]:
        return {}

    def close(self) -> None: ...


def test_an_implementation_without_outputs_is_inconclusive() -> None:
    result = cross_check("board2", Silent(), effort("ci", 0))
    assert not result.conclusive and not result.conforms and not result.mismatches
    assert len(result.uncompared) == len(boards()["board2"].outputs)


def test_a_crash_is_a_finding_with_its_step_and_other_runs_go_on() -> None:
    result = cross_check("board2", running("board2", f"{HERE}:Crashing"), effort("ci", 0))
    assert result.failures and result.differs and not result.conforms
    first = result.failures[0]
    assert f"step {first.tick}:" in first.message and "nobody steers" in first.message
    assert result.coverage.runs > len(result.failures)
    again = rerun(first.board, [step.inputs for step in first.steps])
    assert again[-1].expected["esp_status"] == 2


class Dying:
    """Fails in the sixth step, after a wrong status in an earlier one, if any."""

    def __init__(self, board: str, wrong: int = 0) -> None:
        self._wrong = wrong
        self._one = python.start(OURS[board], boards()[board], isolated=False)
        self._steps = 0

    def reset(self) -> None:
        self._one.reset()
        self._steps = 0

    def step(self, inputs: Values) -> Values:
        self._steps += 1
        if self._steps == 6:
            raise ImplementationError("broken", 6)
        found = dict(self._one.step(inputs))
        if self._steps == self._wrong:
            found["rover_safety_state"] = 1 - int(found["rover_safety_state"])
        return found

    def close(self) -> None: ...


def test_what_differs_before_a_crash_is_found_all_the_same() -> None:
    result = cross_check("board1", Dying("board1", wrong=4), effort("ci", 0), allowance=Allowance(budget=0))
    assert len(result.failures) == ALLOWED.failures and {f.tick for f in result.failures} == {6}
    assert result.mismatches and {m.tick for m in result.mismatches} == {4}


def test_crashes_in_random_runs_alone_end_the_search() -> None:
    for failures in (3, 5):
        search = CompareSearch(
            ENVIRONMENTS["board1"],
            Dying("board1"),
            effort("ci", 50),
            allowance=Allowance(5, failures, budget=0),
        )
        result = search.run()
        assert len(result.failures) == failures
        fixed, random = result.stages
        assert (fixed.because, random.tried, random.of) == ("", search.tried[RANDOM], 50)
        assert random.tried < 50 and random.because == f"given up after {failures} runs not survived"


def test_ctrl_c_keeps_what_was_found() -> None:
    def interrupt(search: object) -> None:
        raise KeyboardInterrupt

    result = cross_check("board1", running("board1", OURS["board1"]), progress=interrupt)
    assert result.interrupted and not result.conforms and result.coverage.runs == 1
    assert [(s.tried, s.because) for s in result.stages] == [(1, "interrupted"), (0, "interrupted")]


def test_ctrl_c_while_runs_are_made_leaves_none_out_the_next_time() -> None:
    ends = [KeyboardInterrupt()]

    def runs() -> Iterator[Run]:
        yield "first", []
        if ends:
            raise ends.pop()
        yield "second", []

    remembered = RunCache(runs)
    with pytest.raises(KeyboardInterrupt):
        list(remembered)
    assert [name for name, _ in remembered] == [name for name, _ in remembered] == ["first", "second"]


@pytest.mark.parametrize("wanted", [0, 2, 100])
def test_distinct_mismatches_are_all_told_apart_and_as_many_made_small_as_are_wanted(wanted: int) -> None:
    class Wrong:
        """Every output of Board 2 is wrong now and then."""

        def __init__(self) -> None:
            self._right = running("board2", OURS["board2"])
            self._reset = 0

        def reset(self) -> None:
            self._right.reset()
            self._reset += 1

        def step(self, inputs: Values) -> Values:
            found = dict(self._right.step(inputs))
            name = sorted(found)[self._reset % len(found)]
            return found | {name: found[name] + 1}

        def close(self) -> None: ...

    allowance = Allowance(mismatches=wanted)
    search = CompareSearch(
        ENVIRONMENTS["board2"], Wrong(), effort("ci", 0), allowance=replace(allowance, budget=20)
    )
    result = search.run(islice(counterexamples(boards()["board2"]), 30))
    keys = {m.key for m in result.mismatches}
    assert len(keys) == len(result.mismatches) > 5
    assert result.small == min(wanted, len(keys))
    assert result.compared == result.coverage.steps, "every run goes to its end"


def test_every_random_run_is_drawn_whatever_is_found() -> None:
    """The first new mismatch ended the random runs, and nothing said so."""
    result, right = (
        CompareSearch(
            ENVIRONMENTS["board2"], running("board2", target), effort("ci", 15), allowance=Allowance(budget=0)
        ).run()
        for target in (f"{HERE}:SwappedSonars", OURS["board2"])
    )
    assert result.mismatches and right.conforms
    assert [(s.kind, s.because) for s in result.stages] == [(FIXED, ""), (RANDOM, "")]
    assert result.stages[1].tried == result.stages[1].of == 15
    assert result.coverage.runs == right.coverage.runs and result.coverage.steps == right.coverage.steps
    assert result.compared == right.compared == right.coverage.steps
