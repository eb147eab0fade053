"""Temporal words in the reference interpreter (rules G13 to G15, specific values)."""

from collections.abc import Iterable

import pytest

from rovercheck.spec_model.lang.action import assign, send, when
from rovercheck.spec_model.lang.chart import Chart, Enabled, Junction, State, to
from rovercheck.spec_model.lang.domain import enumeration
from rovercheck.spec_model.lang.expr import Temporal, Var, flag, var
from rovercheck.spec_model.lang.time import ms, sec, ticks
from rovercheck.spec_model.lang.words import after, duration, held, rising
from tests.lang.bench import Bench, a, b, c, n, note


def first_true(word: Temporal, at: Iterable[int] = range(1, 100), chart_input: Var = a) -> int:
    """The tick in which a transition A -> B with this guard is taken, its input being true in ``at``."""
    bench = Bench(Chart("C", [State("A", transitions=[to("B", when=word)]), State("B")], default="A"))
    true = set(at)
    reads = chart_input.name in bench.interpreter.system.inputs
    for tick in range(1, 100):
        bench.tick(*([chart_input] if reads and tick in true else []))
        if bench.at() == "B":
            return tick
    raise AssertionError("never true")


# --- temporal words (G13 to G15) --------------------------------------------------------------


@pytest.mark.parametrize("span", [3 * ticks, 60 * ms])
def test_g13_after_is_first_true_n_steps_after_entry(span) -> None:
    assert first_true(after(span)) == 1 + 3


def test_g13_after_counts_no_nested_execution() -> None:
    one = State("R1", during=[send("e", "R2"), send("e", "R2")])
    waiting = State("P", transitions=[to("Q", when=after(3 * ticks)), to("P", on="e", when=b)])
    two = State("R2", states=[waiting, State("Q")], default="P")
    bench = Bench(Chart("C", [one, two], parallel=True))
    places = [(bench.tick(), bench.at("C.R2"))[1] for _ in range(4)]
    assert places == ["P", "P", "P", "Q"]


def test_g13_after_refers_to_the_state_the_whole_path_leaves() -> None:
    inner = State("In", transitions=[to("In", when=a), to("J")])
    chart = Chart("C", [State("Out", states=[inner], default="In"), State("Away")], default="Out",
                  junctions=[Junction("J", [to("Away", when=after(2 * ticks))])])  # fmt: skip
    bench = Bench(chart)
    places = [(bench.tick(*true), bench.at())[1] for true in ((), (), (a,), (), ())]
    assert places == ["Out", "Out", "Out", "Out", "Away"]


def test_g13_a_superstate_counts_across_changes_of_its_children() -> None:
    inner = [State("P", transitions=[to("Q")]), State("Q", transitions=[to("P")])]
    outer = State("Out", states=inner, default="P", transitions=[to("Away", when=after(4 * ticks))])
    bench = Bench(Chart("C", [outer, State("Away")], default="Out"))
    assert [(bench.tick(), bench.at())[1] for _ in range(5)] == ["Out"] * 4 + ["Away"]


@pytest.mark.parametrize(("start", "expected"), [(1, 1 + 3 + 1), (4, 4 + 3 + 1)])
def test_g14_duration_is_first_true_n_plus_one_steps_after_its_condition(start: int, expected: int) -> None:
    assert first_true(duration(a) > 3 * ticks, range(start, 100)) == expected


def test_g14_duration_not_strict_is_true_one_step_earlier() -> None:
    assert first_true(duration(a) >= 3 * ticks, range(4, 100)) == 4 + 3


def test_g14_a_gap_restarts_the_duration() -> None:
    assert first_true(duration(a) > 3 * ticks, [1, 2, 3, *range(5, 100)]) == 5 + 3 + 1


def test_g14_the_condition_is_read_at_the_end_of_the_step_and_when_tested() -> None:
    """``stopped`` is written by the during action, after the guard was tested: true from tick 2 on."""
    stopped = flag("stopped")
    braking = State("A", during=[assign(stopped, a)],
                    transitions=[to("B", when=duration(stopped) > 2 * ticks)])  # fmt: skip
    bench = Bench(Chart("C", [braking, State("B")], default="A"))
    assert [(bench.tick(a), bench.at())[1] for _ in range(5)] == ["A", "A", "A", "A", "B"]


