"""Trying with free timers first: what may be kept of it, and what must be searched exactly."""

from dataclasses import replace

import pytest

from rovercheck.checker.engines import Limits, Timers
from rovercheck.checker.results.trace import Trace
from rovercheck.checker.results.verdict import Exhausted, Proved, Violated
from rovercheck.checker.verify.checked import length
from rovercheck.checker.verify.decide import Task, decide
from rovercheck.checker.verify.result import Result
from rovercheck.properties.forms import Never, Property, Reachable
from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Chart, State, to
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expiry import free_timers
from rovercheck.spec_model.lang.expr import Expr, flag, var
from rovercheck.spec_model.lang.system import System, in_order
from rovercheck.spec_model.lang.time import ticks
from rovercheck.spec_model.lang.words import after, minimum

go, late = flag("go"), var("late", integer(0, 9))
CHART = Chart("C", [
    State("A", transitions=[to("B", when=go), to("D", when=after(40 * ticks) & (late > 8))]),
    State("B", during=[assign(late, minimum(late + 1, 9))], transitions=[to("A", when=after(20 * ticks))]),
    State("D", transitions=[to("Never", when=late < 8)]),
    State("Never", transitions=[to("A", when=go)]),
], default="A")  # fmt: skip
COUNTED = in_order("counted", CHART)
EXACT = Limits()


def decided(system: System, that: Expr, timers: Timers, form: type[Never | Reachable] = Never) -> Result:
    prop = Property("P", "Sentence.", form(that), ("R",), system.name)
    task = Task(system, (prop,))
    [found] = decide(task, {system.name: system}, "explicit", replace(EXACT, timers=timers))
    assert found.property == prop
    return found


def test_what_is_proved_with_free_timers_is_proved() -> None:
    found = decided(COUNTED, CHART.active("Never"), Timers.FREE)
    assert isinstance(found.verdict, Proved) and found.system == "counted~free"
    exact = decided(COUNTED, CHART.active("Never"), Timers.EXACT)
    assert isinstance(found.verdict.because, Exhausted)
    assert isinstance(exact.verdict, Proved) and isinstance(exact.verdict.because, Exhausted)
    assert found.verdict.because.states < exact.verdict.because.states / 2


def test_a_run_with_free_timers_counts_if_the_system_has_it() -> None:
    found = decided(COUNTED, CHART.active("B"), Timers.FREE)
    assert isinstance(found.verdict, Violated) and found.system == "counted"
    assert isinstance(found.verdict.because, Trace) and len(found.verdict.because) == 2


@pytest.mark.parametrize("place", ["A", "D"])
def test_a_run_that_only_free_timers_have_is_no_verdict(place: str) -> None:
    """B may be left at once with a free timer: late < 5 in A, and D without waiting."""
    wanted = CHART.active(place) & (late > 0) & (late < 5) if place == "A" else CHART.active(place)
    free, exact = (decided(COUNTED, wanted, t) for t in (Timers.FREE, Timers.EXACT))
    assert free.verdict.word == exact.verdict.word
    assert length(free.verdict) == length(exact.verdict)
    assert free.system == "counted"


@pytest.mark.parametrize("timers", Timers)
@pytest.mark.parametrize("form", [Never, Reachable])
def test_verdicts_do_not_depend_on_how_timers_are_searched(
    timers: Timers, form: type[Never | Reachable]
) -> None:
    for that in (CHART.active("D"), CHART.active("Never"), CHART.active("A") & (late > 3)):
        one, other = decided(COUNTED, that, timers, form), decided(COUNTED, that, Timers.EXACT, form)
        assert one.verdict.word == other.verdict.word
        assert length(one.verdict) == length(other.verdict)


def test_a_value_that_leaves_its_domain_only_with_free_timers_is_no_error() -> None:
    """The count of what is left fits because A waits four ticks; with a free timer it need not."""
    count, age = var("count", integer(0, 2)), var("age", integer(0, 12))
    busy = State("A", during=[assign(age, minimum(age + 1, 12))], transitions=[
        to("B", when=after(4 * ticks), do=[assign(count, 12 - age)]),
    ])  # fmt: skip
    start = State("Start", transitions=[to("A", when=after(9 * ticks) & go, do=[assign(age, 9)])])
    chart = Chart("C", [start, busy, State("B")], default="Start")
    system = in_order("narrow", chart)
    with pytest.raises(ModelError, match="narrow~free"):
        decided(free_timers(system), chart.active("B"), Timers.EXACT)
    for timers in Timers:
        found = decided(system, chart.active("B"), timers)
        assert isinstance(found.verdict, Violated) and found.system == "narrow"
