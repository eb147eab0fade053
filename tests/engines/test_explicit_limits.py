"""The limits of the explicit engine: a search that meets one says so, and claims no more than it saw."""

from functools import partial

import pytest

from rovercheck.checker.engines import Limits, Timers, explicit
from rovercheck.checker.engines.explicit import levels, store
from rovercheck.checker.results.verdict import Exhausted, Open, Reached
from rovercheck.spec_model.lang.action import Assign, If
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import TRUE, Var, all_of, const, flag, ite, var
from rovercheck.spec_model.lang.system import TransitionSystem
from rovercheck.spec_model.lang.words import minimum
from tests.engines.test_explicit import UNLIMITED, check, exhausted


def counters(*sizes: int) -> tuple[TransitionSystem, Var]:
    """Counters that an input each lets go on, and a goal: all of them at their ends."""
    steps, own, inputs = [], [], []
    for i, size in enumerate(sizes):
        go, count = flag(f"go{i}"), var(f"count{i}", integer(0, size))
        steps.append(If(go, (Assign(count, ite(count == size, count, count + 1)),)))
        own.append(count)
        inputs.append(go)
    end = flag("end")
    steps.append(If(all_of(*(c == n for c, n in zip(own, sizes, strict=True))), (Assign(end, TRUE),)))
    return TransitionSystem("counters", tuple(inputs), (), (*own, end), (), tuple(steps)), end


def test_a_depth_limit_leaves_the_goal_open() -> None:
    system, end = counters(9)
    assert isinstance(check(system, end, limits=Limits(depth=9))[0], Reached)
    answer = check(system, end, limits=Limits(depth=8))[0]
    assert answer == Open("the depth limit of 8 ticks", 8)


def test_a_memory_limit_leaves_the_goal_open() -> None:
    system, end = counters(400, 400, 400)
    answer = check(system, end, limits=Limits(memory=3 << 20))[0]
    assert isinstance(answer, Open) and "memory" in answer.reason
    assert 5 < answer.depth < 400


def test_a_time_limit_leaves_the_goal_open() -> None:
    system, end = counters(2000, 2000, 2000)
    answer = check(system, end, limits=Limits(seconds=0.3))[0]
    assert isinstance(answer, Open) and "time" in answer.reason
    assert answer.depth < 6000


def test_the_time_ends_in_the_middle_of_a_tick_with_very_many_inputs() -> None:
    many = tuple(var(f"i{k}", integer(0, 9)) for k in range(12))
    kept = tuple(var(f"k{k}", integer(0, 9)) for k in range(12))
    end = flag("end")
    step = (Assign(end, all_of(*(k == 9 for k in kept))), *map(Assign, kept, many))
    system = TransitionSystem("many", many, (), (*kept, end), (), step)
    answer = check(system, end, limits=Limits(seconds=0))[0]
    assert isinstance(answer, Open) and answer.depth == 0
    assert answer.reason.startswith("the time limit of 0 s is reached at ")


def test_a_memory_limit_is_kept_while_the_choices_of_frozen_variables_are_stored() -> None:
    tag, never = var("tag", integer(0, 200_000)), flag("never")
    system = TransitionSystem("frozen", (), (tag,), (never,), (), (Assign(never, tag < 0),))
    (answer,) = check(system, never, limits=Limits(memory=1 << 20))
    assert isinstance(answer, Open) and answer.depth == 0
    assert answer.reason.startswith("the memory limit of 1 MiB is reached at ")


def test_a_time_limit_is_kept_while_the_choices_of_frozen_variables_are_stored() -> None:
    tag, never = var("tag", integer(0, 200_000)), flag("never")
    system = TransitionSystem("frozen", (), (tag,), (never,), (), (Assign(never, tag < 0),))
    (answer,) = check(system, never, limits=Limits(seconds=0))
    assert isinstance(answer, Open) and answer.reason.startswith("the time limit of 0 s is reached at 2,048 ")


