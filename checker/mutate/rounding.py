"""Numbers of a part in fewer digits: whole numbers, tenths or hundredths where the charts compute exactly.

Such is firmware with an integer in place of a float, or with fixed-point numbers in one place.
"""

from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import replace
from fractions import Fraction
from functools import partial

from rovercheck.checker.mutate.rewrites import ASSIGNED, Rewrite, mapped
from rovercheck.spec_model.lang.action import Action, Assign, If
from rovercheck.spec_model.lang.chart import Block, Chart
from rovercheck.spec_model.lang.domain import Bool, Num
from rovercheck.spec_model.lang.edit import in_actions
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Var
from rovercheck.spec_model.lang.operators import COMPARISONS, Op

STEPS: Mapping[str, Fraction] = {
    "whole numbers": Fraction(1), "tenths": Fraction(1, 10), "hundredths": Fraction(1, 100)
}  # fmt: skip
COMPUTED = "where multiplied"
COMPUTING = frozenset({Op.ADD, Op.SUB, Op.MUL})


def rounded(part: Chart | Block) -> Iterator[Rewrite]:
    """Each measured number that a part reads, assigns or multiplies, in fewer digits wherever it does so.

    All that it assigns also together.
    """
    for digits, step in STEPS.items():
        for way, change in WAYS.items():
            to = f"{digits}, {way}"
            for var in part.read.values():
                if var.name not in part.written and _finer(var, step):
                    make = partial(mapped, part, partial(_read, var.name, step, change))
                    yield Rewrite("rounded read", f"signal/{var.name}", var.name, to, make)
            assigned = [var.name for var in part.written.values() if _finer(var, step)]
            for name in assigned:
                make = partial(_with_assigned, part, (name,), step, change)
                yield Rewrite("rounded assigned", f"everywhere {name}", name, to, make)
            if any(_multiplied(node, step) for node in _nodes(part)):
                make = partial(mapped, part, partial(_product, step, change))
                yield Rewrite("rounded products", COMPUTED, "products", to, make)
            if len(assigned) > 1:
                make = partial(_with_assigned, part, assigned, step, change)
                yield Rewrite("rounded together", ASSIGNED, " and ".join(assigned), to, make)


Round = Callable[[Expr, int], Expr]
"""A number in whole multiples of so many of its steps."""


def _down(number: Expr, step: int) -> Expr:
    return _apply(Op.DIV, number, Const(step, number.sort))


def _nearest(number: Expr, step: int) -> Expr:
    """The nearest one; of two as near that which is larger."""
    twice = _apply(Op.ADD, _apply(Op.MUL, number, Const(2, number.sort)), Const(step, number.sort))
    return _apply(Op.DIV, twice, Const(2 * step, number.sort))


def _even(number: Expr, step: int) -> Expr:
    """The nearest one; of two as near that which is even, as `round` does it."""
    nearest, half = _nearest(number, step), Const(step, number.sort)
    twice = _apply(Op.ADD, _apply(Op.MUL, number, Const(2, number.sort)), half)
    tie = _is(_apply(Op.MOD, twice, Const(2 * step, number.sort)), 0)
    odd = _is(_apply(Op.MOD, nearest, Const(2, number.sort)), 1)
    down = _apply(Op.SUB, nearest, Const(1, number.sort))
    return Apply(Op.ITE, (Apply(Op.AND, (tie, odd), Bool()), down, nearest), number.sort)


def _is(number: Expr, value: int) -> Expr:
    return Apply(Op.EQ, (number, Const(value, number.sort)), Bool())


def _toward_zero(how: Round, number: Expr, step: int) -> Expr:
    """The same for numbers below 0 as for those above, as a cast to an integer does it."""
    below = Apply(Op.LT, (number, Const(0, number.sort)), Bool())
    mirrored = _apply(Op.NEG, how(_apply(Op.NEG, number), step))
    return Apply(Op.ITE, (below, mirrored, how(number, step)), number.sort)


WAYS: Mapping[str, Round] = {
    "rounded": partial(_toward_zero, _nearest),
    "rounded to even": _even,
    "cut off": partial(_toward_zero, _down),
}


def _apply(op: Op, *args: Expr) -> Expr:
    return Apply(op, args, args[0].sort)


def _finer(number: Expr, step: Fraction) -> bool:
    """Whether a number has values between the multiples of a step."""
    if not isinstance(number.sort, Num):
        return False
    steps = step / number.sort.resolution
    between = isinstance(number, Var) and number.domain.dense
    return steps.denominator == 1 and (steps > 1 or (steps == 1 and between))


def _in_steps(number: Expr, step: Fraction, how: Round) -> Expr:
    assert isinstance(number.sort, Num)
    count = int(step / number.sort.resolution)
    return _apply(Op.MUL, how(number, count), Const(count, number.sort))


def _read(name: str, step: Fraction, how: Round, node: Expr) -> Expr:
    return _in_steps(node, step, how) if isinstance(node, Var) and node.name == name else node


def _multiplied(node: Expr, step: Fraction) -> bool:
    return isinstance(node, Apply) and node.op is Op.MUL and _finer(node, step)


def _product(step: Fraction, how: Round, node: Expr) -> Expr:
    return _in_steps(node, step, how) if _multiplied(node, step) else node


def _with_assigned(part: Chart | Block, names: Collection[str], step: Fraction, how: Round) -> Chart | Block:
    def act(action: Action) -> Action:
        match action:
            case Assign(var, value) if (
                var.name in names and not isinstance(value, Const) and _finer(value, step)
            ):
                return Assign(var, _in_steps(value, step, how))
            case If(condition, then, otherwise):
                return If(condition, tuple(map(act, then)), tuple(map(act, otherwise)))
        return action

    if isinstance(part, Block):
        return Block(part.name, tuple(map(act, part.do)), text=part.text, place=part.place)
    return in_actions(part, act)


def with_other_age(part: Chart | Block, age: Var, other: Var, alone: bool) -> Chart | Block:
    """The part with another datum in place of an age; unless ``alone``, only where it is computed with.

    Raises ``ModelError`` where that is nowhere.
    """
    found = False

    def held(node: Expr) -> Expr:
        match node:
            case Var(age.name):
                return other
            case Apply(Op.SCALE, (Var(age.name), by)):
                return replace(node, args=(other, by))
        return node

    def change(node: Expr) -> Expr:
        nonlocal found
        if not isinstance(node, Apply) or node.op not in (COMPUTING | COMPARISONS if alone else COMPUTING):
            return node
        args = tuple(map(held, node.args))
        same = all(a is b for a, b in zip(args, node.args, strict=True))
        found = found or (not same and node.op in COMPUTING)
        return node if same else replace(node, args=args)

    changed = mapped(part, change)
    if not found:
        raise ModelError(f"{part.name} does not compute with {age.name}.")
    return changed


def _nodes(part: Chart | Block) -> Iterator[Expr]:
    found: list[Expr] = []

    def note(node: Expr) -> Expr:
        found.append(node)
        return node

    mapped(part, note)
    yield from found


__all__ = ["rounded", "with_other_age"]
