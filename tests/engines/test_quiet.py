"""Skipping quiet ticks against exact search: the same answers after the same number of ticks."""

from collections.abc import Sequence
from dataclasses import replace

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from hypothesis.strategies import DrawFn

from rovercheck.checker.encode.counters import counters
from rovercheck.checker.encode.native import Layout, layout, moved_on, shifts
from rovercheck.checker.engines import Limits, Timers, explicit, quiet
from rovercheck.checker.results.verdict import Answer, Exhausted, Open, Reached, Unreachable
from rovercheck.spec_model.lang.action import Assign, If
from rovercheck.spec_model.lang.chart import Chart, State, to
from rovercheck.spec_model.lang.domain import Domain, Num, integer
from rovercheck.spec_model.lang.expr import Expr, Var, all_of, any_of, const, flag, ite, var
from rovercheck.spec_model.lang.lower import lower
from rovercheck.spec_model.lang.system import Statement, TransitionSystem, in_order
from rovercheck.spec_model.lang.time import ticks
from rovercheck.spec_model.lang.words import after, duration, maximum, minimum
from tests.naive import replay, search
from tests.profiles import examples
from tests.strategies_ts import goals, transition_systems

SKIP = Limits(timers=Timers.SKIP)


def both(system: TransitionSystem, *wanted: Var, limits: Limits = SKIP) -> list[Answer]:
    """The answers with quiet ticks skipped, after comparing them with those of exact search."""
    exact = explicit.check(system, wanted, replace(limits, timers=Timers.EXACT), quiet)
    skipped = explicit.check(system, wanted, limits, quiet)
    for goal in wanted:
        same(system, goal, exact[goal.name], skipped[goal.name])
    return [skipped[g.name] for g in wanted]


def same(system: TransitionSystem, goal: Var, one: Answer, other: Answer) -> None:
    match one, other:
        case Reached(run), Reached(again):
            assert len(run) == len(again)
            assert replay(system, again)[-1][goal.name]
        case Unreachable(Exhausted() as whole), Unreachable(Exhausted() as part):
            assert part.states <= whole.states and part.depth >= whole.depth
        case Open(reason, depth), Open(as_well, as_deep):
            assert (reason, depth) == (as_well, as_deep)
        case _:
            raise AssertionError((one, other))


def stored(answer: Answer) -> int:
    assert isinstance(answer, Unreachable) and isinstance(answer.because, Exhausted)
    assert answer.because.skipped
    return answer.because.states


# --- random systems ----------------------------------------------------------------------------------


@st.composite
def timed_systems(draw: DrawFn) -> TransitionSystem:
    """Timers of several lengths and kinds that start, stop and wait for each other at random."""
    inputs = [flag(f"i{n}") for n in range(draw(st.integers(1, 3)))]
    kinds = [draw(st.sampled_from(["age", "held", "down", "timer"])) for _ in range(draw(st.integers(1, 3)))]
    modes = [flag(f"m{n}") for n in range(draw(st.integers(0, 2)))]
    made = [_timer(draw, f"c{n}", kind, [*inputs, *modes]) for n, kind in enumerate(kinds)]
    events = [over for _, _, over in made]
    step: list[Statement] = [s for _, statements, _ in made for s in statements]
    for mode in modes:
        chosen = _condition(draw, [*inputs, *events])
        step.append(If(chosen, (Assign(mode, ~mode),)) if draw(st.booleans()) else Assign(mode, chosen))
    wanted = [flag(f"goal{n}") for n in range(2)]
    exact = [v == draw(st.integers(0, v.domain.high)) for v, _, _ in made]
    step += [Assign(g, all_of(*draw(st.lists(st.sampled_from([*exact, *events, *modes, *inputs]), min_size=1,
                                             max_size=4, unique_by=id)))) for g in wanted]  # fmt: skip
    variables = (*(v for v, _, _ in made), *modes, *wanted)
    return TransitionSystem("timed", tuple(inputs), (), variables, (), tuple(step))


