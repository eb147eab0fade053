"""What counts wait for: the limits of all timers of the rover, against the lowering that makes them."""

import pytest

from rovercheck.checker.render.limits import Timer, bounds, timer
from rovercheck.checker.render.story import Quiet, rows
from rovercheck.spec_model.lang.chart import Chart
from rovercheck.spec_model.lang.expr import When
from rovercheck.spec_model.lang.lower.timers import ChartTimers
from rovercheck.spec_model.rover import charts
from tests.render.zoo import long_trace, relay
from tests.traces import changed


@pytest.mark.parametrize("chart", charts().values(), ids=lambda chart: chart.name)
def test_each_timer_has_the_limit_that_it_was_made_for(chart: Chart) -> None:
    made = ChartTimers(chart, 20)
    words = {v.name: w for of in made.durations.values() for w, v in of.values()}
    words |= {v.name: w for w, v in made.helds.values()}
    after = {v.name: v for v in made.after.values()}
    variables = {v.name: v for v in made.variables}
    trace = changed(long_trace(), statecharts={chart.name: chart}, variables=variables)
    for name, word in words.items():
        found = timer(trace, name)
        assert found is not None and found.step_ms == 20
        assert found.limit == f"{'> ' if word.strict else ''}{word.span}"
    for name, counter in after.items():
        found = timer(trace, name)
        if found is None:  # it counts ticks, and is told as a number of them
            assert counter.domain.high <= 2
        else:
            assert found.shown(counter.domain.high) == found.limit
    assert all(timer(trace, v.name) is None for _, v in made.risings.values())


def test_some_charts_have_timers() -> None:
    kinds = {
        w.when
        for c in charts().values()
        for of in ChartTimers(c, 20).durations.values()
        for w, _ in of.values()
    }
    assert kinds == {When.DURATION}


def test_a_timer_is_told_as_a_time_with_its_limit() -> None:
    trace = changed(long_trace(), statecharts={"Relay": relay})
    [quiet] = [row for row in rows(trace) if isinstance(row, Quiet)]
    assert str(quiet.counters[0]) == "Relay.Theirs.duration1: 20 ms → 3 s, limit > 3 s"


def test_times_are_read_easily() -> None:
    shown = Timer(20, "3 s").shown
    assert [shown(n) for n in (0, 1, 49, 50, 51, 150)] == ["0 ms", "20 ms", "980 ms", "1 s", "1.02 s", "3 s"]


def test_numbers_have_the_bounds_of_the_guards() -> None:
    trace = changed(long_trace(), statecharts={"Relay": relay})
    assert bounds(trace)["level"] == ((5, "< 5"), (100, ">= 100"))
