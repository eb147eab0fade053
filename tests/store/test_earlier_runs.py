"""After an edit: a run that was found before it is tried first, and told only for what it still shows."""

from dataclasses import replace
from pathlib import Path

import pytest

from rovercheck.checker.results.trace import Trace
from rovercheck.checker.results.verdict import Proved, StoredRun, Violated
from rovercheck.properties.forms import always, leads_to, never
from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Block
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import Var, flag, ite, var
from rovercheck.spec_model.lang.system import System, in_order
from rovercheck.spec_model.lang.words import minimum
from tests.store.lamps import BEAM, GO, ON, PUSH, decided, lamp, of, store, told
from tests.store.naive_engine import NaiveEngine
from tests.store.test_forged import TRUTH

pytestmark = pytest.mark.usefixtures("folder", "no_child")


def test_a_run_that_still_shows_it_needs_no_search() -> None:
    decided(lamp(), store(), [of("beam-violated")])
    engine, shining = NaiveEngine(), Block("Shining", [assign(BEAM, BEAM | GO)])
    edited = in_order(ON, *lamp().components, shining)
    [found] = decided(edited, store(), [of("beam-violated")], engine=engine, traces=True)
    assert engine.asked == [] and isinstance(found.verdict, Violated)
    trace = found.verdict.because
    assert isinstance(trace, Trace) and trace.breaks()
    assert len(trace) == 2, "one tick would do, which is not known"
    assert not trace.shortest


def test_a_run_is_told_up_to_where_it_shows_it() -> None:
    """With the beam after one tick, a run of three ticks reaches it in its second."""
    slow = never("slow", "", that=BEAM, covers=["R"], on=ON)
    held = replace(lamp(least=3), assume=PUSH)
    decided(held, store(), [slow])
    [found] = decided(replace(lamp(least=1), assume=PUSH), store(), [slow], engine=NaiveEngine())
    assert told([found]) == {"slow": ("violated", 1)}


def test_a_run_that_shows_it_no_longer_is_no_verdict() -> None:
    decided(lamp(), store())
    engine = NaiveEngine()
    dark = lamp(guard=GO & ~GO)
    found = told(decided(dark, store(), engine=engine))
    assert engine.asked and found["lit-violated"] == ("proved", None)
    assert found["lit-proved"] == ("violated", None)


def test_a_run_is_fitted_to_inputs_that_are_new_or_gone() -> None:
    decided(lamp(), store(), [of("lit-violated")])
    other = flag("other")
    engine = NaiveEngine()
    edited = lamp(guard=GO & ~other)
    assert told(decided(edited, store(), [of("lit-violated")], engine=engine)) == {
        "lit-violated": TRUTH["lit-violated"]
    }
    assert engine.asked == []


@pytest.mark.parametrize("passed", [None, var("passed", integer(30, 40, "ms"))])
def test_where_no_trace_is_asked_for_it_is_gone_through_as_well(passed: Var | None) -> None:
    """Also where ticks last unlike times."""
    edited = in_order(ON, *lamp(guard=GO & ~flag("other")).components, elapsed=passed)
    decided(in_order(ON, *lamp().components, elapsed=passed), store(), [of("lit-violated")])
    engine = NaiveEngine()
    [found] = decided(edited, store(), [of("lit-violated")], engine=engine)
    assert engine.asked == [] and isinstance(found.verdict, Violated)
    kept = found.verdict.because
    assert isinstance(kept, StoredRun) and not kept.shortest
    assert kept.total_ms == (
        sum(tick["passed"] for tick in kept.run.inputs) if passed is not None else len(kept) * 20
    )


def test_without_a_store_every_run_is_looked_for() -> None:
    decided(lamp(least=2), store())
    assert told(decided(lamp(least=1), None))["beam-violated"] == ("violated", 1)
    assert told(decided(lamp(least=2), store())) == TRUTH


X, Y = var("x", integer(0, 2)), var("y", integer(0, 5))


def counting(over: int) -> System:
    """Leaves a domain once ``y`` is that."""
    return in_order(
        ON,
        Block("Counting", [assign(Y, minimum(Y + 1, 5))]),
        Block("Over", [assign(X, ite(Y == over, X + 1, minimum(X, 1)))]),
    )


def test_that_a_model_leaves_a_domain_is_not_hidden_by_an_earlier_run() -> None:
    """An edit that lets a value grow: the property is still violated, the model has no meaning."""
    soon = never("soon", "", that=Y == 1, covers=["R"], on=ON)
    still = replace(counting(5), components=counting(5).components[:1])
    assert told(decided(still, store(), [soon])) == {"soon": ("violated", 1)}
    for engine in ("auto", "explicit"):
        decided(still, store(), [soon], engine=engine)
        with pytest.raises(ModelError, match=r"x := .* outside"):
            decided(counting(5), store(), [soon], engine=engine)


def test_a_run_without_end_is_gone_through_again(folder: Path) -> None:
    answered = leads_to("answered", "", trigger=PUSH, response=BEAM, covers=["R"], on=ON)
    [before] = decided(lamp(least=2), store(), [answered], engine="auto", traces=True)
    assert isinstance(before.verdict, Violated)
    engine = NaiveEngine()
    found = decided(lamp(least=3), store(), [answered], engine=engine, traces=True)
    assert [one.verdict.word for one in found] == ["violated"] and engine.asked == []
    trace = found[0].verdict.because  # type: ignore[union-attr]
    assert isinstance(trace, Trace) and trace.loop is not None


# --- proofs of a system that has more runs --------------------------------------------------------------


def loosely(least: int) -> dict[str, System]:
    """A system with more runs of the lamp, and the lamp itself."""
    real = replace(lamp(least=least), name="real")
    loose = replace(lamp(), over=True, concrete="real", assumptions=())
    return {ON: loose, "real": real}


def test_a_proof_of_a_system_with_more_runs_does_not_depend_on_the_one_it_stands_for() -> None:
    proof = always("few", "", that=var("count", integer(0, 3)) <= 3, covers=["R"], on=ON)
    run = of("beam-violated")
    decided(loosely(2), store(), [proof, run])
    engine = NaiveEngine()
    found = decided(loosely(3), store(), [proof], engine=engine)
    assert isinstance(found[0].verdict, Proved) and engine.asked == []
    found = decided(loosely(3), store(), [run], engine=engine)
    assert told(found) == {"beam-violated": ("violated", 3)}, "the run of before is too short"
    assert engine.asked
