"""A change planted in a chart comes first of all that explain the runs; what is as drawn has no cause."""

from collections.abc import Callable, Iterator
from dataclasses import replace
from fractions import Fraction

import pytest

from rovercheck.checker.conformance.cones import cone_groups
from rovercheck.checker.conformance.decoder import InputDecoder
from rovercheck.checker.conformance.recording import LogBlock, Recording
from rovercheck.checker.conformance.signals import Vocabulary
from rovercheck.checker.diagnosis.decide import RunSearch
from rovercheck.checker.diagnosis.evidence import EvidenceCollector, PartEvidence
from rovercheck.checker.diagnosis.limits import simplest
from rovercheck.checker.diagnosis.result import DiagnosedPart, diagnose_board
from rovercheck.checker.mutate.delays import held, late, stale
from rovercheck.checker.mutate.rewrites import mapped, rewrites
from rovercheck.spec_model.abstraction import Board, boards
from rovercheck.spec_model.lang.chart import Block, Chart
from rovercheck.spec_model.lang.edit import constant, drop, in_expressions, swap, timer
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Var
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.system import System
from rovercheck.spec_model.lang.time import sec
from tests.diagnosis.planted import SECONDS, changed, diagnosis, inputs, part_of, recorded, restless

MONITOR = "Monitor_temperature"
HOT = inputs(
    "board1",
    [
        (5, {}), (205, {"temperature_degC": 57.5}), (5, {"temperature_degC": 20.0}),
        (205, {"temperature_degC": 56.9}), (5, {"temperature_degC": 20.0}),
        (205, {"temperature_degC": 60.0}), (5, {"temperature_degC": 20.0}),
        (205, {"temperature_degC": 57.0}), (5, {"temperature_degC": 54.9}),
        (5, {"temperature_degC": 55.0}), (5, {"temperature_degC": -4.9}), (5, {"temperature_degC": -5.0}),
        (160, {"temperature_degC": 70.0}), (5, {"temperature_degC": 20.0}),
    ],
)  # fmt: skip
COLD = inputs(
    "board1",
    [(5, {}), *((5, {"temperature_degC": t}) for t in (-3.1, -2.9, -4.0, -3.0, -2.5, -3.0, -2.0))],
)
LINKS = inputs(
    "board1",
    [
        (200, {}), (8, {"last_valid_b2_ms": 4000}), (9, {}), (8, {"b2_data_last_valid_ms": 4340}), (200, {}),
        (30, {"b2_data_last_valid_ms": 8500}), (3, {}), (90, {"last_valid_b2_ms": 9160}), (200, {}),
        (8, {"b2_data_last_valid_ms": 14960}), (200, {}),
    ],
)  # fmt: skip
RESTLESS = (restless("board1", 5), restless("board1", 6))


def board1(part: str, edit: Callable[[Chart], Chart]) -> System:
    return changed("board1", part, edit)  # type: ignore[arg-type]


def limit(old: int, new: int) -> Callable[[Chart], Chart]:
    return lambda chart: in_expressions(chart, constant(old, new))


def the_part(system: System, *runs: object) -> DiagnosedPart:
    """The one part that deviates, with a cause that explains all."""
    [part] = diagnosis("board1", system, *runs).parts  # type: ignore[arg-type]
    assert part.cause is not None and part.complete
    assert part.cause.trial.wrong == 0 and part.cause.trial.explained == part.cases > 0
    return part


def first(system: System, *runs: object) -> tuple[str, str, str]:
    """The kind, the chart and the text of the one cause."""
    cause = the_part(system, *runs).cause
    assert cause is not None
    [change] = cause.changes
    return change.kind, change.chart, change.text


def test_a_limit_is_found_with_its_value_and_its_range() -> None:
    cause = the_part(board1(MONITOR, limit(60, 57)), HOT).cause
    assert cause is not None
    [change] = cause.changes
    assert (change.kind, change.at) == ("limit", "everywhere")
    assert change.text == "a limit of 57 °C, closed, instead of 60 °C, closed"
    assert change.note == "any limit between 56.9 and 57 explains the same"


def test_an_open_limit_is_told_from_a_closed_one() -> None:
    def opened(node: Expr) -> Expr:
        match node:
            case Apply(Op.GE, (_, Const(60, _))):
                return replace(node, op=Op.GT)
            case Apply(Op.LT, (_, Const(60, _))):
                return replace(node, op=Op.LE)
        return node

    system = changed("board1", MONITOR, lambda p: mapped(p, opened))
    assert first(system, HOT) == ("comparison", MONITOR, "a limit of 60 °C, open, instead of 60 °C, closed")


def test_a_time_is_found() -> None:
    kind, chart, text = first(board1(MONITOR, lambda c: in_expressions(c, timer(3 * sec))), HOT)
    assert (kind, chart) == ("timer", MONITOR) and "3 s" in text


def test_a_late_output_is_found() -> None:
    part = part_of("board1", "Safety_state")
    made = late(boards()["board1"].system, part, part.written["rover_safety_state"])
    assert first(made, *RESTLESS) == ("late", "Safety_state", "rover_safety_state is given a step later")


