"""Candidates hold in the sample they are made from; what excludes a cube is false in all of it."""

import numpy as np
import pytest
from hypothesis import given

from rovercheck.checker.encode.cone import Slice, cone
from rovercheck.checker.encode.invariants import Candidates, TemplateCube, TemplatePool
from rovercheck.checker.encode.simulate import Simulator
from rovercheck.checker.encode.symbolic import transition
from rovercheck.checker.system.arrays import ArrayProgram, Columns
from rovercheck.spec_model.lang.evaluate import evaluate
from rovercheck.spec_model.lang.expr import Expr
from rovercheck.spec_model.lang.system import TransitionSystem
from tests.profiles import examples
from tests.strategies_ts import transition_systems
from tests.toys import counter, relay, waiting


def sampled(system: TransitionSystem, ticks: int = 200) -> tuple[Slice, Columns]:
    part = cone(transition(system), [v.name for v in system.variables])
    simulator = Simulator(part, lanes=16)
    return part, simulator.run(simulator.start(), ticks).samples()


def everything(candidates: Candidates) -> list[Expr]:
    made = (candidates.ranges(), candidates.exclusions(), candidates.ranges_under(), candidates.relations())
    return [candidate for template in made for candidate in template]


@examples(50)
@given(transition_systems())
def test_every_candidate_holds_in_the_sample(system: TransitionSystem) -> None:
    part, sample = sampled(system, 30)
    made = everything(Candidates(part, sample))
    assert all(np.all(holds) for holds in ArrayProgram(made)(sample))


@pytest.mark.parametrize(
    ("system", "expected"),
    [
        (counter(3, top=9), "!goal || count <= 3"),
        (waiting(), "place <= 1"),
        (relay(9), "on || since == 9"),
        (relay(9), "!on || since - hold <= 0"),
        (relay(9), "hold - since <= 0"),
    ],
)
def test_templates(system: TransitionSystem, expected: str) -> None:
    part, sample = sampled(system)
    texts = {str(candidate) for candidate in everything(Candidates(part, sample))}
    assert expected in texts


def test_a_clause_that_excludes_a_cube() -> None:
    part, sample = sampled(relay(9))
    never = TemplateCube({"on": 1, "hold": 5, "since": 3, "goal": 0}, frozenset({"on", "hold", "since"}))
    clause = Candidates(part, sample).excluding(never, np.random.default_rng(0))
    assert clause is not None and not evaluate(clause, never.valuation)
    assert np.all(ArrayProgram([clause])(sample)[0])


def test_a_cube_that_runs_visit_is_not_excluded() -> None:
    part, sample = sampled(relay(9))
    seen = TemplateCube({"on": 1, "hold": 3, "since": 3, "goal": 0}, frozenset({"on", "hold", "since"}))
    assert Candidates(part, sample).excluding(seen, np.random.default_rng(0)) is None


def test_a_pool_gives_each_candidate_once() -> None:
    part, sample = sampled(relay(9))
    pool = TemplatePool(everything(Candidates(part, sample)))
    size = len(pool)
    cube = TemplateCube({"on": 1, "hold": 5, "since": 3, "goal": 0}, frozenset({"on", "hold", "since"}))
    taken = pool.take(cube)
    assert taken and not any(evaluate(candidate, cube.valuation) for candidate in taken)
    assert pool.take(cube) == [] and len(pool) == size - len(taken)
    assert len(pool.rest()) == size - len(taken) and len(pool) == 0
