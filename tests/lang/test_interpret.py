"""Executions, transitions, paths and sends in the reference interpreter (rules G1 to G10)."""

from rovercheck.spec_model.lang.action import assign, send, when
from rovercheck.spec_model.lang.chart import Chart, Enabled, Junction, State, to
from rovercheck.spec_model.lang.interpret import FiredTransition
from tests.lang.bench import Bench, a, b, c, n, note, state

# --- executions and the order of states (G1 to G5) ---------------------------------------------


def test_g1_one_execution_per_step() -> None:
    bench = Bench(Chart("C", [state("A", 1, 2)], default="A"))
    assert [bench.tick() for _ in range(3)] == ["1", "2", "2"]


def test_g2_the_first_execution_only_enters() -> None:
    inner = state("In", 2, 8, transitions=[to("Other", when=a)])
    chart = Chart("C", [state("Out", 1, 9, states=[inner, state("Other")], default="In",
                              transitions=[to("Out", when=b)])], default="Out")  # fmt: skip
    bench = Bench(chart)
    assert bench.tick(a, b) == "12"
    assert [(f.source, f.target, f.order) for f in bench.fired] == [
        ((), ("Out",), 0),
        ((), ("Out", "In"), 0),
    ]
    assert bench["C.entered"] == 1


def test_g2_before_the_first_execution_nothing_is_active() -> None:
    bench = Bench(Enabled(a, Chart("C", [state("A", 1)], default="A")))
    assert (bench.tick(), bench.at(), bench["C.entered"]) == ("", "-", 0)
    assert (bench.tick(a), bench.at(), bench["C.entered"]) == ("1", "A", 1)


def test_g3_regions_in_order_each_completely_and_seen_by_the_next() -> None:
    first = State("R1", during=[assign(n, 5)], states=[state("X", 1, 2)], default="X")
    second = State("R2", during=[when(n == 5, [note(7)])], states=[state("Y", 3, 4)], default="Y")
    bench = Bench(Chart("C", [first, second], parallel=True))
    assert [bench.tick(), bench.tick()] == ["13", "274"]


def test_g4_superstate_first_then_its_during_then_the_child() -> None:
    child = state("In", 0, 2, transitions=[to("Other", when=a)])
    outer = state("Out", 0, 1, states=[child, state("Other", 3)], default="In",
                  transitions=[to("Away", when=b)])  # fmt: skip
    bench = Bench(Chart("C", [outer, state("Away", 9)], default="Out"))
    bench.tick()
    assert bench.tick() == "12"
    assert bench.tick(a) == "13"
    assert bench.tick(a, b) == "9"


def test_g4_transitions_in_priority_order() -> None:
    chart = Chart("C", [state("A", transitions=[to("B", when=a), to("D", when=a | b)]), state("B"),
                        state("D")], default="A")  # fmt: skip
    for true, target, order in ((a, "B", 1), (b, "D", 2)):
        bench = Bench(chart)
        bench.tick()
        bench.tick(true)
        assert (bench.at(), bench.fired[0].order) == (target, order)


def test_g5_a_state_just_entered_waits_for_the_next_execution() -> None:
    chart = Chart("C", [state("A", transitions=[to("B")]), state("B", 1, 9, transitions=[to("D")]),
                        state("D", 2)], default="A")  # fmt: skip
    bench = Bench(chart)
    assert [bench.tick() for _ in range(3)] == ["", "1", "2"]


def test_g5_regions_after_the_one_that_leaves_are_not_executed() -> None:
    both = State("Both", parallel=True, states=[
        State("R1", states=[state("X", transitions=[to("Away", when=a)])], default="X"),
        State("R2", states=[state("Y", 0, 2, 3)], default="Y"),
    ])  # fmt: skip
    bench = Bench(Chart("C", [both, state("Away", 1)], default="Both"))
    bench.tick()
    assert bench.tick(a) == "31"


def test_g5_a_composite_that_is_left_and_entered_again_is_not_executed_again() -> None:
    both = State("Both", parallel=True, states=[
        State("R1", states=[state("X", transitions=[to("Both", when=a)])], default="X"),
        State("R2", states=[state("Y", 1, 9)], default="Y"),
    ])  # fmt: skip
    bench = Bench(Chart("C", [both], default="Both"))
    bench.tick()
    assert bench.tick(a) == "1"


