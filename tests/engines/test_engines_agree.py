"""All engines on the same random systems: no two disagree, every run replays, every proof is certified.

The naive loop over the reference semantics is the judge; each engine works in this process.
"""

from collections.abc import Mapping

import pytest
from hypothesis import given

from rovercheck.checker.certify.certificate import certificates
from rovercheck.checker.certify.check import check
from rovercheck.checker.certify.outcome import Accepted
from rovercheck.checker.encode.native import OutsideDomain
from rovercheck.checker.engines import Limits, engines, quiet
from rovercheck.checker.process import isolate
from rovercheck.checker.results.verdict import Answer, Open, Reached, Unreachable
from rovercheck.spec_model.lang.system import TransitionSystem
from tests import naive
from tests.certifying import SOLVER
from tests.profiles import examples
from tests.strategies_timed import timed_systems
from tests.strategies_ts import goals, transition_systems
from tests.toys import GOAL, counter, overflowing, relay

COMPLETE = ("bdd", "explicit", "pdr")
"""Engines that leave nothing open."""


pytestmark = pytest.mark.usefixtures("engines_in_this_process")


def test_every_engine_is_compared() -> None:
    """And one more in the folder is compared, too."""
    assert set(engines()) >= {"bdd", "bmc", "explicit", "kinduction", "localisation", "pdr", "simulation"}


def test_no_engine_starts_a_child_here(monkeypatch: pytest.MonkeyPatch) -> None:
    """Most of them did, and the tests with random systems spent most of their time on it."""
    monkeypatch.setattr(isolate, "Child", None)
    agree(relay())
    agree(counter(3, top=5))


@pytest.mark.long
@examples(260)
@given(transition_systems())
def test_no_two_engines_disagree(system: TransitionSystem) -> None:
    agree(system)


@pytest.mark.long
@examples(90)
@given(transition_systems(most=5))
def test_nor_on_larger_systems(system: TransitionSystem) -> None:
    agree(system)


@pytest.mark.long
@examples(110)
@given(timed_systems())
def test_nor_on_charts_with_timers(system: TransitionSystem) -> None:
    agree(system)


def agree(system: TransitionSystem) -> None:
    """Every engine against the naive search; every run replayed, every proof certified."""
    asked = goals(system)
    judge = naive.search(system, asked)
    for name, engine in engines().items():
        found = engine.check(system, asked, Limits(depth=12 if name == "bmc" else None), quiet)
        assert set(found) == {g.name for g in asked}
        for goal, answer in found.items():
            expected = judge.reached.get(goal)
            if isinstance(answer, Open):
                assert name not in COMPLETE, (name, answer)
                assert expected is None or answer.depth < expected
            elif isinstance(answer, Reached):
                assert naive.replay(system, answer.run)[-1][goal]
                assert expected is not None and len(answer.run) >= expected
                assert not answer.shortest or len(answer.run) == expected
            else:
                assert expected is None, (name, goal)
        proved = {g: a for g, a in found.items() if isinstance(a, Unreachable)}
        certified(system, proved, name)


def certified(system: TransitionSystem, proved: Mapping[str, Answer], engine: str) -> None:
    """Every proof comes with a certificate, which a solver that no engine uses accepts."""
    made = certificates(system, [system.var(g) for g in proved], proved, engine)
    assert {goal for one in made for goal in one.claims} == set(proved), engine
    for one in made:
        outcome = check(one, system, SOLVER)
        assert isinstance(outcome, Accepted), (engine, one.claims, outcome)


@pytest.mark.parametrize("name", sorted(engines()))
def test_no_engine_proves_what_rests_on_a_value_outside_its_domain(name: str) -> None:
    """The goal compares with a value beyond the domain, so that simplification drops the variable."""
    system = overflowing(5)
    try:
        answer = engines()[name].check(system, [GOAL], Limits(depth=20), quiet)[GOAL.name]
    except OutsideDomain:
        return
    assert isinstance(answer, Open)
    assert "domain" in answer.reason or name == "simulation"  # which takes no tick that leaves one
