"""The explicit engine against a naive search with the reference semantics."""

from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from benchmarks.roverlite import roverlite
from rovercheck.checker.encode.native import OutsideDomain
from rovercheck.checker.engines import Limits, explicit, quiet
from rovercheck.checker.results.closed_set import ClosedSet
from rovercheck.checker.results.verdict import Answer, Exhausted, Open, Reached, Unreachable
from rovercheck.checker.system.slice import sliced
from rovercheck.spec_model.lang.action import Assign
from rovercheck.spec_model.lang.domain import chosen, integer
from rovercheck.spec_model.lang.expr import FALSE, TRUE, Apply, Expr, Var, all_of, const, flag, ite, var
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.system import TransitionSystem
from rovercheck.spec_model.lang.words import minimum
from tests.naive import Searched, State, projected, replay, search
from tests.strategies_ts import goals, transition_systems

UNLIMITED = Limits()


def check(system: TransitionSystem, *wanted: Var, limits: Limits = UNLIMITED) -> list[Answer]:
    answers = explicit.check(system, wanted, limits, quiet)
    return [answers[g.name] for g in wanted]


def exhausted(answer: Answer) -> Exhausted:
    """The evidence of an exhausted search."""
    assert isinstance(answer, Unreachable) and isinstance(answer.because, Exhausted)
    return answer.because


def unpacked(closed: ClosedSet) -> set[State]:
    """The states of a closed set, read by its places alone."""
    rows = [tuple(map(int, row)) for row in closed.words]
    places = closed.places
    return {
        tuple((p.var.name, (row[p.word] >> p.shift & (1 << p.bits) - 1) * p.stride + p.low) for p in places)
        for row in rows
    }


def agrees(system: TransitionSystem, wanted: tuple[Var, ...], naive: Searched) -> None:
    """Verdicts, lengths of runs, the runs themselves, and the number of states."""
    for goal, answer in zip(wanted, check(system, *wanted), strict=True):
        match answer:
            case Reached(run, True):
                after = replay(system, run)
                assert after[-1][goal.name] == 1
                assert len(run) == naive.reached[goal.name]
            case Unreachable(Exhausted() as because):
                assert goal.name not in naive.reached
                assert because.states == len(projected(naive.states, because.variables))
                assert because.closed is not None
                assert unpacked(because.closed.whole) == projected(naive.states, because.variables)
            case _:
                raise AssertionError(answer)


@given(transition_systems())
def test_random_systems(system: TransitionSystem) -> None:
    agrees(system, goals(system), search(system, goals(system)))


@given(transition_systems())
def test_random_systems_goal_by_goal(system: TransitionSystem) -> None:
    naive = search(system, goals(system))
    for goal in goals(system):
        agrees(system, (goal,), naive)


@given(transition_systems(), st.integers(0, 3))
def test_a_depth_limit_never_proves_more_than_was_seen(system: TransitionSystem, depth: int) -> None:
    naive = search(system, goals(system))
    answers = check(system, *goals(system), limits=Limits(depth))
    for goal, answer in zip(goals(system), answers, strict=True):
        first = naive.reached.get(goal.name)
        assert isinstance(answer, Reached) == (first is not None and first <= depth)
        assert not isinstance(answer, Open) or answer.depth == depth
        assert not isinstance(answer, Unreachable) or first is None


# --- packing -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("parts", [1, 2, 3])
def test_valuations_of_several_words(parts: int) -> None:
    """Each part needs 60 bits; the words move one to the next, so none may be lost."""
    wide = [var(f"wide{i}", chosen([0, 5, (1 << 60) - 1])) for i in range(parts)]
    source, end = var("source", wide[0].domain), flag("end")
    moves = [Assign(b, a) for a, b in zip([source, *wide], wide, strict=False)][::-1]
    last = all_of(*(w == 5 if i % 2 else w == (1 << 60) - 1 for i, w in enumerate(wide)))
    system = TransitionSystem("wide", (source,), (), (*wide, end), (), (Assign(end, last), *moves))
    (answer,) = check(system, end)
    assert isinstance(answer, Reached) and len(answer.run) == parts + 1
    assert replay(system, answer.run)[-1]["end"]
    never, odd = flag("never"), all_of(*(~(w == 0) & ~(w == 5) & (w < 7) for w in wide))
    system = TransitionSystem("wide", (source,), (), (*wide, never), (), (Assign(never, odd), *moves))
    (answer,) = check(system, never)
    assert exhausted(answer).states == 3**parts


