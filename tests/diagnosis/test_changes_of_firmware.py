"""Changes as firmware has them: a function's fault in all places, a constant between those of a grid."""

from fractions import Fraction

import pytest

from rovercheck.checker.conformance.cones import cone_groups
from rovercheck.checker.conformance.estimator import StateEstimator, TooMany
from rovercheck.checker.conformance.numbers import number_between, value_of
from rovercheck.checker.conformance.program import Known
from rovercheck.checker.diagnosis.change import ChartChange
from rovercheck.checker.diagnosis.hypotheses import beginning_changes, rewrite_changes
from rovercheck.checker.diagnosis.limits import number_slots
from rovercheck.checker.mutate.memory import shared_memory
from rovercheck.spec_model.abstraction import Value, boards
from rovercheck.spec_model.lang.chart import Chart
from rovercheck.spec_model.lang.domain import Num
from tests.diagnosis.planted import Row, diagnosis, inputs, part_of

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
