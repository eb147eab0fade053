"""The values known of variables: never fewer than there are, and searches that store no more than these."""

from collections.abc import Iterator
from dataclasses import replace
from time import process_time

import pytest
from hypothesis import given
from hypothesis.strategies import booleans

from rovercheck.checker.certify.certificate import certificates
from rovercheck.checker.certify.check import CheckEffort, check
from rovercheck.checker.certify.outcome import Accepted
from rovercheck.checker.encode import values as known_values
from rovercheck.checker.encode.dead_branches import Narrowed
from rovercheck.checker.encode.native import OutsideDomain, layout
from rovercheck.checker.encode.value_sets import Values, ends
from rovercheck.checker.encode.values import possible, values
from rovercheck.checker.engines import Limits, explicit, quiet
from rovercheck.checker.engines.explicit import answers as explicit_answers
from rovercheck.checker.engines.explicit import answers as explicit_cases
from rovercheck.checker.engines.explicit.answers import cases, joined
from rovercheck.checker.results.verdict import Answer, Exhausted, Open, Reached, Run, Unreachable
from rovercheck.checker.system.slice import sliced
from rovercheck.spec_model.lang.action import Assign, If, assign
from rovercheck.spec_model.lang.domain import chosen, enumeration, integer
from rovercheck.spec_model.lang.expr import TRUE, Expr, Var, flag, ite, var
from rovercheck.spec_model.lang.system import TransitionSystem
from tests import naive
from tests.profiles import examples
from tests.strategies_timed import timed_systems
from tests.strategies_ts import goals, transition_systems

WHICH = enumeration("Which", ["LEFT", "RIGHT", "BOTH"])


