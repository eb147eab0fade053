"""The words of formulas beyond operators: arithmetic functions, names, and the temporal words."""

from collections.abc import Sequence
from dataclasses import dataclass

from rovercheck.spec_model.lang.domain import Bool, Num, Number, exact
from rovercheck.spec_model.lang.errors import ModelError, with_article
from rovercheck.spec_model.lang.expr import (
    Apply,
    Const,
    Expr,
    Named,
    Operand,
    Temporal,
    When,
    aligned,
    as_boolean,
    as_formula,
    as_number,
    const,
    ite,
    lift,
    linear,
)
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.time import Span


def minimum(left: Operand, right: Operand) -> Expr:
    """The smaller of two numbers of one unit."""
    return linear(Op.MIN, left, right)


def maximum(left: Operand, right: Operand) -> Expr:
    """The larger of two numbers of one unit."""
    return linear(Op.MAX, left, right)


def absolute(value: Expr) -> Expr:
    """A number without its sign."""
    return Apply(Op.ABS, (as_number(value, "absolute"),), value.sort)


def sign(value: Expr) -> Expr:
    """-1, 0 or 1; sign(0) = 0."""
    return ite(value > 0, const(1), ite(value < 0, const(-1), const(0)))


def modulo(value: Expr, divisor: Number) -> Expr:
    """The remainder in [0, divisor[.  Raises ``ModelError`` unless the divisor is positive."""
    return _by_constant(Op.MOD, value, divisor)


def quotient(value: Expr, divisor: int) -> Expr:
    """A whole number divided by a positive whole constant, rounded down."""
    sort = as_formula(value, "quotient").sort
    if not isinstance(sort, Num) or sort.resolution != 1:
        raise ModelError(f"quotient() needs a whole number; `{value}` is {with_article(value.sort)}.")
    return _by_constant(Op.DIV, value, divisor)


def _by_constant(op: Op, value: Expr, divisor: Number) -> Expr:
    if exact(divisor) <= 0:
        raise ModelError(f"{op.value} by {divisor} has no meaning; write a positive constant.")
    args, sort = aligned(op.value, value, lift(exact(divisor), as_number(value, op.value).sort))
    return Apply(op, args, sort)


def wrap(angle: Expr) -> Expr:
    """((z + 180) mod 360) - 180, in [-180; 180[ degrees."""
    return modulo(angle + 180, 360) - 180


def bit(mask: Expr, index: int) -> Expr:
    """Bit ``index`` of a mask (a non-negative whole number)."""
    sort = as_formula(mask, "bit").sort
    if not isinstance(sort, Num) or sort.resolution != 1 or index < 0:
        raise ModelError(f"bit({mask}, {index}) needs a whole number and an index >= 0.")
    return Apply(Op.BIT, (mask, Const(index, Num())), Bool())


def mask_of(bits: Sequence[Expr]) -> Expr:
    """The number whose bits these are, bit 0 first."""
    total: Expr = const(0)
    for index, bit_ in enumerate(bits):
        total = total + ite(bit_, const(2**index), const(0))
    return total


def named(name: str, body: Expr) -> Named:
    """Give a formula a name that labels and traces show."""
    return Named(name, body)


def after(span: Span) -> Temporal:
    """Stateflow's after(n, sec): true from n after the source state was entered (rule G13)."""
    return Temporal(When.AFTER, None, span)


def rising(value: Expr) -> Temporal:
    """True in a step in which the value is positive (or true) and was not in the step before (G15)."""
    boolean = isinstance(as_formula(value, "rising").sort, Bool)
    return Temporal(When.RISING, value if boolean else value > 0)


def held(condition: Operand, for_: Span) -> Temporal:
    """True when the condition has been true in every step of the last ``for_``, ends included."""
    return Temporal(When.HELD, as_boolean(condition, "held"), for_)


def previous(value: Expr) -> Temporal:
    """The value at the end of the previous tick; before the first tick, its initial value."""
    return Temporal(When.PREVIOUS, value)


def once(condition: Operand) -> Temporal:
    """True when the condition has been true in some tick so far, this one included."""
    return Temporal(When.ONCE, as_boolean(condition, "once"))


@dataclass(frozen=True, eq=False)
class duration:
    """Stateflow's duration(c): compare it with a time, ``duration(c) > 3 * sec`` (rule G14)."""

    condition: Expr

    def __gt__(self, span: Span) -> Temporal:
        return Temporal(When.DURATION, as_boolean(self.condition, "duration"), span, strict=True)

    def __ge__(self, span: Span) -> Temporal:
        return Temporal(When.DURATION, as_boolean(self.condition, "duration"), span)

    def __lt__(self, span: Span) -> Temporal:
        raise ModelError(self._only("<", f"~(duration({self.condition}) >= ...)"))

    def __le__(self, span: Span) -> Temporal:
        raise ModelError(self._only("<=", f"~(duration({self.condition}) > ...)"))

    def __eq__(self, span: object) -> bool:
        raise ModelError(self._only("==", f"duration({self.condition}) >= ..."))

    def __ne__(self, span: object) -> bool:
        raise ModelError(self._only("!=", f"~(duration({self.condition}) >= ...)"))

    __hash__ = object.__hash__

    def _only(self, sign: str, instead: str) -> str:
        return f"A duration is compared by > or >= only, not by {sign}; write `{instead}`."
