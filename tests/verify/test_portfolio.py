"""The portfolio: engines in turn and all at once, on answers that are made up."""

import doctest
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import reduce
from operator import or_

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rovercheck.checker.engines import ALL, AUTO, Engine, Limits, Progress, engines
from rovercheck.checker.results.verdict import Answer, Exhausted, Inductive, Open, Reached, Run, Unreachable
from rovercheck.checker.system.width import WIDE
from rovercheck.checker.verify.portfolio import (
    Callbacks,
    Disagreement,
    Found,
    PortfolioQuestion,
    Prior,
    answers,
    as_found,
    question,
    turns,
)
from rovercheck.checker.verify.portfolio.order import ORDERS, Turn
from rovercheck.checker.verify.portfolio.question import EngineAnswer
from rovercheck.checker.verify.portfolio.shape import VAST, Shape
from rovercheck.spec_model.lang.action import Assign
from rovercheck.spec_model.lang.expr import Var, flag
from rovercheck.spec_model.lang.system import TransitionSystem

TOGGLE, ON, OFF, STRAY = (
    flag("toggle"),
    flag("on"),
    flag("off"),
    flag("on.out_of_domain", "on leaves its domain"),
)


def system(*checks: Var) -> TransitionSystem:
    """``on`` follows an input."""
    step = (Assign(ON, TOGGLE), Assign(OFF, ~TOGGLE))
    told = tuple((check, check.doc) for check in checks)
    return TransitionSystem("toggle", (TOGGLE,), (), (ON, OFF, *checks), (), step, checks=told)


def run(ticks: int, shortest: bool = True) -> Reached:
    return Reached(Run({}, ({"toggle": 1},) * ticks), shortest)


NEVER = Unreachable(Inductive(()))
UNLIMITED = Limits()


@dataclass
class Fake:
    """An engine with an answer for each goal; what it is asked is taken down."""

    NAME: str
    says: Mapping[str, Answer]
    asked: list[tuple[list[str], Limits]] = field(default_factory=list)
    SUMMARY: str = "made up"

    def check(
        self, system: TransitionSystem, goals: Sequence[Var], limits: Limits, progress: Progress
    ) -> Mapping[str, Answer]:
        self.asked.append(([g.name for g in goals], limits))
        return {g.name: self.says.get(g.name, Open(f"{self.NAME} does not know", 3)) for g in goals}


@pytest.fixture
def using(monkeypatch: pytest.MonkeyPatch):
    """Makes engines the only ones there are, in this order."""

    def use(*fakes: Fake) -> None:
        known: dict[str, Engine] = {fake.NAME: fake for fake in fakes}
        orders = dict.fromkeys(ORDERS, tuple(Turn(fake.NAME) for fake in fakes))
        monkeypatch.setattr(turns, "engines", lambda: known)
        monkeypatch.setattr(turns, "engines", lambda: known)
        monkeypatch.setattr(turns, "ORDERS", orders)

    return use


def ask(engine: str | Engine = AUTO, limits: Limits = UNLIMITED, *checks: Var) -> Found:
    return answers(PortfolioQuestion(system(*checks), (ON, OFF)), engine, limits, Callbacks())


def test_only_open_goals_are_passed_on(using) -> None:
    first, second, third = Fake("first", {"on": run(4)}), Fake("second", {"off": NEVER}), Fake("third", {})
    using(first, second, third)
    assert ask() == {"on": (run(4), "first"), "off": (NEVER, "second")}
    assert [names for names, _ in second.asked] == [["off"]] and third.asked == []


def test_what_nobody_decides_keeps_every_reason_and_the_deepest_search(using) -> None:
    using(Fake("first", {"on": Open("too wide", 7)}), Fake("second", {}))
    answer, by = ask()["on"]
    assert isinstance(answer, Open) and (answer.depth, by) == (7, "first")
    assert answer.reason == "first: too wide; second: second does not know"


def test_a_run_that_may_not_be_a_shortest_one_is_shortened_or_confirmed(using) -> None:
    deep = Fake("deep", {"on": run(4, shortest=False), "off": run(9, shortest=False)})
    exact = Fake("exact", {"on": Open("no run of at most 3 ticks", 3), "off": run(5)})
    using(deep, exact)
    assert ask() == {"on": (run(4), "deep"), "off": (run(5), "exact")}


def test_a_depth_that_was_searched_needs_no_second_engine(using) -> None:
    first, second = Fake("first", {"on": run(2)}), Fake("second", {})
    using(first, second)
    ask(limits=Limits(depth=3))
    assert second.asked == []


def test_time_is_shared_out(using) -> None:
    first, second = Fake("first", {}), Fake("second", {"on": NEVER, "off": NEVER})
    using(first, second)
    granted: list[float | None] = []
    answers(
        PortfolioQuestion(system(), (ON, OFF)), AUTO, Limits(seconds=100), Callbacks(on_budget=granted.append)
    )
    [(_, early)], [(_, late)] = first.asked, second.asked
    assert early.seconds is not None and late.seconds is not None and late.seconds <= early.seconds <= 100
    assert [round(seconds or 0) for seconds in granted] == [100] * 4


def test_that_a_goal_is_never_reached_counts_only_if_the_model_stays_in_its_domains(using) -> None:
    using(Fake("first", {"on": NEVER, "off": run(1)}))
    found = ask(AUTO, UNLIMITED, STRAY)
    answer, _ = found["on"]
    assert isinstance(answer, Open) and "on leaves its domain? first does not know" in answer.reason
    assert found["off"] == (run(1), "first")
    using(Fake("first", {"on": NEVER, "off": run(1), STRAY.name: NEVER}))
    assert ask(AUTO, UNLIMITED, STRAY)["on"] == (NEVER, "first")