def test_g14_a_false_condition_in_a_nested_execution_restarts_it() -> None:
    """``b`` is false while the event is processed and true at the end of every step."""
    one = State("R1", during=[assign(b, False), send("e", "R2"), assign(b, True)])
    waiting = State("P", transitions=[to("Q", when=duration(b) > 1 * ticks), to("P", on="e", when=c)])
    two = State("R2", states=[waiting, State("Q")], default="P")
    bench = Bench(Chart("C", [one, two], parallel=True))
    assert [(bench.tick(), bench.at("C.R2"))[1] for _ in range(6)] == ["P"] * 6


def test_g15_rising_is_true_in_the_step_of_the_edge_only() -> None:
    chart = Chart("C", [State("A", during=[when(rising(a), [note(1)])])], default="A")
    bench = Bench(chart)
    assert [bench.tick(*true) for true in ((), (a,), (a,), (), (a,))] == ["", "1", "", "", "1"]


def test_g15_rising_is_false_in_the_first_step() -> None:
    bench = Bench(Chart("C", [State("A", entry=[when(rising(a), [note(1)])])], default="A"))
    assert bench.tick(a) == ""


def test_g15_the_memory_is_updated_when_the_guard_is_not_examined() -> None:
    one = State("A", transitions=[to("B", when=b)])
    two = State("B", transitions=[to("A", when=rising(a))])
    bench = Bench(Chart("C", [one, two], default="A"))
    for true in ((), (a, b), (a,)):
        bench.tick(*true)
    assert bench.at() == "B"


def test_g15_the_memory_is_of_the_previous_executed_step() -> None:
    bench = Bench(Enabled(b, Chart("C", [State("A", during=[when(rising(a), [note(1)])])], default="A")))
    assert [bench.tick(*true) for true in ((a, b), (), (a, b), (b,), (), (a,), (a, b))] == [""] * 6 + ["1"]


def test_g15_rising_of_a_number_is_of_its_being_positive() -> None:
    bench = Bench(Chart("C", [State("A", during=[when(rising(n), [note(1)])])], default="A"))
    assert [bench.tick(n=v) for v in (0, 3, 5, 0, 1)] == ["", "1", "", "", "1"]


@pytest.mark.parametrize("start", [1, 5])
def test_held_is_true_n_steps_after_the_first_true_one(start: int) -> None:
    assert first_true(held(a, 3 * ticks), range(start, 100)) == start + 3


def test_held_of_no_time_is_the_condition() -> None:
    assert first_true(held(a, 0 * ticks), [4]) == 4


# --- specific values (semantics, section 6) -----------------------------------------------------


def test_relay_returns_151_steps_after_the_link_is_well_again() -> None:
    status = enumeration("Rx", ["RX_OK", "RX_DEGRADED", "RX_CRITICAL"])
    rx = var("rx_status", status)
    give = flag("give_b2_actuation")
    relay = Chart("Relay", [
        State("B1_actuating", entry=[assign(give, False)],
              transitions=[to("B2_actuating", when=rx == "RX_CRITICAL")]),
        State("B2_actuating", entry=[assign(give, True)],
              transitions=[to("B1_actuating", when=duration(rx != "RX_CRITICAL") > 3 * sec)]),
    ], default="B1_actuating")  # fmt: skip
    bench = Bench(relay)
    values = [
        (bench.tick(rx_status=2 if k in (2, 3, 4) else 0), bench["give_b2_actuation"])[1]
        for k in range(1, 170)
    ]
    assert values.index(1) + 1 == 2
    assert values.index(0, 2) + 1 == 5 + 151


def test_combination_of_buttons_gives_up_after_one_second() -> None:
    button = flag("btn1")
    toggle = State("Toggle", default="Step2", states=[
        State("Step2", transitions=[to("Step3", when=rising(button)), to("Start", when=after(1 * sec))]),
        State("Step3", transitions=[to("Start", when=after(1 * sec))]),
    ])  # fmt: skip
    bench = Bench(
        Chart("C", [State("Start", transitions=[to("Toggle", when=rising(button))]), toggle], default="Start")
    )
    pressed, places = {2, 40}, []
    for k in range(1, 100):
        bench.tick(btn1=int(k in pressed))
        places.append(bench.at())
    assert places.index("Start", 2) + 1 == 40 + 50
