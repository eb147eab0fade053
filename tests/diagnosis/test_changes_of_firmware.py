"""Changes as firmware has them: a function's fault in all places, a constant between those of a grid."""

from dataclasses import replace
from fractions import Fraction
from functools import partial
from itertools import islice
from typing import cast

import pytest

from rovercheck.checker.compare.beside import rerun
from rovercheck.checker.conformance.cones import cone_groups
from rovercheck.checker.conformance.estimator import StateEstimator, TooMany
from rovercheck.checker.conformance.numbers import PARAMETER, number_between, value_of
from rovercheck.checker.conformance.program import Known
from rovercheck.checker.diagnosis import trial
from rovercheck.checker.diagnosis.cause_cover import _CoverSearch
from rovercheck.checker.diagnosis.change import ChartChange
from rovercheck.checker.diagnosis.cover import CoveringChange, PartCover, Unexplaining
from rovercheck.checker.diagnosis.evidence import EvidenceCollector, PartEvidence
from rovercheck.checker.diagnosis.hypotheses import (
    beginning_changes,
    during_changes,
    mutant_changes,
    rewrite_changes,
)
from rovercheck.checker.diagnosis.limits import number_slots
from rovercheck.checker.diagnosis.row_judge import RowJudge
from rovercheck.checker.diagnosis.trial import TrialBench
from rovercheck.checker.mutate.memory import shared_memory
from rovercheck.checker.mutate.rewrites import rewrites
from rovercheck.spec_model.abstraction import Value, boards
from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Block, Chart
from rovercheck.spec_model.lang.domain import Num
from rovercheck.spec_model.lang.expr import flag
from tests.diagnosis.planted import Row, changed, deviating, diagnosis, inputs, part_of, recorded, restless

SUP_STAMP, RX_STAMP = "last_valid_b1_ms", "b1_data_last_valid_ms"
DRIVING = {"crit_mask_b1": 4, "ay_norm": 0, "bx_norm": 0}


def found(board: str, change: ChartChange, *runs: list[Row]) -> list[tuple[str, ...]]:
    """The keys of the first cause that is found of a board with a change."""
    parts = diagnosis(board, change.make(), *runs).parts
    return [cause.key for part in parts if part.cause for cause in part.cause.changes]


def near(one: int, two: int, three: int) -> dict[str, int]:
    return {"d1": one, "d2": two, "d3": three}


def test_of_many_conditions_of_a_function_one_counts_alone() -> None:
    """Each place by itself explains only half of it: both call the function."""
    system, only = boards()["board2"].system, frozenset({"ObstaclesDriving"})
    [change] = [c for c in rewrite_changes(system, {}, only) if c.at == "everywhere" and c.new == "d2 <= 300"]
    assert change.text == "of `d1 <= 300 || d2 <= 300 || d3 <= 300` only `d2 <= 300` counts"
    far = near(301, 301, 301)
    run = inputs(
        "board2",
        [
            (80, {**DRIVING, **far}),
            *((5, near(*at)) for at in ((100, 301, 301), (301, 301, 100), (300, 301, 300), (301, 301, 301))),
            (5, near(301, 200, 301)),
            (5, near(100, 301, 200)),
            (5, far),
        ],
    )
    assert found("board2", change, run) == [change.key]


def test_all_limits_with_one_number_are_one() -> None:
    system, only = boards()["board2"].system, frozenset({"ObstaclesDriving"})
    [slot] = [s for s in number_slots(system, only) if s.beside]
    assert slot.at == "everywhere" and len(slot.beside) == 2
    change = slot.change(slot.op, 200)
    run = inputs(
        "board2",
        [
            (80, {**DRIVING, **near(301, 301, 301)}),
            *(
                (5, near(*at))
                for at in (
                    (300, 301, 301),
                    (301, 300, 301),
                    (301, 301, 300),
                    (250, 301, 301),
                    (200, 301, 301),
                )
            ),
        ],
    )
    [key] = found("board2", change, run)
    assert key[:3] == ("limit", "ObstaclesDriving", "everywhere")


