"""Skipping quiet ticks against exact search: the same answers after the same number of ticks."""

from collections.abc import Sequence
from dataclasses import replace

import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st
from hypothesis.strategies import DrawFn

from checker.encode.counting import counters
from checker.encode.native import Layout, layout, moved_on, shifts
from checker.engine import Limits, Timers, quiet
from checker.engines import explicit
from checker.verdict import Answer, Exhausted, Open, Reached, Unreachable
from spec_model.lang.action import Assign, If
from spec_model.lang.chart import Chart, State, to
from spec_model.lang.domain import Domain, Num, integer
from spec_model.lang.expr import Expr, Var, all_of, any_of, const, flag, ite, var
from spec_model.lang.lower import lower
from spec_model.lang.system import Statement, TransitionSystem, in_order
from spec_model.lang.time import ticks
from spec_model.lang.words import after, duration, maximum, minimum
from tests.naive import replay, search
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
        case Unreachable(whole), Unreachable(part):
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


@settings(max_examples=200, suppress_health_check=list(HealthCheck))
@given(timed_systems())
def test_random_timers(system: TransitionSystem) -> None:
    wanted = goals(system)
    answers = both(system, *wanted)
    reached = search(system, wanted).reached
    for goal, answer in zip(wanted, answers, strict=True):
        found = len(answer.run) if isinstance(answer, Reached) else None
        assert found == reached.get(goal.name)


@settings(max_examples=60, suppress_health_check=list(HealthCheck))
@given(transition_systems())
def test_any_random_system(system: TransitionSystem) -> None:
    both(system, *goals(system))


@settings(max_examples=60, suppress_health_check=list(HealthCheck))
@given(timed_systems(), st.integers(1, 9))
def test_the_depth_limit(system: TransitionSystem, depth: int) -> None:
    both(system, *goals(system), limits=replace(SKIP, depth=depth))
