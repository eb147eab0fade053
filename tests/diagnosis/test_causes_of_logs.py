"""Causes in folders of logs: some cannot be followed to their end, and show little of what is wrong."""

from collections.abc import Mapping
from dataclasses import replace
from typing import cast

import pytest

from rovercheck.checker.conformance.cones import LogCone
from rovercheck.checker.conformance.deviations import Deviation
from rovercheck.checker.conformance.recording import Raw
from rovercheck.checker.diagnosis import same_reading, trial
from rovercheck.checker.diagnosis.change import TIERS, ChartChange
from rovercheck.checker.diagnosis.evidence import Evidence, EvidenceCollector
from rovercheck.checker.diagnosis.hypotheses import beginning_changes, mutant_changes, stamp_changes
from rovercheck.checker.diagnosis.limits import number_slots
from rovercheck.checker.diagnosis.part_causes import DeviationCause, PartChanges, SearchedPart
from rovercheck.checker.diagnosis.pieces import Pieces
from rovercheck.checker.diagnosis.row_judge import OPEN, RowJudge
from rovercheck.checker.diagnosis.trial import TrialBench
from rovercheck.checker.diagnosis.values_together import TooManyStates
from rovercheck.spec_model.abstraction import boards
from tests.diagnosis.planted import LostTracker, inputs, recorded

BOARD1, BOARD2 = boards()["board1"], boards()["board2"]


class Bench:
    """Says of conforming runs which are left open, and that all of the last run is explained.

    Or that a row of it is left open, where the charts as drawn decide the run to its end or not.  ``end``:
    how many rows of each run count.
    """

    def __init__(
        self, conforming: int, left_open: int, row: int = 0, to_its_end: bool = True, end: int = 10
    ) -> None:
        self.runs: list[list[int]] = [[0] * 10 for _ in range(conforming + 1)]
        self._open, self._row, self._to_its_end, self._end = left_open, row, to_its_end, end

    def end(self, _number: int) -> int:
        return self._end

    def decides(self, rows: Pieces) -> bool:
        return any(row < self._end for _, row in rows)

    def decided(self, number: int) -> bool:
        return self._to_its_end or number < len(self.runs) - 1

    def holds(self, _cone: object, number: int, _parameter: object = None) -> bool | None:
        return None if number < self._open else True

    def mismatches(self, _cone: object, number: int, _parameter: object = None) -> list[object]:
        assert number == len(self.runs) - 1
        return [(self._row, None)] if self._row else []


@pytest.mark.parametrize("left_open", [0, 1, 3, 4])
def test_of_ten_conforming_runs_a_change_may_leave_one_open(left_open: int) -> None:
    """With an alive counter of three bits one of fifty logs, without a column, cannot be followed."""
    conforming = 3 * OPEN + 5
    bench = Bench(conforming, left_open)
    piece = frozenset({("isMotionConsistent", 0)})
    base: list[Mapping[int, frozenset[tuple[str, int]]]] = [*({} for _ in range(conforming)), {7: piece}]
    judge = RowJudge({0: {(id(bench.runs[-1]), 7): piece}})
    asked = cast(TrialBench, bench), base, cast(LogCone, None)
    found = judge.all_right(*asked, None, frozenset({0}))
    assert (found is not None) is (left_open <= 3)
    assert (judge.mostly_right(*asked) is not None) is (left_open <= 3)
    assert judge.all_right(*asked, ("a number that is left open", 290), frozenset({0})) is not None
    if found is not None:
        assert judge.explained(frozenset({0}), asked[0], found) == {0}


@pytest.mark.parametrize(
    ("row", "to_its_end", "counts"), [(9, False, True), (9, True, False), (7, False, False)]
)
def test_a_run_that_is_left_open_may_be_so_from_an_earlier_row_on(
    row: int, to_its_end: bool, counts: bool
) -> None:
    """A critical temperature that lasts a step longer was unnamed: a log was open one row earlier with it."""
    bench = Bench(1, 0, row, to_its_end)
    piece = frozenset({("temp_status", 0)})
    judge = RowJudge({0: {(id(bench.runs[-1]), 7): piece}})
    asked = cast(TrialBench, bench), [{}, {7: piece}], cast(LogCone, None)
    assert (judge.all_right(*asked, None, frozenset({0})) is not None) is counts


def test_what_lies_behind_the_rows_that_count_is_explained_by_nothing() -> None:
    """It was taken to be right with whatever was tried first, and what that explained beside it with it."""
    bench = cast(TrialBench, Bench(1, 0, end=5))
    piece = frozenset({("B2Dec", 0)})
    run = id(bench.runs[-1])
    judge = RowJudge({0: {(run, 3): piece}, 1: {(run, 7): piece}, 2: {(run, 4): piece, (run, 8): piece}})
    every = frozenset({0, 1, 2})
    found = judge.all_right(bench, [{}, dict.fromkeys((3, 4, 7, 8), piece)], cast(LogCone, None), None, every)
    assert found == [{}, {7: piece, 8: piece}]
    assert judge.explained(every, bench, found) == {0, 2}