def test_an_initial_value_that_the_default_transition_sets_again() -> None:
    system = boards()["board2"].system
    [change] = beginning_changes(system, frozenset({"Backward_mode_toggle_2"}))
    run = inputs("board2", [(3, {}), (80, DRIVING)])
    assert found("board2", change, run) == [change.key]


def test_a_constant_between_those_that_its_datum_may_have() -> None:
    """0.7 among 0, 0.4 and 0.8: it was tried, and never taken, as the charts have no room for it."""
    system = boards()["board1"].system
    slots = number_slots(system, frozenset({"updateSafetyLimits"}))
    [slot] = [s for s in slots if s.drawn * s.sort.resolution == Fraction(4, 5)]
    change = slot.change(None, Fraction(7, 2))
    assert change.new == "0.7"
    steps: list[tuple[int, dict[str, Value]]] = [
        (10, {}),
        (10, {"y_norm": 1.0}),
        (20, {"cmd": 2}),
        (20, {"cmd": 0}),
        (10, {"y_norm": 0.0}),
    ]
    run = inputs("board1", steps)
    assert found("board1", change, run) == [change.key]


def test_a_number_says_its_value() -> None:
    var = number_between(Fraction(-7, 2), Num(Fraction(1, 5)))
    assert value_of(var.name) == Fraction(-7, 2)
    assert value_of("V_MAX") is None


def test_cells_of_an_array_share_memory_only_as_a_whole() -> None:
    monitors = part_of("board2", "Monitors_2")
    assert isinstance(monitors, Chart)
    singles = [(one.old, one.new) for one in shared_memory(monitors) if one.site == "memory"]
    wholes = [one for one in shared_memory(monitors) if one.site == "buffers"]
    assert wholes and not any("gap3" in name for pair in singles for name in pair)


def test_two_arrays_share_memory_with_how_many_cells_are_in_use() -> None:
    monitors = part_of("board2", "Monitors_2")
    [one] = [
        r for r in shared_memory(monitors) if (r.site, r.old, r.new) == ("arrays", "B2.rx_gap", "b1_sup_gap")
    ]
    assert not any(name.startswith("B2.rx_gap") for name in one.part.written)
    assert {"b1_sup_gaps", "deg_rx", "B2.rx_asked"} <= one.part.written.keys()


def test_a_gap_of_one_monitor_changes_the_mean_of_the_other_in_one_memory() -> None:
    """The mean was asked for at gaps of its own only: what such firmware did had no cause."""
    [one] = [
        r
        for r in shared_memory(part_of("board2", "Monitors_2"))
        if (r.site, r.old, r.new) == ("arrays", "B2.rx_gap", "b1_sup_gap")
    ]
    shared = changed("board2", "Monitors_2", lambda _: one.part)
    rows = inputs(
        "board2",
        [(100, {}), (6, {SUP_STAMP: 2000}), (7, {SUP_STAMP: 2140}), (3, {SUP_STAMP: 2280, RX_STAMP: 2260})],
    )
    *_, before, last = rerun(replace(boards()["board2"], system=shared), rows)
    assert (before.expected["rx_status"], last.expected["rx_status"]) == (1, 1)
    *_, last = rerun(boards()["board2"], rows)
    assert (last.expected["rx_status"], last.inputs["now_ms"]) == (0, 2320)


def test_cells_of_two_arrays_that_are_named_alike_share_memory_only_as_wholes() -> None:
    names = [f"gap{n}_{what}" for what in ("ms", "fresh") for n in range(4)]
    block = Block("record", [assign(flag(name, name), True) for name in (*names, "one", "two")])
    singles = [{one.old, one.new} for one in shared_memory(block) if one.site == "memory"]
    assert singles == [{"one", "two"}]


