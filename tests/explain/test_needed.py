"""The inputs that force the end of a run, against all runs of small systems."""

from collections.abc import Sequence
from dataclasses import replace
from itertools import combinations

import pytest
from hypothesis import assume, given

from rovercheck.checker.engines.bdd.space import DDMemoryError, Overdrawn
from rovercheck.checker.explain import backwards, fewest, necessary_inputs
from rovercheck.checker.explain.explanation import check
from rovercheck.checker.explain.necessary_inputs import forcing
from rovercheck.checker.explain.unrolled_run import OutOfTime, Unrolled
from rovercheck.checker.results.trace import NecessaryInputs, Needed
from rovercheck.checker.results.verdict import Run
from rovercheck.checker.verify.runs.replay import ReplayError
from rovercheck.spec_model.lang.action import Assign
from rovercheck.spec_model.lang.domain import chosen, integer
from rovercheck.spec_model.lang.evaluate import admissible, step
from rovercheck.spec_model.lang.expr import Var, flag, ite, var
from rovercheck.spec_model.lang.system import TransitionSystem
from rovercheck.spec_model.lang.words import minimum
from tests.naive import vectors
from tests.profiles import examples
from tests.strategies_ts import goals, transition_systems
from tests.toys import GOAL, counter, filling, once

Allowed = dict[int, dict[str, frozenset[int]]]


def ends(system: TransitionSystem, goal: Var, run: Run, those: Sequence[Needed]) -> set[int]:
    """Whether the goal is true after the last tick, for all runs with the needed inputs."""
    at = [{**system.init, **run.frozen}]
    for number in range(1, len(run) + 1):
        allowed = {n.name: n.values for n in those if n.number == number}
        given = [i for i in vectors(system.inputs) if all(i[n] in of for n, of in allowed.items())]
        found = [step(system, state, i) for state in at for i in given if admissible(system, state, i)]
        at = list({tuple(sorted(state.items())): state for state in found}.values())
    return {state[goal.name] for state in at}


def some_run(system: TransitionSystem, goal: Var, most: int) -> Run | None:
    """A run to the goal, of the most ticks up to ``most``."""
    found: Run | None = None
    for frozen in vectors(system.frozen):
        layer: dict[tuple[tuple[str, int], ...], tuple[dict[str, int], Run]] = {
            (): ({**system.init, **frozen}, Run(frozen, ()))
        }
        for _ in range(most):
            following: dict[tuple[tuple[str, int], ...], tuple[dict[str, int], Run]] = {}
            for at, run in layer.values():
                for inputs in vectors(system.inputs):
                    if admissible(system, at, inputs):
                        after = step(system, at, inputs)
                        longer = Run(frozen, (*run.inputs, inputs))
                        found = longer if after[goal.name] else found
                        following[tuple(sorted(after.items()))] = after, longer
            layer = following
    return found


@examples(40)
@given(transition_systems(most=2))
def test_what_is_needed_forces_the_end_and_nothing_of_it_can_be_left_out(system: TransitionSystem) -> None:
    goal = goals(system)[0]
    run = some_run(system, goal, 3)
    assume(run is not None)
    assert run is not None
    for large in (necessary_inputs.LARGE, 0):  # a short run is gone through backwards, too
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(necessary_inputs, "LARGE", large)
            found = forcing(system, goal, run)
            judge(system, goal, run, found)
            assert found.smallest or not large, "so few inputs are all tried"


def judge(system: TransitionSystem, goal: Var, run: Run, found: NecessaryInputs) -> None:
    """The needed inputs against all runs."""
    assert found.minimal
    assert ends(system, goal, run, found.needed) == {1}
    assert all(run.inputs[n.number - 1][n.name] in n.values for n in found.needed)
    for one in found.needed:
        others = [n for n in found.needed if n is not one]
        assert 0 in ends(system, goal, run, others), f"{one} is not needed"
    if found.smallest and found.needed:
        own = [Needed(t, n, frozenset({v})) for t, at in enumerate(run.inputs, 1) for n, v in at.items()]
        for fewer in combinations(own, len(found.needed) - 1):
            assert 0 in ends(system, goal, run, fewer), f"{fewer} are enough"
    check(system, goal, run, found)