# --- labels, paths, actions (G6 to G9) --------------------------------------------------------


def test_g6_a_transition_with_an_event_needs_that_event() -> None:
    sender = State("R1", during=[when(a, [send("go", "R2")])])
    receiver = State(
        "R2", states=[state("X", transitions=[to("Y", on="go", when=b)]), state("Y")], default="X"
    )
    bench = Bench(Chart("C", [sender, receiver], parallel=True))
    for true, place in (((), "X"), ((b,), "X"), ((a,), "X"), ((a, b), "Y")):
        bench.tick(*true)
        if true:
            assert bench.at("C.R2") == place
    assert bench.fired == (FiredTransition("C", ("R2", "X"), ("R2", "Y"), "go [b]", 1, "go"),)


def test_g7_backtracking_to_the_previous_point_and_to_the_next_transition() -> None:
    chart = Chart(
        "C",
        [state("A", transitions=[to("J", when=a), to("D")]), state("B"), state("D")],
        default="A",
        junctions=[Junction("J", [to("K", when=b), to("B", when=c)]), Junction("K", [to("A", when=n > 3)])],
    )
    for true, extra, target in (((), 0, "D"), ((a,), 0, "D"), ((a, c), 0, "B"), ((a, b, c), 0, "B"),
                                ((a, b, c), 4, "A")):  # fmt: skip
        bench = Bench(chart)
        bench.tick()
        bench.tick(*true, n=extra)
        assert bench.at() == target
        assert bench.fired[0].order == (2 if target == "D" else 1)


def test_g8_condition_actions_run_at_once_transition_actions_only_on_a_complete_path() -> None:
    chart = Chart(
        "C",
        [state("A", 0, 9, 4, transitions=[to("J", do=[note(1)], then=[note(5)])]), state("B", 6)],
        default="A",
        junctions=[Junction("J", [to("B", when=a, do=[note(2)], then=[note(7)])])],
    )
    bench = Bench(chart)
    bench.tick()
    assert bench.tick() == "19"
    assert bench.tick(a) == "124576"
    label = "{log := log*10 + 1} / log := log*10 + 5 → [a] {log := log*10 + 2} / log := log*10 + 7"
    assert bench.fired == (FiredTransition("C", ("A",), ("B",), label, 1, None),)


def test_g9_exit_inside_out_transition_action_entry_outside_in() -> None:
    inner = state("In", 0, 0, 1, transitions=[to("Deep", when=a, then=[note(3)])])
    left = state("L", 0, 0, 2, states=[inner], default="In")
    right = state("R", 4, states=[state("Shallow", 9), state("Mid", 5, states=[state("Deep", 6)])],
                  default="Shallow")  # fmt: skip
    bench = Bench(Chart("C", [left, state("Unused", transitions=[to("R")]), right],
                        default=[to("L", when=~b), to("Unused")]))  # fmt: skip
    bench.tick()
    assert bench.tick(a) == "123456"
    assert (bench.at("C.L"), bench.at("C.R"), bench.at("C.R.Mid")) == ("-", "Mid", "Deep")


def test_g9_a_self_loop_leaves_and_enters() -> None:
    bench = Bench(Chart("C", [state("A", 1, 9, 2, transitions=[to("A", when=a)])], default="A"))
    assert [bench.tick(), bench.tick(), bench.tick(a)] == ["1", "9", "21"]


def test_g9_a_transition_to_a_child_leaves_and_enters_the_superstate() -> None:
    outer = state("Out", 1, 0, 4, states=[state("In", 2, 0, 3), state("Two", 5)], default="In",
                  transitions=[to("Two", when=a)])  # fmt: skip
    bench = Bench(Chart("C", [outer], default="Out"))
    assert [bench.tick(), bench.tick(a)] == ["12", "3415"]


