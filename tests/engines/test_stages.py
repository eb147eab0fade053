"""Inputs chosen coarsely until the state is complete, and finely for the goals alone: nothing is lost."""

from collections.abc import Callable, Iterator, Mapping

import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.strategies import DataObject

from rovercheck.checker.encode.code_motion import sunk
from rovercheck.checker.encode.native import NativeTask, OutsideDomain, layout, search
from rovercheck.checker.encode.path_statements import (
    Branch,
    Choose,
    Complete,
    Each,
    PathProgram,
    PathStatement,
    Require,
)
from rovercheck.checker.engines import Limits, Timers
from rovercheck.checker.results.verdict import Open, Reached
from rovercheck.checker.system.slice import sliced
from rovercheck.spec_model.lang.action import Assign, If
from rovercheck.spec_model.lang.domain import chosen, enumeration, integer
from rovercheck.spec_model.lang.evaluate import step
from rovercheck.spec_model.lang.expr import Var, all_of, any_of, flag, ite, member, var
from rovercheck.spec_model.lang.system import Program, Statement, TransitionSystem
from rovercheck.spec_model.lang.words import minimum
from tests import naive
from tests.engines.compared import Group, compare
from tests.engines.test_explicit import agrees, check, exhausted
from tests.profiles import examples
from tests.strategies_stages import staged_systems
from tests.strategies_ts import goals, transition_systems

SEEN = enumeration("Seen", {"NEAR": 0, "MID": 1, "FAR": 2})
NEAR, MID, FAR = (member(SEEN, name) for name in ("NEAR", "MID", "FAR"))


def task(system: TransitionSystem, wanted: tuple[Var, ...]) -> NativeTask:
    part = sliced(system, wanted)
    return NativeTask(part, layout((*part.frozen, *part.variables)), wanted)


def statements(program: PathProgram) -> Iterator[PathStatement]:
    """Every statement, also those in branches."""
    for statement in program:
        yield statement
        if isinstance(statement, Branch):
            yield from statements((*statement.then, *statement.otherwise))


def stages(made: NativeTask) -> tuple[PathProgram, PathProgram]:
    """The statements before and after the state is complete."""
    (at,) = (i for i, s in enumerate(made.stages) if isinstance(s, Complete))
    return made.stages[:at], made.stages[at + 1 :]


def values(program: PathProgram) -> dict[str, tuple[int, ...]]:
    """The values among which each input is chosen, by name."""
    return {s.var.name: s.values for s in statements(program) if isinstance(s, Choose | Each)}


# --- systems whose goals need finer cells than what is kept ------------------------------------------


def sonars() -> Group:
    """Three inputs, of which only "far or not" is kept from tick to tick."""
    seen = [Var(f"sonar{n}", SEEN) for n in range(3)]
    was = [flag(f"was{n}") for n in range(3)]
    count, near, all_near, never = var("count", integer(0, 3)), flag("near"), flag("all_near"), flag("never")
    falling = any_of(*(w & ~(s == FAR) for w, s in zip(was, seen, strict=True)))
    step: Program = (
        Assign(count, ite(falling, minimum(count + 1, 3), count)),
        *(Assign(w, s == FAR) for w, s in zip(was, seen, strict=True)),
        Assign(near, any_of(*(s == NEAR for s in seen)) & (count == 3)),
        Assign(all_near, all_of(*(s == NEAR for s in seen), count == 2)),
        Assign(never, near & all_of(*(s == MID for s in seen))),
    )
    made = TransitionSystem("sonars", tuple(seen), (), (*was, count, near, all_near, never), (), step)
    return made, (near, all_near, never)


def linked() -> Group:
    """An assumption that links two inputs; their goals need values that it does not tell apart."""
    a, b, high, was = var("a", integer(0, 9)), var("b", integer(0, 9)), flag("high"), flag("was")
    both, one, never = flag("both"), flag("one"), flag("never")
    step = (
        Assign(was, high),
        Assign(high, a > 4),
        Assign(both, all_of(was, a == 7, b == 3)),
        Assign(one, ~was & (b == 9)),
        Assign(never, all_of(a == 8, b == 8)),
    )
    assume = (a <= 4) | (b <= 5)
    return TransitionSystem("linked", (a, b), (), (high, was, both, one, never), (), step, assume), (
        both,
        one,
        never,
    )


def mixed_by_the_assumption() -> Group:
    """An assumption that compares two inputs: neither has coarse cells, a third one has."""
    a, b, c = (var(n, integer(0, 5)) for n in "abc")
    high, was, reached, never = flag("high"), flag("was"), flag("reached"), flag("never")
    step = (
        Assign(was, high),
        Assign(high, (a > 2) & (c > 2)),
        Assign(reached, all_of(was, a == 4, b == 3, c == 5)),
        Assign(never, all_of(a == 3, b == 4)),
    )
    return TransitionSystem("mixed", (a, b, c), (), (high, was, reached, never), (), step, a > b), (
        reached,
        never,
    )


