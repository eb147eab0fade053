"""Expressions as LLVM instructions: 64-bit arithmetic, and truth values as single bits.

Every value carries the interval it lies in, so that rounding down costs nothing where a value is
never negative, and so that a formula that may leave 64 bits is refused instead of wrapping round.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from llvmlite import ir

from rovercheck.checker.system.intervals import TRUTH, Interval, transfer
from rovercheck.spec_model.lang.domain import Bool
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Named, Var
from rovercheck.spec_model.lang.operators import COMPARISONS, Op

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
            case Apply(op, args, sort):
                values = [self._value(a, known) for a in args]
                if isinstance(sort, Bool):
                    return Value(self._truth(op, values), TRUTH)
                return Value(self._number(op, values), transfer(op, [v.within for v in values]))
        raise AssertionError(f"{expr} speaks of the past")

    def _truth(self, op: Op, args: list[Value]) -> Any:
        build = self.builder
        if op in COMPARISONS:
            if all(a.code.type == BIT for a in args):
                return build.icmp_unsigned(op.value, args[0].code, args[1].code)
            return build.icmp_signed(op.value, self.as_int(args[0]), self.as_int(args[1]))
        match op:
            case Op.NOT:
                return build.not_(self.as_bit(args[0]))
            case Op.AND | Op.OR:
                join = build.and_ if op is Op.AND else build.or_
                result = self.as_bit(args[0])
                for arg in args[1:]:
                    result = join(result, self.as_bit(arg))
                return result
            case Op.ITE:
                return build.select(*(self.as_bit(a) for a in args))
            case Op.BIT:
                index = INT(min(args[1].within.low, 63))
                return build.trunc(build.ashr(self.as_int(args[0]), index), BIT)
        raise AssertionError(op)

    def _number(self, op: Op, args: list[Value]) -> Any:
        build = self.builder
        if op is Op.ITE:
            return build.select(self.as_bit(args[0]), self.as_int(args[1]), self.as_int(args[2]))
        v = [self.as_int(a) for a in args]
        match op:
            case Op.ADD:
                return build.add(v[0], v[1], flags=["nsw"])
            case Op.SUB:
                return build.sub(v[0], v[1], flags=["nsw"])
            case Op.NEG:
                return build.sub(INT(0), v[0], flags=["nsw"])
            case Op.MUL | Op.SCALE:
                return build.mul(v[0], v[1], flags=["nsw"])
            case Op.DIV | Op.MOD:
                return self._rounded_down(op, args[0], args[1])
            case Op.ABS:
                negative = build.icmp_signed("<", v[0], INT(0))
                return build.select(negative, build.sub(INT(0), v[0]), v[0])
            case Op.MIN | Op.MAX:
                first = build.icmp_signed("<" if op is Op.MIN else ">", v[0], v[1])
                return build.select(first, v[0], v[1])
        raise AssertionError(op)

    def _rounded_down(self, op: Op, left: Value, right: Value) -> Any:
        """Floor division or remainder by a positive constant, of what may be negative."""
        build, divisor = self.builder, right.within.low
        if divisor != right.within.high or divisor <= 0:
            raise TooWide(f"{op.value} needs a positive constant on the right.")
        value, by = self.as_int(left), INT(divisor)
        if left.within.low >= 0:
            return build.udiv(value, by) if op is Op.DIV else build.urem(value, by)
        rest = build.srem(value, by)
        below = build.icmp_signed("<", rest, INT(0))
        if op is Op.MOD:
            return build.select(below, build.add(rest, by), rest)
        return build.sub(build.sdiv(value, by), build.zext(below, INT))