def test_during_actions_that_are_left_out_in_one_state() -> None:
    """The user's references keep their values in a half turn, and so do the limits that they are made of."""
    system, chart = boards()["board1"].system, "Motion_Supervision"
    every = {c.new: c for c in during_changes(system, frozenset({chart})) if c.old == "all actions"}
    assert "only in Retromarcia_180" in every
    change = every["not in Retromarcia_180, nor is updateSafetyLimits"]
    assert change.key[:3] == ("missing", chart, "state/Stato_marcia_rover/during")
    turning = {"y_norm": -1, "x_norm": 0, "current_yaw": 0}
    stick = [(20, {"y_norm": 0, "x_norm": x}) for x in (1, -1, 0.5, 1)]
    run = inputs(
        "board1", [(5, {"y_norm": 1}), (5, turning), *stick, (20, {"degr_mask_b2": 8, "x_norm": -1})]
    )
    assert found("board1", change, run)[0][0] == "missing"
    made = recorded("board1", change.make(), run, "held")
    assert deviating(boards()["board1"], [made]) == [chart]


def test_a_comparison_that_holds_for_another_member_too() -> None:
    chart = part_of("board1", "Motion_Supervision")
    told = {one.new for one in rewrites(chart, {}) if one.kind == "also"}
    assert "cmd == CMD_NORMAL || cmd == CMD_ROTATE_180" in told


def test_values_of_a_limit_that_are_followed_together_are_judged_as_each_alone() -> None:
    board = boards()["board1"]
    runs = [recorded("board1", board.system, restless("board1", seed), f"run {seed}") for seed in range(3)]
    collector = EvidenceCollector(board)
    for run in runs:
        [block] = run.blocks()
        cells = block.values["temp_status"]
        wrong = {**block.values, "temp_status": [*cells[:200], *cells[:1] * (len(cells) - 200)]}
        collector.add(replace(run, blocks=partial(list, [replace(block, values=wrong)])))
    [part] = [one for one in collector.evidence().parts if one.name == "Monitor_temperature"]
    bench = TrialBench(part)
    slots = [s for s in number_slots(part.group.system, frozenset({part.name})) if s.op is not None]
    judged = 0
    for slot in slots[:6]:
        cone = part.group.cone(slot.opened(slot.op))
        values = [slot.old.value + d for d in (-40, -7, -1, 0, 1, 2, 30)]
        for number, last in ((0, 199), (1, 120), (2, 230), (0, 40)):
            together = bench.passing(cone, number, last, PARAMETER, values)
            alone = [v for v in values if bench.passes(cone, number, last, (PARAMETER, v))]
            assert sorted(together) == alone
            judged += 0 < len(alone) < len(values)
    assert judged


def test_rows_before_the_first_deviation_need_no_tracker(monkeypatch: pytest.MonkeyPatch) -> None:
    run = recorded("board1", boards()["board1"].system, restless("board1", 7), "run")
    [block] = run.blocks()
    cells = list(block.values["batt_status"])
    cells[300:305] = [2 - (cell or 0) for cell in cells[300:305]]
    collector = EvidenceCollector(boards()["board1"])
    collector.add(
        replace(run, blocks=partial(list, [replace(block, values={**block.values, "batt_status": cells})]))
    )
    [part] = collector.evidence().parts
    bench = TrialBench(part)
    quick = [(row, m and m.differences) for row, m in bench.mismatches(part.cone, 0)]
    monkeypatch.setattr(trial, "_explained", lambda *_: 0)
    assert quick == [(row, m and m.differences) for row, m in bench.mismatches(part.cone, 0)] != []


