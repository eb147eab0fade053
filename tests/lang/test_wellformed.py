"""What is no chart or no system, and the sentence that says so."""

import pytest

from rovercheck.spec_model.lang.action import Action, assign, send, when
from rovercheck.spec_model.lang.chart import Chart, Junction, State, to
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.time import ms, ticks
from rovercheck.spec_model.lang.wellformed import check_chart
from rovercheck.spec_model.lang.words import after, duration, rising
from tests.lang.faults import a, faults, kept, leaf, n, of


def test_a_chart_that_uses_everything_has_no_fault() -> None:
    one = State("R1", states=[leaf("X", to("J", when=rising(a))), leaf("Y", to("X", when=after(3 * ticks)))],
                default="X", junctions=[Junction("J", [to("Y", do=[send("e", "R2")])])])  # fmt: skip
    x = leaf("X", to("R2.Y", on="e"), entry=[assign(kept, 1)], during=[assign(n, kept)])
    two = State("R2", states=[x, leaf("Y", to("R2.X", when=duration(n > 2) > 40 * ms))], default="X")
    assert of(one, two, parallel=True, local_to=[(kept, ["R2.X"])]) == []


# --- names, composites, ends of transitions ----------------------------------------------------------


def test_a_misspelt_target() -> None:
    monitor = Chart(
        "MonitorBattery",
        [leaf("Battery_ok", to("Batery_degraded")), leaf("Battery_degraded", to("Battery_ok"))],
        default="Battery_ok",
    )
    assert faults(lambda: check_chart(monitor)) == [
        "MonitorBattery: transition 1 of Battery_ok goes to 'Batery_degraded', which is no state of this "
        "chart. Did you mean 'Battery_degraded'?"
    ]


def test_all_faults_are_said_together() -> None:
    assert of(leaf("A", to("B"), to("Aa")), default="X") == [
        "C: the default transition of the chart goes to 'X', which is no state of this chart. Known: A.",
        "C: transition 1 of A goes to 'B', which is no state of this chart. Known: A.",
        "C: transition 2 of A goes to 'Aa', which is no state of this chart. Did you mean 'A'?",
    ]


def test_an_ambiguous_target() -> None:
    left = State("L", states=[leaf("X")], default="X")
    right = State("R", states=[leaf("X")], default="X")
    assert of(leaf("A", to("X"), to("L"), to("R")), left, right) == [
        "C: transition 1 of A goes to 'X', which is 2 states of this chart; write one of: L.X, R.X."
    ]


def test_a_transition_from_a_junction_and_a_default_among_several_are_pointed_at() -> None:
    found = of(leaf("A", to("J")), default=[to("Z", when=a), to("A")], junctions=[Junction("J", [to("Q")])])
    assert found == [
        "C: transition 1 of the default transitions of the chart goes to 'Z', which is no state of this "
        "chart. Known: A, J.",
        "C: transition 1 of J goes to 'Q', which is no state of this chart. Known: A, J.",
    ]


SHAPES = {
    "C: 2 states or junctions of the chart are named 'A'; names at one level must differ.": lambda: of(
        leaf("A"), leaf("A")
    ),
    "C: 2 states or junctions of A are named 'X'; names at one level must differ.": lambda: of(
        State("A", states=[leaf("X", to("X"))], junctions=[Junction("X", [to("X")])], default="X")
    ),
    "C: 'A.B' in the chart cannot be a name; write one without dots, not '-'.": lambda: of(leaf("A.B")),
    "C: a chart needs at least one state; a chart without states is a Block.": of,
    "C: the chart is parallel and has a default transition; all regions are entered, remove it.": lambda: of(
        leaf("A"), parallel=True, default="A"
    ),
    "C: A is parallel and has no regions; give it states or remove parallel=True.": lambda: of(
        State("A", parallel=True)
    ),
    "C: A has a default transition and no states; remove it.": lambda: of(State("A", default="B")),
    "C: junction J has no transitions, so that no path through it is complete; draw one.": lambda: of(
        leaf("A", to("J")), junctions=[Junction("J", [])]
    ),
    "C: A is a region of the parallel chart and has transitions; a region is left only with all its "
    "siblings: draw the transition from the composite.": lambda: of(
        leaf("A", to("B")), leaf("B"), parallel=True
    ),
}


@pytest.mark.parametrize("message", SHAPES)
def test_shape(message: str) -> None:
    assert SHAPES[message]() == [message]


def test_junction_cycle() -> None:
    junctions = [Junction("J", [to("K"), to("A")]), Junction("K", [to("J", when=a)])]
    assert of(leaf("A", to("J")), junctions=junctions) == [
        f"C: the transitions from junction {j} lead back to it without a state; break the cycle."
        for j in "JK"
    ]


# --- paths --------------------------------------------------------------------------------------


def both(*first: State, **how) -> State:
    """A parallel composite of R1, with the states given, and R2, with a state Y."""
    one = State("R1", states=first, default=first[0].name)
    return State("Both", states=[one, State("R2", states=[leaf("Y")], default="Y")], parallel=True, **how)


def composite(**how) -> State:
    return State("B", states=[leaf("X"), leaf("Z", to("X"))], **how)