def apart(last: int) -> tuple[TransitionSystem, tuple[Var, ...]]:
    """Three counters with nothing in common, so that each of the goals has a search of its own."""
    counts = [var(f"count{n}", integer(0, last)) for n in range(3)]
    never = tuple(flag(f"never{n}") for n in range(3))
    step = (
        *(Assign(c, ite(c == last, 0, c + 1)) for c in counts),
        *(Assign(g, c > last) for g, c in zip(never, counts, strict=True)),
    )
    return TransitionSystem("apart", (), (), (*counts, *never), (), step), never


def test_a_limit_of_transitions_is_for_all_searches_together() -> None:
    system, never = apart(5000)
    first, *others = check(system, *never, limits=Limits(transitions=6000))
    assert exhausted(first).states == 5001
    for answer in others:
        assert isinstance(answer, Open) and answer.depth < 5000
        assert answer.reason.startswith("the limit of 6,000 transitions is reached at ")


def test_a_memory_limit_is_for_all_searches_together() -> None:
    """The closed set of the first search is kept, so that less is left for the others."""
    system, never = apart(120_000)
    first, *others = check(system, *never, limits=Limits(memory=5 << 19))
    assert exhausted(first).states == 120_001
    for answer in others:
        assert isinstance(answer, Open) and 0 < answer.depth < 120_000
        assert answer.reason.startswith("the memory limit of 2 MiB is reached at ")


def test_a_time_limit_is_for_all_searches_together() -> None:
    system, never = apart(5000)
    for answer in check(system, *never, limits=Limits(seconds=0))[1:]:
        assert answer == Open("the time limit of 0 s is reached before it is searched for", 0)


def test_no_more_valuations_than_have_numbers(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(levels, "StateStore", partial(store.StateStore, most=1000))
    system, end = counters(50, 50)
    (answer,) = check(system, end)
    assert isinstance(answer, Open)
    assert " can number, 1,000, is reached at 1,000 states" in answer.reason


def test_a_goal_that_the_system_does_not_write_is_refused() -> None:
    """An input has no value after a tick: whatever was said of it would be a guess."""
    go, seen = flag("go"), flag("seen")
    system = TransitionSystem("inputs", (go,), (), (seen,), (), (Assign(seen, go),))
    for goal in (go, flag("unknown")):
        with pytest.raises(ModelError, match=f"{goal.name} is no variable of inputs"):
            check(system, goal)


def summed(*, forbidden: bool) -> tuple[TransitionSystem, Var]:
    """A counter beside more inputs than can be tried: their sum is asked for, or assumed, out of reach."""
    many = tuple(var(f"i{k}", integer(0, 9)) for k in range(12))
    count, never = var("count", integer(0, 9), init=1), flag("never")
    beyond = sum(many, start=const(0)) > 200
    step = (Assign(count, minimum(count + 1, 9)), Assign(never, (count > 9) if forbidden else beyond))
    return TransitionSystem("sum", many, (), (count, never), (), step, beyond if forbidden else TRUE), never


@pytest.mark.parametrize(("forbidden", "timers"), [(True, Timers.EXACT), (False, Timers.SKIP)])
def test_the_time_ends_in_the_middle_of_a_tick_that_leads_to_nothing_to_store(
    forbidden: bool, timers: Timers
) -> None:
    system, never = summed(forbidden=forbidden)
    (answer,) = check(system, never, limits=Limits(seconds=0, timers=timers))
    assert isinstance(answer, Open) and answer.depth == 0
    assert answer.reason.startswith("the time limit of 0 s is reached at 1 states")


def test_the_store_grows_and_forgets_nothing() -> None:
    system, end = counters(60, 60, 60)
    never = flag("never")
    whole = TransitionSystem(
        "", system.inputs, (), (*system.variables, never), (), (*system.step, Assign(never, end & ~end))
    )
    (answer,) = check(whole, never)
    found = exhausted(answer)
    assert found == Exhausted(61**3, found.transitions, 60, found.variables)


def test_progress_is_reported() -> None:
    lines: list[str] = []
    system, end = counters(150, 150, 150)
    explicit.check(system, [end], UNLIMITED, lines.append)
    assert lines and all(line.startswith("explicit: ") for line in lines)
