"""The case a property speaks of: what it is for each form, and that an empty one is found out."""

from typing import Any

import pytest

from rovercheck.checker.engines import Limits
from rovercheck.checker.verify.decide import decide, tasks
from rovercheck.properties.catalogue import catalogue
from rovercheck.properties.forms import (
    Property,
    Reachable,
    always,
    enters_only_if,
    holds_after,
    holds_for,
    leads_to,
    leaves_only_if,
    never,
    precedes,
    reachable,
    recoverable,
    responds,
    settles,
    until,
)
from rovercheck.properties.premise import premise
from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Chart, State, to
from rovercheck.spec_model.lang.expr import Expr, flag, implies
from rovercheck.spec_model.lang.label import text
from rovercheck.spec_model.lang.system import in_order
from rovercheck.spec_model.lang.time import ticks

x, y, z = flag("x"), flag("y"), flag("z")
ABOUT: Any = {"covers": ["R"], "on": "toy"}

CASES = {
    "x": [
        always("P", "", that=implies(x, y), **ABOUT),
        responds("P", "", trigger=x, response=y, within=2 * ticks, **ABOUT),
        leads_to("P", "", trigger=x, response=y, **ABOUT),
        holds_for("P", "", start=x, that=y, for_=2 * ticks, **ABOUT),
        until("P", "", start=x, holds=y, release=z, **ABOUT),
        enters_only_if("P", "", entering=x, only_if=y, **ABOUT),
        precedes("P", "", first=y, then=x, **ABOUT),
        settles("P", "", premise=x, then=y, **ABOUT),
    ],
    "held(x, 2 ticks)": [holds_after("P", "", premise=x, for_=2 * ticks, then=y, **ABOUT)],
    "previous(x) && !x": [leaves_only_if("P", "", leaving=x, only_if=y, **ABOUT)],
}


@pytest.mark.parametrize(("case", "prop"), [(case, p) for case, props in CASES.items() for p in props])
def test_the_case_of_each_form(case: str, prop: Property) -> None:
    found = premise(prop)
    assert found is not None and isinstance(found.form, Reachable)
    assert text(found.form.that) == case
    assert (found.id, found.on, found.from_tick) == (prop.id, prop.on, prop.from_tick)


@pytest.mark.parametrize(
    "prop",
    [
        always("P", "", that=x, **ABOUT),
        always("P", "", that=x | y, **ABOUT),
        never("P", "", that=x, **ABOUT),
        reachable("P", "", that=x, **ABOUT),
        recoverable("P", "", to=x, **ABOUT),
    ],
)
def test_what_speaks_of_every_tick_has_no_case(prop: Property) -> None:
    assert premise(prop) is None


def test_most_properties_of_the_rover_have_one() -> None:
    cases = [case for case in map(premise, catalogue().values()) if case is not None]
    assert len(cases) > 200
    assert not any(case.costly for case in cases)


LAMP = in_order(
    "toy",
    Chart(
        "Lamp",
        [
            State("Off", entry=[assign(y, False)], transitions=[to("On", when=x)]),
            State("On", entry=[assign(y, True)], transitions=[to("Off", when=x)]),
        ],
        default="Off",
    ),
)


@pytest.mark.parametrize(("trigger", "verdict"), [(y & x, "proved"), (y & ~y, "violated")])
def test_a_case_that_never_occurs_is_found_out(trigger: Expr, verdict: str) -> None:
    case = premise(responds("P", "", trigger=trigger, response=~y, within=1 * ticks, **ABOUT))
    assert case is not None
    systems = {"toy": LAMP}
    [task] = tasks([case], systems)
    [result] = decide(task, systems, "bdd", Limits())
    assert result.verdict.word == verdict
