"""Times, counts and changes of a chart, step by step."""

from pathlib import Path

import pytest

from rovercheck.checker.drawn.faults import DrawnFault
from rovercheck.checker.simulink.writer.charts import WrittenChart
from tests.drawn.charts import logged, note, running


@pytest.mark.parametrize(
    ("guard", "step"),
    [
        ("after(3, tick)", 3), ("after(0.3, sec)", 3), ("after(300, msec)", 3), ("at(2, tick)", 2),
        ("before(2, tick)", 1), ("every(4, tick)", 4), ("temporalCount(tick) > 4", 5),
        ("elapsed(sec) >= 0.3", 3), ("temporalCount(sec) >= 0.3", 3), ("duration(u == 1) >= 0.2", 2),
        ("duration(u == 1) > 0.2", 3), ("duration(u == 1, msec) >= 300", 3), ("count(u == 1) >= 2", 2),
        ("after(0.25, sec)", 3),
    ],
)  # fmt: skip
def test_times_count_executed_steps_since_entry(tmp_path: Path, guard: str, step: int) -> None:
    def draw(c: WrittenChart) -> None:
        a, b = c.state("A"), c.state(f"B\nen: {note(1)}")
        c.transition(None, a)
        c.transition(a, b, f"[{guard}]")

    found = logged(running(tmp_path, draw), [1] * 10)
    assert found.index(1) == step


@pytest.mark.parametrize(
    ("word", "values"),
    [
        ("before(2, tick)", "11000"), ("after(2, tick)", "00111"), ("at(2, tick)", "00100"),
        ("every(2, tick)", "00101"), ("temporalCount(tick)", "01234"), ("count(u == 1)", "01234"),
    ],
)  # fmt: skip
def test_times_may_stand_in_actions_too(tmp_path: Path, word: str, values: str) -> None:
    def draw(c: WrittenChart) -> None:
        c.transition(None, c.state(f"A\nen, du: log = log * 10 + double({word});"))

    assert logged(running(tmp_path, draw), [1] * 5)[-1] == int(values)


def test_times_begin_anew_when_a_state_is_entered_again(tmp_path: Path) -> None:
    def draw(c: WrittenChart) -> None:
        c.event("E")
        s, t = c.state("S\ndu: send(E, T);", order=1), c.state("T", order=2)
        a, b = c.state("A", t), c.state("B", t)
        c.transition(None, a)
        c.transition(a, b, "[duration(u < 9) >= 0.2 || u == 5]{log = log + 1;}", 1)
        c.transition(b, a, "after(2, E){log = log + 100;}", 1)
        assert s

    steps = logged(running(tmp_path, draw, parallel=True), [1] * 9)
    assert steps == [0, 0, 1, 1, 101, 101, 102, 102, 202]


def test_nothing_has_changed_in_the_first_step(tmp_path: Path) -> None:
    def draw(c: WrittenChart) -> None:
        a, b = c.state("A"), c.state(f"B\nen: {note(1)}")
        c.transition(None, a)
        c.transition(a, b, "[hasChanged(u) || rising(u)]")

    assert logged(running(tmp_path, draw, executeAtInitialization=1), [5, 5, 6]) == [0, 0, 1]


def test_a_duration_begins_anew_where_its_condition_does_not_hold(tmp_path: Path) -> None:
    def draw(c: WrittenChart) -> None:
        a, b = c.state("A"), c.state(f"B\nen: {note(1)}")
        c.transition(None, a)
        c.transition(a, b, "[duration(u == 1) >= 0.2]")

    assert logged(running(tmp_path, draw), [1, 1, 0, 1, 1, 1]).index(1) == 5


def test_events_are_counted_since_a_state_was_entered(tmp_path: Path) -> None:
    def draw(c: WrittenChart) -> None:
        c.event("E")
        s, t = c.state("S\ndu: if u == 1, send(E, T); end", order=1), c.state("T", order=2)
        a, b = c.state("A", t), c.state(f"B\nen: {note(1)}", t)
        c.transition(None, a)
        c.transition(a, b, "after(2, E)")
        assert s

    assert logged(running(tmp_path, draw, parallel=True), [0, 1, 0, 1, 0]) == [0, 0, 0, 1, 1]


@pytest.mark.parametrize(
    ("guard", "inputs", "step"),
    [
        ("hasChanged(u)", [2, 2, 2, 3], 3), ("hasChangedTo(u, 3)", [2, 4, 3], 2),
        ("hasChangedFrom(u, 2)", [2, 2, 5], 2), ("rising(u)", [-1, -1, 0, 1], 3),
        ("falling(u)", [1, 1, 0, -1], 3), ("crossing(u)", [1, 1, -1], 2),
    ],
)  # fmt: skip
def test_changes_are_seen_from_step_to_step(
    tmp_path: Path, guard: str, inputs: list[float], step: int
) -> None:
    def draw(c: WrittenChart) -> None:
        a, b = c.state("A"), c.state(f"B\nen: {note(1)}")
        c.transition(None, a)
        c.transition(a, b, f"[{guard}]")

    assert logged(running(tmp_path, draw), [*inputs, 9]).index(1) == step


def test_a_time_in_seconds_needs_the_length_of_a_step(tmp_path: Path) -> None:
    def draw(c: WrittenChart) -> None:
        a, b = c.state("A"), c.state("B")
        c.transition(None, a)
        c.transition(a, b, "[after(1, sec)]")

    with pytest.raises(DrawnFault, match="the length of a step is not known"):
        logged(running(tmp_path, draw, step="auto"), [0, 0])
