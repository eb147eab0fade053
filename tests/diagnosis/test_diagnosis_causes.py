"""A change planted in a chart comes first of all that explain the runs; what is as drawn has no cause."""

from collections.abc import Callable
from fractions import Fraction

import pytest

from rovercheck.checker.mutate.delays import held, late, stale
from rovercheck.checker.mutate.rewrites import with_memory
from rovercheck.spec_model.abstraction import boards
from rovercheck.spec_model.interpretations import woven
from rovercheck.spec_model.ambiguity import fixed
from rovercheck.spec_model.lang.chart import Chart, to
from rovercheck.spec_model.lang.edit import also, constant, drop, guard, in_expressions, operator, swap, timer
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.system import System
from rovercheck.spec_model.lang.time import sec
from rovercheck.spec_model.repairs import repaired, repairs
from tests.diagnosis.planted import changed, deviating, diagnosis, inputs, part_of, recorded, restless

HOT = inputs(
    "board1",
    [
        (20, {}), (230, {"temperature_degC": 57.5}), (20, {"temperature_degC": 20.0}),
        (230, {"temperature_degC": 56.9}), (20, {"temperature_degC": 20.0}),
        (230, {"temperature_degC": 60.0}), (20, {"temperature_degC": 20.0}),
        (230, {"temperature_degC": 57.0}), (20, {"temperature_degC": 54.9}),
        (20, {"temperature_degC": 55.0}), (20, {"temperature_degC": -4.9}), (20, {"temperature_degC": -5.0}),
        (150, {"temperature_degC": 70.0}), (10, {"temperature_degC": 20.0}),
        (160, {"temperature_degC": 70.0}), (10, {"temperature_degC": 20.0}),
    ],
)  # fmt: skip


def board1(part: str, edit: Callable[[Chart], Chart]) -> System:
    return changed("board1", part, edit)  # type: ignore[arg-type]


def monitor(*changes: Callable[[Chart], Chart]) -> System:
    def edit(chart: Chart) -> Chart:
        for change in changes:
            chart = change(chart)
        return chart

    return board1("Monitor_temperature", edit)


def limit(old: int, new: int) -> Callable[[Chart], Chart]:
    return lambda chart: in_expressions(chart, constant(old, new))


def signal(board: str, part: str, name: str) -> Var:
    found = part_of(board, part)
    return {**found.read, **found.written}[name]


def first(board: str, system: System, *runs: object) -> tuple[str, str, str]:
    """The kind, the chart and the text of the one cause."""
    found = diagnosis(board, system, *runs)  # type: ignore[arg-type]
    [part] = found.parts
    assert part.cause is not None and part.complete
    [change] = part.cause.changes
    assert part.cause.trial.wrong == 0 and part.cause.trial.explained == part.cases > 0
    return change.kind, change.chart, change.text


def test_a_limit_is_found_with_its_value_and_its_range() -> None:
    found = diagnosis("board1", monitor(limit(60, 57)), HOT)
    [part] = found.parts
    assert part.cause is not None
    [change] = part.cause.changes
    assert (change.kind, change.at) == ("limit", "everywhere")
    assert change.text == "a limit of 57 °C, closed, instead of 60 °C, closed"
    assert change.note == "any limit between 56.9 and 57 explains the same"


def test_an_open_limit_is_told_from_a_closed_one() -> None:
    kind, _, text = first("board1", monitor(lambda c: in_expressions(c, operator(Op.GE, Op.GT))), HOT)
    assert kind == "comparison" and "open" in text


def test_a_time_is_found() -> None:
    assert first("board1", monitor(lambda c: in_expressions(c, timer(3 * sec))), HOT)[:2] == (
        "timer",
        "Monitor_temperature",
    )


def test_a_missing_transition_is_found() -> None:
    kind, chart, _ = first(
        "board1", monitor(lambda c: guard(c, "decide", 1, lambda g: constant(60, 2000)(g))), HOT
    )
    assert (kind, chart) in {("limit", "Monitor_temperature"), ("never", "Monitor_temperature")}


def test_a_late_output_is_found() -> None:
    system = boards()["board1"].system
    part = part_of("board1", "Safety_state")
    made = late(system, part, part.written["rover_safety_state"])
    assert first("board1", made, restless("board1", 3))[0] == "late"


def test_an_input_of_the_step_before_is_found() -> None:
    system = boards()["board1"].system
    part = part_of("board1", "Relay")
    kind, chart, text = first(
        "board1", stale(system, part, part.read["rx_status"]), LINKS
    )
    assert (kind, chart, text) == ("stale", "Relay", "rx_status is read as of the step before")


LINKS = inputs(
    "board1",
    [
        (200, {}), (3, {"last_valid_b2_ms": 4000}), (9, {"last_valid_b2_ms": 4000}), (200, {}),
        (30, {"b2_data_last_valid_ms": 8000}), (3, {}), (200, {"last_valid_b2_ms": 9000}), (200, {}),
        (8, {"b2_data_last_valid_ms": 17000}), (200, {}),
    ],
)  # fmt: skip


def test_an_output_that_is_held_is_found() -> None:
    system = boards()["board1"].system
    part = part_of("board1", "Monitor_wheel_FL")
    made = held(system, part, part.written["wheel_status_FL"], part.read["isMotionConsistent"], 0)
    assert first("board1", made, restless("board1", 5), restless("board1", 6))[0] == "held"


