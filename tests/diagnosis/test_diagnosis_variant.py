"""Variants: causes written down and applied again, after which nothing deviates; those that do not fit."""

from fractions import Fraction
from pathlib import Path

import pytest

from rovercheck.checker.compare.beside import SteppedCharts
from rovercheck.checker.compare.recorded_runs import counterexamples
from rovercheck.checker.diagnosis.change import ChartChange
from rovercheck.checker.diagnosis.hypotheses import mutant_changes, rewrite_changes, signals_of
from rovercheck.checker.diagnosis.result import diagnose_board
from rovercheck.checker.diagnosis.variant import (
    VariantError,
    WrittenChange,
    applied,
    read_variant,
    with_change,
    written,
)
from rovercheck.checker.mutate.delays import late
from rovercheck.checker.system.text import SystemText
from rovercheck.spec_model.abstraction import boards
from rovercheck.spec_model.lang.chart import parts
from rovercheck.spec_model.lang.edit import constant, in_expressions, timer
from rovercheck.spec_model.lang.lower import lower
from rovercheck.spec_model.lang.system import System
from rovercheck.spec_model.lang.time import sec
from tests.diagnosis.planted import changed, deviating, inputs, part_of, recorded, restless

HOT = inputs(
    "board1",
    [(5, {}), *((n, {"temperature_degC": t}) for t in (57.5, 56.9, 60.0, 57.0) for n in (160, 45)),
     (5, {"temperature_degC": 20.0}), (160, {"temperature_degC": 70.0}), (5, {"temperature_degC": 20.0})],
)  # fmt: skip


def planted(kind: str) -> System:
    charts = boards()["board1"].system
    match kind:
        case "limit":
            return changed("board1", "Monitor_temperature", lambda p: in_expressions(p, constant(60, 57)))  # type: ignore[arg-type]
        case "timer":
            return changed("board1", "Monitor_temperature", lambda p: in_expressions(p, timer(3 * sec)))  # type: ignore[arg-type]
        case "interpretation":
            return boards({"S01": "HOLD"})["board1"].system
        case "late":
            part = part_of("board1", "Safety_state")
            return late(charts, part, part.written["rover_safety_state"])
    raise AssertionError(kind)


@pytest.mark.parametrize("kind", ["limit", "timer", "interpretation", "late"])
def test_with_the_causes_applied_nothing_deviates(kind: str, tmp_path: Path) -> None:
    """All causes that explain as much, written to a file, read and applied, one by one."""
    board = boards()["board1"]
    rows = restless("board1", 5) if kind == "late" else HOT
    run = recorded("board1", planted(kind), rows, "run")
    [part] = diagnose_board(board, [run]).parts
    assert part.cause is not None
    assert part.cause.changes[0].kind == kind
    for number, cause in enumerate([part.cause, *(r.cause for r in part.rivals)]):
        file = tmp_path / f"variant{number}.toml"
        file.write_text(written("board1", cause.changes, ["What it does."]), encoding="utf-8")
        assert deviating(applied(board, read_variant(file)), [run]) == []
    assert deviating(board, [run]) == [part.name]


CHANGE = """board = "board1"
[[change]]
kind = "limit"
chart = "Monitor_temperature"
at = "everywhere"
from = "temperature_degC >= 60"
to = "temperature_degC >= 57"
"""


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        ("limit", "limits", "change 1 (limits in Monitor_temperature): there is no kind"),
        ("Monitor_temperature", "Monitor_temp", "change 1 (limit in Monitor_temp): board1 has no chart"),
        ("everywhere", "nowhere", "there is no another limit"),
        (">= 60", ">= 61", "and not `temperature_degC >= 61`"),
        (">= 57", ">= hot", "there is no another limit"),
        ("board1", "board2", "it is a variant of board2, and not of board1"),
        ('from = "', 'form = "', "change 1: write kind, chart, at, from, to"),
        ("[[change]]", "[change]", "and nothing else"),
        ('board = "board1"', "board = ", "Write a file as"),
    ],
)
def test_a_variant_that_does_not_fit_is_refused_with_its_place(
    old: str, new: str, says: str, tmp_path: Path
) -> None:
    file = tmp_path / "variant.toml"
    file.write_text(CHANGE.replace(old, new, 1), encoding="utf-8")
    with pytest.raises(VariantError) as refused:
        applied(boards()["board1"], read_variant(file), str(file))
    assert says.replace("there is no another", "there is nothing for another") in str(refused.value)
    assert str(refused.value).startswith(str(file))


def digest(system: System) -> str:
    text = SystemText()
    text.system(lower(system))
    return text.digest


def all_changes(board: str) -> list[ChartChange]:
    drawn = boards()[board]
    names = frozenset(part.name for part in parts(drawn.system.components))
    return [*mutant_changes(drawn.system), *rewrite_changes(drawn.system, signals_of(drawn), names)]


@pytest.mark.parametrize("board", ["board1", "board2"])
def test_no_two_changes_are_written_alike(board: str) -> None:
    """Of a member in several branches of an action the first one was changed, whichever was found."""
    keys = [change.key for change in all_changes(board)]
    assert len(keys) == len({*keys})


def test_what_stands_several_times_at_one_place_is_changed_where_it_was_found() -> None:
    """A stop that is no emergency stop was known without its cause, and a fault behind it was not seen."""
    board = boards()["board2"]
    alike = [
        change
        for change in all_changes("board2")
        if (change.chart, change.old, change.new) == ("TranslateDecision", "CMD_ESTOP", "CMD_STOP")
    ]
    assert [change.at for change in alike] == ["block", "block#2"]
    first, second = (digest(with_change(board, WrittenChange(*change.key)).system) for change in alike)
    assert [first, second] == [digest(change.make()) for change in alike]
    assert first != second
    assert "(place 2)" in alike[1].text and "(place" not in alike[0].text


def test_a_number_between_the_multiples_of_its_resolution_is_given_in_every_step() -> None:
    """0.7 of full speed, which the charts have in fifths, was an input without a value in all runs."""
    slower = WrittenChange("constant", "updateSafetyLimits", "block V_MAX_MANEUVER", "0.8", "0.7")
    board = with_change(boards()["board1"], slower)
    fastest = set[int]()
    for _, steps in counterexamples(board):
        charts = SteppedCharts(board)
        for step in steps:
            charts.step(step.inputs)
            fastest.add(charts.valuation()["V_MAX_MANEUVER"])
    assert max(fastest) == Fraction(7, 2)


def test_a_stamp_that_two_charts_show_to_be_taken_otherwise_is_taken_so_once() -> None:
    """Every other update, written for two charts, was every fourth one."""
    record = "into one record, added up in 32 bits, with last_valid_b2_ms"
    found = (
        ("shared", "stamp/b2_data_last_valid_ms", "as it is given", record),
        ("stamp", "stamp/last_valid_b2_ms", "as it is given", "every other one"),
    )
    board = boards()["board1"]
    for chart in ("Monitor_heartbeat", "Monitor_reception"):
        for kind, *change in found:
            board = with_change(board, WrittenChange(kind, chart, *change))
    assert [one.stamp for one in board.interface.taken] == ["b2_data_last_valid_ms", "last_valid_b2_ms"]
