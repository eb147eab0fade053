"""Every format, read back by a reader of its own, does in every tick what the system does."""

import random
from collections.abc import Callable, Sequence

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rovercheck.checker.export import Bad, Problem, exporters
from rovercheck.checker.export.names import identifiers, symbols
from rovercheck.checker.export.problem import LEAVES
from rovercheck.spec_model.lang.action import Assign
from rovercheck.spec_model.lang.domain import Bool, Domain, Num, chosen, integer
from rovercheck.spec_model.lang.evaluate import admissible, evaluate, step
from rovercheck.spec_model.lang.expr import Apply, Const, Var, flag
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.system import TransitionSystem
from tests.encode.test_bitvector import CASES, sort_of
from tests.export import read_aiger, read_btor2, read_smv
from tests.export.reading import Machine
from tests.profiles import examples
from tests.strategies_ts import goals, transition_systems

READERS: dict[str, Callable[[bytes], Machine]] = {
    "aiger": read_aiger.read,
    "aag": read_aiger.read,
    "btor2": read_btor2.read,
    "smv": read_smv.read,
}
FORMATS = sorted(READERS)


def asked(system: TransitionSystem, bad: Sequence[Var]) -> Problem:
    return Problem(
        "random", system, tuple(Bad(v, f"{v.name} is reached") for v in bad), ("a line for readers",)
    )


def exported(problem: Problem, format: str) -> bytes:
    data = exporters()[format].export(problem)
    return data.encode() if isinstance(data, str) else data


def bad_name(goal: str, format: str) -> str:
    """The name of the bad state in a file of that format."""
    bad = f"bad {goal}"
    return {"btor2": symbols([bad])[bad], "smv": identifiers([bad])[bad]}.get(format, goal)


def some(variables: Sequence[Var], seed: random.Random) -> dict[str, int]:
    return {v.name: seed.choice(list(v.domain.values)) for v in variables}


def beside(
    system: TransitionSystem, bad: Sequence[Var], machine: Machine, format: str, seed: random.Random
) -> None:
    """Run both with the same random inputs, admissible or not."""
    frozen = some(system.frozen, seed)
    before = {**system.init, **frozen}
    machine.start(frozen)
    for _ in range(8):
        inputs = some(system.inputs, seed)
        allowed, found = machine.tick(inputs)
        assert allowed == admissible(system, before, inputs)
        if allowed:
            before = step(system, before, inputs)
            assert {g.name: found[bad_name(g.name, format)] for g in bad} == {
                g.name: before[g.name] for g in bad
            }
            assert not found.get(bad_name(LEAVES, format), False)


@pytest.mark.parametrize("format", FORMATS)
@examples(60)
@given(transition_systems(), st.randoms(use_true_random=False))
def test_random_systems_tick_by_tick(format: str, system: TransitionSystem, seed: random.Random) -> None:
    wanted = goals(system)
    machine = READERS[format](exported(asked(system, wanted), format))
    for _ in range(3):
        beside(system, wanted, machine, format, seed)


@pytest.mark.parametrize("format", FORMATS)
@pytest.mark.parametrize("op", list(Op))
def test_every_operator(op: Op, format: str) -> None:
    seed = random.Random(op.value)
    for args in CASES[op]:
        expr = Apply(op, args, sort_of(op, args))
        inputs = tuple({a.name: a for a in args if isinstance(a, Var)}.values())
        is_truth = isinstance(expr.sort, Bool)
        wanted = Var(
            "wanted", Domain(expr.sort, range(2)) if is_truth else Domain(expr.sort, range(-1500, 1500))
        )
        same = flag("same")
        check = Assign(same, Apply(Op.EQ, (expr, wanted), Bool()))
        system = TransitionSystem("one operator", (*inputs, wanted), (), (same,), (), (check,))
        machine = READERS[format](exported(asked(system, (same,)), format))
        machine.start({})
        for _ in range(40):
            at = some(inputs, seed)
            value = evaluate(expr, at)
            for guess in {value, 1 - value if is_truth else value + 1}:
                allowed, bad = machine.tick({**at, "wanted": guess})
                assert allowed and bad[bad_name("same", format)] == (guess == value), (args, at, guess)


@pytest.mark.parametrize("format", FORMATS)
@pytest.mark.parametrize(
    ("domain", "by", "tick"),
    [
        (integer(0, 3), 1, 4),
        (integer(0, 4), 1, 5),
        (integer(-3, 0), -1, 4),
        (chosen([0, 1, 3]), 1, 2),
        (integer(0, 8), 3, 3),
    ],
)
def test_leaving_a_domain_is_a_bad_state_of_its_own(domain: Domain, by: int, tick: int, format: str) -> None:
    machine = READERS[format](exported(asked(counting(domain, by), (flag("seen"),)), format))
    machine.start({})
    left = [machine.tick({})[1][bad_name(LEAVES, format)] for _ in range(tick)]
    assert left == [False] * (tick - 1) + [True]


@pytest.mark.parametrize("format", FORMATS)
def test_a_comparison_that_no_value_of_the_domain_meets_hides_nobody_who_leaves(format: str) -> None:
    x, beyond = Var("x", integer(0, 3)), flag("beyond")
    count = Assign(x, Apply(Op.ADD, (x, Const(1, Num())), Num()))
    system = TransitionSystem("beyond", (), (), (x, beyond), (), (Assign(beyond, x > 3), count))
    machine = READERS[format](exported(asked(system, (beyond,)), format))
    machine.start({})
    found = [machine.tick({})[1][bad_name(LEAVES, format)] for _ in range(4)]
    assert found == [False, False, False, True]


@pytest.mark.parametrize("format", FORMATS)
def test_what_nothing_asks_for_is_cut_away(format: str) -> None:
    machine = READERS[format](exported(asked(counting(integer(0, 3), 1), (flag("never"),)), format))
    assert machine.bad == (bad_name("never", format),)


def counting(domain: Domain, by: int) -> TransitionSystem:
    """``x`` leaves its domain some time, which ``seen`` depends on and ``never`` does not."""
    x, seen, never = Var("x", domain), flag("seen"), flag("never")
    count = Assign(x, Apply(Op.ADD, (x, Const(by, Num())), Num()))
    statements = (count, Assign(seen, x == by), Assign(never, never))
    return TransitionSystem("counting", (), (), (x, seen, never), (), statements)