def test_many_bits_in_many_variables() -> None:
    fed = flag("fed")
    flags = [flag(f"was{i}") for i in range(140)]
    shift = [Assign(b, a) for a, b in pairwise(flags)][::-1]
    far, never = flag("far"), flag("never")
    program = (*shift, Assign(flags[0], fed), Assign(far, flags[-1]), Assign(never, flags[0] & ~flags[0]))
    system = TransitionSystem("", (fed,), (), (*flags, far, never), (), program)
    answer = check(system, far, limits=Limits(depth=12))[0]
    assert isinstance(answer, Open) and answer.depth == 12
    once = TransitionSystem(
        "", (), (), (*flags, far, never), (), (*shift, Assign(flags[0], TRUE), *program[-2:])
    )
    answer = check(once, far)[0]
    assert isinstance(answer, Reached) and len(answer.run) == 140


def test_valuations_with_the_same_hash_are_told_apart() -> None:
    """The hash of the table, computed here to make two states collide in all its bits."""
    first = next(n for n in range((1 << 62) + 5, 1 << 63) if _mix(n) >> 63 == 0)
    a, b = var("a", chosen([0, 1, first])), var("b", chosen([0, 1, _mix(first)]))
    never = flag("never")
    program = (Assign(never, (a == 1) & (b == 1)), Assign(a, const(first)), Assign(b, const(_mix(first))))
    (answer,) = check(TransitionSystem("", (), (), (a, b, never), (), program), never)
    assert exhausted(answer).states == 2


def _mix(word: int) -> int:
    return (word ^ word >> 32) * 0xD6E8FEB86659FD93 % (1 << 64)


def test_a_value_outside_its_domain_is_an_error_that_names_the_variable() -> None:
    count, over = var("count", integer(0, 5)), flag("over")
    system = TransitionSystem(
        "", (), (), (count, over), (), (Assign(over, (count == 5) & (count == 4)), Assign(count, count + 1))
    )
    with pytest.raises(OutsideDomain, match="count becomes 6"):
        check(system, over)


def test_a_hole_of_a_sparse_domain_is_outside() -> None:
    level, over = var("level", chosen([0, 20, 30])), flag("over")
    system = TransitionSystem(
        "", (), (), (level, over), (), (Assign(over, level == 99), Assign(level, minimum(level + 10, 30)))
    )
    with pytest.raises(OutsideDomain, match="level becomes 10"):
        check(system, over)


# --- inputs ------------------------------------------------------------------------------------------


def with_goal(inputs: tuple[Var, ...], condition: Expr, assume: Expr = TRUE) -> tuple[TransitionSystem, Var]:
    goal, seen = flag("goal"), var("seen", integer(0, 2))
    program = (Assign(goal, condition & (seen == 2)), Assign(seen, minimum(seen + 1, 2)))
    return TransitionSystem("", inputs, (), (seen, goal), (), program, assume), goal


def test_inputs_that_are_not_read_cost_nothing() -> None:
    many = tuple(var(f"i{k}", integer(0, 99)) for k in range(12))
    system, goal = with_goal(many, all_of(*(v > 99 for v in many)))
    (answer,) = check(system, goal)
    assert exhausted(answer).transitions < 1000


