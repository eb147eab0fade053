"""Random systems as charts are: locations left when a timer is over or an event comes, latches, a hold.

What is asked of them depends on many ticks in a row, which ``strategies_ts`` seldom does: some goals are
reached only after an input has been held for as long as several timers together.
"""

from hypothesis import strategies as st
from hypothesis.strategies import DrawFn

from rovercheck.spec_model.lang.action import Assign, If
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.expr import TRUE, Expr, Var, all_of, any_of, flag, ite, var
from rovercheck.spec_model.lang.system import Statement, TransitionSystem
from rovercheck.spec_model.lang.words import minimum

LONGEST = 9
"""Ticks of the longest timer."""


@st.composite
def timed_systems(draw: DrawFn) -> TransitionSystem:
    """A chart of two to four locations, a timer of the inputs and up to two goals about both."""
    inputs = [flag(f"i{n}") for n in range(draw(st.integers(1, 3)))]
    last = draw(st.integers(1, 3))
    place, since = var("place", integer(0, last)), var("since", integer(0, LONGEST))
    held, latch = var("held", integer(0, LONGEST)), flag("latch")
    weather = draw(st.sampled_from(inputs))
    step: list[Statement] = [
        Assign(held, ite(_condition(draw, inputs), minimum(held + 1, LONGEST), 0)),
        _transitions(draw, place, since, held, inputs),
        Assign(latch, (latch | _reached(draw, place, held)) & ~_condition(draw, [weather, latch])),
    ]
    wanted = [flag(f"goal{n}") for n in range(draw(st.integers(1, 2)))]
    for goal in wanted:
        parts = [_reached(draw, place, held), _reached(draw, place, since), latch, ~latch]
        step.append(Assign(goal, all_of(*draw(st.lists(st.sampled_from(parts), min_size=1, max_size=3)))))
    calm = TRUE if draw(st.integers(0, 2)) else any_of(*inputs) | (place == 0)
    own = (place, since, held, latch, *wanted)
    return TransitionSystem("timed", tuple(inputs), (), own, (), tuple(step), calm)


def _condition(draw: DrawFn, flags: list[Var]) -> Expr:
    one = draw(st.sampled_from(flags))
    return one if draw(st.booleans()) else ~one


def _reached(draw: DrawFn, place: Var, timer: Var) -> Expr:
    """That a location is active, a timer is over, or both."""
    at, over = (
        place == draw(st.sampled_from(list(place.domain.values))),
        timer >= draw(st.integers(1, LONGEST)),
    )
    return draw(st.sampled_from([at, over, at & over]))


def _transitions(draw: DrawFn, place: Var, since: Var, held: Var, inputs: list[Var]) -> Statement:
    """From each location a transition or two, the first whose guard holds; else the timer goes on."""
    stay: Statement = Assign(since, minimum(since + 1, LONGEST))
    for source in place.domain.values:
        for _ in range(draw(st.integers(1, 2))):
            guard = all_of(
                place == source,
                draw(st.sampled_from([since, held])) >= draw(st.integers(0, LONGEST)),
                *([_condition(draw, inputs)] if draw(st.booleans()) else []),
            )
            target = draw(st.sampled_from(list(place.domain.values)))
            stay = If(guard, (Assign(place, place * 0 + target), Assign(since, since * 0)), (stay,))
    return stay