def _condition(draw: DrawFn, scope: Sequence[Expr]) -> Expr:
    parts = draw(st.lists(st.sampled_from(scope), min_size=1, max_size=2, unique_by=id))
    return draw(st.sampled_from([all_of, any_of]))(*(~p if draw(st.booleans()) else p for p in parts))


def _timer(draw: DrawFn, name: str, kind: str, scope: Sequence[Expr]) -> tuple[Var, list[Statement], Expr]:
    """A counter, what a tick does with it, and the condition that its time is over."""
    by, top = draw(st.sampled_from([1, 1, 1, 2, 20])), draw(st.integers(1, 12))
    c = Var(name, Domain(Num(), range(0, by * top + 1, by)))
    runs = _condition(draw, scope)
    onward, full = minimum(c + by, by * top), c >= by * top
    match kind:
        case "age":
            return c, [Assign(c, ite(runs, const(0), onward))], full
        case "held":
            return c, [Assign(c, ite(runs, onward, const(0)))], full
        case "down":
            return c, [Assign(c, ite(runs, const(by * top), maximum(c - by, 0)))], c == 0
        case _:
            stops = _condition(draw, [*scope, full])
            return c, [If((c > 0) | runs, (Assign(c, onward),)), If(stops, (Assign(c, const(0)),))], full


@settings(examples(60), suppress_health_check=list(HealthCheck))
@given(timed_systems())
def test_random_timers(system: TransitionSystem) -> None:
    wanted = goals(system)
    answers = both(system, *wanted)
    reached = search(system, wanted).reached
    for goal, answer in zip(wanted, answers, strict=True):
        found = len(answer.run) if isinstance(answer, Reached) else None
        assert found == reached.get(goal.name)


@settings(examples(20), suppress_health_check=list(HealthCheck))
@given(transition_systems())
def test_any_random_system(system: TransitionSystem) -> None:
    both(system, *goals(system))


@settings(examples(20), suppress_health_check=list(HealthCheck))
@given(timed_systems(), st.integers(1, 9))
def test_the_depth_limit(system: TransitionSystem, depth: int) -> None:
    both(system, *goals(system), limits=replace(SKIP, depth=depth))


# --- named cases -------------------------------------------------------------------------------------

go, stop = flag("go"), flag("stop")
goal, never = flag("goal"), flag("never")


def timed(*states: State, reaches: str = "End") -> tuple[TransitionSystem, Var, Var]:
    """A chart, whether it is in a state, and whether it is nowhere."""
    chart = Chart("C", states, default=states[0].name)
    system = lower(in_order("timed", chart))
    step = (*system.step, Assign(goal, chart.active(reaches)), Assign(never, ~any_of(chart.active_path(()))))
    return replace(system, variables=(*system.variables, goal, never), step=step), goal, never


def test_a_chain_of_quiet_ticks_is_stored_once() -> None:
    wait = State("Wait", transitions=[to("End", when=after(100 * ticks))])
    answers = both(*timed(wait, State("End")))
    assert isinstance(answers[0], Reached) and len(answers[0].run) == 101
    assert stored(both(*_without_goal(timed(wait, State("End"))))[0]) < 8


def _without_goal(made: tuple[TransitionSystem, Var, Var]) -> tuple[TransitionSystem, Var]:
    return made[0], made[2]


def test_a_timer_restarted_by_a_loop_is_quiet_again() -> None:
    again = State("Wait", transitions=[to("Wait", when=go), to("End", when=after(30 * ticks))])
    made = timed(again, State("End", transitions=[to("Wait", when=stop)]))
    answers = both(*made)
    assert isinstance(answers[0], Reached) and len(answers[0].run) == 31
    assert stored(both(*_without_goal(made))[0]) < 10


def test_a_duration_that_is_interrupted() -> None:
    still = State("Still", transitions=[to("End", when=duration(go) > 40 * ticks)])
    made = timed(still, State("End"))
    answers = both(*made)
    assert isinstance(answers[0], Reached) and len(answers[0].run) == 42
    assert stored(both(*_without_goal(made))[0]) < 10


