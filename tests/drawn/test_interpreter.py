"""Each rule of Stateflow's semantics, by charts that log the order of their actions."""

import csv
from pathlib import Path

import pytest

from rovercheck.checker.drawn.faults import DrawnFault
from rovercheck.checker.drawn.interpret.diagram import ModelRunner
from rovercheck.checker.simulink.model import read_model
from rovercheck.checker.simulink.writer.charts import WrittenChart
from tests.drawn.charts import logged, note, running
from tests.simulink.samples import EXAMPLES


@pytest.mark.parametrize("name", sorted(p.name for p in EXAMPLES.iterdir() if p.is_dir()))
def test_the_examples_give_what_their_simulations_by_hand_give(name: str) -> None:
    folder = EXAMPLES / name
    runner = ModelRunner(read_model(next(folder.glob("*.slx"))))
    inputs = list(runner.inputs())
    with (folder / "io.csv").open(encoding="utf-8") as file:
        for row in csv.DictReader(file):
            given = runner.step({name: float(row[name]) for name in inputs})
            assert {name: float(row[name]) for name in given} == given, f"in row {row['step']}"


# --- one execution ------------------------------------------------------------------------------------------


def test_outer_transitions_come_before_during_actions_and_these_before_inner_ones_and_children(
    tmp_path: Path,
) -> None:
    def draw(c: WrittenChart) -> None:
        a = c.state(f"A\ndu: {note(2)}")
        child = c.state(f"K\ndu: {note(4)}", a)
        b = c.state("B")
        c.transition(None, a)
        c.transition(None, child)
        c.transition(a, b, f"[u == 9]{{{note(1)}}}")
        c.transition(a, child, f"[u == 8]{{{note(3)}}}", inner=True)

    assert logged(running(tmp_path, draw), [0, 0, 8, 9]) == [0, 24, 2423, 24231]


def test_the_first_step_only_enters_and_a_chart_may_be_entered_before_it(tmp_path: Path) -> None:
    def draw(c: WrittenChart) -> None:
        a, b = c.state(f"A\nen: {note(1)}\ndu: {note(2)}"), c.state("B")
        c.transition(None, a)
        c.transition(a, b, f"[u == 1]{{{note(3)}}}")

    assert logged(running(tmp_path, draw), [1, 1]) == [1, 13]
    assert logged(running(tmp_path, draw, executeAtInitialization=1), [1, 1]) == [13, 13]


def test_a_chart_without_states_runs_its_flow_in_every_step(tmp_path: Path) -> None:
    def draw(c: WrittenChart) -> None:
        c.transition(None, c.junction(), f"{{{note(1)}}}")

    assert logged(running(tmp_path, draw), [0, 0, 0]) == [1, 11, 111]


def test_outputs_may_begin_anew_in_every_step(tmp_path: Path) -> None:
    def draw(c: WrittenChart) -> None:
        a = c.state(f"A\ndu: if u == 1, {note(7)} end")
        c.transition(None, a)

    assert logged(running(tmp_path, draw), [0, 1, 0]) == [0, 7, 7]
    assert logged(running(tmp_path, draw, initializeOutput=1), [0, 1, 0]) == [0, 7, 0]


# --- paths --------------------------------------------------------------------------------------------------


def test_condition_actions_of_a_path_that_fails_stay_done_and_the_next_one_is_tried(tmp_path: Path) -> None:
    def draw(c: WrittenChart) -> None:
        a, b = c.state("A"), c.state(f"B\nen: {note(5)}")
        first, second = c.junction(), c.junction()
        c.transition(None, a)
        c.transition(a, first, f"{{{note(1)}}} / {note(8)}", 1)
        c.transition(first, b, "[u == 1]", 1)
        c.transition(first, second, f"{{{note(2)}}}", 2)
        c.transition(second, b, "[u == 2]", 1)
        c.transition(a, b, f"[u == 3]{{{note(3)}}} / {note(4)}", 2)

    assert logged(running(tmp_path, draw), [0, 0, 3]) == [0, 12, 1212345]
    assert logged(running(tmp_path, draw), [0, 2]) == [0, 1285]


def test_a_junction_without_a_way_on_ends_the_search(tmp_path: Path) -> None:
    def draw(c: WrittenChart) -> None:
        a, b = c.state(f"A\ndu: {note(2)}"), c.state("B")
        c.transition(None, a)
        c.transition(a, c.junction(), f"[u == 1]{{{note(1)}}}", 1)
        c.transition(a, b, f"{{{note(3)}}}", 2)

    assert logged(running(tmp_path, draw), [0, 1, 0]) == [0, 12, 123]