def test_traces_are_calm() -> None:
    """An input keeps its value while that is in the cell that the run needs."""
    level, other = var("level", integer(0, 1000)), var("other", integer(3, 9))
    system, goal = with_goal((level, other), (level > 500) & (other < 20))
    (answer,) = check(system, goal)
    assert isinstance(answer, Reached)
    assert [dict(i) for i in answer.run.inputs] == [
        {"level": 0, "other": 3},
        {"level": 0, "other": 3},
        {"level": 501, "other": 3},
    ]


def test_inputs_of_a_conjunct_that_was_left_out_still_meet_it() -> None:
    a, b, c = (var(n, integer(0, 9)) for n in "abc")
    system, goal = with_goal((a, b, c), a == 3, all_of(b > c, c > 1, a < 8))
    assert [v.name for v in sliced(system, [goal]).inputs] == ["a"]
    (answer,) = check(system, goal)
    assert isinstance(answer, Reached)
    replay(system, answer.run)


def test_goals_that_have_nothing_in_common_do_not_multiply() -> None:
    holds = [flag(f"hold{n}") for n in range(3)]
    counts = [var(f"count{n}", integer(0, 4000)) for n in range(3)]
    never = [flag(f"never{n}") for n in range(3)]
    step = (
        *(Assign(c, ite(h, minimum(c + 1, 4000), 0)) for h, c in zip(holds, counts, strict=True)),
        *(Assign(g, c > 4000) for g, c in zip(never, counts, strict=True)),
    )
    system = TransitionSystem("apart", tuple(holds), (), (*counts, *never), (), step)
    found = explicit.check(system, never, Limits(), quiet)
    assert [exhausted(a).states for a in found.values()] == [4001, 4001, 4001]


def test_an_assumption_that_nothing_meets_blocks_every_tick() -> None:
    a = var("a", integer(0, 9))
    for assume in (a > 9, FALSE, (a > 3) & (a < 2)):
        system, goal = with_goal((a,), TRUE, assume)
        (answer,) = check(system, goal)
        assert exhausted(answer).states == 1


def test_frozen_variables_are_part_of_the_valuation() -> None:
    limit, count, reached = var("limit", integer(3, 6)), var("count", integer(0, 9)), flag("reached")
    program = (Assign(count, ite(count < limit, count + 1, count)), Assign(reached, count == 5))
    system = TransitionSystem("", (), (limit,), (count, reached), (), program)
    (answer,) = check(system, reached)
    assert isinstance(answer, Reached) and answer.run.frozen["limit"] >= 5 and len(answer.run) == 5
    never = flag("never")
    more = (*program, Assign(never, (count > limit)))
    (answer,) = check(TransitionSystem("", (), (limit,), (count, reached, never), (), more), never)
    assert exhausted(answer).states == 4 + 5 + 6 + 7


def test_more_goals_than_bits_in_a_word() -> None:
    count = var("count", integer(0, 99))
    wanted = tuple(flag(f"at{i}") for i in range(120))
    program = (
        Assign(count, Apply(Op.MOD, (count + 1, const(100)), count.sort)),
        *(Assign(g, count == i) for i, g in enumerate(wanted)),
    )
    answers = check(TransitionSystem("", (), (), (count, *wanted), (), program), *wanted)
    lengths = [len(a.run) if isinstance(a, Reached) else None for a in answers]
    assert lengths == [100, *range(1, 100), *[None] * 20]


# --- a known model -----------------------------------------------------------------------------------


@pytest.mark.parametrize(("parts", "k", "states"), [(3, 1, 50_904), (32, 1, 93_180), (31, 25, 40_560)])
def test_roverlite_has_as_many_valuations_as_in_c(parts: int, k: int, states: int) -> None:
    system, wanted = roverlite(parts, k)
    never = next(g for g in wanted if g.name == "broken")
    (answer,) = check(system, never)
    assert exhausted(answer).states == states


def test_roverlite_fails_after_as_many_ticks_as_in_c() -> None:
    system, wanted = roverlite(85, 10)
    lengths = {g.name: len(a.run) for g in wanted if isinstance(a := check(system, g)[0], Reached)}
    assert lengths == {"P4": 20, "P5": 46}
