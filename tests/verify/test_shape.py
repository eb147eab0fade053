"""What counts as a wide question: what one state can hold at once, not all that is declared."""

import pytest

from rovercheck.checker.system.width import FEW, WIDE
from rovercheck.checker.verify.portfolio import PortfolioQuestion, Prior
from rovercheck.checker.verify.portfolio.order import ORDERS
from rovercheck.checker.verify.portfolio.shape import BROAD, MANY, VAST, Shape, shape
from rovercheck.spec_model.composition.motors import motors_zero
from rovercheck.spec_model.lang.chart import Chart, State, to
from rovercheck.spec_model.lang.lower import lower
from rovercheck.spec_model.lang.system import in_order
from rovercheck.spec_model.lang.time import ticks
from rovercheck.spec_model.lang.words import after
from rovercheck.spec_model.rover import systems

REGION = 100
PAIR = {"One": 0, "Two": REGION}


def region(first: int) -> list[State]:
    """States in a ring, each left after twenty ticks: five bits of a counter for each."""
    names = [f"S{first + n}" for n in range(REGION)]
    return [State(name, transitions=[to(names[n - 1], after(20 * ticks))]) for n, name in enumerate(names)]


def asked(chart: Chart) -> Shape:
    return shape(PortfolioQuestion(lower(in_order("c", chart)), tuple(chart.locations)))


def test_counters_of_states_that_are_never_active_together_do_not_make_a_question_wide() -> None:
    one = asked(Chart("C", region(0), default="S0"))
    assert (one.bits, one.at_once, one.kind) == (7 + REGION * 5, 7 + 5, "narrow")
    regions = [State(name, states=region(first), default=f"S{first}") for name, first in PAIR.items()]
    both = asked(Chart("C", regions, parallel=True))
    assert (both.bits, both.at_once) == (1 + 2 * (7 + REGION * 5), 1 + 2 * (7 + 5))


@pytest.mark.parametrize(("bits", "at_once", "kind"), [
    (BROAD, None, "narrow"), (BROAD + 1, None, "broad"), (WIDE, None, "broad"), (WIDE + 1, None, "wide"),
    (VAST + 1, None, "vast"), (VAST + 1, BROAD, "narrow"), (VAST + 1, WIDE, "broad"),
    (VAST + 1, WIDE + 1, "vast"),
])  # fmt: skip
def test_the_kind_follows_from_what_is_there_at_once(bits: int, at_once: int | None, kind: str) -> None:
    assert Shape(bits, at_once=at_once).kind == kind


@pytest.mark.parametrize(("bits", "free", "kind"), [
    (BROAD, FEW, "narrow"), (WIDE, FEW, "broad"), (VAST, FEW, "driven"), (VAST + 1, FEW, "driven"),
    (VAST, FEW + 1, "wide"),
])  # fmt: skip
def test_a_wide_valuation_with_few_free_bits_is_enumerated_first(bits: int, free: int, kind: str) -> None:
    assert Shape(bits, free=free).kind == kind
    if kind == "driven":
        assert ORDERS[kind][0].engine == "explicit"


@pytest.mark.parametrize(("bits", "free", "hint", "kind"), [
    (WIDE, MANY + 1, Prior.NONE, "broad"), (WIDE + 1, MANY, Prior.NONE, "wide"),
    (WIDE + 1, MANY + 1, Prior.NONE, "vast"), (WIDE + 1, MANY + 1, Prior.CONCRETE, "concrete"),
])  # fmt: skip
def test_a_wide_valuation_with_many_free_bits_is_not_enumerated(
    bits: int, free: int, hint: Prior, kind: str
) -> None:
    assert Shape(bits, hint, free=free).kind == kind
    assert kind != "vast" or "explicit" not in {turn.engine for turn in ORDERS[kind]}


def test_free_bits_are_those_of_inputs_that_the_goals_depend_on() -> None:
    assert shape(PortfolioQuestion(lower(systems()["weather_joystick"]), (motors_zero,))).free == 2