def test_an_input_of_the_step_before_is_found() -> None:
    part = part_of("board1", "Relay")
    made = stale(boards()["board1"].system, part, part.read["rx_status"])
    assert first(made, LINKS) == ("stale", "Relay", "rx_status is read as of the step before")


def test_an_output_that_is_held_is_found() -> None:
    part = part_of("board1", "Monitor_wheel_FL")
    made = held(
        boards()["board1"].system, part, part.written["wheel_status_FL"], part.read["isMotionConsistent"], 0
    )
    told = "wheel_status_FL is held while not isMotionConsistent"
    assert told in list(every_text(the_part(made, *RESTLESS)))


def test_bits_that_are_exchanged_in_all_masks_are_found() -> None:
    """Of conditions about signals of different kinds, which cannot be read for each other."""
    weights = {2: 4, 4: 2}

    def exchanged(node: Expr) -> Expr:
        match node:
            case Apply(Op.ITE, (condition, Const(weight, sort), Const(0, _) as nothing)) if weight in weights:
                return replace(node, args=(condition, Const(weights[weight], sort), nothing))
        return node

    made = changed("board1", "Fault_masks", lambda p: mapped(p, exchanged))
    flat = inputs("board1", [(5, {}), (300, {"battery_pct": 20.0}), (300, {"battery_pct": 10.0})])
    assert first(made, LINKS, flat) == ("exchanged", "Fault_masks", "bit 1 and bit 2 are exchanged")


def every_text(part: DiagnosedPart) -> Iterator[str]:
    """The texts of the cause and of those that explain as much."""
    for cause in (part.cause, *(r.cause for r in part.rivals)):
        assert cause is not None
        yield from (c.text for c in cause.changes)


def other_bit(part: Chart | Block) -> Chart | Block:
    signals = dict[str, Var]()
    return next(one.part for one in rewrites(part, signals) if one.kind == "member")


def test_a_member_in_a_mask_is_found() -> None:
    kind, chart, _ = first(changed("board1", "Fault_masks", other_bit), *RESTLESS)
    assert (kind, chart) == ("member", "Fault_masks")


def test_an_exchanged_signal_is_found() -> None:
    others = boards()["board1"].system.inputs
    part = part_of("board1", "Monitor_wheel_FL")
    wrong = next(
        one.part
        for one in rewrites(part, others)
        if (one.kind, one.old, one.new) == ("exchanged", "hasNoFeedback_FL", "hasNoFeedback_RR")
    )
    told = first(changed("board1", "Monitor_wheel_FL", lambda _: wrong), *RESTLESS)
    assert told == ("exchanged", part.name, "hasNoFeedback_RR is read in place of hasNoFeedback_FL")


def test_another_order_is_found() -> None:
    """Each cause alone, and two at once: only then does the order matter."""
    calm = {"crit_mask_b2": 0, "degr_mask_b2": 0, "hasNoFeedback_FL": False, "isMotionConsistent": True}
    causes = (
        {"crit_mask_b2": 15}, {"degr_mask_b2": 15}, {"crit_mask_b2": 15, "degr_mask_b2": 15},
        {"hasNoFeedback_FL": True}, {"hasNoFeedback_FL": True, "isMotionConsistent": False},
    )  # fmt: skip
    both = inputs("board1", [(5, {}), *(b for cause in causes for b in ((5, cause), (5, calm)))])
    system = board1("Safety_state", lambda c: swap(c, "Rover_Safe_State"))
    told = "the transitions 1 and 2 are tested in the other order"
    assert told in list(every_text(the_part(system, both)))


def test_a_dropped_transition_is_found() -> None:
    kind, chart, text = first(board1("Monitor_wheel_RL", lambda c: drop(c, "decide", 4)), *RESTLESS)
    assert (kind, chart) == ("interpretation", "Monitor_wheel_RL") and text.startswith("S27=")


def test_an_interpretation_is_found() -> None:
    system = boards({"S01": "HOLD"})["board1"].system
    assert first(system, HOT)[2].startswith("S01=HOLD")


def test_two_changes_of_one_chart_are_found_together() -> None:
    def both(chart: Chart) -> Chart:
        return limit(-5, -3)(limit(60, 57)(chart))

    cause = the_part(board1(MONITOR, both), HOT, COLD).cause
    assert cause is not None
    assert sorted(c.text for c in cause.changes) == [
        "a limit of -3 °C, closed, instead of -5 °C, closed",
        "a limit of 57 °C, closed, instead of 60 °C, closed",
    ]


def test_a_cause_is_found_in_a_run_of_which_rows_and_columns_are_missing() -> None:
    run = recorded("board1", board1(MONITOR, limit(60, 57)), HOT, "cut")
    [block] = run.blocks()
    keep = [i for i in range(len(block)) if i != 300]
    rows = {
        n: [cells[i] for i in keep] for n, cells in block.values.items() if n not in ("btn1", "rx_status")
    }
    missing = [0] * len(keep)
    missing[300] = 1
    cut = LogBlock([block.lines[i] for i in keep], [block.ticks[i] for i in keep], missing, rows)
    [part] = diagnose_board(
        boards()["board1"], [replace(run, signals=frozenset(rows), blocks=lambda: [cut])]
    ).parts
    assert part.cause is not None
    assert part.cause.changes[0].text == "a limit of 57 °C, closed, instead of 60 °C, closed"


