"""Circuits mean what ``evaluate`` means: every operator at every small value, random systems tick by tick."""

import random
from collections.abc import Mapping, Sequence
from itertools import product

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rovercheck.checker.encode.bits import FALSE, TRUE, Aig, Bit, Blaster, Circuit, circuit
from rovercheck.checker.encode.bits.aig import bits_of
from rovercheck.checker.encode.bits.blast import as_word, bits_needed, value_of
from rovercheck.spec_model.lang.domain import Bool
from rovercheck.spec_model.lang.evaluate import admissible, evaluate, step
from rovercheck.spec_model.lang.expr import Apply, Expr, Var
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.system import TransitionSystem
from tests.encode.test_bitvector import CASES, sort_of
from tests.profiles import examples
from tests.strategies_ts import goals, transition_systems


def blasted(expr: Expr, over: Sequence[Var]) -> tuple[Aig, dict[str, list[int]], list[int]]:
    """The graph, the inputs of each variable, and the value of the formula."""
    aig = Aig()
    bits = {v.name: [aig.input() for _ in range(bits_needed(v))] for v in over}
    return aig, bits, Blaster(aig, {v.name: as_word(v, bits[v.name]) for v in over})(expr)


def at_every_value(expr: Expr, over: Sequence[Var]) -> None:
    aig, bits, word = blasted(expr, over)
    for values in product(*(v.domain.values for v in over)):
        at = {v.name: raw for v, raw in zip(over, values, strict=True)}
        given_bits = {
            i >> 1: b for n, own in bits.items() for i, b in zip(own, bits_of(at[n], 64), strict=False)
        }
        found = [w & 1 for w in aig.evaluate(word, given_bits)]
        value = found[0] if isinstance(expr.sort, Bool) else value_of(found)
        assert value == evaluate(expr, at), (expr, at)


@pytest.mark.parametrize("op", list(Op))
def test_every_operator(op: Op) -> None:
    for args in CASES[op]:
        at_every_value(Apply(op, args, sort_of(op, args)), [a for a in args if isinstance(a, Var)])


def some(variables: Sequence[Var], seed: random.Random) -> dict[str, int]:
    return {v.name: seed.choice(list(v.domain.values)) for v in variables}


def literals(bits: Sequence[Bit], at: Mapping[str, int]) -> dict[int, int]:
    """The value of every bit, by node."""
    return {b.literal >> 1: at[b.var.name] >> b.number & 1 for b in bits}


def values(made: Circuit, at: Mapping[str, int]) -> dict[int, int]:
    return literals([*(latch.bit for latch in made.latches), *made.inputs, *made.others], at)


def true(made: Circuit, literal: int, at: Mapping[str, int]) -> bool:
    return bool(made.aig.evaluate([literal], values(made, at))[0] & 1)


@examples(400)
@given(transition_systems(), st.randoms(use_true_random=False))
def test_random_systems_tick_by_tick(system: TransitionSystem, seed: random.Random) -> None:
    made = circuit(system, [g.name for g in goals(system)])
    before = {**system.init, **some(system.frozen, seed)}
    for _ in range(8):
        at = before | some(system.inputs, seed)
        inputs = {v.name: at[v.name] for v in system.inputs}
        allowed = true(made, made.assume, at) and true(made, made.loose, at)
        assert allowed == admissible(system, before, inputs)
        assert true(made, made.within, at) and true(made, made.start, at)
        assert not true(made, made.leaves, at)
        if not allowed:
            continue
        after = step(system, before, inputs)
        for latch in made.latches:
            assert true(made, latch.next, at) == after[latch.bit.var.name] >> latch.bit.number & 1
        for name, literal in made.goals.items():
            assert true(made, literal, at) == after[name]
        before = {**before, **after}


@given(transition_systems())
def test_initial_values_are_those_of_the_system(system: TransitionSystem) -> None:
    made = circuit(system, [g.name for g in goals(system)])
    frozen = {v.name for v in system.frozen}
    for latch in made.latches:
        name, number = latch.bit.var.name, latch.bit.number
        expected = None if name in frozen else system.init[name] >> number & 1
        assert latch.init == expected


@given(transition_systems(), st.randoms(use_true_random=False))
def test_runs_are_read_back_from_bits(system: TransitionSystem, seed: random.Random) -> None:
    made = circuit(system, [g.name for g in goals(system)])
    frozen, inputs = some(system.frozen, seed), some(system.inputs, seed)
    still = literals([latch.bit for latch in made.latches], {**system.init, **frozen})
    moving = literals([*made.inputs, *made.others], inputs)
    run = made.run({2 * n: b for n, b in still.items()}, [{2 * n: b for n, b in moving.items()}])
    assert run.inputs == (inputs,)
    kept = {latch.bit.var.name for latch in made.latches}
    assert all(run.frozen[n] == frozen[n] for n in frozen if n in kept)


def test_constants_fold() -> None:
    aig = Aig()
    a, b = aig.input(), aig.input()
    assert aig.both(a, a ^ 1) == FALSE and aig.both(a, TRUE) == a and aig.either(a, a ^ 1) == TRUE
    assert aig.both(a, b) == aig.both(b, a) and aig.differ(a, a) == FALSE and aig.differ(a, a ^ 1) == TRUE
    assert aig.mux(a, b, b) == b and aig.all([]) == TRUE and aig.any([]) == FALSE
