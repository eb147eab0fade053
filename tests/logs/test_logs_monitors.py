"""Monitors of logs: every form of properties against its reduction, in steps, gaps and empty cells."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rovercheck.checker.conformance.signals import Vocabulary
from rovercheck.checker.logs import ColumnMap, as_on_record, examine
from rovercheck.checker.logs.cells import converter
from rovercheck.checker.logs.check import LogResult
from rovercheck.checker.logs.form_monitors import Judge
from rovercheck.checker.logs.formula import FormulaRows
from rovercheck.checker.logs.mapping import Column
from rovercheck.checker.logs.selection import choose
from rovercheck.properties.catalogue import catalogue
from rovercheck.properties.forms import (
    Always,
    EntersOnlyIf,
    Form,
    HoldsAfter,
    HoldsFor,
    LeavesOnlyIf,
    Never,
    Precedes,
    Property,
    Reachable,
    Responds,
    Until,
)
from rovercheck.properties.reduce import reduce
from rovercheck.spec_model.abstraction import Output, boards
from rovercheck.spec_model.abstraction.signals import computed
from rovercheck.spec_model.lang.evaluate import step
from rovercheck.spec_model.lang.expr import Const, flag, implies
from rovercheck.spec_model.lang.system import TransitionSystem
from rovercheck.spec_model.lang.time import ticks
from rovercheck.spec_model.lang.words import held, once, previous, rising
from rovercheck.spec_model.rover import systems
from tests.logs.recorded import Row, copied, long_log, written
from tests.profiles import examples

p, q, r = flag("p"), flag("q"), flag("r")
FORMS: list[Form] = [
    Always(implies(p, q)),
    Always(implies(previous(p) & rising(q), r)),
    Always(implies(held(p, for_=2 * ticks), q | once(r))),
    Always(implies(previous(previous(p) | q), r)),
    Never(p & q & r),
    Reachable(p & previous(q & ~r)),
    Responds(p, q, 0 * ticks),
    Responds(p, q, 3 * ticks),
    HoldsAfter(p, 0 * ticks, q),
    HoldsAfter(p, 2 * ticks, q),
    HoldsFor(p, q, 2 * ticks),
    LeavesOnlyIf(p, q),
    EntersOnlyIf(p, q),
    Precedes(p, q),
    Until(p, q, r),
]
LOGS = st.lists(st.tuples(st.booleans(), st.booleans(), st.booleans()), min_size=1, max_size=24)


def monitored(form: Form, from_tick: int = 1) -> Property:
    return Property("P", "It is so.", form, ("R",), "toy", from_tick)


def reduced(prop: Property, log: Sequence[tuple[bool, bool, bool]]) -> list[bool]:
    """The rows in which the monitor that the model checker uses reports the property."""
    toy = TransitionSystem("toy", (p, q, r), (), (), (), ())
    question = reduce(toy, [prop])
    at, found = question.system.init, []
    for row in log:
        at = step(question.system, at, dict(zip("pqr", map(int, row), strict=True)))
        found.append(bool(at[question.goals[0].var.name]))
    return found


def judged(judge: Judge, log: Sequence[tuple[bool, bool, bool]], blocks: Sequence[int]) -> list[bool]:
    """The same by the monitor of logs, the rows given in blocks."""
    found: list[bool] = []
    ends = [*blocks, len(log)]
    start = 0
    for end in sorted(min(e, len(log)) for e in ends):
        if end > start:
            columns = {n: np.array([row[i] for row in log[start:end]], float) for i, n in enumerate("pqr")}
            found += judge.advance(FormulaRows(columns, end - start))[0].tolist()
            start = end
    return found


@pytest.mark.parametrize("form", FORMS, ids=lambda form: type(form).__name__)
@examples(40)
@given(log=LOGS, blocks=st.lists(st.integers(1, 24), max_size=3), from_tick=st.integers(1, 3))
def test_every_form_agrees_with_its_reduction(
    form: Form, log: list[tuple[bool, bool, bool]], blocks: list[int], from_tick: int
) -> None:
    prop = monitored(form, from_tick)
    assert judged(Judge(prop), log, blocks) == reduced(prop, log)


@pytest.mark.parametrize("form", FORMS, ids=lambda form: type(form).__name__)
@examples(40)
@given(before=LOGS, log=LOGS)
def test_after_a_gap_nothing_is_reported_that_some_past_would_excuse(
    form: Form, before: list[tuple[bool, bool, bool]], log: list[tuple[bool, bool, bool]]
) -> None:
    prop = monitored(form)
    judge = Judge(prop)
    judged(judge, before, [])
    judge.gap()
    found = judged(judge, log, [])
    with_past = reduced(prop, [*before, *log])[len(before) :]
    assert all(broken or not reported for reported, broken in zip(found, with_past, strict=True))


# --- the properties of the rover -----------------------------------------------------------------


def result(folder: Path, rows: list[Row], without: tuple[str, ...] = ()) -> LogResult:
    return examine(written(folder, rows, without), ColumnMap())


@pytest.fixture(scope="module", params=["board1", "board2"])
def good(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> LogResult:
    return result(tmp_path_factory.mktemp(request.param), copied(long_log(request.param)))


def test_a_good_log_breaks_only_what_is_on_record(good: LogResult) -> None:
    assert good.unexpected == ()
    assert {v.word for v in good.verdicts} >= {"satisfied", "violated", "never triggered", "reached"}
    assert all(as_on_record(v) for v in good.verdicts if v.word == "violated")


def test_every_property_of_the_board_has_its_place(good: LogResult) -> None:
    assert len(good.verdicts) >= 70 and good.choice.missing == ()
    assert all(one.because for one in good.choice.untold)


@pytest.mark.parametrize("board", ["board1", "board2"])
def test_verdicts_are_those_of_the_reduced_monitors(board: str, tmp_path: Path) -> None:
    """The first violation of each property that reads outputs alone, in a log in which many are broken."""
    rows = copied(long_log(board)[:300])
    known = {o.var.name: o for o in boards()[board].outputs if all(o.name in row for row in rows)}
    for place, output in enumerate(known.values()):
        values = sorted({int(v) for v in output.var.domain.values[:2]})
        if len(output.var.domain) <= 8:
            rows[40 + 7 * place][output.name] = values[-1]
    found = result(tmp_path, rows)
    chosen = {
        c.property.id: c for c in found.choice.monitored if c.gate is None and set(c.names) <= known.keys()
    }
    props = [c.property for c in chosen.values()]
    toy = TransitionSystem("toy", tuple(o.var for o in known.values()), (), (), (), ())
    question = reduce(toy, props)
    at, first = question.system.init, dict[str, int]()
    for tick, row in enumerate(rows, 1):
        at = step(question.system, at, {n: _raw(o, row[o.name]) for n, o in known.items()})
        for goal in question.goals:
            if at[goal.var.name]:
                first.setdefault(goal.property.id, tick)
    told = {v.prop.id: v.first.tick for v in found.verdicts if v.prop.id in chosen and v.first is not None}
    assert told == first and len(props) > 5 and len(first) > 3


def _raw(output: Output, value: float) -> int:
    (raw,) = converter(Column(output.name), output.signal, False, False)([repr(float(value))])
    assert raw is not None
    return computed({"": raw})[""]


def test_what_is_not_logged_is_named(tmp_path: Path) -> None:
    found = result(tmp_path, copied(long_log("board1")[:60]), ("temp_status", "give_b2_actuation"))
    lacking = {one.property.id: one.missing for one in found.choice.missing}
    assert lacking["PB1-15"] == ("give_b2_actuation",)
    assert {"temp_status"} < {name for missing in lacking.values() for name in missing}


def test_charts_that_do_not_execute_are_not_judged() -> None:
    """The safety state of Board 1 is frozen while Board 2 drives: so are the properties about it."""
    vocabulary = Vocabulary(boards()["board1"])
    known = frozenset(vocabulary.sights) | {o.var.name for o in vocabulary.board.outputs}
    chosen = choose(vocabulary, known, catalogue().values(), systems().__getitem__)
    gated = {c.property.on for c in chosen.monitored if c.gate is not None}
    assert "backward" in gated
    assert not {"relay", "temperature", "references"} & gated


def test_what_is_stated_of_a_scene_is_not_asked_of_a_log(good: LogResult) -> None:
    """A property of a system that assumes something of its environment is none of every log."""
    assumed = {v.prop.on for v in good.verdicts if not isinstance(systems()[v.prop.on].assumed, Const)}
    assert assumed == set() and not any(systems()[v.prop.on].under for v in good.verdicts)
    assert any("takes more for granted" in one.because for one in good.choice.untold)


def test_a_violation_is_told_with_its_line_and_what_is_false(tmp_path: Path) -> None:
    rows = copied(long_log("board1")[:200])
    rows[150]["degraded_mask"] = int(rows[150]["degraded_mask"]) ^ 1
    broken = {v.prop.id: v.first for v in result(tmp_path, rows).unexpected}
    first = broken["PB1-10b"]
    assert first is not None and (first.tick, first.line) == (151, 152)
    assert first.parts == ("bit(degraded_mask, 0) == (temp_status == TEMP_HEALTH_DEGRADED)",)


def test_empty_cells_and_lost_rows_break_nothing(tmp_path: Path) -> None:
    rows = copied(long_log("board1")[:1200])
    for place, row in enumerate(rows):
        if place % 7 == 0:
            del row["temp_status"]
    found = result(tmp_path, rows[:400] + rows[405:900] + rows[1000:])
    assert found.unexpected == () and found.missing == 105
    judged_rows = {v.prop.id: v.judged for v in found.verdicts}
    assert judged_rows["PB1-15"] == found.rows > judged_rows["PB1-03"]


def test_a_property_that_starts_later_is_not_judged_before() -> None:
    prop = replace(monitored(Never(p)), from_tick=3)
    assert judged(Judge(prop), [(True, True, True)] * 4, []) == [False, False, True, True]
