"""The reference interpreter, rule by rule (G1 to G15), on small charts made by hand."""

from collections.abc import Iterable, Sequence

import pytest

from spec_model.lang.action import Action, assign, send, when
from spec_model.lang.chart import Block, Chart, Component, Enabled, Junction, State, Transition, to
from spec_model.lang.domain import boolean, enumeration, integer
from spec_model.lang.errors import ModelError
from spec_model.lang.expr import Temporal, Var, after, duration, flag, held, maximum, minimum, rising, var
from spec_model.lang.interpret import Fired, Interpreter
from spec_model.lang.system import in_order
from spec_model.lang.time import ms, sec, ticks

log = var("log", integer(0, 10**9))
a, b, c = flag("a"), flag("b"), flag("c")
n = var("n", integer(0, 9))


def note(digit: int) -> Action:
    """Append a digit to the log: the order in which actions ran."""
    return assign(log, log * 10 + digit)


def state(
    name: str, entry: int = 0, during: int = 0, exit: int = 0, *, transitions: Sequence[Transition] = (),
    states: Sequence[State] = (), default: str | Transition | Sequence[Transition] | None = None,
    junctions: Sequence[Junction] = (), parallel: bool = False,
) -> State:  # fmt: skip
    """A state that notes a digit when it is entered, stays active and is left; 0 for nothing."""
    notes = [[note(digit)] if digit else [] for digit in (entry, during, exit)]
    return State(
        name, entry=notes[0], during=notes[1], exit=notes[2], transitions=transitions, states=states,
        default=default, junctions=junctions, parallel=parallel,
    )  # fmt: skip


class Bench:
    """Runs components and says what happened in each tick."""

    def __init__(self, *components: Component, frozen: Sequence[Var] = ()) -> None:
        self.interpreter = Interpreter(in_order("Bench", *components, frozen=frozen))
        self.fired: tuple[Fired, ...] = ()

    def tick(self, *true: Var, **values: int) -> str:
        """One tick with the flags named true; returns the digits noted in it."""
        inputs = dict.fromkeys(self.interpreter.system.inputs, 0) | {v.name: 1 for v in true} | values
        if "log" in self.interpreter.data:
            self.interpreter._at["log"] = 0
        self.fired = self.interpreter.step(inputs)
        return str(self.interpreter.data.get("log", 0)).strip("0")

    def at(self, place: str = "C") -> str:
        """The active state of a chart or of a composite."""
        var_ = next(v for ch in self.interpreter.system.charts for v in ch.locations if v.name == place)
        return var_.domain.show(self.interpreter.valuation()[place])

    def __getitem__(self, name: str) -> int:
        return self.interpreter.valuation()[name]


def first_true(word: Temporal, at: Iterable[int] = range(1, 100), chart_input: Var = a) -> int:
    """The tick in which an arrow A -> B with this guard is taken, its input being true in ``at``."""
    bench = Bench(Chart("C", [State("A", transitions=[to("B", when=word)]), State("B")], default="A"))
    true = set(at)
    reads = chart_input.name in bench.interpreter.system.inputs
    for tick in range(1, 100):
        bench.tick(*([chart_input] if reads and tick in true else []))
        if bench.at() == "B":
            return tick
    raise AssertionError("never true")


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


def test_g4_arrows_in_priority_order() -> None:
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


def test_g6_an_arrow_with_an_event_needs_that_event() -> None:
    sender = State("R1", during=[when(a, [send("go", "R2")])])
    receiver = State("R2", states=[state("X", transitions=[to("Y", on="go", when=b)]), state("Y")], default="X")
    bench = Bench(Chart("C", [sender, receiver], parallel=True))
    for true, place in (((), "X"), ((b,), "X"), ((a,), "X"), ((a, b), "Y")):
        bench.tick(*true)
        if true:
            assert bench.at("C.R2") == place
    assert bench.fired == (Fired("C", ("R2", "X"), ("R2", "Y"), "go [b]", 1, "go"),)


def test_g7_backtracking_to_the_previous_point_and_to_the_next_arrow() -> None:
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
    assert bench.fired == (Fired("C", ("A",), ("B",), label, 1, None),)


