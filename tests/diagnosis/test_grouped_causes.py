"""Causes of a part that deviates in several ways: masked ones, exchanged members, inputs taken otherwise."""

from dataclasses import replace

import pytest

from rovercheck.checker.conformance.recording import Raw, Recording
from rovercheck.checker.diagnosis import trial
from rovercheck.checker.diagnosis.causes import CauseGroups, cause_groups, followed
from rovercheck.checker.diagnosis.evidence import EvidenceCollector
from rovercheck.checker.mutate.rewrites import ASSIGNED, COMPARED, rewrites
from rovercheck.spec_model.abstraction import boards
from rovercheck.spec_model.lang.chart import Block, Chart
from rovercheck.spec_model.lang.edit import constant, in_expressions, timer
from rovercheck.spec_model.lang.time import sec
from tests.diagnosis.planted import LostTracker, changed, inputs, part_of, recorded

BOARD1 = boards()["board1"]
STAMP = "last_valid_b2_ms"


def grouped(part: str, *runs: Recording) -> CauseGroups:
    collector = EvidenceCollector(BOARD1)
    for run in runs:
        collector.add(run)
    behaviours = collector.evidence().behaviours
    found = [d for run in runs for d in behaviours[run.name].deviations if d.scope.part == part]
    return cause_groups(followed(BOARD1, runs), found, [part], 60)


def test_a_stamp_that_is_taken_otherwise_is_one_cause_under_the_input_made_of_it() -> None:
    """The firmware misses ten heartbeats: their age is longer, and so is once their mean gap."""
    given = inputs("board1", [(80, {})])
    held = [{**row, STAMP: given[min(n, 30)][STAMP]} if 30 <= n < 45 else row for n, row in enumerate(given)]
    run = recorded("board1", BOARD1.system, held, "held")
    [block] = run.blocks()
    [own] = recorded("board1", BOARD1.system, given, "given").blocks()
    told = replace(block, values={**block.values, STAMP: own.values[STAMP]})
    groups = grouped("Monitor_heartbeat", Recording("held", run.signals, True, lambda: [told]))
    assert len(groups.causes) in (1, 2) and not groups.cut
    assert {c.input for c in groups.causes} <= {
        f"heartbeat_age, which is computed from {STAMP}",
        f"heartbeat_slow, which is computed from {STAMP}",
    }
    assert groups.causes[0].input.startswith("heartbeat_age") and groups.causes[0].change is None


def test_members_are_exchanged_where_they_are_compared_or_where_they_are_assigned() -> None:
    chart = part_of("board1", "Motion_Supervision")
    pairs = {(one.site, *sorted((one.old, one.new))) for one in rewrites(chart, {}) if one.kind == "members"}
    assert (COMPARED, "CMD_AVOID_LEFT", "CMD_AVOID_RIGHT") in pairs
    assert (ASSIGNED, "CMD_AVOID_LEFT", "CMD_AVOID_RIGHT") in pairs
    assert all(one != two for _, one, two in pairs)


def test_what_is_not_decided_is_not_explained(monkeypatch: pytest.MonkeyPatch) -> None:
    """Too many states from the fourth row on: what deviates later was taken to be right with the change.

    The rows before the first deviation are explained without a tracker.
    """

    given = inputs("board1", [(20, {}), (20, {"temperature_degC": 70.0}), (300, {})])
    run = recorded("board1", BOARD1.system, given, "hot")
    [block] = run.blocks()
    cold: list[Raw | None] = [0] * len(given)
    cool = {**block.values, "temp_status": cold}
    collector = EvidenceCollector(BOARD1)
    collector.add(Recording("hot", run.signals, True, lambda: [replace(block, values=cool)]))
    [part] = [one for one in collector.evidence().parts if one.name == "Monitor_temperature"]
    bench = trial.TrialBench(part)
    monkeypatch.setattr(trial, "Tracker", LostTracker)
    assert [row for row, _ in bench.mismatches(part.cone, 0)] == list(range(23, len(given)))
    judged = bench.trial(part.cone)
    assert judged.cases and judged.explained == 0 and not judged.full


def test_two_changes_that_are_wrong_in_the_same_steps_are_found_one_on_top_of_the_other() -> None:
    """It is critical from 57 °C on, after 3 s: one alone makes no deviation right in all steps."""

    def both(part: Chart | Block) -> Chart | Block:
        assert isinstance(part, Chart)
        return in_expressions(in_expressions(part, constant(60, 57)), timer(3 * sec))

    held = [(n, {"temperature_degC": t}) for t in (70.0, 20.0, 57.5, 20.0, 58.0) for n in (45, 170)]
    run = recorded("board1", changed("board1", "Monitor_temperature", both), inputs("board1", held), "run")
    groups = grouped("Monitor_temperature", run)
    found = [c.change for c in groups.causes if c.change is not None]
    assert {c.kind for c in found} == {"limit", "timer"} and len(found) == len(groups.causes)
    assert "3 s" in " ".join(c.text for c in found)
    assert sorted(c.beside for c in groups.causes) == [False, True]
    assert all(c.deviations for c in groups.causes)