def test_junctions_may_be_a_loop_that_a_guard_ends_and_one_without_end_is_told(tmp_path: Path) -> None:
    def draw(c: WrittenChart) -> None:
        a, b, j = c.state("A"), c.state("B"), c.junction()
        c.data("n", "local", "uint8", 0)
        c.transition(None, a)
        c.transition(a, j)
        c.transition(j, j, f"[n < u]{{n = n + 1; {note(1)}}}", 1)
        c.transition(j, b, "", 2)

    assert logged(running(tmp_path, draw), [0, 3, 3]) == [0, 111, 111]
    with pytest.raises(DrawnFault, match=r"SSID \d+\) in C is in a loop of junctions without end"):
        logged(running(tmp_path, draw), [0, 10**6])


def test_a_self_transition_outside_leaves_and_enters_and_one_inside_only_what_is_in_it(
    tmp_path: Path,
) -> None:
    def draw(c: WrittenChart) -> None:
        a = c.state(f"A\nen: {note(1)}\nex: {note(2)}")
        k = c.state(f"K\nen: {note(3)}\nex: {note(4)}", a)
        c.transition(None, a)
        c.transition(None, k)
        c.transition(a, a, "[u == 1]", 1)
        c.transition(a, a, "[u == 2]", 1, inner=True)
        c.transition(a, k, "[u == 3]", 2)

    assert logged(running(tmp_path, draw), [0, 1, 2]) == [13, 134213, 13421343]
    assert logged(running(tmp_path, draw), [0, 3]) == [13, 134213], "outside to its own child"


def test_a_transition_to_the_state_around_it_takes_its_default_transition(tmp_path: Path) -> None:
    def draw(c: WrittenChart) -> None:
        a = c.state(f"A\nen: {note(1)}\nex: {note(2)}")
        k, m = c.state(f"K\nen: {note(3)}", a), c.state(f"M\nen: {note(4)}\nex: {note(5)}", a)
        c.transition(None, a)
        c.transition(None, k)
        c.transition(k, m, "[u == 1]")
        c.transition(m, a, "[u == 2]", holder=a)

    assert logged(running(tmp_path, draw), [0, 1, 2]) == [13, 134, 13453]


def test_regions_are_entered_in_order_and_left_in_reverse_around_an_explicit_one(tmp_path: Path) -> None:
    def draw(c: WrittenChart) -> None:
        a, p = c.state("A"), c.state(f"P\nen: {note(1)}\nex: {note(9)}", parallel=True)
        regions = [c.state(f"R{n}\nen: {note(n + 1)}\nex: {note(n + 4)}", p, order=n) for n in (1, 2, 3)]
        inside = c.state(f"X\nen: {note(8)}", regions[1])
        other = c.state("Y", regions[1])
        c.transition(None, a)
        c.transition(None, other)
        c.transition(a, inside, "[u == 1]")
        c.transition(p, a, "[u == 2]")

    assert logged(running(tmp_path, draw), [0, 1, 2]) == [0, 12384, 123847659]


# --- history ------------------------------------------------------------------------------------------------


def test_history_enters_the_state_that_was_left_also_where_a_transition_ends_on_it(tmp_path: Path) -> None:
    def draw(c: WrittenChart) -> None:
        a, b = c.state("A"), c.state("B")
        k, m = c.state(f"K\nen: {note(1)}", a), c.state(f"M\nen: {note(2)}", a)
        h = c.junction(a, history=True)
        c.transition(None, a)
        c.transition(None, k)
        c.transition(k, m, "[u == 1]")
        c.transition(a, b, "[u == 2]")
        c.transition(b, a, "[u == 3]", 1)
        c.transition(b, h, "[u == 4]", 2)

    assert logged(running(tmp_path, draw), [0, 1, 2, 3, 2, 4]) == [1, 12, 12, 122, 122, 1222]


# --- events -------------------------------------------------------------------------------------------------


def test_an_event_runs_the_chart_at_once_and_to_one_state_only_this(tmp_path: Path) -> None:
    def draw(c: WrittenChart, sends: str = "E;") -> None:
        c.event("E")
        r1 = c.state("R1", order=1)
        r2 = c.state(f"R2\ndu: {note(5)}", order=2)
        a, b = c.state("A", r1), c.state("B", r1)
        x, y = c.state("X", r2), c.state(f"Y\nen: {note(2)}", r2)
        c.transition(None, a)
        c.transition(None, x)
        c.transition(a, b, f"[u == 1]{{{note(1)} {sends} {note(3)}}}")
        c.transition(x, y, "E")

    def broadcast(c: WrittenChart) -> None:
        draw(c, "if log < 10, E; end")

    def directed(c: WrittenChart) -> None:
        draw(c, "send(E, R2);")

    assert logged(running(tmp_path, directed, parallel=True), [0, 1]) == [0, 15235]
    assert logged(running(tmp_path, broadcast, parallel=True), [0, 1]) == [0, 113525], "A was left"


