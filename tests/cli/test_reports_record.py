"""Verdicts on record beside the reports: believed as answers to the same question, and not else."""

import json
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from rovercheck.checker.commands.reports.record import FILE, Row, VerdictRecord, asked, read, sealed
from rovercheck.checker.commands.reports.run import differences
from rovercheck.checker.engines import Limits, Timers
from rovercheck.checker.model.kept_runs import VERDICTS, lines
from rovercheck.checker.render.verdict_text import evidence
from rovercheck.checker.results.trace import Trace
from rovercheck.checker.verify.checked import length
from rovercheck.checker.verify.result import Result
from rovercheck.checker.verify.tasks import Task
from rovercheck.properties.catalogue import catalogue
from rovercheck.spec_model.lang.chart import Block, Chart
from rovercheck.spec_model.lang.edit import drop, guard, in_system, timer
from rovercheck.spec_model.lang.system import System
from rovercheck.spec_model.lang.time import sec
from rovercheck.spec_model.rover import systems

EXHAUSTED, RUN, LOOP, INDUCTIVE = "PB1-16c", "PB1-15", "PB1-25", "PSY-25-B1a"
FORGED = {"states": 7}


@pytest.fixture(scope="module")
def rows() -> dict[str, Row]:
    """What is found of a few properties, each with evidence of another kind."""
    record = VerdictRecord()
    for id in (EXHAUSTED, RUN, LOOP, INDUCTIVE):
        decided(record, id)
    return record.now


def decided(record: VerdictRecord, id: str, on: Mapping[str, System] | None = None) -> Result:
    [found] = record.decided([catalogue()[id]], on or systems(), Limits())
    return found


def edited(on: str, part: str, edit: Callable[[Chart], Chart]) -> dict[str, System]:
    """The systems, with a slip in a chart of one of them."""

    def change(found: Chart | Block) -> Chart:
        assert isinstance(found, Chart)
        return edit(found)

    return {**systems(), on: in_system(systems()[on], part, change)}


def forged(row: Row) -> Row:
    """A row that somebody has changed, seal and all: what is said of it is known to come from there."""
    return sealed({**row, **FORGED})


@pytest.mark.parametrize(
    ("id", "kept"), [(EXHAUSTED, "states"), (RUN, "run"), (LOOP, "loop"), (INDUCTIVE, "conjuncts")]
)
def test_a_verdict_is_read_as_it_was_found(rows: dict[str, Row], id: str, kept: str) -> None:
    assert kept in rows[id]
    again = VerdictRecord({id: rows[id]})
    found, anew = decided(again, id), decided(VerdictRecord(), id)
    assert again.now == {id: rows[id]}
    assert (evidence(found), length(found.verdict)) == (evidence(anew), length(anew.verdict))
    assert found.limited_to == anew.limited_to and found.system == anew.system
    one, other = found.verdict.because, anew.verdict.because  # type: ignore[union-attr]
    if isinstance(one, Trace) and isinstance(other, Trace):
        assert (one.ticks, one.loop, one.shortest) == (other.ticks, other.loop, other.shortest)


def test_the_answer_to_the_same_question_is_not_searched_for(rows: dict[str, Row]) -> None:
    assert "all 7 reachable states" in evidence(
        decided(VerdictRecord({EXHAUSTED: forged(rows[EXHAUSTED])}), EXHAUSTED)
    )


def test_it_is_where_all_is_searched_for_anew(rows: dict[str, Row]) -> None:
    record = VerdictRecord({EXHAUSTED: forged(rows[EXHAUSTED])}, lambda task: task.system.name == "safety")
    decided(record, EXHAUSTED)
    assert record.now[EXHAUSTED] == rows[EXHAUSTED]


def test_of_other_charts_it_is_searched_for(rows: dict[str, Row]) -> None:
    slip = edited("safety", "Safety_state", lambda chart: drop(chart, "critical_1", 2))
    record = VerdictRecord({EXHAUSTED: forged(rows[EXHAUSTED])})
    assert "all 7 reachable states" not in evidence(decided(record, EXHAUSTED, slip))
    assert record.now[EXHAUSTED]["question"] != rows[EXHAUSTED]["question"]


@pytest.mark.parametrize("change", [FORGED, {"verdict": "violated"}, {"seal": ""}, {"engine": "bmc"}])
def test_a_row_that_was_changed_by_hand_is_not_believed(rows: dict[str, Row], change: dict[str, Any]) -> None:
    record = VerdictRecord({EXHAUSTED: {**rows[EXHAUSTED], **change}})
    decided(record, EXHAUSTED)
    assert record.now[EXHAUSTED] == rows[EXHAUSTED]


@pytest.mark.parametrize(
    "change", [{"system": "nowhere"}, {"run": {}}, {"run": 5}, {"shortest": None, "run": None}]
)
def test_nor_is_one_of_which_nothing_can_be_made(rows: dict[str, Row], change: dict[str, Any]) -> None:
    record = VerdictRecord({RUN: sealed({**rows[RUN], **change})})
    decided(record, RUN)
    assert record.now[RUN] == rows[RUN]


def test_a_run_that_shows_nothing_is_not_believed(rows: dict[str, Row]) -> None:
    run = rows[RUN]["run"]
    shorter = {**run, "blocks": run["blocks"][:-1]}
    record = VerdictRecord({RUN: sealed({**rows[RUN], "run": shorter})})
    decided(record, RUN)
    assert record.now[RUN] == rows[RUN]


def test_a_question_is_what_its_answer_follows_from() -> None:
    prop, by_name = catalogue()[RUN], systems()
    task = Task(by_name[prop.on], (prop,))
    known = asked(task, by_name, Limits())
    assert known == asked(task, systems(), Limits())
    other = catalogue()["PB1-11"]
    slip = edited("relay", "Relay", lambda chart: guard(chart, "B2_actuating", 1, timer(3.02 * sec)))
    changed = {
        asked(replace(task, properties=(other,)), by_name, Limits()),
        asked(replace(task, properties=(prop, other)), by_name, Limits()),
        asked(replace(task, properties=(replace(prop, from_tick=prop.from_tick + 1),)), by_name, Limits()),
        asked(replace(task, recorded=(True,)), by_name, Limits()),
        asked(replace(task, system=replace(task.system, over=not task.system.over)), by_name, Limits()),
        asked(replace(task, system=replace(task.system, concrete="")), by_name, Limits()),
        asked(replace(task, system=slip["relay"]), by_name, Limits()),
        asked(task, {**by_name, "board1": by_name["safety"]}, Limits()),
        asked(task, by_name, Limits(timers=Timers.FREE)),
    }
    assert len(changed - {known}) == 9


def test_what_a_solver_chose_may_differ_in_the_file_and_nothing_else(
    rows: dict[str, Row], tmp_path: Path
) -> None:
    made = {FILE: lines(VERDICTS, VERDICTS, rows)}

    def stale(id: str, change: dict[str, Any]) -> list[str]:
        changed = {**rows, id: sealed({**rows[id], **change})}
        (tmp_path / FILE).write_text(lines(VERDICTS, VERDICTS, changed), encoding="utf-8")
        assert read(tmp_path) == json.loads((tmp_path / FILE).read_text(encoding="utf-8"))[VERDICTS]
        return list(differences(tmp_path, made))

    assert stale(RUN, {}) == stale(INDUCTIVE, {"conjuncts": []}) == []
    assert (
        stale(EXHAUSTED, FORGED)
        == stale(RUN, {"verdict": "proved"})
        == stale(RUN, {"question": ""})
        == [FILE]
    )
