"""Random systems whose goals tell apart more values of an input than what is kept from tick to tick.

What is kept asks of an input only whether it is above a bound; goals ask for single values, before or
after what they read is overwritten.  The assumption may link inputs, statements may lie in branches.
"""

from hypothesis import strategies as st
from hypothesis.strategies import DrawFn

from rovercheck.spec_model.lang.action import Assign, If
from rovercheck.spec_model.lang.domain import Bool, Num, chosen, integer
from rovercheck.spec_model.lang.expr import TRUE, Apply, Const, Expr, Var, all_of, any_of, flag
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.system import Statement, TransitionSystem
from tests.strategies_ts import MODE

INPUTS = (integer(0, 4), integer(-2, 2), chosen([-7, 0, 1, 30]), MODE)


def _compared(draw: DrawFn, source: Var, ops: list[Op]) -> Expr:
    value = Const(draw(st.sampled_from(list(source.domain.values))), source.sort)
    op = draw(st.sampled_from(ops)) if isinstance(source.sort, Num) else Op.EQ
    return Apply(op, (source, value), Bool())


def _condition(draw: DrawFn, inputs: list[Var], kept: list[Var], ops: list[Op]) -> Expr:
    """Up to three parts, each about an input or what is kept, joined by "and" or "or"."""
    parts = [
        _compared(draw, draw(st.sampled_from(inputs)), ops)
        if draw(st.integers(0, 2))
        else draw(st.sampled_from(kept))
        for _ in range(draw(st.integers(1, 3)))
    ]
    return draw(st.sampled_from([all_of, any_of]))(*parts)


def _in_a_branch(draw: DrawFn, statement: Assign, inputs: list[Var], kept: list[Var]) -> Statement:
    """The statement, or it in a branch whose condition may read an input."""
    kind = draw(st.integers(0, 3))
    if kind == 0:
        return If(_condition(draw, inputs, kept, [Op.LE]), (statement,))
    if kind == 1:
        other = Assign(statement.var, draw(st.sampled_from(kept)))
        return If(draw(st.sampled_from(kept)), (statement,), (other,))
    return statement


@st.composite
def staged_systems(draw: DrawFn) -> TransitionSystem:
    """A random system of one to three inputs, flags that are kept, a temporary and one to three goals."""
    domains = [draw(st.sampled_from(INPUTS)) for _ in range(draw(st.integers(1, 3)))]
    inputs = [Var(f"i{n}", domain, domain.low) for n, domain in enumerate(domains)]
    kept = [flag(f"x{n}") for n in range(draw(st.integers(1, 3)))]
    wanted, near = [flag(f"goal{n}") for n in range(draw(st.integers(1, 3)))], flag("near")
    fine = [Op.EQ, Op.NE, Op.LE]
    step: list[Statement] = [
        _in_a_branch(draw, Assign(v, _condition(draw, inputs, kept, [Op.LE])), inputs, kept) for v in kept
    ]
    last: list[Statement] = [
        _in_a_branch(draw, Assign(g, _condition(draw, inputs, [*kept, near], fine)), inputs, kept)
        for g in wanted
    ]
    for statement in last:  # some goals before what they read is overwritten
        step.insert(draw(st.integers(0, len(step))) if draw(st.booleans()) else len(step), statement)
    step.insert(0, Assign(near, _condition(draw, inputs, kept, fine)))
    linked = [_condition(draw, inputs, kept, fine) for _ in range(draw(st.sampled_from([0, 0, 1, 2])))]
    return TransitionSystem(
        "staged",
        tuple(inputs),
        (),
        (*kept, *wanted),
        (near,),
        tuple(step),
        all_of(*linked) if linked else TRUE,
    )