def test_g9_exit_inside_out_transition_action_entry_outside_in() -> None:
    left = state("L", 0, 0, 2, states=[state("In", 0, 0, 1, transitions=[to("Deep", when=a, then=[note(3)])])],
                 default="In")  # fmt: skip
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


def test_g9_an_arrow_to_a_child_leaves_and_enters_the_superstate() -> None:
    outer = state("Out", 1, 0, 4, states=[state("In", 2, 0, 3), state("Two", 5)], default="In",
                  transitions=[to("Two", when=a)])  # fmt: skip
    bench = Bench(Chart("C", [outer], default="Out"))
    assert [bench.tick(), bench.tick(a)] == ["12", "3415"]


def test_g9_a_region_named_as_target_is_entered_with_its_siblings() -> None:
    both = state("Both", 1, 0, 9, parallel=True, states=[
        state("R1", 2, 0, 8, states=[state("X", 3, 0, 7), state("Z")], default=[to("X", when=a | ~a), to("Z")]),
        state("R2", 4, 0, 6, states=[state("Y", 9), state("W", 5, 0, 5)],
              default=[to("Y", when=b), to("W")]),
    ])  # fmt: skip
    chart = Chart("C", [state("Idle", transitions=[to("W")]), State("End"), both], default="Idle")
    with pytest.raises(ModelError, match="End"):
        Interpreter(in_order("S", chart))
    both_with_arrow = State("Both", entry=both.entry, exit=both.exit, states=both.states, parallel=True,
                            transitions=[to("Idle", when=b)])  # fmt: skip
    bench = Bench(Chart("C", [chart.root.states[0], both_with_arrow], default="Idle"))
    bench.tick()
    assert bench.tick() == "12345"
    assert bench.tick(b) == "567" + "89"


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


def test_g10_arrows_without_event_are_tested_in_a_nested_execution_too() -> None:
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


# --- data, frozen subsystems (G11, G12) -------------------------------------------------------


def test_g11_data_keep_their_value_until_written() -> None:
    bench = Bench(Chart("C", [State("A", entry=[assign(n, 3)], during=[when(a, [assign(n, n + 1)])])], default="A"))
    seen = [(bench.tick(*true), bench["n"])[1] for true in ((), (), (a,), (), (a,))]
    assert seen == [3, 3, 4, 4, 5]


def test_g11_local_data_return_to_their_initial_value_when_their_states_are_left() -> None:
    kept = var("kept", integer(0, 9), 7)
    one = State("A", entry=[assign(kept, 1)], exit=[assign(n, kept)], transitions=[to("B", when=a)])
    two = State("B", entry=[assign(kept, 2)], transitions=[to("D")])
    bench = Bench(Chart("C", [one, two, State("D", entry=[assign(n, 5)])], default="A",
                        local_to=[(kept, ["A", "B"])]))  # fmt: skip
    seen = [(bench.tick(a), bench["kept"], bench["n"])[1:] for _ in range(3)]
    assert seen == [(1, 0), (2, 1), (7, 5)]


def test_g11_a_value_outside_the_domain_is_an_error() -> None:
    chart = Chart("Counter", [State("A", during=[assign(n, n + 1)])], default="A")
    bench = Bench(chart)
    with pytest.raises(ModelError, match=r"Counter: n := 10 leaves its domain, integer in 0\.\.9"):
        for _ in range(11):
            bench.tick()


def test_g12_a_disabled_subsystem_is_frozen_and_resumes() -> None:
    count = [assign(n, minimum(n + 1, 9))]
    chart = Chart("C", [State("A", during=count, transitions=[to("B", when=after(3 * ticks))]), State("B")],
                  default="A")  # fmt: skip
    bench = Bench(Enabled(a, chart))
    seen = []
    for enabled in (1, 1, 0, 0, 1, 1):
        bench.tick(a=enabled)
        seen.append((bench.at(), bench["n"]))
    assert seen == [("A", 0), ("A", 1), ("A", 1), ("A", 1), ("A", 2), ("B", 2)]


def test_g12_the_enable_is_read_when_the_subsystem_is_reached() -> None:
    bench = Bench(Block("Gate", [assign(b, ~a)]), Enabled(b, Block("Count", [assign(n, n + 1)])))
    bench.tick(a)
    assert bench["n"] == 0
    bench.tick()
    assert bench["n"] == 1