def two_ages(longest: int, other: int) -> TransitionSystem:
    """Two ages that start at different times and stay at their ends, and the goals that they differ."""
    a, b = var("a", integer(0, longest)), var("b", integer(0, other))
    step = (
        If((a > 0) | go, (Assign(a, minimum(a + 1, longest)),)),
        If((b > 0) | stop, (Assign(b, minimum(b + 1, other)),)),
        Assign(goal, (a == longest) & (b == other - 2)),
        Assign(never, (a == longest) & (b > other)),
    )
    return TransitionSystem("", (go, stop), (), (a, b, goal, never), (), step)


def test_two_timers_started_at_different_times() -> None:
    reached, unreachable = both(two_ages(30, 20), goal, never)
    assert isinstance(reached, Reached) and len(reached.run) == 30
    exact = explicit.check(two_ages(30, 20), [never], Limits(), quiet)["never"]
    assert isinstance(exact, Unreachable) and isinstance(exact.because, Exhausted)
    assert stored(unreachable) < exact.because.states / 4


def test_saturated_timers_stay_where_they_are() -> None:
    system = two_ages(3, 4)
    (answer,) = both(system, never)
    assert isinstance(answer, Unreachable) and isinstance(answer.because, Exhausted)
    assert answer.because.depth >= 5


def test_an_event_in_the_middle_of_a_line_is_found_in_time() -> None:
    """The goal needs an input on the ninth quiet tick: neither an anchor nor the end of a line."""
    a = var("a", integer(0, 50))
    step = (Assign(goal, go & (a == 9)), Assign(a, minimum(a + 1, 50)))
    system = TransitionSystem("", (go,), (), (a, goal), (), step)
    (answer,) = both(system, goal)
    assert isinstance(answer, Reached) and [tick["go"] for tick in answer.run.inputs][-1] == 1
    assert len(answer.run) == 10


def test_a_line_that_meets_an_anchor_ends_there() -> None:
    """A state may be reached by an event first and by quiet ticks later, or the other way round."""
    a, jumped = var("a", integer(0, 40)), flag("jumped")
    step = (
        Assign(jumped, go),
        Assign(a, ite((a > 0) & go & (a < 20), a + 10, minimum(a + 1, 40))),
        Assign(goal, (a == 37) & stop),
        Assign(never, (a == 40) & jumped & (a < 40)),
    )
    both(TransitionSystem("", (go, stop), (), (a, jumped, goal, never), (), step), goal, never)


# --- what counts -------------------------------------------------------------------------------------


def test_counters_are_found_by_the_shape_of_their_assignments() -> None:
    up, down, both_ways, plain = (var(n, integer(0, 9)) for n in ("up", "down", "both_ways", "plain"))
    step: tuple[Statement, ...] = (
        If(go, (Assign(up, ite(stop, minimum(up + 2, 9), const(0))),)),
        Assign(down, maximum(down - 1, 0)),
        Assign(both_ways, ite(go, minimum(both_ways + 1, 9), maximum(both_ways - 1, 0))),
        Assign(plain, up),
    )
    system = TransitionSystem("", (go, stop), (), (up, down, both_ways, plain), (), step)
    assert [(c.var.name, c.by) for c in counters(system)] == [("up", 2), ("down", -1)]
    packing: Layout = layout(system.variables)
    assert len(shifts(packing, counters(system))) == 2


@pytest.mark.parametrize(
    ("before", "then"),
    [((3, 5), (4, 4)), ((0, 5), (0, 4)), ((9, 5), (9, 4)), ((0, 0), None), ((8, 5), None), ((3, 1), None)],
)
def test_where_a_quiet_tick_leads(before: tuple[int, int], then: tuple[int, int] | None) -> None:
    up, down = var("up", integer(0, 9)), var("down", integer(0, 9))
    step = (Assign(up, minimum(up + 1, 9)), Assign(down, maximum(down - 1, 0)))
    packing = layout((up, down))
    moving = shifts(packing, counters(TransitionSystem("", (), (), (up, down), (), step)))
    after_it = moved_on(packing.pack(dict(zip(("up", "down"), before, strict=True))), moving)
    expected = None if then is None else packing.pack(dict(zip(("up", "down"), then, strict=True)))
    assert after_it == expected
