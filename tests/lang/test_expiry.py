"""Free expiry against exact counters: every run of a system is a run of it with free timers."""

from collections.abc import Iterator, Mapping, Sequence

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from rovercheck.spec_model.lang.chart import Chart, Junction, State, to
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.evaluate import step
from rovercheck.spec_model.lang.expiry import Counter, Expiry, free_timers
from rovercheck.spec_model.lang.expr import Var, When, flag
from rovercheck.spec_model.lang.interpret import Interpreter
from rovercheck.spec_model.lang.lower import lower
from rovercheck.spec_model.lang.lower.timers import ChartTimers
from rovercheck.spec_model.lang.system import System, in_order
from rovercheck.spec_model.lang.time import sec, ticks
from rovercheck.spec_model.lang.walk import structure
from rovercheck.spec_model.lang.words import after, duration, held
from tests.profiles import examples
from tests.strategies import frozen_values, input_blocks, systems


def drives(system: System, keep: Sequence[str]) -> Iterator[tuple[Var, str, int]]:
    """Each free input, its exact counter, and the value of that before a tick at which it is true."""
    for chart in system.charts:
        exact = ChartTimers(chart, system.step_ms)
        for counter, flags in Expiry(chart, system.step_ms, keep).flags.items():
            for least, over in flags.items():
                early = (
                    0 if counter[1] is When.DURATION else 1
                )  # the others are increased before they are read
                yield over, _exact(exact, counter, least).name, least - early


def _exact(timers: ChartTimers, counter: Counter, least: int) -> Var:
    owner, when, arg = counter
    if when is When.AFTER:
        return timers.after[owner]
    found = (timers.durations[owner] if when is When.DURATION else timers.helds).values()
    return next(
        v for w, v in found if w.arg is not None and structure(w.arg) == arg and v.domain.high == least
    )


def follow(
    system: System, keep: Sequence[str], ticks: Sequence[Mapping[str, int]], frozen: Mapping[str, int] = {}
) -> list[str]:
    """Run both with the free inputs driven by the exact counters; the free inputs that were true."""
    free = free_timers(system, keep)
    exact, loose = lower(system), lower(free)
    timers = {v.name for c in free.charts for v in ChartTimers(c, system.step_ms).variables}
    same = [v.name for v in loose.variables if v.name not in timers]
    assert {n for n in system.written if n not in frozen} <= {*same}
    one, other, used = {**exact.init, **frozen}, {**loose.init, **frozen}, list[str]()
    driven = list(drives(system, keep))
    assert {v.name for v in loose.inputs} - {v.name for v in exact.inputs} == {v.name for v, _, _ in driven}
    for number, inputs in enumerate(ticks, start=1):
        over = {v.name: int(one[counter] >= least) for v, counter, least in driven}
        used += [name for name, raw in over.items() if raw]
        one, other = step(exact, one, inputs), step(loose, other, {**inputs, **over})
        assert {n: one[n] for n in same} == {n: other[n] for n in same}, (number, over)
    return used


@settings(examples(100), suppress_health_check=list(HealthCheck))
@given(st.data())
def test_every_run_is_a_run_with_free_timers(data: st.DataObject) -> None:
    system = data.draw(systems())
    frozen = data.draw(frozen_values(system))
    states = [".".join(p) for c in system.charts for p in c.states if p]
    keep = data.draw(st.lists(st.sampled_from(states), max_size=2, unique=True))
    follow(system, keep, data.draw(input_blocks(system)), frozen)


@settings(examples(30), suppress_health_check=list(HealthCheck))
@given(st.data())
def test_both_readings_of_a_chart_with_free_timers_agree(data: st.DataObject) -> None:
    system = free_timers(data.draw(systems()))
    ticks = data.draw(input_blocks(system))
    interpreter, lowered = Interpreter(system), lower(system)
    at = {**lowered.init, **{v.name: v.init for v in system.frozen}}
    for inputs in ticks:
        interpreter.step(inputs)
        at = step(lowered, at, inputs)
        expected = interpreter.valuation()
        assert all(at[v.name] == expected[v.name] for v in lowered.variables if v.name in expected)


