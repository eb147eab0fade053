"""What the explicit search says of the variable that multiplies its states."""

import re

import pytest

from rovercheck.checker.encode.counters import counters
from rovercheck.checker.encode.native import NativeSearch, NativeTask, layout, shifts
from rovercheck.checker.engines import Limits, Timers, explicit, quiet
from rovercheck.checker.engines.explicit.advice import Advisor
from rovercheck.checker.engines.explicit.levels import LevelSearch
from rovercheck.checker.engines.explicit.lines import LineSearch
from rovercheck.checker.results.verdict import Open
from rovercheck.checker.system.slice import sliced
from rovercheck.spec_model.lang.action import Assign
from rovercheck.spec_model.lang.chart import Chart, State, to
from rovercheck.spec_model.lang.domain import chosen, integer
from rovercheck.spec_model.lang.expr import Var, all_of, flag, ite, var
from rovercheck.spec_model.lang.lower import lower
from rovercheck.spec_model.lang.system import Statement, TransitionSystem, in_order
from rovercheck.spec_model.lang.time import ticks
from rovercheck.spec_model.lang.words import after, minimum

end = flag("end")


def searched(system: TransitionSystem) -> LevelSearch:
    part = sliced(system, [end])
    search = LevelSearch(
        NativeSearch.compile(NativeTask(part, layout(part.variables), (end,))), Limits(), None, quiet
    )
    search.run()
    return search


def multiplied(search: LevelSearch) -> tuple[str, float] | None:
    store, advisor = search.store, Advisor(search.native)
    most = advisor.multiplier(store.words, store.table, search["count"])
    return None if most is None else (most.field.var.name, most.factor)


def free(*variables: Var) -> TransitionSystem:
    """Variables that take any value at any time, and a goal about all of them."""
    inputs = tuple(Var(f"any {v.name}", v.domain, v.domain.low) for v in variables)
    step: list[Statement] = [Assign(v, i) for v, i in zip(variables, inputs, strict=True)]
    never = all_of(*(v > v.domain.high - 1 for v in variables), variables[0] < variables[0].domain.high)
    return TransitionSystem("free", inputs, (), (*variables, end), (), (Assign(end, never), *step))


@pytest.mark.parametrize("sizes", [(3, 40, 2), (90, 4, 4), (5, 6, 33)])
def test_the_largest_of_independent_variables(sizes: tuple[int, ...]) -> None:
    made = free(*(var(f"v{n}", integer(0, size - 1)) for n, size in enumerate(sizes)))
    found = multiplied(searched(made))
    assert found is not None and found[0] == f"v{sizes.index(max(sizes))}"
    assert found[1] == pytest.approx(max(sizes), rel=0.1)


def test_more_values_than_are_looked_up_one_by_one() -> None:
    found = multiplied(searched(free(var("wide", integer(0, 5000)), var("narrow", integer(0, 3)))))
    assert found is not None and found[0] == "wide" and found[1] == pytest.approx(5001, rel=0.2)


def test_a_sparse_variable() -> None:
    found = multiplied(searched(free(var("sparse", chosen([0, 7, 20])), var("narrow", integer(0, 1)))))
    assert found is not None and found[0] == "sparse" and found[1] == pytest.approx(3, rel=0.1)


def test_a_variable_that_another_one_determines_multiplies_nothing() -> None:
    a, copy = var("a", integer(0, 50)), var("copy", integer(0, 50))
    step = (Assign(end, (a == 7) & (copy == 8)), Assign(a, var("any", a.domain)), Assign(copy, a))
    system = TransitionSystem("", (var("any", a.domain),), (), (a, copy, end), (), step)
    assert multiplied(searched(system)) is None


def stopped(system: TransitionSystem, goal: Var, timers: Timers = Timers.EXACT) -> str:
    answer = explicit.check(system, [goal], Limits(memory=900 << 10, timers=timers), quiet)[goal.name]
    assert isinstance(answer, Open)
    return answer.reason


def counting(*, always: bool) -> TransitionSystem:
    """An age that restarts at any moment, and a number that changes in every tick, or only then."""
    age, level, reset = var("age", integer(0, 900)), var("level", integer(0, 200)), flag("reset")
    other = var("other", level.domain)
    step = (
        Assign(end, (age == 900) & (level == 200) & reset & ~reset),
        Assign(age, ite(reset, 1, ite(age > 0, minimum(age + 1, 900), 0))),
        Assign(level, other if always else ite(reset, other, level)),
    )
    return TransitionSystem("", (reset, other), (), (age, level, end), (), step)


def test_the_reason_names_the_limit_the_valuations_and_the_variable() -> None:
    said = re.fullmatch(
        r"the memory limit of 1 MiB is reached at ([\d,]+) states: (\w+) multiplies them by about "
        r"([\d.,]+)( \(try --timers skip\))?",
        stopped(counting(always=False), end),
    )
    assert said and int(said[1].replace(",", "")) > 10_000
    assert (said[2] == "age") == bool(said[4])


def test_skipping_is_advised_only_where_most_ticks_are_quiet() -> None:
    """It was advised wherever a counter multiplies: a monitor was then no longer decided."""
    for always in (False, True):
        search = searched(counting(always=always))
        stored = search.store.words[: search["count"]]
        wanted = "" if always else "try --timers skip"
        assert search.advisor.remedy("age", stored, memory=True) == wanted
        assert search.advisor.remedy("age", stored, memory=False) == ""
        skipped = LineSearch(lines(counting(always=always)), Limits(), None, quiet).run()
        assert (10 * skipped.states < search["count"]) == bool(wanted)


def lines(system: TransitionSystem) -> NativeSearch:
    """The search that skips quiet ticks."""
    part = sliced(system, [end])
    packing = layout(part.variables)
    return NativeSearch.compile(NativeTask(part, packing, (end,), shifts(packing, counters(part))))


def _waiting(again: Var) -> State:
    return State("Wait", transitions=[to("Wait", when=again), to("End", when=after(900 * ticks))])


def test_a_timer_of_a_chart_can_be_free() -> None:
    go = flag("go")
    end_ = State("End", transitions=[to("Wait", when=go)])
    charts = [Chart(n, (_waiting(flag(f"again {n}")), end_), default="Wait") for n in ("A", "B")]
    system = lower(in_order("timed", *charts))
    step = (*system.step, Assign(end, charts[0].active("End") & charts[1].active("End") & go & ~go))
    made = TransitionSystem(
        "timed", system.inputs, (), (*system.variables, end), system.temps, step, source=system.source
    )
    assert stopped(made, end).endswith("(try --timers free)")
    assert "--timers free" not in stopped(made, end, Timers.FREE), "it was advised to who had tried it"


def test_nothing_is_advised_that_is_done_already() -> None:
    search = searched(counting(always=False))
    stored = search.store.words[: search["count"]]
    assert Advisor(lines(counting(always=False))).remedy("age", stored, memory=True) == ""
    assert search.advisor.remedy("level", stored, memory=True) == ""
