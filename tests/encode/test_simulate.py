"""Random runs are runs of the system, and formulas on arrays mean what the reference says."""

import numpy as np
from hypothesis import assume, given
from hypothesis import strategies as st

from rovercheck.checker.encode.cone import cone
from rovercheck.checker.encode.simulate import Simulator, Trail
from rovercheck.checker.encode.symbolic import transition
from rovercheck.checker.encode.unrolling import Outside
from rovercheck.checker.system.arrays import ArrayProgram, column
from rovercheck.spec_model.lang.action import Assign
from rovercheck.spec_model.lang.domain import Bool, Num, chosen
from rovercheck.spec_model.lang.evaluate import evaluate
from rovercheck.spec_model.lang.expr import Apply, Const, var
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.system import TransitionSystem
from tests import naive
from tests.profiles import examples
from tests.strategies_ts import transition_systems
from tests.toys import GOAL, counter, overflowing, relay


def simulated(system: TransitionSystem, ticks: int, seed: int = 0) -> Trail:
    part = cone(transition(system), [v.name for v in system.variables])
    simulator = Simulator(part, lanes=8, seed=seed)
    return simulator.run(simulator.start(), ticks)


@given(transition_systems(), st.integers(0, 7))
def test_every_random_run_is_a_run(system: TransitionSystem, lane: int) -> None:
    part = cone(transition(system), [v.name for v in system.variables])
    outside = Outside(system, part)
    assume(outside.possible)
    trail = simulated(system, 12)
    after = naive.replay(system, outside.complete(trail.extract(12, lane, [v.name for v in part.frozen])))
    last = {name: int(values[lane]) for name, values in trail.states[-1].items()}
    assert not after or last.items() <= after[-1].items()


@examples(50)
@given(transition_systems())
def test_formulas_on_arrays(system: TransitionSystem) -> None:
    """The next values of all variables, against the reference, in many states at once."""
    exprs = list(transition(system).next.values())
    everything = (*system.variables, *system.inputs, *system.frozen)
    random = np.random.default_rng(0)
    places = [{v.name: int(random.choice(v.domain.values)) for v in everything} for _ in range(20)]
    columns = {v.name: column(v, [at[v.name] for at in places]) for v in everything}
    for expr, values in zip(exprs, ArrayProgram(exprs)(columns), strict=True):
        found = np.broadcast_to(values, len(places)).tolist()
        assert [int(f) for f in found] == [evaluate(expr, at) for at in places]


def test_formulas_without_variables_are_exact() -> None:
    """Of products of single values numpy would keep 64 bits."""
    large = Const(1 << 40, Num())
    square = Apply(Op.MUL, (large, large), Num())
    power = Apply(Op.MUL, (square, square), Num())
    assert [int(found) for found in ArrayProgram([power])({})] == [1 << 160]
    bit = Apply(Op.BIT, (Apply(Op.MUL, (power, large), Num()), Const(200, Num())), Bool())
    assert [bool(found) for found in ArrayProgram([bit])({})] == [True]


def test_the_first_run_to_a_goal() -> None:
    trail = simulated(counter(3, top=9), 60)
    hit = trail.first(GOAL.name)
    assert hit is not None
    run = trail.extract(*hit, [])
    assert len(run) == hit[0] and naive.replay(counter(3, top=9), run)[-1]["goal"] == 1
    assert simulated(relay(), 200).first(GOAL.name) is None


def test_timers_of_hundreds_of_ticks_fill() -> None:
    trail = simulated(counter(300, top=300), 1500)
    assert trail.first(GOAL.name) is not None


def test_a_tick_that_must_not_be_is_not_taken() -> None:
    system = overflowing(5)
    part = cone(transition(system), ["count"])
    beyond = part.next["count"] > 5
    simulator = Simulator(part, [beyond], lanes=8)
    assert simulator.run(simulator.start(), 100).samples()["count"].max() == 5


def test_no_tick_is_taken_where_no_value_of_an_input_is_allowed() -> None:
    """The only value that the assumption allows lies in a gap of the domain."""
    noise = var("noise", chosen([3, 5, 40]))
    step = (Assign(GOAL, noise < 40),)
    system = TransitionSystem("gap", (noise,), (), (GOAL,), (), step, noise == 4)
    simulator = Simulator(cone(transition(system), [GOAL.name]), lanes=8)
    trail = simulator.run(simulator.start(), 20)
    assert trail.first(GOAL.name) is None and not np.any(trail.moved)


def test_runs_can_be_repeated() -> None:
    one, two, other = (simulated(relay(), 50, seed).samples() for seed in (0, 0, 1))
    assert all((one[name] == two[name]).all() for name in one)
    assert any((one[name] != other[name]).any() for name in one)


def test_blocks_and_samples_hold_every_valuation() -> None:
    trail = simulated(relay(), 70)
    blocks = list(trail.blocks())
    assert sum(len(block["since"]) for block in blocks) == len(trail.samples()["since"]) - 8 == 71 * 8
