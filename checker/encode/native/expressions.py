"""Expressions as LLVM instructions: 64-bit arithmetic, and truth values as single bits.

Every value carries the interval it lies in, so that rounding down costs nothing where a value is
never negative, and so that a formula that may leave 64 bits is refused instead of wrapping round.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import reduce
from typing import Any

from llvmlite import ir

from rovercheck.checker.system.intervals import Interval, transfer
from rovercheck.spec_model.lang.domain import Bool
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Named, Var
from rovercheck.spec_model.lang.operators import COMPARISONS, SIGNS, Op

BIT = ir.IntType(1)
INT = ir.IntType(64)

_WIDEST = Interval(-(1 << 63) + 1, (1 << 63) - 1)


class TooWide(Exception):
    """A formula may leave the 64-bit numbers, so native code could compute something else."""


@dataclass(frozen=True)
class Value:
    """An LLVM value and the interval it lies in."""

    code: Any
    within: Interval


@dataclass(frozen=True)
class Slot:
    """Where a variable lives while a path is run, and the interval of what is there now."""

    place: Any
    within: Interval


def kind(var: Var) -> Any:
    """The LLVM type of a variable."""
    return BIT if isinstance(var.sort, Bool) else INT


class Expressions:
    """Emits expressions at the builder's place; ``slots`` says where variables are."""

    def __init__(self, builder: Any, slots: Mapping[str, Slot]) -> None:
        self.builder = builder
        self.slots = slots

    def value(self, expr: Expr) -> Value:
        """The value of a formula, shared parts computed once."""
        return self._value(expr, {})

    def condition(self, expr: Expr) -> Any:
        """The value of a formula as a bit."""
        return self.as_bit(self.value(expr))

    def as_int(self, value: Value) -> Any:
        code = value.code
        return self.builder.zext(code, INT) if code.type == BIT else code

    def as_bit(self, value: Value) -> Any:
        code = value.code
        return code if code.type == BIT else self.builder.icmp_signed("!=", code, INT(0))

    def _value(self, expr: Expr, known: dict[int, Value]) -> Value:
        if id(expr) not in known:
            known[id(expr)] = made = self._made(expr, known)
            if not made.within.within(_WIDEST):
                raise TooWide(f"`{expr}` may leave the 64-bit numbers.")
        return known[id(expr)]

    def _made(self, expr: Expr, known: dict[int, Value]) -> Value:
        match expr:
            case Const(value, sort):
                return Value((BIT if isinstance(sort, Bool) else INT)(value), Interval(value, value))
            case Var(name):
                slot = self.slots[name]
                return Value(self.builder.load(slot.place), slot.within)
            case Named(_, body):
                return self._value(body, known)
            case Apply(op, args, _):
                values = [self._value(a, known) for a in args]
                return Value(OPERATIONS[op](self, values), transfer(op, [v.within for v in values]))
        raise AssertionError(f"{expr} speaks of the past")


Row = Callable[[Expressions, Sequence[Value]], Any]
"""Emits an operator on values, at the builder's place."""


def _compared(sign: str) -> Row:
    def row(emit: Expressions, args: Sequence[Value]) -> Any:
        if all(a.code.type == BIT for a in args):
            return emit.builder.icmp_unsigned(sign, *(a.code for a in args))
        return emit.builder.icmp_signed(sign, *map(emit.as_int, args))

    return row


def _joined(instruction: str) -> Row:
    return lambda emit, args: reduce(getattr(emit.builder, instruction), map(emit.as_bit, args))


def _computed(instruction: str) -> Row:
    """That it does not overflow is known: the interval of the result lies in 64 bits."""
    return lambda emit, args: getattr(emit.builder, instruction)(*map(emit.as_int, args), flags=["nsw"])


def _chosen(emit: Expressions, args: Sequence[Value]) -> Any:
    test, *branches = args
    as_branch = emit.as_bit if all(b.code.type == BIT for b in branches) else emit.as_int
    return emit.builder.select(emit.as_bit(test), *map(as_branch, branches))


def _extreme(sign: str) -> Row:
    def row(emit: Expressions, args: Sequence[Value]) -> Any:
        a, b = map(emit.as_int, args)
        return emit.builder.select(emit.builder.icmp_signed(sign, a, b), a, b)

    return row


def _absolute(emit: Expressions, args: Sequence[Value]) -> Any:
    build, value = emit.builder, emit.as_int(args[0])
    negative = build.icmp_signed("<", value, INT(0))
    return build.select(negative, build.sub(INT(0), value), value)


def _divisor(op: Op, of: Value) -> int:
    if of.within.low != of.within.high or of.within.low <= 0:
        raise TooWide(f"{op.value} needs a positive constant on the right.")
    return of.within.low


def _quotient(emit: Expressions, args: Sequence[Value]) -> Any:
    """Floor division by a positive constant, of what may be negative."""
    build, value, by = emit.builder, emit.as_int(args[0]), INT(_divisor(Op.DIV, args[1]))
    if args[0].within.low >= 0:
        return build.udiv(value, by)
    below = build.icmp_signed("<", build.srem(value, by), INT(0))
    return build.sub(build.sdiv(value, by), build.zext(below, INT))


def _remainder(emit: Expressions, args: Sequence[Value]) -> Any:
    build, value, by = emit.builder, emit.as_int(args[0]), INT(_divisor(Op.MOD, args[1]))
    if args[0].within.low >= 0:
        return build.urem(value, by)
    rest = build.srem(value, by)
    return build.select(build.icmp_signed("<", rest, INT(0)), build.add(rest, by), rest)


def _bit(emit: Expressions, args: Sequence[Value]) -> Any:
    index = INT(min(args[1].within.low, 63))
    return emit.builder.trunc(emit.builder.ashr(emit.as_int(args[0]), index), BIT)


OPERATIONS: Mapping[Op, Row] = {
    **{op: _compared(SIGNS[op]) for op in COMPARISONS},
    Op.NOT: lambda emit, args: emit.builder.not_(emit.as_bit(args[0])),
    Op.AND: _joined("and_"),
    Op.OR: _joined("or_"),
    Op.ITE: _chosen,
    Op.ADD: _computed("add"),
    Op.SUB: _computed("sub"),
    Op.NEG: lambda emit, args: emit.builder.sub(INT(0), emit.as_int(args[0]), flags=["nsw"]),
    Op.MUL: _computed("mul"),
    Op.SCALE: _computed("mul"),
    Op.DIV: _quotient,
    Op.MOD: _remainder,
    Op.ABS: _absolute,
    Op.MIN: _extreme("<"),
    Op.MAX: _extreme(">"),
    Op.BIT: _bit,
}
