"""Temporal words, conditions and data that have no meaning, and the sentence that says so."""

from collections.abc import Sequence

import pytest

from rovercheck.spec_model.lang.action import assign, send, when
from rovercheck.spec_model.lang.chart import Block, Chart, Enabled, State, to
from rovercheck.spec_model.lang.domain import enumeration, integer
from rovercheck.spec_model.lang.expr import TRUE, Temporal, Var, When, var
from rovercheck.spec_model.lang.system import System
from rovercheck.spec_model.lang.time import ms, ticks
from rovercheck.spec_model.lang.wellformed import check_chart, check_system
from rovercheck.spec_model.lang.words import after, duration, held, once, previous, rising
from tests.lang.faults import a, b, faults, kept, leaf, n, of, of_system, simple

# --- temporal words and conditions ---------------------------------------------------------------


def guarded(guard) -> list[str]:
    return of(leaf("A", to("A", when=guard)))


GUARDS: dict[str, object] = {
    "C: the guard of transition 1 of A, `n`, is an integer; write a condition, such as a comparison.": n,
    "C: the guard of transition 1 of A: `after(30 ms)`: 30 ms is not a whole number of ticks of 20 ms; "
    "write a multiple of the tick.": after(30 * ms),
    "C: the guard of transition 1 of A: `after(0 s)` is always true; remove it or give it a time.": (
        after(0 * ms)
    ),
    "C: the guard of transition 1 of A: `duration(a) >= 0 ticks` is always true; "
    "remove it or give it a time.": (
        duration(a) >= 0 * ticks
    ),
    "C: the guard of transition 1 of A: `previous(a)` belongs in properties; in a chart, "
    "keep the past in a datum.": (
        previous(a)
    ),
    "C: the guard of transition 1 of A: `once(a)` belongs in properties; in a chart, "
    "keep the past in a datum.": (
        once(a)
    ),
    "C: the guard of transition 1 of A: `duration(rising(a)) > 2 ticks` has a temporal word inside another; "
    "keep the inner one in a datum.": duration(rising(a)) > 2 * ticks,
}  # fmt: skip


@pytest.mark.parametrize("message", GUARDS)
def test_guard(message: str) -> None:
    assert message in guarded(GUARDS[message])


@pytest.mark.parametrize("word", [rising(n), held(n > 2, 3 * ticks)])
def test_rising_and_held_of_what_the_chart_writes(word) -> None:
    assert of(leaf("A", to("A", when=word), during=[assign(n, 1)])) == [
        f"C: the guard of transition 1 of A: `{word}` is read at the start of the step, but the chart itself "
        "writes n; use data of earlier components."
    ]


def test_rising_of_the_own_location() -> None:
    drawn = Chart("C", [leaf("A", to("B")), leaf("B", to("A"))], default="A")
    found = of(leaf("A", to("B", when=rising(drawn.active("A")))), leaf("B", to("A")))
    assert len(found) == 1 and "the chart itself writes C;" in found[0]


def test_words_in_actions() -> None:
    assert of(State("A", during=[when(after(2 * ticks), [assign(b, rising(a))])])) == [
        "C: the during action of A: `after(2 ticks)` belongs in a guard of a transition that leaves a state."
    ]


def test_a_condition_in_an_action() -> None:
    assert of(State("A", entry=[when(n, [])])) == [
        "C: a condition in the entry action of A, `n`, is an integer; write a condition, "
        "such as a comparison."
    ]


def test_blocks_have_actions_only() -> None:
    assert of_system(Block("F", [send("e", "A"), assign(b, rising(a))])) == [
        "F: `send(e, A)`: a block has no states to send to; use a chart.",
        "F: `rising(a)`: `rising(a)` has no meaning outside a chart; compute it in one that runs before.",
    ]


def test_enables_and_assumptions_have_no_words() -> None:
    assert of_system(Enabled(rising(a), simple()), assume=held(a, 2 * ticks)) == [
        "S: the enable `rising(a)`: `rising(a)` has no meaning outside a chart; "
        "compute it in one that runs before.",
        "S: the assumption `held(a, 2 ticks)`: `held(a, 2 ticks)` has no meaning outside a chart; "
        "compute it in one that runs before.",
    ]
    assert of_system(Enabled(n, simple())) == [
        "S: the enable `n` is an integer; write a condition, such as a comparison."
    ]