def test_g9_the_other_regions_of_an_explicit_target_are_entered_by_default() -> None:
    one = state("R1", 2, 0, 9, states=[state("X", 3, 0, 8)], default="X")
    two = state("R2", 4, 0, 7, states=[state("Y"), state("W", 5, 0, 6)], default="Y")
    both = State("Both", entry=[note(1)], states=[one, two], parallel=True, transitions=[to("Idle", when=b)])
    idle = State("Idle", transitions=[to("Both", when=a), to("W")])
    bench = Bench(Chart("C", [idle, both], default="Idle"))
    bench.tick()
    assert bench.tick() == "12345"
    assert bench.tick(b) == "6789"


def test_g9_default_paths_may_pass_junctions_and_have_actions() -> None:
    chart = Chart("C", [state("A", 3), state("B", 4)],
                  default=to("J", do=[note(1)]),
                  junctions=[Junction("J", [to("A", when=a, then=[note(2)]), to("B")])])  # fmt: skip
    assert Bench(chart).tick(a) == "123"
    assert Bench(chart).tick() == "14"


# --- directed sends (G10) ---------------------------------------------------------------------


def relay_of_events() -> Chart:
    one = State("R1", states=[state("X", 0, 0, 1, transitions=[
        to("Y", when=a, do=[send("e", "R2"), note(5)]),
    ]), state("Y", 6)], default="X")  # fmt: skip
    two = State("R2", states=[
        state("P", 0, 8, 2, transitions=[to("Q", on="e", do=[send("f", "R3")])]), state("Q", 4),
    ], default="P")  # fmt: skip
    three = State("R3", states=[state("S", 0, 9, transitions=[to("T", on="f")]), state("T", 3)], default="S")
    return Chart("C", [one, two, three], parallel=True)


def test_g10_sends_nest_and_run_before_the_sender_goes_on() -> None:
    bench = Bench(relay_of_events())
    bench.tick()
    assert bench.tick(a) == "3" + "24" + "5" + "16"
    assert [(f.target[-1], f.event) for f in bench.fired] == [("T", "f"), ("Q", "e"), ("Y", None)]


def test_g10_the_event_ceases_and_one_that_nobody_wants_is_lost() -> None:
    one = State("R1", during=[when(a, [send("e", "R2")])])
    two = State("R2", states=[state("P", transitions=[to("Q", on="e", when=b)]), state("Q")], default="P")
    bench = Bench(Chart("C", [one, two], parallel=True))
    bench.tick()
    bench.tick(a)
    bench.tick(b)
    assert bench.at("C.R2") == "P"


def test_g10_transitions_without_event_are_tested_in_a_nested_execution_too() -> None:
    one = State("R1", during=[when(a, [send("e", "R2")])])
    two = State("R2", states=[state("P", transitions=[to("Q", when=a)]),
                              state("Q", 0, 0, transitions=[to("P", on="e"), to("S", when=b)]),
                              state("S", 0, 7)], default="P")  # fmt: skip
    bench = Bench(Chart("C", [one, two], parallel=True))
    bench.tick()
    bench.tick(a, b)
    assert [(f.target[-1], f.event) for f in bench.fired] == [("Q", "e"), ("S", None)]


def test_g10_a_receiver_that_is_not_active_is_not_executed() -> None:
    """A region entered after the sender is not active yet, one left before the sender no more."""
    two = State("R2", during=[note(9)], states=[
        state("P", transitions=[to("Q", on="e")]), state("Q", transitions=[to("P", on="e")]),
    ], default="P")  # fmt: skip
    one = State("R1", entry=[send("e", "R2")], exit=[send("e", "R2")])
    both = State("Both", parallel=True, states=[one, two], transitions=[to("Away", when=a)])
    bench = Bench(Chart("C", [both, State("Away")], default="Both"))
    assert (bench.tick(), bench.at("C.Both.R2")) == ("", "P")
    assert (bench.tick(), bench.at("C.Both.R2")) == ("9", "P")
    assert bench.tick(a) == ""


def test_g10_the_receiver_may_be_a_state_inside_the_sender() -> None:
    inner = [state("P", 0, 8, transitions=[to("Q", on="e")]), state("Q", 1, 2)]
    outer = State("Out", during=[when(a, [send("e", "P")])], states=inner, default="P")
    bench = Bench(Chart("C", [outer], default="Out"))
    bench.tick()
    assert bench.tick(a) == "12"
