"""Bit-vectors mean what ``evaluate`` means, for every operator and every small value."""

from itertools import product

import pytest
import z3
from hypothesis import given

from rovercheck.checker.encode.bitvector import Encoder, literal, member, symbol, value, width
from rovercheck.checker.system.intervals import Interval, intervals
from rovercheck.spec_model.lang.domain import Bool, Domain, Num, Sort, boolean, chosen, enumeration, integer
from rovercheck.spec_model.lang.evaluate import evaluate
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Var, ite
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.system import TransitionSystem
from rovercheck.spec_model.lang.walk import variables
from tests.profiles import examples
from tests.strategies_ts import transition_systems

B0, B1, B2 = (Var(f"b{i}", boolean) for i in range(3))
X, Y, Z = Var("x", integer(-5, 6)), Var("y", integer(-3, 4)), Var("z", integer(0, 9))
TRUTHS, NUMBERS = (B0, B1, B2), (X, Y)
DIVISORS = [Const(n, Num()) for n in range(1, 8)]
COMPARED: list[tuple[Expr, ...]] = [(X, Y), (Y, X), (X, Const(3, Num())), (Const(-9, Num()), Y), (Z, X)]

CASES: dict[Op, list[tuple[Expr, ...]]] = {
    Op.NOT: [(B0,)],
    Op.AND: [(B0, B1), TRUTHS, (B0,)],
    Op.OR: [(B0, B1), TRUTHS, (B0,)],
    Op.ITE: [(B0, X, Z), (B0, B1, B2), (B0, Const(70, Num()), Y)],
    Op.EQ: [*COMPARED, (B0, B1)],
    Op.NE: [*COMPARED, (B0, B1)],
    Op.LT: COMPARED,
    Op.LE: COMPARED,
    Op.GT: COMPARED,
    Op.GE: COMPARED,
    Op.ADD: COMPARED,
    Op.SUB: COMPARED,
    Op.NEG: [(X,), (Z,)],
    Op.MUL: COMPARED,
    Op.SCALE: [(X, d) for d in DIVISORS],
    Op.DIV: [(v, d) for v in (X, Z) for d in (*DIVISORS, Const(100, Num()))],
    Op.MOD: [(v, d) for v in (X, Z) for d in (*DIVISORS, Const(100, Num()))],
    Op.ABS: [(X,), (Z,)],
    Op.MIN: COMPARED,
    Op.MAX: COMPARED,
    Op.BIT: [(v, Const(i, Num())) for v in (Z, X) for i in range(6)],
}
TRUTH_VALUED = {Op.NOT, Op.AND, Op.OR, Op.EQ, Op.NE, Op.LT, Op.LE, Op.GT, Op.GE, Op.BIT}


def sort_of(op: Op, args: tuple[Expr, ...]) -> Sort:
    return Bool() if op in TRUTH_VALUED else args[-1].sort


def at_every_value(expr: Expr, over: tuple[Var, ...]) -> None:
    """Compare the simplified term with the evaluator, everywhere."""
    symbols = {v.name: symbol(v, v.name) for v in over}
    term = Encoder(symbols)(expr)
    for values in product(*(v.domain.values for v in over)):
        at = {v.name: x for v, x in zip(over, values, strict=True)}
        pairs = [(symbols[v.name], literal(at[v.name], v.sort, width(v.domain))) for v in over]
        assert value(z3.simplify(z3.substitute(term, *pairs))) == evaluate(expr, at), (expr, at)


@pytest.mark.parametrize("op", list(Op))
def test_every_operator(op: Op) -> None:
    for args in CASES[op]:
        at_every_value(Apply(op, args, sort_of(op, args)), tuple(a for a in args if isinstance(a, Var)))


def test_results_are_as_narrow_as_their_interval() -> None:
    expr = ((X * Y + 100) * 7) - Z
    term = Encoder({v.name: symbol(v, v.name) for v in (X, Y, Z)})(expr)
    assert term.size() == intervals(expr)[id(expr)].width
    at_every_value(expr, (X, Y, Z))


def test_a_constant_meets_a_narrow_variable() -> None:
    at_every_value(ite(X > 1000, Z, Const(-700, Num())) == Y, (X, Y, Z))


@pytest.mark.parametrize(
    "domain",
    [
        boolean,
        Domain(Bool(), range(1, 2)),
        integer(0, 0),
        integer(-3, 12),
        integer(0, 7),
        integer(-8, 7),
        chosen([-7, 0, 1, 30]),
        enumeration("E", {"A": 2, "B": 3, "C": 7}),
        integer(5, 9),
    ],
)
def test_a_member_of_the_domain_is_what_the_constraints_allow(domain: Domain) -> None:
    var = Var("v", domain, domain.low)
    term, solver = symbol(var, "v"), z3.SolverFor("QF_BV")
    solver.add(*member(term, domain))
    found = set()
    while solver.check() == z3.sat:
        model = solver.model().eval(term, True)
        found.add(value(model))
        solver.add(term != model)
    assert found == set(domain.values)


@pytest.mark.parametrize(
    ("low", "high", "bits"),
    [(0, 0, 1), (0, 1, 2), (-1, 0, 1), (-2, 1, 2), (-3, 0, 3), (0, 127, 8), (-128, 5, 8), (128, 128, 9)],
)
def test_width(low: int, high: int, bits: int) -> None:
    assert Interval(low, high).width == bits


@examples(60)
@given(transition_systems(most=2))
def test_the_formulas_of_random_systems(system: TransitionSystem) -> None:
    at_every_value(system.assume, tuple(variables(system.assume).values()))
