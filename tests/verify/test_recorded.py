"""Recorded invariants: formulas that are written and read again, and tried before anything is searched."""

import json
from collections.abc import Mapping, Sequence
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rovercheck.checker.engines import AUTO, Engine, Limits
from rovercheck.checker.engines.kinduction.search import with_given
from rovercheck.checker.results.verdict import Answer, Inductive, Open, Reached, Unreachable
from rovercheck.checker.system.formula_json import Tree, Unreadable, formula, readable, size, written
from rovercheck.checker.verify.portfolio import Callbacks, PortfolioQuestion, answers, turns
from rovercheck.checker.verify.portfolio.order import ORDERS, SOON
from rovercheck.checker.verify.portfolio.question import EngineAnswer
from rovercheck.checker.verify.portfolio.turns import RecordedInvariants
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.evaluate import evaluate
from rovercheck.spec_model.lang.expr import Expr, Var, flag, var
from rovercheck.spec_model.lang.system import TransitionSystem
from tests.engines.test_kinduction import agrees, answered, searched
from tests.inductive import problems
from tests.profiles import examples
from tests.strategies_ts import booleans, goals, transition_systems
from tests.toys import GOAL, counter, overflowing, relay

LAMP, AGE = flag("lamp"), var("age", integer(0, 9))
KNOWN = {"lamp": LAMP, "age": AGE}


def spoken(system: TransitionSystem) -> dict[str, Var]:
    return {v.name: v for v in (*system.frozen, *system.variables)}


def through_json(expr: Expr) -> Tree:
    return json.loads(json.dumps(written(expr)))


# --- formulas as JSON ----------------------------------------------------------------------------


@given(st.data())
def test_a_formula_means_what_was_written(data: st.DataObject) -> None:
    system = data.draw(transition_systems())
    known = spoken(system)
    expr = data.draw(st.composite(booleans)(tuple(known.values()), 4))
    again = formula(through_json(expr), known)
    assert through_json(again) == through_json(expr)
    at = {name: data.draw(st.sampled_from(list(v.domain.values))) for name, v in known.items()}
    assert evaluate(again, at) == evaluate(expr, at)


def test_what_is_shared_counts_each_time() -> None:
    twice = AGE + AGE
    assert size(twice) == 3 and size(twice + twice) == 7
    assert written((twice <= 4) & LAMP) == ["and", ["<=", ["+", "age", "age"], 4], "lamp"]


@pytest.mark.parametrize(
    "tree",
    [
        "fan",
        None,
        2.5,
        {},
        [],
        ["and"],
        ["not", "age"],
        ["and", "lamp", "age"],
        ["<=", "lamp", "age"],
        ["<=", "age"],
        ["<=", "lamp", True],
        ["==", "age", False],
        ["+", "age", "lamp"],
        ["div", "age", 0],
        ["mod", "age", "age"],
        ["scale", "age", -1],
        ["bit", "age", -1],
        ["ite", "lamp", "age", True],
        ["ite", "age", 1, 2],
        ["neg", "lamp"],
        ["<=", "age", 1 << 63],
        ["raised", "age"],
        [["<="], "age", 1],
    ],
)
def test_what_is_no_formula_is_not_read(tree: Any) -> None:
    with pytest.raises(Unreadable):
        formula(tree, KNOWN)
    assert list(readable([tree, "lamp"], KNOWN)) == [LAMP]


def test_a_number_is_no_condition() -> None:
    assert formula(["+", "age", 1], KNOWN).sort == AGE.sort
    assert list(readable([["+", "age", 1], "age", 3, "lamp"], KNOWN)) == [LAMP]


def test_nesting_beyond_all_measure_is_not_read() -> None:
    deep: Tree = "lamp"
    for _ in range(100_000):
        deep = ["not", deep]
    assert list(readable([deep, "lamp"], KNOWN)) == [LAMP]


# --- tried as invariants -------------------------------------------------------------------------


def shown(
    system: TransitionSystem, wanted: Sequence[Var], candidates: Sequence[Expr]
) -> Mapping[str, Answer]:
    """The answers with candidates, in this process."""
    return answered(with_given(system, [g.name for g in wanted], candidates), wanted)


