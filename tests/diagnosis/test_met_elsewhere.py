"""What other recordings show is the cause also where columns are lost, and little is shown."""

from dataclasses import replace
from types import SimpleNamespace
from typing import cast

import pytest

from rovercheck.checker.conformance.deviations import Deviation, DeviationTally, WholeEvidence
from rovercheck.checker.conformance.recording import Recording
from rovercheck.checker.diagnosis import met_elsewhere
from rovercheck.checker.diagnosis.causes import cause_groups, followed
from rovercheck.checker.diagnosis.change import ChartChange
from rovercheck.checker.diagnosis.evidence import Evidence, PartEvidence
from rovercheck.checker.diagnosis.hypotheses import rewrite_changes, signals_of, stamp_changes
from rovercheck.checker.diagnosis.part_causes import SearchedPart
from rovercheck.spec_model.abstraction import boards
from tests.diagnosis.planted import Held, inputs, part_of, recorded

BOARD1 = boards()["board1"]
FL, FR = "hasNoFeedback_FL", "hasNoFeedback_FR"


def reads_the_other_wheel() -> ChartChange:
    found = rewrite_changes(BOARD1.system, signals_of(BOARD1), frozenset({"Monitor_wheel_FR"}))
    return next(c for c in found if c.kind == "exchanged" and {c.old, c.new} == {FR, FL})


def run(name: str, held: Held, without: str = "") -> Recording:
    whole = recorded("board1", reads_the_other_wheel().make(), inputs("board1", held), name)
    [block] = whole.blocks()
    kept = replace(block, values={n: column for n, column in block.values.items() if n != without})
    return Recording(name, whole.signals - {without}, True, lambda: [kept])


def deviations(evidence: Evidence) -> list[Deviation]:
    tally = DeviationTally()
    for name, behaviour in evidence.behaviours.items():
        own = behaviour.tally
        tally.add(own.groups.values(), own.evidence or WholeEvidence(), name)
    return list(tally.deviations())


def test_a_log_without_a_column_has_the_cause_that_other_logs_show() -> None:
    """Of the faults masks alone another bit in one place was told."""
    long = [(n, change) for change in ({}, {FL: True}, {FL: False}, {FR: True}) for n in (9, 40)]
    whole = run("whole", long)
    lost = run("lost", [(9, {}), (2, {FL: True}), (9, {})], "wheel_status_FR")
    evidence = followed(BOARD1, [whole, lost])
    found = deviations(evidence)
    parts = {one.scope.part for one in found}
    assert len(parts) > 1
    groups = cause_groups(evidence, found, parts, 20, at_once=1)
    [cause] = groups.causes
    assert cause.change is not None and cause.change.key == reads_the_other_wheel().key
    assert set(cause.parts) == parts


def test_what_is_read_by_mistake_is_told_though_a_log_does_not_record_it() -> None:
    """One log without the column, and in 28 logs the cause was told of no case but the first step of one."""
    long = [(n, change) for change in ({}, {FL: True}, {FL: False}, {FR: True}) for n in (9, 40)]
    evidence = followed(BOARD1, [run("whole", long), run("lost", [(9, {}), (20, {FL: True}), (9, {})], FL)])
    [part] = [one for one in evidence.parts if one.name == "Monitor_wheel_FR"]
    assert len(part.deviating) == 2
    groups = cause_groups(evidence, deviations(evidence), [part.name], 20, at_once=1)
    [cause] = [one for one in groups.causes if one.part == part.name]
    assert cause.change is not None and (cause.change.old, cause.change.new) == (FR, FL)


STAMP = "stamp/last_valid_b2_ms"


@pytest.mark.parametrize(
    ("cases", "explained", "taken"),
    [(9, (0, 1), True), (9, (0,), True), (9, (1,), False), (1, (0, 1), False)],
    ids=["more", "as much", "another", "seldom"],
)
def test_a_stamp_is_looked_for_in_all_parts_that_read_it(
    cases: int, explained: tuple[int, ...], taken: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What an alive counter of three bits does to the coherence was told as a condition joined by or."""

    def stamp(part: str) -> ChartChange:
        found = stamp_changes(BOARD1, BOARD1.system, frozenset({part}))
        return next(one for one in found if one.at == STAMP and "16" in one.new)

    alone = replace(BOARD1.system, components=(part_of("board1", "Monitor_heartbeat"),))
    evidence = cast(PartEvidence, SimpleNamespace(group=SimpleNamespace(system=alone)))
    own = reads_the_other_wheel()
    here = SearchedPart("Monitor_heartbeat", (), (own,), (0,), None, 3)
    there = SearchedPart("Relay", (), (stamp("Monitor_heartbeat"),), (2,), None, cases)

    def searched(*asked: object) -> SearchedPart:
        tried = cast(list[ChartChange], asked[-1])
        assert [one.key for one in tried] == [stamp("Monitor_heartbeat").key, own.key]
        assert tried[0].nearness < own.nearness
        return SearchedPart("Monitor_heartbeat", (), (tried[0],), explained, None, 3)

    monkeypatch.setattr(met_elsewhere, "searched_part", searched)
    pairs = [(evidence, here), (evidence, there)]
    [made, other] = met_elsewhere.explained_elsewhere(BOARD1, pairs, (), 1, 1)
    assert other is there and (made is not here) is taken
