"""Formulas as a person writes them: the same values, without what lowering needs and a reader does not."""

from collections.abc import Callable, Mapping, Sequence

from rovercheck.checker.drawn.charts.masks import bit_of_sum, mask_terms, masked
from rovercheck.checker.drawn.lower.symbols import folded
from rovercheck.spec_model.lang.action import Action, Assign, If
from rovercheck.spec_model.lang.domain import Bool, Enum, Num, Sort
from rovercheck.spec_model.lang.expr import (
    FALSE,
    TRUE,
    Apply,
    Const,
    Expr,
    Named,
    Temporal,
    all_of,
    any_of,
    const,
)
from rovercheck.spec_model.lang.operators import COMPARISONS, Op
from rovercheck.spec_model.lang.walk import plain, structure

_OPPOSITE = {Op.EQ: Op.NE, Op.NE: Op.EQ, Op.LT: Op.GE, Op.GE: Op.LT, Op.GT: Op.LE, Op.LE: Op.GT}


def tidied(expr: Expr) -> Expr:
    """A formula with the same value in every state.

    >>> from rovercheck.spec_model.lang.expr import flag, ite
    >>> str(tidied(ite(flag("door"), 1, 0) > 0))
    'door'
    """
    match expr:
        case Named(name, body):
            made = tidied(body)
            return expr if made is body else Named(name, made)
        case Temporal(when, arg, span, strict) if arg is not None:
            return Temporal(when, tidied(arg), span, strict)
        case Apply(Op.ADD, _, sort):
            return _sum([tidied(one) for one in _terms(expr)], sort)
        case Apply(op, args, sort):
            inner = folded(Apply(op, tuple(map(tidied, args)), sort))
            if not isinstance(inner, Apply):
                return inner
            return RULES.get(inner.op, _as_it_is)(inner)
    return expr


def tidied_actions(actions: tuple[Action, ...]) -> tuple[Action, ...]:
    """The same of all formulas in actions."""
    return tuple(map(_action, actions))


def _action(action: Action) -> Action:
    match action:
        case Assign(var, value):
            return Assign(var, tidied(value))
        case If(condition, then, otherwise):
            return If(tidied(condition), tidied_actions(then), tidied_actions(otherwise))
    return action


# --- rules: each takes an operator whose operands are tidy -------------------------------------------------


def _as_it_is(expr: Apply) -> Expr:
    return expr


def _joined(expr: Apply) -> Expr:
    return all_of(*expr.args) if expr.op is Op.AND else any_of(*expr.args)


def _negated(expr: Apply) -> Expr:
    [inner] = expr.args
    if isinstance(inner, Apply) and inner.op in _OPPOSITE and not _asks_for_state(inner):
        return Apply(_OPPOSITE[inner.op], inner.args, inner.sort)
    return expr


def _asks_for_state(expr: Apply) -> bool:
    """Whether a comparison asks which state is active, as ``in(...)`` of a label does."""
    sort = expr.args[0].sort
    return isinstance(sort, Enum) and (sort.name.startswith("states of ") or sort.name == "Entered")


def _choice(expr: Apply) -> Expr:
    test, then, other = expr.args
    if not isinstance(expr.sort, Bool):
        return expr
    if structure(test) == structure(other):
        return all_of(test, then)
    if structure(test) == structure(then):
        return any_of(test, other)
    if isinstance(then, Const):
        return any_of(test, other) if then.value else all_of(tidied(~test), other)
    if isinstance(other, Const):
        return any_of(tidied(~test), then) if other.value else all_of(test, then)
    return expr


def _terms(expr: Expr) -> list[Expr]:
    """What a sum is made of."""
    if isinstance(expr, Apply) and expr.op is Op.ADD:
        return [term for one in expr.args for term in _terms(one)]
    return [expr]


def _sum(terms: Sequence[Expr], sort: Sort) -> Expr:
    left = [one for one in terms if not (isinstance(one, Const) and one.value == 0)] or terms[:1]
    total, *others = left
    for one in others:
        total = folded(Apply(Op.ADD, (total, one), sort))
    return masked(total) if isinstance(total, Apply) else total


def _compared(expr: Apply) -> Expr:
    """A number that is one of two constants, or a sum of bits, beside a constant."""
    one, other = expr.args
    body = plain(one)
    if not isinstance(other, Const) or not isinstance(body, Apply):
        return expr
    if body.op is Op.ITE and all(isinstance(arg, Const) for arg in body.args[1:]):
        then, otherwise = (folded(Apply(expr.op, (arg, other), Bool())) for arg in body.args[1:])
        return tidied(folded(_choice_of(body.args[0], then, otherwise)))
    if body.op is Op.MUL and isinstance(body.args[1], Const) and body.args[1].value > 0 and not other.value:
        return Apply(expr.op, (body.args[0], const(0)), Bool())
    terms = mask_terms(body)
    if terms and not other.value and expr.op in (Op.NE, Op.GT, Op.EQ):
        some = any_of(*(condition for condition, _ in terms))
        return some if expr.op is not Op.EQ else folded(~some)
    return expr


def _choice_of(test: Expr, then: Expr, otherwise: Expr) -> Expr:
    if isinstance(then, Const) and isinstance(otherwise, Const):
        if then.value == otherwise.value:
            return TRUE if then.value else FALSE
        return test if then.value else folded(~test)
    return Apply(Op.ITE, (test, then, otherwise), Bool())


def _quotient(expr: Apply) -> Expr:
    """A quotient of a fraction, rounded down, as one of whole numbers."""
    value, by = expr.args
    assert isinstance(value.sort, Num)
    if value.sort.resolution == 1:
        return expr
    whole = _in_steps(value)
    return expr if whole is None else tidied(Apply(Op.DIV, (whole, by), expr.sort))


def _in_steps(expr: Expr) -> Expr | None:
    """How many steps of its resolution a number is, as a formula of whole numbers."""
    assert isinstance(expr.sort, Num)
    if isinstance(expr, Const):
        return Const(expr.value, Num())
    if expr.sort.resolution == 1:
        return expr
    if not isinstance(expr, Apply):
        return None
    args = expr.args
    if expr.op is Op.ITE:
        some = [_in_steps(arg) for arg in args[1:]]
        return None if None in some else Apply(Op.ITE, (args[0], *filter(None, some)), Num())
    some = [_in_steps(arg) for arg in args]
    found = [one for one in some if one is not None]
    if len(found) < len(some):
        return None
    if expr.op is Op.SCALE:
        return folded(Apply(Op.MUL, tuple(found), Num()))
    if expr.op is Op.MUL:
        found = [one for one in found if not (isinstance(one, Const) and one.value == 1)]
        return found[0] if len(found) == 1 else folded(Apply(Op.MUL, tuple(found), Num()))
    if expr.op in (Op.ADD, Op.SUB, Op.NEG, Op.MIN, Op.MAX, Op.ABS, Op.MOD):
        return folded(Apply(expr.op, tuple(found), Num()))
    return None


RULES: Mapping[Op, Callable[[Apply], Expr]] = {
    Op.AND: _joined, Op.OR: _joined, Op.NOT: _negated, Op.ITE: _choice, Op.BIT: bit_of_sum,
    Op.DIV: _quotient, **dict.fromkeys(COMPARISONS, _compared),
}  # fmt: skip

__all__ = ["tidied", "tidied_actions"]
