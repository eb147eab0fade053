"""Engines that work on formulas, on systems with what models seldom have (tests/strategies_odd.py)."""

from collections.abc import Mapping, Sequence

import pytest
from hypothesis import given

from rovercheck.checker.certify.certificate import certificates
from rovercheck.checker.certify.check import check
from rovercheck.checker.certify.outcome import Accepted
from rovercheck.checker.engines import Limits, engines, quiet
from rovercheck.checker.results.verdict import Answer, Open, Reached, Unreachable
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.system import TransitionSystem
from tests import naive
from tests.certifying import SOLVER
from tests.profiles import examples
from tests.strategies_odd import odd_systems
from tests.strategies_ts import goals

FORMULAS = ("bdd", "bmc", "kinduction", "pdr")


pytestmark = pytest.mark.usefixtures("engines_in_this_process")


def answers(name: str, system: TransitionSystem) -> Mapping[str, Answer]:
    """What an engine says of the goals; its runs replay, and its proofs are accepted."""
    found = engines()[name].check(system, goals(system), Limits(depth=9 if name == "bmc" else None), quiet)
    for goal, answer in found.items():
        if isinstance(answer, Reached):
            assert naive.replay(system, answer.run)[-1][goal], (name, goal)
    proved = {goal: answer for goal, answer in found.items() if isinstance(answer, Unreachable)}
    for made in certificates(system, [system.var(g) for g in proved], proved, name):
        outcome = check(made, system, SOLVER)
        assert isinstance(outcome, Accepted), (name, made.claims, outcome)
    return found


def reached_inside(system: TransitionSystem, wanted: Sequence[Var]) -> dict[str, int]:
    """The least number of ticks to each goal along runs that leave no domain."""
    frontier = [{**system.init, **frozen} for frozen in naive.vectors(system.frozen)]
    seen = {tuple(at.items()) for at in frontier}
    names, found, depth = list(frontier[0]), dict[str, int](), 0
    while frontier:
        depth += 1
        after = [{n: x[n] for n in names} for at in frontier for x in naive.successors(system, at)]
        inside = [at for at in after if all(at[v.name] in v.domain for v in system.variables)]
        for at in inside:
            for goal in wanted:
                if at[goal.name]:
                    found.setdefault(goal.name, depth)
        new = {tuple(at.items()): at for at in inside}
        frontier = [at for key, at in new.items() if key not in seen]
        seen.update(new)
    return found


@pytest.mark.parametrize("name", FORMULAS)
@examples(40)
@given(system=odd_systems(strays=False))
def test_where_every_value_fits(name: str, system: TransitionSystem) -> None:
    """The naive search is the judge, also of the lengths of runs and the depths of what is left open."""
    least = naive.search(system, goals(system)).reached
    for goal, answer in answers(name, system).items():
        match answer:
            case Reached(run, shortest):
                assert len(run) == least[goal] or (not shortest and len(run) > least[goal])
            case Unreachable():
                assert goal not in least
            case Open(_, depth):
                assert name in ("bmc", "kinduction") and least.get(goal, depth + 1) > depth


@pytest.mark.parametrize("name", FORMULAS)
@examples(40)
@given(system=odd_systems(strays=True))
def test_where_values_may_not_fit(name: str, system: TransitionSystem) -> None:
    """Nothing is proved, and no depth claimed, against a run that leaves no domain."""
    least = reached_inside(system, goals(system))
    for goal, answer in answers(name, system).items():
        assert goal not in least or not isinstance(answer, Unreachable)
        assert goal not in least or not isinstance(answer, Open) or answer.depth < least[goal]