def test_blocks_run_in_order_and_read_what_earlier_ones_wrote() -> None:
    m = var("m", integer(0, 9))
    bench = Bench(Block("One", [assign(m, n)]), Block("Two", [assign(n, minimum(m + 1, 9))]))
    bench.tick()
    bench.tick()
    assert (bench["m"], bench["n"]) == (1, 2)


# --- temporal words (G13 to G15) --------------------------------------------------------------


@pytest.mark.parametrize("span", [3 * ticks, 60 * ms])
def test_g13_after_is_first_true_n_steps_after_entry(span) -> None:
    assert first_true(after(span)) == 1 + 3


def test_g13_after_counts_no_nested_execution() -> None:
    one = State("R1", during=[send("e", "R2"), send("e", "R2")])
    two = State("R2", states=[State("P", transitions=[to("Q", when=after(3 * ticks)), to("P", on="e", when=b)]),
                              State("Q")], default="P")  # fmt: skip
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
    one = State("R1", during=[assign(b, FALSE_WHILE_SENDING), send("e", "R2"), assign(b, ~FALSE_WHILE_SENDING)])
    two = State("R2", states=[State("P", transitions=[to("Q", when=duration(b) > 1 * ticks), to("P", on="e", when=c)]),
                              State("Q")], default="P")  # fmt: skip
    bench = Bench(Chart("C", [one, two], parallel=True))
    assert [(bench.tick(), bench.at("C.R2"))[1] for _ in range(6)] == ["P"] * 6


FALSE_WHILE_SENDING = n > 9


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
    values = [(bench.tick(rx_status=2 if k in (2, 3, 4) else 0), bench["give_b2_actuation"])[1] for k in range(1, 170)]
    assert values.index(1) + 1 == 2
    assert values.index(0, 2) + 1 == 5 + 151


def test_combination_of_buttons_gives_up_after_one_second() -> None:
    button = flag("btn1")
    toggle = State("Toggle", default="Step2", states=[
        State("Step2", transitions=[to("Step3", when=rising(button)), to("Start", when=after(1 * sec))]),
        State("Step3", transitions=[to("Start", when=after(1 * sec))]),
    ])  # fmt: skip
    bench = Bench(Chart("C", [State("Start", transitions=[to("Toggle", when=rising(button))]), toggle], default="Start"))
    pressed, places = {2, 40}, []
    for k in range(1, 100):
        bench.tick(btn1=int(k in pressed))
        places.append(bench.at())
    assert places.index("Start", 2) + 1 == 40 + 50


# --- what goes in and what comes out ------------------------------------------------------------


def test_frozen_values_and_inputs_are_part_of_the_valuation() -> None:
    reading = Var("reading", boolean, 1)
    chart = Chart("C", [State("A", during=[assign(n, maximum(n, 1))], transitions=[to("A", when=reading & a)])],
                  default="A")  # fmt: skip
    interpreter = Interpreter(in_order("S", chart, frozen=[reading]), {"reading": 0})
    assert interpreter.valuation() == {"n": 0, "reading": 0, "C": 0, "C.entered": 0}
    assert interpreter.step({"a": 1})
    assert interpreter.data == {"n": 0, "reading": 0, "a": 1}


@pytest.mark.parametrize(("inputs", "message"), [
    ({}, "S: no value given for a."),
    ({"a": 2}, "a = 2 is outside boolean."),
    ({"a": 0, "aa": 0}, "'aa' is no input variable. Did you mean 'a'?"),
])  # fmt: skip
def test_inputs_must_be_those_of_the_system(inputs: dict[str, int], message: str) -> None:
    chart = Chart("C", [State("A", transitions=[to("A", when=a)])], default="A")
    with pytest.raises(ModelError) as error:
        Interpreter(in_order("S", chart)).step(inputs)
    assert str(error.value) == message


def test_locations_of_other_charts_can_be_read() -> None:
    first = Chart("First", [State("A", transitions=[to("B", when=a)]), State("B")], default="A")
    second = Chart("Second", [State("X", transitions=[to("Y", when=first.active("B"))]), State("Y")], default="X")
    bench = Bench(first, second)
    bench.tick()
    bench.tick(a)
    assert (bench.at("First"), bench.at("Second")) == ("B", "Y")