def test_a_cause_is_told_once_over_runs_with_other_columns() -> None:
    system = board1(MONITOR, limit(60, 57))
    whole, some = recorded("board1", system, HOT, "whole"), recorded("board1", system, HOT[:300], "some")
    some = replace(some, signals=some.signals - {"btn1"})
    [part] = diagnose_board(boards()["board1"], [whole, some]).parts
    assert part.cause is not None and part.runs == ("whole", "some")


def test_runs_with_other_columns_are_of_one_part_that_reads_none_of_these() -> None:
    """A cause that explained some of them contradicted others, which were looked at by themselves."""
    system = board1(MONITOR, limit(60, 57))
    whole, other = recorded("board1", system, HOT, "whole"), recorded("board1", system, HOT[:300], "some")

    def parts_of(*runs: Recording) -> list[int]:
        collector = EvidenceCollector(boards()["board1"])
        for run in runs:
            collector.add(run)
        return [len(part.runs) for part in collector.evidence().parts if part.name == MONITOR]

    assert parts_of(whole, without(other, "v_ref", "btn1")) == [2]
    assert parts_of(whole, without(other, "temp_last_valid_ms")) == [1]


@pytest.mark.parametrize("board", ["board1", "board2"])
def test_runs_of_the_charts_have_no_cause(board: str) -> None:
    found = diagnosis(board, boards()[board].system, restless(board, 1), restless(board, 2))
    assert found.parts == [] and len(found.conforming) == 2


def glitch() -> tuple[Board, LogBlock]:
    """An output that is wrong once: no limit, no interpretation."""
    run = recorded("board1", boards()["board1"].system, RESTLESS[0], "glitch")
    [block] = run.blocks()
    cells = block.values["batt_status"]
    cells[300] = 2 if cells[300] != 2 else 0
    return boards()["board1"], block


def test_what_no_change_explains_has_no_cause() -> None:
    board, block = glitch()
    run = replace(recorded("board1", board.system, RESTLESS[0], "glitch"), blocks=lambda: [block])
    [part] = diagnose_board(board, [run]).parts
    assert (part.name, part.cause, part.cases) == ("Monitor_battery", None, 1)


def test_the_time_that_ends_a_search_is_said() -> None:
    run = recorded("board1", board1(MONITOR, limit(60, 57)), HOT, "run")
    [part] = diagnose_board(boards()["board1"], [run], 1e-9).parts
    assert not part.complete and part.tried < part.of and part.cause is None


@pytest.mark.parametrize(
    ("low", "high", "closed", "simple"),
    [
        ("56.9", "57.5", (False, True), "57"), ("51", "58", (False, True), "55"),
        ("-3.1", "-3", (True, False), "-3.1"), ("3", "3", (True, True), "3"), ("3", "3", (False, True), None),
        ("0.012", "0.019", (True, True), "0.015"), ("-4", "6", (False, False), "0"),
    ],
)  # fmt: skip
def test_simple_numbers(low: str, high: str, closed: tuple[bool, bool], simple: str | None) -> None:
    assert simplest(Fraction(low), Fraction(high), *closed) == (None if simple is None else Fraction(simple))


def without(run: Recording, *names: str) -> Recording:
    """The same run with columns left out."""
    [block] = run.blocks()
    values = {name: cells for name, cells in block.values.items() if name not in names}
    left = replace(block, values=values)
    return Recording(f"{run.name} without {', '.join(names)}", frozenset(values), True, lambda: [left])


def test_a_cause_is_tried_on_runs_with_other_columns_as_a_change_of_their_own_charts() -> None:
    """The charts of the one are other ones than those of the other: `NameError` once."""
    part = part_of("board1", "Relay")
    made = stale(boards()["board1"].system, part, part.read["rx_status"])
    runs = [recorded("board1", made, LINKS, f"run {number}") for number in (1, 2)]
    every = [*runs, without(runs[0], "rx_status")]
    found = diagnose_board(boards()["board1"], every, SECONDS, deciding=False).parts
    assert {run for p in found if p.cause is not None for run in p.runs} >= {"run 1", "run 2"}


def test_a_mask_is_tried_with_whole_numbers_only() -> None:
    """Beside a limit it has no bits, 5/2 among them: `TypeError` once.  A stick may lie anywhere."""
    board = boards()["board1"]
    run = without(recorded("board1", board.system, HOT, "run"), "rover_safety_state", "b2_critical")
    vocabulary = Vocabulary(board)
    seen = InputDecoder(vocabulary, run.signals, True).seen
    groups = cone_groups(board, seen, run.signals - vocabulary.inputs)
    [group] = [g for g in groups if g.name == "Motion_Supervision"]
    part = PartEvidence(group, group.cone(), [])
    values = RunSearch(part, part.cone, part.cone)._values
    assert all(isinstance(value, int) for value in values["crit_mask_b2"])
    assert not all(isinstance(value, int) for value in values["x_norm"])