@examples(60)
@given(st.data())
def test_whatever_is_on_record_nothing_wrong_is_shown(data: st.DataObject) -> None:
    system = data.draw(transition_systems())
    condition = st.composite(booleans)(tuple(spoken(system).values()), 3)
    tried = [formula(through_json(c), spoken(system)) for c in data.draw(st.lists(condition, max_size=4))]
    agrees(system, goals(system), shown(system, goals(system), tried))


@examples(40)
@given(transition_systems())
def test_what_was_proved_once_is_shown_again(system: TransitionSystem) -> None:
    first = searched(system, goals(system))
    proofs = {n: a.because for n, a in first.items() if isinstance(a, Unreachable)}
    trees = [through_json(c) for because in proofs.values() for c in getattr(because, "conjuncts", ())]
    again = shown(system, goals(system), list(readable(trees, spoken(system))))
    agrees(system, goals(system), again)
    simple = {n for n, because in proofs.items() if isinstance(because, Inductive) and because.simple}
    assert proofs.keys() - simple <= {n for n, a in again.items() if isinstance(a, Unreachable)}


def asked(system: TransitionSystem, candidates: tuple[Expr, ...] | None, engine: str = AUTO) -> Answer:
    question = PortfolioQuestion(system, (GOAL,), candidates=candidates)
    return answers(question, engine, Limits(), Callbacks())[GOAL.name][0]


def test_what_a_record_shows_is_not_searched_for(monkeypatch: pytest.MonkeyPatch) -> None:
    system = relay()
    hold, since, on = (system.var(name) for name in ("hold", "since", "on"))
    monkeypatch.setattr("rovercheck.checker.verify.portfolio.turns.ORDERS", dict.fromkeys(ORDERS, ()))
    answer = asked(system, (~on | (hold == since),))
    assert isinstance(answer, Unreachable) and isinstance(answer.because, Inductive)
    assert problems(system, GOAL, answer.because) == []


@pytest.mark.parametrize("candidates", [(), (LAMP,), (flag("on"),)])
def test_what_a_record_does_not_show_is_searched_for(candidates: tuple[Expr, ...]) -> None:
    assert isinstance(asked(relay(), candidates), Unreachable)
    run = asked(counter(20, top=30), candidates)
    assert isinstance(run, Reached) and run.shortest and len(run.run) == 20


def test_a_value_that_leaves_its_domain_is_not_talked_away() -> None:
    system = overflowing(3)
    count = system.var("count")
    assert isinstance(shown(system, [GOAL], [count <= 2, count <= 3])[GOAL.name], Open)


def test_a_run_is_left_to_engines_that_find_plainer_ones() -> None:
    answer = shown(counter(4, top=30), [GOAL], [])[GOAL.name]
    assert isinstance(answer, Open) and answer.reason == "a run reaches it"


def test_what_a_record_leaves_open_is_enumerated_next(monkeypatch: pytest.MonkeyPatch) -> None:
    """It was not proved with the rest: k-induction is not asked to prove a broad question once more."""
    order, asked_by = list[str](), turns.run_turn

    def noted(engine: Engine, *rest: Any) -> dict[str, EngineAnswer]:
        order.append(engine.SUMMARY if isinstance(engine, RecordedInvariants) else engine.NAME)
        return asked_by(engine, *rest)

    monkeypatch.setattr(turns, "run_turn", noted)
    monkeypatch.setattr(
        "rovercheck.checker.verify.portfolio.turns.ORDERS", dict.fromkeys(ORDERS, (SOON, ORDERS["narrow"][0]))
    )
    assert isinstance(asked(relay(20), ()), Unreachable)
    assert order == [RecordedInvariants.SUMMARY, "explicit"]
    order.clear()
    assert isinstance(asked(relay(20), None), Unreachable)
    assert order[0] == SOON.engine


def test_a_chosen_engine_is_not_helped() -> None:
    system = relay()
    plain = asked(system, (), "explicit")
    assert isinstance(plain, Unreachable) and not isinstance(plain.because, Inductive)