@pytest.fixture(params=["unrolled", "backwards"])
def way(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """Both ways, whatever the size of the run."""
    if request.param == "backwards":
        monkeypatch.setattr(necessary_inputs, "LARGE", 0)
        monkeypatch.setattr(necessary_inputs, "Unrolled", None)


both_ways = pytest.mark.usefixtures("way")


def held(ticks: int, before: int = 0) -> Run:
    """Not held for some ticks, then held."""
    return Run({}, ({"hold": 0},) * before + ({"hold": 1},) * ticks)


def told(found: NecessaryInputs) -> dict[tuple[int, str], list[int]]:
    return {(n.number, n.name): sorted(n.values) for n in found.needed}


@both_ways
def test_only_the_last_ticks_count() -> None:
    system = counter(3, top=3)
    found = forcing(system, GOAL, held(3, before=4))
    assert told(found) == {(k, "hold"): [1] for k in (5, 6, 7)} and found.minimal


@both_ways
def test_an_input_that_must_not_come_too_early_is_needed_too() -> None:
    system = counter(2, top=5)  # held for exactly two ticks
    assert told(forcing(system, GOAL, held(2, before=2))) == {
        (2, "hold"): [0],
        (3, "hold"): [1],
        (4, "hold"): [1],
    }


@both_ways
def test_an_end_that_nothing_avoids_needs_nothing() -> None:
    found = forcing(once(), GOAL, Run({}, ({}, {})))
    assert found == NecessaryInputs((), True, True)


def either() -> tuple[TransitionSystem, Run]:
    """Two inputs together lead to the goal, and so does a third one, which is true like them."""
    a, b, c = flag("a"), flag("b"), flag("c")
    system = TransitionSystem("either", (a, b, c), (), (GOAL,), (), (Assign(GOAL, (a & b) | c),))
    return system, Run({}, ({"a": 1, "b": 1, "c": 1},))


def test_of_two_sets_it_is_the_smaller_one() -> None:
    system, run = either()
    found = forcing(system, GOAL, run)
    assert told(found) == {(1, "c"): [1]} and found.smallest


def test_a_set_that_need_not_be_the_smallest_is_not_called_so(monkeypatch: pytest.MonkeyPatch) -> None:
    system, run = either()
    monkeypatch.setattr(fewest, "ROUNDS", 0)
    assert not forcing(system, GOAL, run).smallest
    monkeypatch.setattr(necessary_inputs, "LARGE", 0)
    assert not forcing(system, GOAL, run).smallest, "gone through backwards, only what has no other is"


@both_ways
def test_a_set_without_another_is_the_smallest() -> None:
    assert forcing(counter(3, top=3), GOAL, held(3, before=4)).smallest


def test_another_number_of_times_is_the_smallest_too() -> None:
    system, run = counter(2, top=2), held(6)
    found = forcing(system, GOAL, run)
    assert len(found.needed) == 2 and found.smallest


def many(runs: int) -> tuple[TransitionSystem, Run]:
    """Two measurements together are high enough, after some ticks."""
    level, last = var("level", integer(0, 4000)), var("last", integer(0, 4000))
    count = var("count", integer(0, runs))
    step = (
        Assign(count, minimum(count + 1, runs)),
        Assign(GOAL, (level + last >= 5000) & (count >= runs)),
        Assign(last, level),
    )
    system = TransitionSystem("many", (level,), (), (count, last, GOAL), (), step)
    return system, Run({}, ({"level": 2600},) * runs)


@both_ways
def test_thousands_of_values_are_no_harder() -> None:
    system, run = many(3)
    found = forcing(system, GOAL, run)
    assert [(n.number, n.name) for n in found.needed] == [(2, "level"), (3, "level")] and found.smallest


@both_ways
def test_a_run_that_leaves_a_domain_avoids_the_end_whatever_its_bits_are_then() -> None:
    x, i = var("x", integer(0, 3)), var("i", integer(0, 3))
    step = (Assign(GOAL, x < 4), Assign(x, ite(i == 3, 5, 0)))
    system = TransitionSystem("leaving", (i,), (), (x, GOAL), (), step, assume=x != 1)
    run = Run({}, ({"i": 0}, {"i": 0}))
    assert {(1, "i")} <= told(forcing(system, GOAL, run)).keys()


def test_a_solver_that_gives_up_claims_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    system, run = either()
    monkeypatch.setattr(fewest._Meeting, "few", lambda *_: None)
    found = forcing(system, GOAL, run)
    assert found.minimal and not found.smallest


def sensor(low: int, high: int) -> TransitionSystem:
    """The goal: a measurement within bounds after one below them, whatever the noise."""
    level, noise, low_before = var("level", integer(-50, 300)), flag("noise"), flag("low_before")
    step = (
        Assign(GOAL, low_before & (level >= low) & (level <= high)),
        Assign(low_before, level < low),
    )
    return TransitionSystem("sensor", (level, noise), (), (low_before, GOAL), (), step)


@both_ways
def test_values_are_widened_to_the_whole_interval() -> None:
    run = Run({}, ({"level": 0, "noise": 0}, {"level": 90, "noise": 1}))
    found = told(forcing(sensor(70, 120), GOAL, run))
    assert found == {(1, "level"): list(range(-50, 70)), (2, "level"): list(range(70, 121))}


def copying() -> TransitionSystem:
    """Every value of the input is a case of its own, as it is stored; the sum of two must reach 100."""
    level, last = var("level", integer(0, 200)), var("last", integer(0, 200))
    step = (Assign(GOAL, level + last >= 100), Assign(last, level))
    return TransitionSystem("copying", (level,), (), (last, GOAL), (), step)


@both_ways
def test_intervals_are_found_by_bisection_where_values_are_many() -> None:
    found = told(forcing(copying(), GOAL, Run({}, ({"level": 60}, {"level": 50}))))
    first, second = found[1, "level"], found[2, "level"]
    assert first == list(range(min(first), 201)) and second == list(range(min(second), 201))
    assert min(first) + min(second) == 100, "any two of them are enough, and one less is not"


@both_ways
def test_values_that_the_assumption_excludes_are_not_offered() -> None:
    system = replace(filling(2), assume=var("noise", chosen([3, 5, 40])) > 3)
    noise = system.inputs[1]
    system = replace(system, step=(*system.step, Assign(GOAL, (noise > 3) & flag("hold"))))
    system = replace(system, variables=(*system.variables, GOAL))
    assert told(forcing(system, GOAL, Run({}, ({"hold": 1, "noise": 5},)))) == {(1, "hold"): [1]}


def test_a_set_that_does_not_force_the_end_is_noticed() -> None:
    system, run = counter(3, top=3), held(3, before=2)
    found = forcing(system, GOAL, run)
    for one in found.needed:
        less = NecessaryInputs(tuple(n for n in found.needed if n is not one), True)
        with pytest.raises(ReplayError, match="does not force it"):
            check(system, GOAL, run, less)


def test_a_solver_that_takes_anything_for_forced_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    from rovercheck.checker.explain.unrolled_run import ForcedEnd

    monkeypatch.setattr(Unrolled, "asked", lambda *_: ForcedEnd(True))
    monkeypatch.setattr(Unrolled, "avoids", lambda _, changes: iter([False] * len(changes)))
    system, run = counter(3, top=3), held(3)
    with pytest.raises(ReplayError, match="does not force it"):
        check(system, GOAL, run, forcing(system, GOAL, run))


@both_ways
def test_a_run_that_does_not_reach_its_end_is_an_error() -> None:
    with pytest.raises(ReplayError, match="not lead to its end"):
        forcing(counter(3, top=3), GOAL, held(2))


def test_when_time_is_over_what_was_found_is_not_called_minimal() -> None:
    system = replace(counter(3, top=3), inputs=(flag("hold"), flag("beside")))
    beside, hold = flag("beside"), flag("hold")
    count = var("count", integer(0, 3))
    late = Assign(count, ite(hold | (beside & ~beside), minimum(count + 1, 3), 0))
    system = replace(system, step=(late, *system.step[1:]))
    moments = iter([False] * 6 + [True] * 1000)
    run = Run({}, ({"hold": 1, "beside": 0},) * 6)
    found = forcing(system, GOAL, run, over=lambda: next(moments))
    assert not found.minimal
    assert ends(system, GOAL, run, found.needed) == {1}


def test_a_long_run_is_explained_as_far_as_the_time_goes(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(necessary_inputs, "LARGE", 0)
    system, run = counter(120, top=120), held(120, before=400)
    whole = forcing(system, GOAL, run)
    assert told(whole) == {(k, "hold"): [1] for k in range(401, 521)} and whole.minimal
    moments = iter([False] * 300 + [True] * 5000)
    found = forcing(system, GOAL, run, over=lambda: next(moments))
    assert not found.minimal and set(whole.needed) < set(found.needed)
    check(system, GOAL, run, found)


@pytest.mark.parametrize("error", [Overdrawn, DDMemoryError])
def test_what_is_too_large_for_sets_is_unrolled(
    error: type[Exception], monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(*_: object) -> None:
        raise error("full")

    monkeypatch.setattr(necessary_inputs, "LARGE", 0)
    monkeypatch.setattr(backwards, "_Ticks", full)
    found = forcing(counter(3, top=3), GOAL, held(3, before=4))
    assert told(found) == {(k, "hold"): [1] for k in (5, 6, 7)}


def test_time_that_is_over_at_once() -> None:
    with pytest.raises(OutOfTime, match="0 of 3 ticks"):
        forcing(counter(3, top=3), GOAL, held(3), over=lambda: True)


@both_ways
def test_frozen_values_are_kept() -> None:
    limit, hold, count = var("limit", integer(1, 3)), flag("hold"), var("count", integer(0, 3))
    step = (Assign(count, ite(hold, minimum(count + 1, 3), 0)), Assign(GOAL, count >= limit))
    system = TransitionSystem("frozen", (hold,), (limit,), (count, GOAL), (), step)
    run = Run({"limit": 2}, ({"hold": 1},) * 3)
    assert told(forcing(system, GOAL, run)) == {(2, "hold"): [1], (3, "hold"): [1]}