PATHS = {
    "C: B is entered without naming one of its states and has no default transition; give it default=.": (
        lambda: of(leaf("A", to("B"), to("Z")), composite())
    ),
    "C: the chart is entered without naming one of its states and has no default transition; "
    "give it default=.": lambda: of(leaf("A"), default=None),
    "C: the default transitions of B all have guards, so that it may be entered with none valid; "
    "end them with one that has no guard.": lambda: of(
        leaf("A", to("B"), to("Z")), composite(default=[to("X", when=a), to("Z", when=~a)])
    ),
    "C: the default transition of B goes to A, which is not inside B.": lambda: of(
        leaf("A", to("B"), to("Z")), composite(default="A")
    ),
    "C: transition 1 of the default transitions of the chart waits for the event e, but a default path of "
    "the chart is followed at once; remove the event.": lambda: of(
        leaf("A"), default=[to("A", on="e"), to("A")]
    ),
    "C: no transition and no default transition leads to B; draw one or remove it.": lambda: of(
        leaf("A"), leaf("B", to("A"))
    ),
    "C: no transition leads to junction J; draw one or remove the junction.": lambda: of(
        leaf("A"), junctions=[Junction("J", [to("A")])]
    ),
    "C: transition 1 of X goes from X to Y across the regions of the parallel Both; regions are active "
    "together, send an event instead.": lambda: of(both(leaf("X", to("Y")))),
    "C: transition 1 of J goes from X to Y across the regions of the parallel Both; regions are active "
    "together, send an event instead.": lambda: of(
        both(leaf("X", to("J"))), junctions=[Junction("J", [to("Y")])]
    ),
}  # fmt: skip


@pytest.mark.parametrize("message", PATHS)
def test_path(message: str) -> None:
    assert PATHS[message]() == [message]


def test_after_in_a_default_path() -> None:
    inner = State("B", states=[leaf("X")], default=[to("J", when=a), to("X")],
                  junctions=[Junction("J", [to("X", when=after(2 * ticks))])])  # fmt: skip
    assert of(leaf("A", to("B")), inner) == [
        "C: the guard of transition 1 of J: `after(2 ticks)` counts from a state's entry, "
        "but a default path leaves none."
    ]


def test_a_composite_only_entered_through_a_child_needs_no_default() -> None:
    assert of(leaf("A", to("X"), to("Z")), composite()) == []


def test_a_transition_may_leave_a_parallel_composite_from_inside() -> None:
    assert of(both(leaf("X", to("Away"))), leaf("Away")) == []


# --- sends --------------------------------------------------------------------------------------


def regions(*first: Action, event: str = "e", **second) -> list[str]:
    """The faults of two regions, the first running actions, the second waiting for an event."""
    waiting = State("R2", states=[leaf("P", to("Q", on=event)), leaf("Q", to("P"), **second)], default="P")
    return of(State("R1", during=first), waiting, parallel=True)


def test_sends_between_regions_are_fine() -> None:
    assert regions(send("e", "R2")) == []
    assert regions(when(a, [], [send("e", "P")])) == []


def test_an_event_without_reaction_and_a_reaction_without_event() -> None:
    assert regions(send("f", "R2")) == [
        "C: `send(f, R2)` in the during action of R1: no transition inside R2 waits for the event f.",
        "C: transition 1 of P waits for the event e, which is never sent to P.",
    ]


def test_an_event_sent_elsewhere() -> None:
    assert regions(send("e", "Q"), event="e") == [
        "C: `send(e, Q)` in the during action of R1: no transition inside Q waits for the event e.",
        "C: transition 1 of P waits for the event e, which is never sent to P.",
    ]


def test_an_unknown_receiver() -> None:
    assert regions(send("e", "R3")) == [
        "C: `send(e, R3)` in the during action of R1 has no receiver: C has no state 'R3'. "
        "Did you mean 'R2' or 'R1'?"
    ]


def test_sends_that_recurse() -> None:
    assert regions(send("e", "R2"), during=[send("g", "R1")])[:2] == [
        "C: `send(g, R1)` in the during action of Q: no transition inside R1 waits for the event g.",
        "C: `send(e, R2)` in the during action of R1 can lead to the same send again, for ever; "
        "break the cycle of sends.",
    ]


def test_a_send_to_the_state_that_sends() -> None:
    assert of(leaf("A", to("A", on="e"), during=[send("e", "A")])) == [
        "C: `send(e, A)` in the during action of A can lead to the same send again, for ever; "
        "break the cycle of sends."
    ]


def test_a_send_that_would_leave_its_sender() -> None:
    inner = State("In", states=[leaf("P", to("Away", on="e"))], default="P")
    outer = State("Out", states=[inner], default="In", during=[send("e", "In")])
    assert of(outer, leaf("Away")) == [
        "C: `send(e, In)` in the during action of Out executes In, where transition 1 of P would leave Out "
        "in the middle of its own action."
    ]


def test_a_state_may_be_named_with_its_chart_as_traces_write_it() -> None:
    """`A.b` was refused with "Did you mean 'b'?", though messages and traces write `A.b`."""
    inner = State("D", states=[State("E")], default="E")
    chart = Chart("A", [State("B", transitions=[to("D")]), inner], default="B")
    assert chart.path("A.B") == ("B",) and chart.path("A.D.E") == chart.path("A.E") == ("D", "E")
    assert str(chart.active("A.B")) == "A == B"
    with pytest.raises(ModelError, match=r"A has no state 'X'. Known: B, D"):
        chart.active("A.X")
    with pytest.raises(ModelError, match="A has no state 'A'"):
        chart.active("A")