def only_for_a_goal() -> Group:
    """One input that nothing else reads."""
    go, code, count = flag("go"), var("code", integer(0, 99)), var("count", integer(0, 5))
    opened, never = flag("opened"), flag("never")
    step = (
        Assign(count, ite(go, minimum(count + 1, 5), 0)),
        Assign(opened, (count == 5) & (code == 42)),
        Assign(never, (code == 7) & (count > 5)),
    )
    return TransitionSystem("code", (go, code), (), (count, opened, never), (), step), (opened, never)


def read_on_some_paths() -> Group:
    """Inputs that the step reads in one branch, coarsely, and goals everywhere, finely; long, so that forks
    lie between the choices."""
    pick, go, other = var("pick", integer(0, 9)), flag("go"), var("other", chosen([-5, 0, 10]))
    x, high, was = var("x", integer(0, 3)), flag("high"), flag("was")
    low, sure, never = flag("low"), flag("sure"), flag("never")
    turns = (Assign(x, ite(x == 3, 0, x + 1)),) * 30
    step: Program = (
        Assign(was, high),
        If(go, (Assign(high, (pick > 6) & (other > 0)),), (Assign(x, minimum(x + 1, 3)),)),
        *turns,
        If(high & ~go, (Assign(high, other > 0),)),
        *turns,
        Assign(low, all_of(was, ~go, pick == 3, other == 0, x == 2)),
        Assign(sure, (x == 3) & (pick == 8)),
        Assign(never, all_of(x > 3, was, pick == 2)),
    )
    made = TransitionSystem("some paths", (pick, go, other), (), (x, high, was, low, sure, never), (), step)
    return made, (low, sure, never)


def kept_goals() -> Group:
    """A goal that stays true, one that reads what is overwritten after it, one before what it reads."""
    level, was, count = var("level", integer(0, 9)), flag("was"), var("count", integer(0, 3))
    ever, falling, late, never = flag("ever"), flag("falling"), flag("late"), flag("never")
    step = (
        Assign(falling, all_of(was, level == 2, count == 3)),
        Assign(never, was & (count > 3) & (level == 1)),
        Assign(count, ite(was, minimum(count + 1, 3), count)),
        Assign(was, level > 5),
        Assign(ever, ever | ((level == 6) & (count == 2))),
        Assign(late, ever & (level == 8) & falling),
    )
    made = TransitionSystem("kept", (level,), (), (was, count, ever, falling, late, never), (), step)
    return made, (ever, falling, late, never)


Made = Callable[[], Group]

GROUPS: tuple[Made, ...] = (
    sonars,
    linked,
    mixed_by_the_assumption,
    only_for_a_goal,
    read_on_some_paths,
    kept_goals,
)


@pytest.mark.parametrize("made", GROUPS)
def test_goals_that_need_finer_cells(made: Made) -> None:
    compare(made)
    compare(made, Timers.SKIP)
    system, wanted = made()
    found = naive.search(system, wanted)
    for goal in wanted:
        agrees(system, (goal,), found)


@examples(60)
@given(staged_systems())
def test_random_systems_whose_goals_need_finer_cells(system: TransitionSystem) -> None:
    agrees(system, goals(system), naive.search(system, goals(system)))


# --- the program -------------------------------------------------------------------------------------


def test_the_valuation_is_complete_before_fine_cells_are_chosen() -> None:
    before, after = stages(task(*sonars()))
    assert values(before) == {f"sonar{n}": (0, 2) for n in range(3)}
    assert values(after) == {f"sonar{n}": (0, 1, 2) for n in range(3)}
    assert all(isinstance(s, Each) == isinstance(s, Choose | Each) for s in statements(after))


def test_cells_stay_as_fine_as_the_assumption_needs() -> None:
    before, _ = stages(task(*linked()))
    assert values(before) == {"a": (0, 5), "b": (0, 6)}
    before, after = stages(task(*mixed_by_the_assumption()))
    assert values(before) == {"a": (0, 1, 2, 3, 4, 5), "b": (0, 1, 2, 3, 4, 5), "c": (0, 3)}
    assert values(after) == {"c": (0, 3, 5)}
    assert any(isinstance(s, Require) for s in before)


def test_an_input_for_goals_alone_is_chosen_after_the_valuation_is_complete() -> None:
    before, after = stages(task(*only_for_a_goal()))
    assert values(before) == {"go": (0, 1)}
    assert values(after) == {"code": (0, 7, 42)}


