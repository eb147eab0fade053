"""Two differences that look like a repair of the charts and a correction of it are told as what they are."""

from rovercheck.checker.conformance.deviations import DeviationTally, WholeEvidence
from rovercheck.checker.diagnosis.causes import cause_groups, followed
from rovercheck.checker.diagnosis.hypotheses import rewrite_changes, written_changes
from rovercheck.checker.diagnosis.variant import with_changes
from rovercheck.spec_model.abstraction import boards
from tests.diagnosis.planted import Held, inputs, recorded_on

BOARD1 = boards()["board1"]
NAME = "Safety_state"


def test_a_repair_that_is_corrected_gives_way_to_changes_of_the_charts_as_drawn() -> None:
    """It was told as a repair, and as a condition joined by and in what only the repair has."""
    system = BOARD1.system
    [first] = [c for c in written_changes(BOARD1, system) if c.at == "S56" and c.new == "CRIT-FIRST"]
    entries = (c for c in rewrite_changes(system, {}, frozenset({NAME})) if c.kind == "entry")
    [entry] = [c for c in entries if c.new == "transition 2"]
    planted = with_changes(BOARD1, [first.key, entry.key])
    degraded, critical = {"degr_mask_b2": 1, "crit_mask_b2": 0}, {"degr_mask_b2": 0, "crit_mask_b2": 1}
    held: list[Held] = [
        [(3, degraded), (3, {"degr_mask_b2": 0})],
        [(3, {}), (5, degraded), (5, critical)],
        [(3, {"degr_mask_b2": 1, "crit_mask_b2": 1}), (3, critical)],
        [(4, degraded), (2, critical), (2, degraded), (2, critical), (4, {"crit_mask_b2": 0})],
    ]
    runs = [recorded_on(planted, inputs("board1", one), f"run {n}") for n, one in enumerate(held)]
    evidence, tally = followed(BOARD1, runs), DeviationTally()
    for name, behaviour in evidence.behaviours.items():
        tally.add(behaviour.tally.groups.values(), behaviour.tally.evidence or WholeEvidence(), name)
    found = list(tally.deviations())
    groups = cause_groups(evidence, found, [NAME], 30, at_once=1)
    assert {one.change.key for one in groups.causes if one.change is not None} == {first.key, entry.key}