@pytest.fixture(autouse=True, scope="module")
def however_narrow() -> Iterator[None]:
    """Searches look at values, and go case by case, in systems of any size."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(explicit_answers, "NARROW", -1)
        yield


def holds_all(system: TransitionSystem, known: dict[str, Values]) -> None:
    """What a naive search reaches is within the values known."""
    for state in naive.search(system, ()).states:
        for name, raw in state:
            low, top = ends(known[name])
            assert raw in known[name] and low <= raw <= top, (name, raw, known[name])


@given(transition_systems())
def test_all_reachable_values_are_known(system: TransitionSystem) -> None:
    holds_all(system, values(system))
    part = sliced(system, goals(system))
    holds_all(part, values(part))


@examples(40)
@given(timed_systems())
def test_also_of_charts_with_timers(system: TransitionSystem) -> None:
    holds_all(system, values(system))


@given(transition_systems())
def test_searches_that_store_what_can_be_find_the_same(system: TransitionSystem) -> None:
    asked = goals(system)
    judge = naive.search(system, asked)
    agrees(system, asked, judge)


@given(transition_systems())
def test_and_so_they_do_case_by_case(system: TransitionSystem) -> None:
    which = var("which", WHICH)
    body = If(which == "LEFT", system.step[: len(system.step) // 2], system.step)
    several = replace(system, frozen=(*system.frozen, which), step=(body,))
    asked = goals(system)
    agrees(several, asked, naive.search(several, asked))


@examples(12)
@given(transition_systems(), booleans())
def test_what_is_proved_case_by_case_has_a_certificate(system: TransitionSystem, without: bool) -> None:
    """Also of values with which no tick is possible."""
    which = var("which", WHICH)
    assume = system.assume & (which != "RIGHT") if without else system.assume
    several, asked = replace(system, frozen=(*system.frozen, which), assume=assume), goals(system)
    found = explicit.check(several, asked, Limits(), quiet)
    made = certificates(several, asked, found, "explicit")
    for one in made:
        assert isinstance(check(one, several, CheckEffort()), Accepted)
    proved = {name for name, answer in found.items() if isinstance(answer, Unreachable)}
    assert proved == {name for one in made for name in one.claims}


def agrees(system: TransitionSystem, asked: tuple[Var, ...], judge: naive.Searched) -> None:
    for name, answer in explicit.check(system, asked, Limits(), quiet).items():
        match answer:
            case Reached(run, True):
                assert naive.replay(system, run)[-1][name] == 1
                assert len(run) == judge.reached[name]
            case Unreachable(Exhausted() as because):
                assert name not in judge.reached
                assert because.states == len(naive.projected(judge.states, because.variables))
            case _:
                raise AssertionError(answer)


# --- what is seen ----------------------------------------------------------------------------------------

level = var("level", integer(0, 600))
spare = var("spare", integer(0, 1000))
on = flag("on")


def system(*step: Assign | If, frozen: tuple[Var, ...] = (), assume: Expr = TRUE) -> TransitionSystem:
    return TransitionSystem("toy", (on,), frozen, (level, spare), (), step, assume)


def test_what_never_changes_takes_no_bits_and_two_values_take_one() -> None:
    toy = system(assign(level, ite(on, 600, 0)))
    known = values(toy)
    assert known == {"level": frozenset({0, 600}), "spare": frozenset({0})}
    packing = layout(toy.variables, known)
    assert [(f.bits, f.stride, f.top) for f in packing.fields] == [(1, 600, 600), (0, 1, 0)]
    assert packing.unpack(packing.pack({"level": 600, "spare": 0})) == {"level": 600, "spare": 0}
    with pytest.raises(OutsideDomain):
        packing.pack({"level": 600, "spare": 7})


def test_a_counter_that_conditions_end_goes_no_further() -> None:
    assert values(system(If(level < 5, (assign(level, level + 1),), ())))["level"] == frozenset(range(6))
    assert values(system(assign(level, ite(level >= 5, 5, level + 1))))["level"] == frozenset(range(6))


def test_the_assumption_says_what_inputs_are() -> None:
    assert values(system(assign(level, ite(on, 600, 0)), assume=~on))["level"] == frozenset({0})


def test_nothing_happens_where_the_assumption_is_never_met() -> None:
    assert values(system(assign(level, 3), assume=level > 7))["level"] == frozenset({0})


def test_values_that_a_domain_lacks_are_left_out() -> None:
    odd = var("odd", chosen([0, 3, 9, 21]))
    toy = TransitionSystem("toy", (on,), (), (odd,), (), (assign(odd, ite(on, 9, 3)),), TRUE)
    [field] = layout(toy.variables, values(toy)).fields
    assert (field.low, field.top, field.stride, field.bits) == (0, 9, 3, 2)


def test_a_value_that_none_was_known_to_take_is_an_error_of_ours(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(
        explicit_answers, "narrowed", lambda part: Narrowed(part, {"level": frozenset({0, 1})})
    )
    done = flag("done")
    toy = replace(system(assign(done, level == 8), assign(level, 7)), variables=(level, spare, done))
    with pytest.raises(AssertionError, match="none was known to take"):
        explicit.check(toy, [done], Limits(), quiet)


# --- cases -----------------------------------------------------------------------------------------------

which, pair = var("which", WHICH), var("pair", enumeration("Pair", ["ONE", "OTHER"]))


def texts(one: TransitionSystem) -> list[str]:
    return [text for text, _ in cases(one, one)]


def test_the_enumeration_with_the_most_values_is_told_apart() -> None:
    both = system(frozen=(pair, which))
    assert texts(both) == ["which = LEFT", "which = RIGHT", "which = BOTH"]
    only = dict(cases(both, both))["which = RIGHT"]
    assert [v.domain.values for v in only(both).frozen] == [range(2), (1,)]
    assert texts(system(frozen=(pair,))) == []


def test_a_value_that_the_assumption_excludes_is_no_case() -> None:
    not_right = system(frozen=(which,), assume=which != "RIGHT")
    assert texts(not_right) == ["which = LEFT", "which = BOTH"]
    assert texts(system(frozen=(which,), assume=(which == "LEFT") & (which == "RIGHT"))) == []


STEPS = 5000
counting = replace(
    system(
        If(which == "LEFT", (assign(level, ite(level == 600, 600, level + 1)),), (assign(spare, 7),)),
        assign(over := flag("over"), (level == 600) & (spare == 8)),
    ),
    frozen=(which,),
    variables=(level, spare, over),
)
"""Never over; only one case has more than a few states."""


def test_a_case_says_which_limit_it_met_and_gives_its_memory_back(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(explicit_cases, "KEPT", 600)
    [answer] = explicit.check(counting, [over], Limits(), quiet).values()
    assert isinstance(answer, Unreachable) and isinstance(answer.because, Exhausted)
    assert answer.because.closed is None and answer.because.states > 600
    [few] = explicit.check(counting, [over], Limits(transitions=100), quiet).values()
    assert isinstance(few, Open) and "which = " in few.reason and "the limit of 100 transitions" in few.reason


def test_a_large_case_leaves_transitions_to_the_others() -> None:
    """A run of the last case was not found where the first one took all that there were."""
    seen = flag("seen")
    wanted = replace(
        counting, step=(*counting.step, assign(seen, spare == 7)), variables=(*counting.variables, seen)
    )
    [answer] = explicit.check(wanted, [seen], Limits(transitions=300), quiet).values()
    assert isinstance(answer, Reached) and len(answer.run) == 1 and answer.shortest
    assert answer.run.frozen["which"] == 1


def test_when_time_is_over_no_other_case_is_begun() -> None:
    [late] = explicit.check(counting, [over], Limits(seconds=0), quiet).values()
    assert isinstance(late, Open) and "the time limit of 0 s is reached before which = LEFT" in late.reason


# --- what takes too long --------------------------------------------------------------------------------


def test_choices_that_share_what_they_choose_from_are_looked_at_once() -> None:
    """Each formula is used twice in the next: followed one by one these are 2 to the 200."""
    value: Expr = level
    for _ in range(200):
        value = ite(on, value, ite(spare == 3, value, 7))
    started = process_time()
    assert values(system(assign(level, value)))["level"] == frozenset({0, 7})
    assert process_time() - started < 60


def test_deep_formulas_need_no_deep_stack() -> None:
    value: Expr = level
    met: Expr = on
    for n in range(STEPS):
        value, met = ite(on, value, n % 5), met & (spare == 0) if n % 2 else ~met
    assert values(system(assign(level, value)))["level"] == frozenset(range(5))
    assert values(system(If(met, (assign(level, 5),), ())))["level"] == frozenset({0, 5})


def test_of_a_step_that_takes_too_long_nothing_is_known(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(known_values, "_EFFORT", 3)
    toy = system(assign(level, ite(on, 600, 0)), assume=on)
    assert values(toy) == {} and possible(toy)
    assert [f.bits for f in layout(toy.variables, values(toy)).fields] == [10, 10]


LONG, SHORT = (Run({}, ({},) * n) for n in (7, 4))
NONE = Unreachable(Exhausted(10, 20, 5, ("level",)))


@pytest.mark.parametrize(
    ("answers", "expected"),
    [
        ((Reached(LONG), NONE, Reached(SHORT)), Reached(SHORT)),
        ((Open("memory", 9), Reached(SHORT)), Reached(SHORT)),
        ((Open("memory", 2), Reached(SHORT)), Reached(SHORT, shortest=False)),
        ((NONE, Open("memory", 9), Open("time", 2)), Open("time", 2)),
        ((NONE, NONE), Unreachable(Exhausted(20, 40, 5, ("level",)))),
    ],
)
def test_what_cases_say_together(answers: tuple[Answer, ...], expected: Answer) -> None:
    assert joined(system(), [{"goal": answer} for answer in answers]) == {"goal": expected}