@pytest.mark.parametrize("made", GROUPS)
def test_two_stages_find_the_valuations_of_one(made: Made, monkeypatch: pytest.MonkeyPatch) -> None:
    """As many, and after no more paths; three cells of each of three inputs are tried in every tick."""
    system, (*_, never) = made()
    two = exhausted(*check(system, never))
    monkeypatch.setattr(search, "staged_program", lambda *_: None)
    one = exhausted(*check(system, never))
    assert (two.states, two.depth) == (one.states, one.depth)
    assert two.transitions <= one.transitions
    if made is sonars:
        assert two.transitions == one.transitions == 27 * two.states


def test_without_coarser_cells_there_is_one_stage() -> None:
    level, go, high, goal = var("level", integer(0, 9)), flag("go"), flag("high"), flag("goal")
    step: Program = (Assign(goal, ~high & go & (level > 5)), Assign(high, (level > 5) | go))
    made = task(TransitionSystem("", (level, go), (), (high, goal), (), step), (goal,))
    assert not any(isinstance(s, Complete) for s in made.stages)
    assert made.stages is made.paths


# --- limits and errors -------------------------------------------------------------------------------


def codes(number: int) -> tuple[TransitionSystem, Var]:
    """A goal that needs many values of many inputs, in a state that has one successor."""
    many = tuple(var(f"i{n}", integer(0, 9)) for n in range(number))
    count, never = var("count", integer(0, 2)), flag("never")
    beyond = sum(many, start=count + 0) > 200
    step = (Assign(count, minimum(count + 1, 2)), Assign(never, beyond))
    return TransitionSystem("codes", many, (), (count, never), (), step), never


def test_a_search_with_too_many_inputs_for_a_goal_is_given_up(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(search, "MOST_SUCCESSORS", 3 * search.MOST_IDLE)
    (answer,) = check(*codes(12))
    assert answer == Open("too many inputs in one tick for an explicit search", 0)
    assert exhausted(*check(*codes(4))).transitions == 3 * 10**4


def test_the_time_ends_in_the_middle_of_the_second_stage() -> None:
    (answer,) = check(*codes(12), limits=Limits(seconds=0))
    assert isinstance(answer, Open)
    assert answer.reason.startswith("the time limit of 0 s is reached at 1 states")


def test_a_goal_is_reached_by_a_tick_that_breaks_the_model() -> None:
    """As in one stage: the goals of a tick count before the values that it leaves outside their domains."""
    level, count, goal = var("level", integer(0, 9)), var("count", integer(0, 3)), flag("goal")
    step: Program = (Assign(count, count + 1), Assign(goal, (count == 4) & (level == 7)))
    system = TransitionSystem("", (level,), (), (count, goal), (), step)
    assert any(isinstance(s, Complete) for s in task(system, (goal,)).stages)
    (answer,) = check(system, goal)
    assert isinstance(answer, Reached) and len(answer.run) == 4
    broken = TransitionSystem(
        "", (level,), (), (count, goal), (), (step[0], Assign(goal, (level == 7) & (count > 4)))
    )
    with pytest.raises(OutsideDomain, match="count becomes 4"):
        check(broken, goal)


# --- sinking -----------------------------------------------------------------------------------------


def after(system: TransitionSystem, program: Program, at: Mapping[str, int]) -> Mapping[str, int]:
    whole = TransitionSystem("", system.inputs, system.frozen, system.variables, system.temps, program)
    return step(whole, at, at)


@given(st.one_of(transition_systems(), staged_systems()), st.data())
def test_the_two_parts_of_a_step_do_what_it_does(system: TransitionSystem, data: DataObject) -> None:
    variables = (*system.variables, *system.temps)
    stored = frozenset(v.name for v in variables if data.draw(st.booleans()))
    first, second = sunk(system.step, stored)
    assert sorted(map(id, (*first, *second))) == sorted(map(id, system.step))
    everything = (*system.inputs, *system.frozen, *variables)
    at = {v.name: data.draw(st.sampled_from(list(v.domain.values))) for v in everything}
    whole = after(system, system.step, at)
    assert after(system, (*first, *second), at) == whole
    complete = after(system, first, at)
    assert {n: complete[n] for n in stored if n in complete} == {n: whole[n] for n in stored if n in whole}


def test_what_reads_a_value_that_is_overwritten_stays_before() -> None:
    level, was, falling, goal = var("level", integer(0, 9)), flag("was"), flag("falling"), flag("goal")
    note: Statement = Assign(falling, was & (level < 3))
    keep, ask = Assign(was, level > 5), Assign(goal, falling & (level == 2))
    assert sunk((note, keep, ask), frozenset({"was"})) == ((note, keep), (ask,))
    assert sunk((keep, note, ask), frozenset({"was"})) == ((keep,), (note, ask))