def test_what_an_action_would_do_is_dropped_once_its_state_was_left(tmp_path: Path) -> None:
    def draw(c: WrittenChart) -> None:
        c.event("E")
        a, b, z = c.state("A"), c.state(f"B\nen: {note(1)} E; {note(2)}"), c.state(f"Z\nen: {note(3)}")
        inside = c.state(f"K\nen: {note(4)}", b)
        c.transition(None, a)
        c.transition(None, inside)
        c.transition(a, b, "[u == 1]")
        c.transition(b, z, "E")

    assert logged(running(tmp_path, draw), [0, 1, 0]) == [0, 13, 13]


def test_a_condition_action_that_has_its_state_left_drops_the_transition(tmp_path: Path) -> None:
    def draw(c: WrittenChart) -> None:
        c.event("E")
        a, b, z = c.state("A"), c.state(f"B\nen: {note(2)}"), c.state(f"Z\nen: {note(3)}")
        c.transition(None, a)
        c.transition(a, z, "E", 1)
        c.transition(a, b, f"[u == 1]{{E; {note(1)}}}", 2)

    assert logged(running(tmp_path, draw), [0, 1]) == [0, 3]


def test_a_transition_action_after_which_another_state_is_active_is_the_last_one(tmp_path: Path) -> None:
    def draw(c: WrittenChart) -> None:
        c.event("E")
        p = c.state("P", order=1)
        q = c.state("Q", order=2)
        a, b = c.state("A", p), c.state(f"B\nen: {note(2)}", p)
        other = c.state("O", q)
        c.transition(None, a)
        c.transition(None, other)
        c.transition(a, b, f"[u == 1] / {note(1)} E; {note(4)}")
        c.transition(other, other, f"E{{{note(3)}}}")

    assert logged(running(tmp_path, draw, parallel=True), [0, 1]) == [0, 1342]


def test_a_transition_action_after_which_its_scope_was_left_is_the_last_one(tmp_path: Path) -> None:
    def draw(c: WrittenChart) -> None:
        c.event("E")
        s, z = c.state("S"), c.state(f"Z\nen: {note(3)}")
        a, b = c.state("A", s), c.state(f"B\nen: {note(2)}", s)
        c.transition(None, s)
        c.transition(None, a)
        c.transition(a, b, f"[u == 1] / {note(1)} E; {note(4)}")
        c.transition(s, z, "E")

    assert logged(running(tmp_path, draw), [0, 1]) == [0, 13]


def test_a_state_is_active_while_its_exit_action_runs(tmp_path: Path) -> None:
    def draw(c: WrittenChart) -> None:
        a, b = c.state("A\nex: log = 10 + double(in(A));"), c.state("B\nen: log = log * 10 + double(in(A));")
        c.transition(None, a)
        c.transition(a, b, "[u == 1]")

    assert logged(running(tmp_path, draw), [0, 1]) == [0, 110]


def test_an_event_to_a_state_that_is_not_active_does_nothing(tmp_path: Path) -> None:
    def draw(c: WrittenChart) -> None:
        c.event("E")
        a, b = c.state(f"A\ndu: send(E, B); {note(1)}"), c.state(f"B\non E: {note(2)}")
        c.transition(None, a)
        c.transition(a, b, "[u == 1]")

    assert logged(running(tmp_path, draw), [0, 0, 1]) == [0, 1, 1]


def test_a_region_is_not_executed_once_the_state_around_it_was_left(tmp_path: Path) -> None:
    def draw(c: WrittenChart) -> None:
        c.event("E")
        p, z = c.state("P", parallel=True), c.state(f"Z\nen: {note(3)}")
        first = c.state(f"R1\ndu: if u == 1, {note(1)} E; end", p, order=1)
        second = c.state(f"R2\ndu: {note(2)}", p, order=2)
        c.transition(None, p)
        c.transition(p, z, "E")
        assert first and second

    assert logged(running(tmp_path, draw), [0, 0, 1]) == [0, 2, 213]


def test_on_sections_run_in_an_execution_with_their_event(tmp_path: Path) -> None:
    def draw(c: WrittenChart) -> None:
        c.event("E")
        s = c.state("S", order=1)
        t = c.state(f"T\non E: {note(2)}\ndu: {note(3)}", order=2)
        k = c.state(f"K\ndu: if u == 1, {note(1)} send(E, T); end", s)
        c.transition(None, k)
        assert t

    assert logged(running(tmp_path, draw, parallel=True), [0, 0, 1]) == [0, 3, 31323]


def test_sections_of_one_kind_run_in_the_order_they_are_written(tmp_path: Path) -> None:
    """What stands before the first keyword is one, too."""

    def draw(c: WrittenChart) -> None:
        c.transition(
            None, c.state(f"A\n{note(1)}\nen: {note(2)}\ndu: {note(4)}\nen: {note(3)}\ndu: {note(5)}")
        )

    assert logged(running(tmp_path, draw), [0, 0]) == [123, 12345]