def test_answers_are_given_once_as_they_are_found(using) -> None:
    using(Fake("first", {"on": run(4)}), Fake("second", {"off": NEVER}), Fake("third", {STRAY.name: NEVER}))
    heard: list[set[str]] = []
    told = Callbacks(on_answer=lambda _, found: heard.append(set(found)))
    given = [
        set(found) for found in as_found(PortfolioQuestion(system(STRAY), (ON, OFF)), AUTO, Limits(), told)
    ]
    assert given == heard == [{"on"}, {"off", STRAY.name}]


def test_one_engine_may_be_given_as_it_is() -> None:
    fake = Fake("only", {"on": NEVER})
    assert ask(fake)["on"] == (NEVER, "only")


def test_a_short_run_is_enough_for_who_wants_one(using) -> None:
    first, second = Fake("first", {"on": run(1), "off": run(2)}), Fake("second", {})
    using(first, second)
    answers(PortfolioQuestion(system(STRAY), (ON, OFF), Prior.SHORT), AUTO, Limits(), Callbacks())
    assert second.asked == []


def test_memory_that_runs_out_leaves_the_others_their_turn(using) -> None:
    class Greedy(Fake):
        def check(self, *_: object) -> Mapping[str, Answer]:
            raise MemoryError

    using(Greedy("greedy", {}), Fake("modest", {"on": NEVER, "off": NEVER}))
    assert ask()["on"] == (NEVER, "modest")


EXHAUSTED = Unreachable(Exhausted(2, 4, 1, ("on",)))
CONTRADICTIONS = [
    (run(3), NEVER),
    (run(3), EXHAUSTED),
    (run(3), run(4)),
    (run(3, shortest=False), run(4)),
    (run(3), Open("searched", 3)),
]
HARMONIES = [
    (run(3), run(3)),
    (run(3), run(4, shortest=False)),
    (run(3), Open("searched", 2)),
    (NEVER, EXHAUSTED),
    (NEVER, Open("searched", 300)),
]


@pytest.mark.parametrize(("one", "other"), CONTRADICTIONS)
def test_answers_that_cannot_both_be_true_are_never_merged(one: Answer, other: Answer, using) -> None:
    for first, second in ((one, other), (other, one)):
        using(Fake("first", {"on": first}), Fake("quiet", {}), Fake("second", {"on": second}))
        with pytest.raises(Disagreement, match=r"engines disagree about on of toggle.*first: .*second: "):
            ask(ALL)


@pytest.mark.parametrize(
    ("before", "now"),
    [
        (run(3, shortest=False), NEVER),
        (run(3, shortest=False), run(4)),
        (run(3, shortest=False), Open("searched", 3)),
        (Open("searched", 3), run(3)),
    ],
)
def test_a_turn_that_contradicts_an_earlier_one_is_not_overheard(before: Answer, now: Answer, using) -> None:
    using(Fake("first", {"on": before}), Fake("second", {"on": now}))
    with pytest.raises(Disagreement, match=r"engines disagree about on of toggle.*first: .*second: "):
        ask(AUTO)


@pytest.mark.parametrize(("one", "other"), HARMONIES)
def test_answers_that_agree_are_merged(one: Answer, other: Answer, using) -> None:
    for first, second in ((one, other), (other, one)):
        using(Fake("first", {"on": first}), Fake("second", {"on": second}))
        answer, _ = ask(ALL)["on"]
        assert answer in (one, other) and not isinstance(answer, Open)


def test_a_disagreement_tells_which_run_replays(using) -> None:
    bogus = Reached(Run({}, ({"toggle": 0},)))
    using(Fake("first", {"on": bogus}), Fake("second", {"on": run(2)}))
    with pytest.raises(Disagreement, match=r"first: after 1 tick, which does not replay; second: .* replays"):
        ask(ALL)


def test_every_turn_of_the_table_can_be_taken() -> None:
    known = engines()
    assert {turn.engine for order in ORDERS.values() for turn in order} <= known.keys()


@pytest.mark.parametrize("bits", [0, WIDE, WIDE + 1, VAST, VAST + 1])
@pytest.mark.parametrize("hint", Prior)
def test_every_question_has_an_order(bits: int, hint: Prior) -> None:
    assert ORDERS[Shape(bits, hint).kind]


@given(
    turn=st.sampled_from([turn for order in ORDERS.values() for turn in order]),
    depth=st.none() | st.integers(1, 400),
    memory=st.integers(1, 1 << 34),
    left=st.none() | st.floats(0, 1000),
)
def test_no_turn_grants_more_than_the_user_allows(
    turn: Turn, depth: int | None, memory: int, left: float | None
) -> None:
    granted = turn.within(Limits(depth, left, memory), left)
    assert granted.memory <= memory
    assert depth is None or (granted.depth is not None and granted.depth <= depth)
    assert left is None or (granted.seconds is not None and granted.seconds <= left)


def test_each_reason_is_told_once_with_its_engine() -> None:
    """Each further turn named the first engine once more: ``bmc: bmc: bmc: no run ...``."""
    answers = [
        EngineAnswer(Open(f"reason {n}", n), name)
        for n, name in enumerate(("bmc", "explicit", "pdr"), start=1)
    ]
    answer, by = reduce(or_, answers)
    assert answer == Open("bmc: reason 1; explicit: reason 2; pdr: reason 3", 3) and by == "pdr"


def test_the_example_of_two_answers_is_true() -> None:
    assert doctest.testmod(question).failed == 0
