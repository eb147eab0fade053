"""Data, frozen subsystems, inputs and states of the reference interpreter (rules G11 and G12)."""

import pytest

from rovercheck.spec_model.lang.action import assign, when
from rovercheck.spec_model.lang.chart import Block, Chart, Enabled, State, to
from rovercheck.spec_model.lang.domain import boolean, integer
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import Var, var
from rovercheck.spec_model.lang.interpret import Interpreter
from rovercheck.spec_model.lang.system import in_order
from rovercheck.spec_model.lang.time import ticks
from rovercheck.spec_model.lang.words import after, maximum, minimum
from tests.lang.bench import Bench, a, b, n

# --- data, frozen subsystems (G11, G12) -------------------------------------------------------


def test_g11_data_keep_their_value_until_written() -> None:
    bench = Bench(
        Chart("C", [State("A", entry=[assign(n, 3)], during=[when(a, [assign(n, n + 1)])])], default="A")
    )
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


# --- what goes in and what comes out ------------------------------------------------------------


def test_frozen_values_and_inputs_are_part_of_the_valuation() -> None:
    interpretation = Var("reading", boolean, 1)
    loop = State("A", during=[assign(n, maximum(n, 1))], transitions=[to("A", when=interpretation & a)])
    chart = Chart("C", [loop], default="A")
    interpreter = Interpreter(in_order("S", chart, frozen=[interpretation]), {"reading": 0})
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
    second = Chart(
        "Second", [State("X", transitions=[to("Y", when=first.active("B"))]), State("Y")], default="X"
    )
    bench = Bench(first, second)
    bench.tick()
    bench.tick(a)
    assert (bench.at("First"), bench.at("Second")) == ("B", "Y")