def test_a_bit_is_found() -> None:
    system = changed("board1", "Process_B2_masks", _other_bit)
    assert first("board1", system, restless("board1", 7), restless("board1", 8))[0] in ("bit", "constant")


def _other_bit(part):
    from rovercheck.checker.mutate.rewrites import rewrites

    return next(one.part for one in rewrites(part, {}) if one.kind in ("bit", "negated"))


def test_an_exchanged_signal_is_found() -> None:
    system = changed("board1", "Monitor_wheel_FL", lambda p: _read(p, "hasNoFeedback_FL", "hasNoFeedback_RR"))
    kind, chart, text = first("board1", system, restless("board1", 5), restless("board1", 6))
    assert (kind, chart) == ("exchanged", "Monitor_wheel_FL")
    assert text == "hasNoFeedback_RR is read in place of hasNoFeedback_FL"


def _read(part, name: str, other: str):
    return with_memory(part, {name: boards()["board1"].system.inputs[other]})


def test_another_order_is_found() -> None:
    system = board1("Safety_state", lambda c: swap(c, "Rover_Safe_State"))
    kind, chart, _ = first("board1", system, restless("board1", 9), restless("board1", 10))
    assert chart == "Safety_state" and kind == "order"


def test_an_extra_transition_is_found() -> None:
    """Nothing nearer explains that the state is left when the motors are given away."""
    away = signal("board1", "Safety_state", "give_b2_actuation")
    system = board1(
        "Safety_state", lambda c: also(c, "Rover_Critical_State", to("Rover_Safe_State", when=away), first=True)
    )
    found = diagnosis("board1", system, restless("board1", 9), restless("board1", 10), restless("board1", 11))
    if not found.parts:
        pytest.fail("no run shows the transition")
    assert found.parts[0].cause is not None


def test_a_dropped_transition_is_found() -> None:
    system = board1("Monitor_wheel_RL", lambda c: drop(c, "decide", 4))
    kind, chart, _ = first("board1", system, restless("board1", 5), restless("board1", 6))
    assert (kind, chart) == ("never", "Monitor_wheel_RL")


def test_an_interpretation_is_found() -> None:
    choices = {"S01": "HOLD"}
    system = fixed(choices).system(woven(boards()["board1"].system, choices))
    assert first("board1", system, HOT)[2].startswith("S01=HOLD")


def test_a_repair_is_found() -> None:
    system = repaired(boards()["board1"].system, repairs()["wheel-by-feedback"])
    found = diagnosis("board1", system, restless("board1", 5), restless("board1", 6))
    assert found.parts and all(p.cause is not None for p in found.parts)


def test_two_changes_of_one_chart_are_found_together() -> None:
    system = monitor(limit(60, 57), limit(-5, -3))
    cold = inputs("board1", [(20, {}), (9, {"temperature_degC": -3.1}), (9, {"temperature_degC": -2.9}),
                             (9, {"temperature_degC": -4.0}), (9, {"temperature_degC": -3.0})])  # fmt: skip
    found = diagnosis("board1", system, HOT, cold)
    [part] = found.parts
    assert part.cause is not None
    assert sorted(c.text for c in part.cause.changes) == [
        "a limit of -3 °C, closed, instead of -5 °C, closed",
        "a limit of 57 °C, closed, instead of 60 °C, closed",
    ]


def test_a_change_is_found_in_runs_without_its_state() -> None:
    """Of a run that begins anywhere, with steps missing."""
    run = recorded("board1", monitor(limit(60, 57)), HOT, "cut")
    assert deviating(boards()["board1"], [run]) == ["Monitor_temperature"]


@pytest.mark.parametrize("board", ["board1", "board2"])
def test_runs_of_the_charts_have_no_cause(board: str) -> None:
    found = diagnosis(board, boards()[board].system, restless(board, 1), restless(board, 2))
    assert found.parts == [] and len(found.conforming) == 2


def test_what_no_change_explains_has_no_cause() -> None:
    """An output that is wrong once: no limit, no interpretation, and nothing made up."""
    run = recorded("board1", boards()["board1"].system, restless("board1", 1), "glitch")
    [block] = run.blocks()
    cells = block.values["batt_status"]
    cells[300] = 2 if cells[300] != 2 else 0
    from rovercheck.checker.diagnosis.result import diagnose_board

    [part] = diagnose_board(boards()["board1"], [run], 60).parts
    assert (part.name, part.cause, part.cases) == ("Monitor_battery", None, 1)


def test_the_time_that_ends_a_search_is_said() -> None:
    run = recorded("board1", monitor(limit(60, 57)), HOT, "run")
    from rovercheck.checker.diagnosis.result import diagnose_board

    [part] = diagnose_board(boards()["board1"], [run], 1e-9).parts
    assert not part.complete and part.tried < part.of and part.cause is None


def test_simple_numbers() -> None:
    from rovercheck.checker.diagnosis.limits import simplest

    tenth = Fraction(1, 10)
    assert simplest(Fraction(569) * tenth, Fraction(575) * tenth, False, True) == 57
    assert simplest(Fraction(51), Fraction(58), False, True) == 55
    assert simplest(Fraction(-31) * tenth, Fraction(-3), True, False) == Fraction(-31) * tenth
    assert simplest(Fraction(3), Fraction(3), True, True) == 3
    assert simplest(Fraction(3), Fraction(3), False, True) is None