def test_a_run_that_cannot_be_followed_is_neither_right_nor_wrong(monkeypatch: pytest.MonkeyPatch) -> None:
    given = inputs("board1", [(20, {}), (20, {"temperature_degC": 70.0})])
    run = recorded("board1", BOARD1.system, given, "hot")
    [block] = run.blocks()
    status: list[Raw | None] = [1] * len(given)
    other = {**block.values, "temp_status": status}
    collector = EvidenceCollector(BOARD1)
    collector.add(replace(run, blocks=lambda: [replace(block, values=other)]))
    [part] = [one for one in collector.evidence().parts if one.name == "Monitor_temperature"]
    bench = TrialBench(part)
    assert bench.holds(part.cone, 0) is False
    monkeypatch.setattr(trial.TrialBench, "_followed", _too_many)
    monkeypatch.setattr(trial, "_explained", lambda *_: 0)
    monkeypatch.setattr(trial, "Tracker", LostTracker)
    assert bench.holds(part.cone, 0) is None


def _too_many(*_: object) -> int | None:
    raise TooManyStates


def test_what_a_formula_counts_are_no_numbers_to_try() -> None:
    of_windows = list(number_slots(BOARD2.system, frozenset({"Coherence.short"})))
    result = [s for s in of_windows if s.at == "block fast_result"]
    assert [(s.op is not None, s.old.value) for s in result] == [(True, 8), (False, 0)]
    weights = {s.old.value for s in number_slots(BOARD1.system, frozenset({"Fault_masks"}))}
    assert {1, 2, 4, 8} <= weights


def test_another_initial_value_of_a_number_comes_after_a_limit_and_one_of_a_flag_before_it() -> None:
    only = frozenset({"Monitors_2", "Backward_mode_toggle_2", "Motion_Supervision_2"})
    every = [*mutant_changes(BOARD2.system, only), *beginning_changes(BOARD2.system, only)]
    initial = {c.at: c.nearness[0] for c in every if c.kind == "initial"}
    gaps = [tier for at, tier in initial.items() if "imu_gap9_ms" in at]
    assert gaps and all(TIERS["limit"] < tier < TIERS["constant"] for tier in gaps)
    flags = [tier for at, tier in initial.items() if "backward_enabled" in at]
    assert flags and all(tier < TIERS["repair"] for tier in flags)


def test_of_ways_to_take_a_stamp_that_explain_as_much_the_later_one_comes_first() -> None:
    found = [
        c
        for c in stamp_changes(BOARD1, BOARD1.system, frozenset({"Monitor_reception"}))
        if c.at == "stamp/b2_data_last_valid_ms" and "in every step from update" in c.new
    ]
    inorder = [c.new.split()[6] for c in sorted(found, key=lambda c: c.nearness)]
    assert inorder == ["256", "128", "64", "32", "16", "8", "4", "2", "1"]


@pytest.mark.parametrize("fits", ["8", "64", "none"])
def test_a_stamp_is_taken_in_one_way_in_all_parts(fits: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """One part shows no update before the sixty-fourth; the other one tells that it is the eighth."""

    def way(number: str, part: str) -> ChartChange:
        at, new = "stamp/b2_data_last_valid_ms", f"new in every step from update {number} on"
        of = stamp_changes(BOARD1, BOARD1.system, frozenset({part}))
        return next(c for c in of if c.at == at and c.new == new)

    def searched(part: str, change: ChartChange) -> SearchedPart:
        return SearchedPart(part, ((DeviationCause(part, change, ()), (0,)),), (change,), (0,), None)

    def held(_: object, one: PartChanges) -> PartChanges:
        return one if f"update {fits} on" in one.changes[0].new else replace(one, deviations=())

    monkeypatch.setattr(same_reading, "that_hold", held)
    parts = [
        searched("Relay", way("64", "Monitor_reception")),
        searched("Masks", way("8", "Monitor_reception")),
    ]
    made = same_reading.read_alike(cast(Evidence, None), parts, [cast(Deviation, None)])
    told = [one.changes[0].new.split()[6] for one in made]
    assert told == {"8": ["8", "8"], "64": ["64", "64"], "none": ["64", "8"]}[fits]
    assert [cause.change for one in made for cause, _ in one.causes] == [one.changes[0] for one in made]


def test_another_code_of_an_equality_is_no_limit_and_comes_behind_another_member() -> None:
    """`B2Dec == 2` in place of `B2Dec == 4` was told, as an open limit, where two members were exchanged."""
    slots = list(number_slots(BOARD2.system, frozenset({"TranslateDecision"})))
    codes = [slot.change(slot.op, slot.drawn + 1) for slot in slots if slot.of_equality]
    members = [c for c in mutant_changes(BOARD2.system) if c.kind == "member"]
    assert codes and members
    assert not any("limit" in code.text or "open" in code.text for code in codes)
    assert min(code.nearness for code in codes) > max(one.nearness for one in members)
