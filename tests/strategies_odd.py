"""Random transition systems with what models seldom have, and engines may therefore get wrong.

Several goals, some of them equal, some read by the step and kept from tick to tick; domains with gaps and
with one value only; values assigned that may lie outside the domain; assumptions of several conjuncts
over the state, the inputs and the frozen variables, which may forbid every tick.
"""

from collections.abc import Sequence

from hypothesis import strategies as st
from hypothesis.strategies import DrawFn

from rovercheck.spec_model.lang.action import Assign
from rovercheck.spec_model.lang.domain import Bool, Num, chosen
from rovercheck.spec_model.lang.expr import TRUE, Apply, Const, Expr, Var, all_of
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.system import Statement, TransitionSystem
from tests.strategies_ts import DOMAINS, booleans, fitting, integers, programs

ODD = (*DOMAINS, chosen([4]), chosen([-3]), chosen([2, 3, 5]))


def _variables(draw: DrawFn, prefix: str, least: int, most: int) -> list[Var]:
    domains = [draw(st.sampled_from(ODD)) for _ in range(draw(st.integers(least, most)))]
    inits = [draw(st.sampled_from(list(domain.values))) for domain in domains]
    return [Var(f"{prefix}{i}", *at) for i, at in enumerate(zip(domains, inits, strict=True))]


def _straying(draw: DrawFn, var: Var, scope: Sequence[Var]) -> Expr:
    """A value that may lie outside the domain, often just beyond its end."""
    if not isinstance(var.sort, Num):
        return fitting(draw, var.domain, scope, 2)
    if draw(st.booleans()):
        return integers(draw, scope, 2)
    return Apply(Op.ADD, (var, Const(draw(st.sampled_from([1, 1, -1, 5])), Num())), Num())


def _assumed(draw: DrawFn, valuation: Sequence[Var], inputs: Sequence[Var]) -> Expr:
    """A conjunct; often an input is compared with a variable or a value, or fixed."""
    source = draw(st.sampled_from(inputs)) if inputs else None
    if source is None or draw(st.integers(0, 2)) == 0:
        return booleans(draw, [*valuation, *inputs], 2)
    same = [v for v in valuation if v.sort == source.sort]
    if draw(st.booleans()) and same:
        op = draw(st.sampled_from([Op.EQ, Op.NE, Op.LE] if isinstance(source.sort, Num) else [Op.EQ, Op.NE]))
        return Apply(op, (source, draw(st.sampled_from(same))), Bool())
    if isinstance(source.sort, Bool):
        return source if draw(st.booleans()) else ~source
    value = Const(draw(st.sampled_from(list(source.domain.values))), source.sort)
    return Apply(Op.EQ, (source, value), Bool())


def _goal(draw: DrawFn, goal: Var, goals: Sequence[Var], scope: Sequence[Var]) -> Assign:
    kind = draw(st.integers(0, 4))
    if kind == 0:
        return Assign(goal, draw(st.sampled_from(goals)))
    if kind == 1:
        return Assign(goal, goal | booleans(draw, scope, 2))
    return Assign(goal, all_of(*(booleans(draw, scope, 1) for _ in range(kind))))


@st.composite
def odd_systems(draw: DrawFn, *, strays: bool) -> TransitionSystem:
    """A random system whose goals are named ``goal0``, ``goal1``...; ``strays``: it may leave its domains."""
    variables, inputs = _variables(draw, "x", 1, 3), _variables(draw, "i", 0, 2)
    frozen = _variables(draw, "f", 0, 1)
    goals = [
        Var(f"goal{i}", DOMAINS[0], int(draw(st.integers(0, 5)) == 0)) for i in range(draw(st.integers(1, 3)))
    ]
    scope = [*variables, *inputs, *frozen, *goals]
    step: list[Statement] = list(programs(draw, [*variables, *goals], scope, 4))
    if strays:
        step += (Assign(v, _straying(draw, v, scope)) for v in variables if draw(st.booleans()))
    step += (_goal(draw, goal, goals, scope) for goal in goals if draw(st.integers(0, 4)))
    valuation = [*variables, *frozen]
    parts = [_assumed(draw, valuation, inputs) for _ in range(draw(st.sampled_from([0, 0, 1, 2, 3])))]
    assume = all_of(*parts) if parts else TRUE
    return TransitionSystem(
        "odd", tuple(inputs), tuple(frozen), (*variables, *goals), (), tuple(step), assume
    )