def test_what_explains_more_than_a_chance_cause_goes_before_it(monkeypatch: pytest.MonkeyPatch) -> None:
    """Three differences of one chart were told as eight findings: chance causes of single rows were taken."""
    every = mutant_changes(boards()["board1"].system, frozenset({"Motion_Supervision"}))
    changes = dict(zip("abcd", islice(every, 4), strict=True))
    explains = {"a": {1}, "b": {1, 2, 3}, "c": {2, 3, 4}, "d": {1, 2}}
    search = object.__new__(_CoverSearch)

    def made(name: str, gain: int = 0) -> CoveringChange:
        return CoveringChange(changes[name], frozenset(explains[name]), gain, [], boards()["board1"].system)

    def partly(*passed: tuple[str, int]) -> list[Unexplaining]:
        return [
            Unexplaining(changes[name], cast(TrialBench, None), number, frozenset())
            for name, number in passed
        ]

    bridges = {id(changes[name]): made(name, gain) for name, gain in (("b", 5), ("c", 9), ("d", 7))}
    monkeypatch.setattr(search, "_bridge", lambda one: bridges[id(one.change)], raising=False)
    search._good, search._passed_by_good = [made("a")], 2
    search._partly = partly(("b", 3), ("c", 3), ("d", 3))
    assert search._ahead() is bridges[id(changes["b"])]  # c leaves what a explains, d explains less
    search._partly = partly(("b", 2), ("c", 3))
    assert search._ahead() is None  # b is right with no more witnesses
    search._good = [made("b")]
    search._partly = partly(("b", 9), ("c", 9), ("d", 9))
    assert search._ahead() is None
    search._good = []
    assert search._ahead() is None


@pytest.mark.parametrize(("passed", "taken"), [({2, 3}, "a"), ({2}, "ab"), ({3, 4}, "ab")])
def test_what_one_change_may_explain_is_not_taken_in_pieces(
    passed: set[int], taken: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A chart that tests its transitions in the step of entry was told as a repair and one transition."""
    every = mutant_changes(boards()["board1"].system, frozenset({"Motion_Supervision"}))
    changes = dict(zip("abc", islice(every, 3), strict=True))
    search = object.__new__(_CoverSearch)
    found: list[str] = []

    def made(name: str, *explains: int) -> CoveringChange:
        return CoveringChange(changes[name], frozenset(explains), 0, [], boards()["board1"].system)

    def accept(one: CoveringChange) -> bool:
        found.append(next(name for name, change in changes.items() if change is one.change))
        search._left -= one.explains
        search._cover.changes.append((one.change, one.explains))
        return True

    monkeypatch.setattr(search, "_accept", accept, raising=False)
    monkeypatch.setattr(search, "_again", accept, raising=False)
    monkeypatch.setattr(search, "_clock", lambda: 0.0, raising=False)
    search._cover, search._left = PartCover(cast(PartEvidence, None), []), frozenset({1, 2, 3, 4})
    search._end = 1.0
    search._partly = [Unexplaining(changes["c"], cast(TrialBench, None), 2, frozenset(passed))]
    search._take([made("a", 1), made("b", 2)])
    assert "".join(found) == taken


def test_numbers_without_meaning_end_no_search(monkeypatch: pytest.MonkeyPatch) -> None:
    """A mask of 5/2 passed what it had to get past, and had no bits in another run: a TypeError ended it."""

    def without_value(*_: object) -> None:
        raise TypeError("unsupported operand type(s) for >>: 'Fraction' and 'int'")

    monkeypatch.setattr(RowJudge, "all_right", without_value)
    monkeypatch.setattr(RowJudge, "mostly_right", without_value)
    system = next(mutant_changes(boards()["board1"].system, frozenset({"Fault_masks"}))).make()
    [part] = diagnosis("board1", system, list(restless("board1", 5))).parts
    assert part.cause is None and part.partial is None


def test_too_many_states_are_seen_before_they_are_made(monkeypatch: pytest.MonkeyPatch) -> None:
    """Ten gaps of which each may be any: thousands of steps were taken before the part was given up."""
    board = boards()["board2"]
    seen = frozenset(board.system.inputs)
    names = frozenset(o.name for o in board.outputs)
    [group] = [g for g in cone_groups(board, seen, names) if g.name == "Monitors_2"]
    cone = group.cone()
    taken = 0
    step = cone.step

    def counted(*given: Known) -> tuple[Known, Known]:
        nonlocal taken
        taken += 1
        return step(*given)

    monkeypatch.setitem(cone.__dict__, "step", counted)
    estimator = StateEstimator(cone, {})
    known: Known = tuple(v.init for v in cone.system.inputs)
    with pytest.raises(TooMany):
        estimator.outcomes(estimator.anything({}), known)
    assert taken < 100
    assert estimator.runs_left < 0