def test_the_step_is_that_of_the_system() -> None:
    def told(wait: int, step_ms: int) -> list[str]:
        chart = Chart("C", [leaf("A", to("A", when=after(wait * ms)))], default="A")
        return faults(lambda: check_system(System("S", (chart,), tick_ms=10, step_ms=step_ms)))

    assert told(30, 30) == told(30, 0) == []
    assert "40 ms is not a whole number of ticks of 30 ms" in told(40, 30)[0]
    assert told(30, 15) == [
        "S: step_ms=15 is no multiple of tick_ms=10; charts execute in ticks only, write a multiple of one."
    ]


# --- data ----------------------------------------------------------------------------------------


def local(owner: State, *others: State, owners: Sequence[str] = ("A",)) -> list[str]:
    return of(owner, *others, local_to=[(kept, owners)])


def test_local_data() -> None:
    sets = [assign(kept, 1)]
    there = leaf("B", to("A"))
    assert local(leaf("A", to("B", when=kept > 3), entry=sets, during=[assign(kept, 2)]), there) == []
    assert local(leaf("A", to("B")), there) == [
        "C: kept is local to A, whose entry action does not assign it; assign it there, "
        "so that it has a value from the start."
    ]
    assert local(
        leaf("A", to("B"), entry=sets), leaf("B", to("A", when=kept > 1), during=[assign(n, kept)])
    ) == [
        "C: the during action of B reads kept, which has a value only in A.",
        "C: the guard of transition 1 of B reads kept, which has a value only in A.",
    ]
    assert local(leaf("A", entry=sets), owners=["AA"]) == [
        "C: kept is local to an unknown state: C has no state 'AA'. Did you mean 'A'?"
    ]


def test_local_data_read_by_another_component() -> None:
    chart = Chart("C", [State("A", entry=[assign(kept, 1)])], default="A", local_to=[(kept, ["A"])])
    assert of_system(chart, Block("F", [assign(n, kept)])) == [
        "S: F reads kept, which is local to states of C; write it to an output."
    ]


def test_two_components_of_one_name() -> None:
    assert of_system(simple(), simple()) == ["S: two components are named 'C'; give each its own name."]


def test_one_name_for_two_variables() -> None:
    other = var("n", integer(0, 5))
    assert of_system(Block("F", [assign(n, 1)]), Block("G", [assign(b, other > 2)])) == [
        "S: two variables are named n: integer in 0..9 from 0 and integer in 0..5 from 0; "
        "rename one or use the same variable."
    ]


def test_frozen_data_are_not_assigned() -> None:
    assert of_system(simple("C", assign(n, 1)), frozen=[n]) == [
        "S: n is frozen and is assigned by C; drop one of the two."
    ]


def test_locations_are_not_assigned() -> None:
    place = simple().location()
    assert faults(lambda: check_chart(simple("C", assign(place, "A")))) == [
        "C: the during action of A assigns C, which says where the chart is; draw a transition instead."
    ]
    assert of_system(simple(), Block("F", [assign(place, "A")])) == [
        "S: F assigns C, which says where a chart is."
    ]


def test_locations_of_charts_that_are_not_there() -> None:
    assert of_system(simple("Relay"), Block("F", [assign(b, simple("Relais").active("A"))])) == [
        "S: F reads Relais, the active state of a chart that is not in this system. Did you mean 'Relay'?"
    ]


def test_entered_is_for_parallel_charts() -> None:
    chart = simple()
    assert of_system(chart, Block("F", [assign(b, chart.entered == "yes")])) == [
        "S: F reads C.entered; write `C != '-'`, the chart being exclusive."
    ]


def test_words_of_every_kind_are_covered() -> None:
    """Each temporal word is either allowed in guards or said to belong elsewhere."""
    for word in When:
        span = 2 * ticks if word in (When.AFTER, When.DURATION, When.HELD) else None
        found = guarded(Temporal(word, None if word is When.AFTER else a, span))
        assert bool(found) == (word in (When.PREVIOUS, When.ONCE))


def test_true_is_a_guard_and_variables_are_shared() -> None:
    mode = enumeration("Mode", ["on", "off"])
    first, second = Var("mode", mode), Var("mode", mode)
    assert of_system(Block("F", [assign(first, "on")]), Block("G", [assign(b, second == "on")])) == []
    assert guarded(TRUE) == []