# --- named cases -------------------------------------------------------------------------------------

go, warm, hot = flag("go"), flag("warm"), flag("hot")


def one_chart(*states: State, junctions: Sequence[Junction] = ()) -> System:
    return in_order("timed", Chart("C", states, default=states[0].name, junctions=junctions))


TWO_LENGTHS = one_chart(
    State("A", transitions=[to("B", when=after(4 * ticks) & go), to("C", when=after(9 * ticks))]),
    State("B", transitions=[to("A", when=duration(warm) > 3 * ticks), to("B", when=hot)]),
    State("C", transitions=[to("A", when=held(warm & hot, 5 * ticks))]),
)
SHARED = one_chart(
    State("A", transitions=[to("J")]),
    State("B", transitions=[to("J"), to("A", when=after(1 * sec))]),
    junctions=[Junction("J", [to("A", when=after(2 * sec)), to("B", when=go)])],
)


def test_every_word_of_a_chart_may_be_over_at_will() -> None:
    free = free_timers(TWO_LENGTHS)
    counters = {v.name: v.domain.high for v in lower(free).variables if v.domain.high > 1}
    assert counters == {"C": 3}
    assert (free.name, free.over, free.concrete) == ("timed~free", True, "timed")
    assert "`after(4 ticks)` of A; `after(9 ticks)` of A" in free.notes[-1]


def test_free_ends_are_met_by_long_runs() -> None:
    blocks = [(1, 0, 0)] * 12 + [(0, 1, 0)] * 7 + [(0, 0, 1)] * 12 + [(0, 1, 1)] * 30 + [(1, 1, 0)] * 20
    inputs = [dict(zip(("go", "warm", "hot"), tick, strict=True)) for tick in blocks]
    assert {*follow(TWO_LENGTHS, (), inputs)} == {"C.A.over1", "C.A.over2", "C.B.over1", "C.over1"}


def test_a_longer_time_is_over_only_if_a_shorter_one_is() -> None:
    loose = lower(free_timers(TWO_LENGTHS))
    at = dict(loose.init)
    for _ in range(2):
        at = step(loose, at, {v.name: 0 for v in loose.inputs})
    at = step(loose, at, {v.name: int(v.name in ("go", "C.A.over2")) for v in loose.inputs})
    assert at["C"] == loose.var("C").domain.raw("B")


def test_nothing_is_over_in_the_step_of_entry() -> None:
    again = one_chart(State("A", transitions=[to("A", when=after(1 * sec))]))
    loose = lower(free_timers(again))
    at = step(loose, loose.init, {"C.A.over1": 1})
    assert at["C.A.after"] == 0
    assert step(loose, at, {"C.A.over1": 0})["C.A.after"] == 1
    assert step(loose, at, {"C.A.over1": 1})["C.A.after"] == 0


def test_a_word_that_two_states_share_keeps_its_counter() -> None:
    free = free_timers(SHARED)
    assert [n for n in free.inputs if "over" in n] == ["C.B.over1"]
    assert lower(free).var("C.A.after").domain.high == lower(free).var("C.B.after").domain.high == 100


def test_some_timers_may_stay_exact() -> None:
    assert [n for n in free_timers(TWO_LENGTHS, ["A"]).inputs if "over" in n] == ["C.B.over1", "C.over1"]
    assert free_timers(TWO_LENGTHS, ["C"]) is TWO_LENGTHS
    with pytest.raises(ModelError, match="has a state 'Aa' whose timer could be kept"):
        free_timers(TWO_LENGTHS, ["Aa"])


def test_short_words_have_nothing_to_be_freed_of() -> None:
    short = one_chart(State("A", transitions=[to("A", when=after(1 * ticks) & (duration(go) > 0 * ticks))]))
    assert free_timers(short) is short
