"""Slips of one place of a formula: an operator, a limit, a time, a member, a bit, a part that is missing."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from fractions import Fraction

from rovercheck.spec_model.lang.domain import Bool, Enum, Num
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Named, Temporal, When
from rovercheck.spec_model.lang.operators import COMPARISONS, Op
from rovercheck.spec_model.lang.time import Span

BESIDE = {Op.LT: Op.LE, Op.LE: Op.LT, Op.GT: Op.GE, Op.GE: Op.GT, Op.EQ: Op.NE, Op.NE: Op.EQ}
"""The comparison that is written for another by mistake."""
TIMED = (When.AFTER, When.DURATION, When.HELD)
_NUMBERS = COMPARISONS | {Op.ADD, Op.SUB, Op.MIN, Op.MAX}
"""Operators whose constants may be off by one step; a factor or divisor is none of them."""


@dataclass(frozen=True)
class Slip:
    """A formula with a fault in one place: the operator that made it, the fault in words, and the formula."""

    operator: str
    text: str
    whole: Expr


def slips(expr: Expr, step_ms: int) -> Iterator[Slip]:
    """Every slip in a formula whose timers count steps of ``step_ms``, from the outside inwards."""
    match expr:
        case Apply(op, args, sort):
            yield from _operator(op, expr)
            yield from _constants(expr)
            for place, arg in enumerate(args):
                for slip in slips(arg, step_ms):
                    changed = (*args[:place], slip.whole, *args[place + 1 :])
                    yield replace(slip, whole=Apply(op, changed, sort))
        case Named(_, body):
            yield from slips(body, step_ms)  # what is changed is no longer what the name says
        case Temporal(_, arg, _, _):
            yield from _timer(expr, step_ms)
            for slip in () if arg is None else slips(arg, step_ms):
                yield replace(slip, whole=replace(expr, arg=slip.whole))


def other(value: Const) -> Const | None:
    """The constant that is taken for another: the next member, the other truth, one step more."""
    match value.sort:
        case Bool():
            return Const(1 - value.value, value.sort)
        case Num():
            return Const(value.value + 1, value.sort)
        case Enum(name, members):
            numbers = [n for _, n in members]
            if name.startswith("states of "):
                numbers = numbers[1:]  # without "no state"
            if value.value not in numbers or len(numbers) < 2:
                return None
            return Const(numbers[(numbers.index(value.value) + 1) % len(numbers)], value.sort)


def _operator(op: Op, expr: Apply) -> Iterator[Slip]:
    if op in BESIDE:
        yield Slip("comparison", f"`{expr}` is written with {BESIDE[op].value}", replace(expr, op=BESIDE[op]))
    if op in (Op.AND, Op.OR):
        swapped = Op.OR if op is Op.AND else Op.AND
        yield Slip("and-or", f"`{expr}` is joined by {swapped.value}", replace(expr, op=swapped))
        for place, arg in enumerate(expr.args):
            rest = (*expr.args[:place], *expr.args[place + 1 :])
            left = rest[0] if len(rest) == 1 else replace(expr, args=rest)
            yield Slip("dropped", f"`{arg}` is missing in `{expr}`", left)
    match expr:
        case Apply(Op.BIT, (mask, Const(index, sort))):
            new = replace(expr, args=(mask, Const(index + 1, sort)))
            yield Slip("bit", f"`{expr}` looks at bit {index + 1}", new)


def _constants(expr: Apply) -> Iterator[Slip]:
    for place, arg in enumerate(expr.args):
        if not isinstance(arg, Const):
            continue
        if isinstance(arg.sort, Num) and expr.op in _NUMBERS:
            found = [
                ("limit-up", Const(arg.value + 1, arg.sort)),
                ("limit-down", Const(arg.value - 1, arg.sort)),
            ]
        elif (isinstance(arg.sort, Enum) and expr.op in COMPARISONS) or (expr.op is Op.ITE and place):
            changed = other(arg)
            found = (
                [] if changed is None else [("member" if isinstance(arg.sort, Enum) else "value", changed)]
            )
        else:
            continue
        for operator, new in found:
            args = (*expr.args[:place], new, *expr.args[place + 1 :])
            yield Slip(operator, f"`{arg}` is {new} in `{expr}`", replace(expr, args=args))


def _timer(expr: Temporal, step_ms: int) -> Iterator[Slip]:
    if expr.when not in TIMED or expr.span is None:
        return
    step = Fraction(1 if expr.span.unit == "ticks" else step_ms)
    for operator, amount in (("timer-up", expr.span.amount + step), ("timer-down", expr.span.amount - step)):
        if amount >= 0:
            new = replace(expr, span=Span(amount, expr.span.unit))
            yield Slip(operator, f"`{expr}` is `{new}`", new)
    if expr.when is When.DURATION:
        new = replace(expr, strict=not expr.strict)
        yield Slip("comparison", f"`{expr}` is `{new}`", new)


__all__ = ["BESIDE", "Slip", "other", "slips"]
