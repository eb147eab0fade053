"""Expressions: a small closed language of typed formulas over finite variables.

``Var``, ``Const``, ``Apply`` of an ``Op``, ``Named`` (a formula with a name, transparent to every reader) and
``Temporal`` (removed by lowering and property reduction).  Arithmetic is on raw integers, as sorts explain.
"""

from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum
from fractions import Fraction
from functools import reduce
from typing import SupportsIndex, Union

from rovercheck.spec_model.lang.domain import (
    Bool,
    Domain,
    Enum,
    Num,
    Number,
    Sort,
    Unit,
    boolean,
    check_domain,
    common_resolution,
    exact,
    in_resolution,
    own,
)
from rovercheck.spec_model.lang.errors import BINDS, BINDS_BEFORE, ModelError, apart, brief, with_article
from rovercheck.spec_model.lang.operators import Op, infix
from rovercheck.spec_model.lang.time import Span

Operand = Union["Expr", Number, bool, SupportsIndex]


class Expr:
    """A formula.  Operators build larger formulas; ``==`` too, so compare nodes with ``is``."""

    __slots__ = ()
    __array_ufunc__ = None  # or NumPy would take `three < x` for a comparison of its own
    sort: Sort

    def __and__(self, other: Operand) -> "Expr":
        return _joined(all_of, self, other, binds=BINDS)

    def __rand__(self, other: Operand) -> "Expr":
        return _joined(all_of, other, self, binds=BINDS_BEFORE)

    def __or__(self, other: Operand) -> "Expr":
        return _joined(any_of, self, other, binds=BINDS)

    def __ror__(self, other: Operand) -> "Expr":
        return _joined(any_of, other, self, binds=BINDS_BEFORE)

    def __invert__(self) -> "Expr":
        return _joined(_negated, self, binds="" if isinstance(self, Const) else BINDS)

    def __eq__(self, other: object) -> "Expr":  # type: ignore[override]
        return _compare(Op.EQ, self, other)

    def __ne__(self, other: object) -> "Expr":  # type: ignore[override]
        return _compare(Op.NE, self, other)

    def __lt__(self, other: Operand) -> "Expr":
        return _compare(Op.LT, self, other)

    def __le__(self, other: Operand) -> "Expr":
        return _compare(Op.LE, self, other)

    def __gt__(self, other: Operand) -> "Expr":
        return _compare(Op.GT, self, other)

    def __ge__(self, other: Operand) -> "Expr":
        return _compare(Op.GE, self, other)

    def __add__(self, other: Operand) -> "Expr":
        return linear(Op.ADD, self, other)

    def __radd__(self, other: Operand) -> "Expr":
        return linear(Op.ADD, other, self)

    def __sub__(self, other: Operand) -> "Expr":
        return linear(Op.SUB, self, other)

    def __rsub__(self, other: Operand) -> "Expr":
        return linear(Op.SUB, other, self)

    def __neg__(self) -> "Expr":
        return Apply(Op.NEG, (self,), as_number(self, "-").sort)

    def __mul__(self, other: Operand) -> "Expr":
        return _product(self, other)

    def __rmul__(self, other: Operand) -> "Expr":
        return _product(other, self)

    def __truediv__(self, other: Number | SupportsIndex) -> "Expr":
        if isinstance(other, Expr) or exact(other) == 0:
            raise ModelError(
                f"`{infix(self, '/', other)}` divides by no constant; divide by a non-zero number."
            )
        return _product(self, 1 / exact(other))

    def __mod__(self, other: object) -> "Expr":
        raise ModelError(f"`{infix(self, '%', other)}`: write modulo({self}, {other}).")

    def __floordiv__(self, other: object) -> "Expr":
        raise ModelError(f"`{infix(self, '//', other)}`: write quotient({self}, {other}).")

    def __abs__(self) -> "Expr":
        raise ModelError(f"`abs({self})`: write absolute({self}).")

    def __hash__(self) -> int:
        return object.__hash__(self)

    def __bool__(self) -> bool:
        raise ModelError(
            f"`{self}` is a formula, not a Python truth value. Write & | ~ for and, or, not; "
            "ite(), minimum(), maximum() for if, min, max; and `(a < x) & (x < b)` for `a < x < b`."
        )

    def __str__(self) -> str:
        from rovercheck.spec_model.lang.label import text  # the printer reads expressions

        return text(self)

    __repr__ = __str__


@dataclass(frozen=True, eq=False, slots=True, repr=False)
class Const(Expr):
    """A constant: its raw value and its sort."""

    value: int
    sort: Sort


@dataclass(frozen=True, eq=False, slots=True, repr=False)
class Var(Expr):
    """A variable, known by its name.  ``init`` is the raw value before the first tick.

    ``hidden`` marks bookkeeping that a reader of a trace does not want to see.
    """

    name: str
    domain: Domain
    init: int = 0
    doc: str = ""
    hidden: bool = False

    def __post_init__(self) -> None:
        if self.init not in self.domain:
            raise ModelError(
                f"{self.name} starts at raw value {self.init}, outside {self.domain}; give init=."
            )

    @property
    def sort(self) -> Sort:  # type: ignore[override]
        return self.domain.sort


@dataclass(frozen=True, eq=False, slots=True, repr=False)
class Apply(Expr):
    """An operator applied to arguments, already brought to a common resolution."""

    op: Op
    args: tuple[Expr, ...]
    sort: Sort


@dataclass(frozen=True, eq=False, slots=True, repr=False)
class Named(Expr):
    """A formula with a name of its own; readers see through it, printers show the name."""

    name: str
    body: Expr

    @property
    def sort(self) -> Sort:  # type: ignore[override]
        return self.body.sort


class When(StrEnum):
    """The temporal words. The first four belong to charts, all but after and duration to properties."""

    AFTER = "after"
    DURATION = "duration"
    RISING = "rising"
    HELD = "held"
    PREVIOUS = "previous"
    ONCE = "once"


@dataclass(frozen=True, eq=False, slots=True, repr=False)
class Temporal(Expr):
    """A formula about the past.  ``strict`` is ``duration(c) > span`` as against ``>=``."""

    when: When
    arg: Expr | None
    span: Span | None = None
    strict: bool = False

    @property
    def sort(self) -> Sort:  # type: ignore[override]
        return self.arg.sort if self.when is When.PREVIOUS and self.arg is not None else Bool()


# --- making nodes ------------------------------------------------------------------------------


def var(
    name: str, domain: Domain, init: Number | bool | None = None, doc: str = "", hidden: bool = False
) -> Var:
    """A variable; ``init`` in the domain's own terms, by default 0 or else the lowest value."""
    check_domain(f"var({name!r}, ...)", domain)
    raw = domain.raw(init) if init is not None else (0 if 0 in domain else domain.low)
    return Var(name, domain, raw, doc, hidden)


def flag(name: str, doc: str = "", hidden: bool = False) -> Var:
    """A boolean variable, false before the first tick."""
    return Var(name, boolean, 0, doc, hidden)


def member(domain: Domain, name: str) -> Const:
    """The member of an enumeration as a constant."""
    check_domain("member()", domain)
    return Const(domain.raw(name), domain.sort)


def const(value: Number | bool | SupportsIndex, unit: str | Unit = "") -> Const:
    """A constant; a number takes the resolution it needs and the unit given.

    A factor with a unit converts: ``minutes * const(60, "s/min")`` is in seconds.
    """
    if isinstance(truth := own(value), bool):
        return Const(int(truth), Bool())
    number = exact(value)
    return Const(number.numerator, Num(Fraction(1, number.denominator), Unit.of(unit)))


TRUE, FALSE = const(True), const(False)


def lift(value: object, like: Sort) -> Expr:
    """A Python value met beside a formula of sort ``like``."""
    if isinstance(value, Expr):
        return value
    if type(value) is int and isinstance(like, Num):  # the most frequent case
        return Const(value, like if like.resolution == 1 else Num(unit=like.unit))
    value = own(value)
    if isinstance(value, bool) and isinstance(like, Bool):
        return TRUE if value else FALSE
    if isinstance(value, str) and isinstance(like, Enum):
        return Const(like.number(value), like)
    if isinstance(value, int | float | Fraction) and not isinstance(value, bool) and isinstance(like, Num):
        number = exact(value)
        return Const(number.numerator, Num(Fraction(1, number.denominator), like.unit))
    raise ModelError(
        f"{brief(value)} has no meaning beside {with_article(like)}; write a value of that sort."
    )


def _sort_of(*operands: object) -> Sort:
    for operand in operands:
        if isinstance(operand, Expr):
            return operand.sort
    raise ModelError(f"{operands!r} holds no formula; write at least one variable or const().")


def as_boolean(value: object, where: str) -> Expr:
    expr = value if isinstance(value, Expr) else lift(value, Bool())
    if not isinstance(expr.sort, Bool):
        kind = with_article(expr.sort)
        raise ModelError(f"`{expr}` is {kind}; `{where}` needs a condition, such as a comparison.")
    return expr


def as_formula(value: object, where: str) -> Expr:
    if not isinstance(value, Expr):
        raise ModelError(f"`{where}` takes a formula, such as a variable, and not {brief(value)}.")
    return value


def as_number(expr: Expr, where: str) -> Expr:
    as_formula(expr, where)
    if not isinstance(expr.sort, Num):
        raise ModelError(f"`{expr}` is {with_article(expr.sort)}; `{where}` needs a number.")
    return expr


def rescale(expr: Expr, sort: Num) -> Expr:
    """The same number in a resolution that divides its own (for a constant: its value)."""
    assert isinstance(expr.sort, Num)
    if (old := expr.sort.resolution) == (new := sort.resolution):
        return expr
    if isinstance(expr, Const):
        raw = in_resolution(expr.value, old, new)
        assert raw is not None
        return Const(raw, sort)
    factor = old / new
    assert factor.denominator == 1
    return Apply(Op.SCALE, (expr, Const(int(factor), Num())), sort)


def aligned(where: str, *exprs: Expr) -> tuple[tuple[Expr, ...], Num]:
    """Numbers of one unit in one resolution."""
    nums = [s for e in exprs if isinstance(s := as_number(e, where).sort, Num)]
    if all(n is nums[0] or n == nums[0] for n in nums):
        return exprs, nums[0]
    if len({n.unit for n in nums}) > 1:
        shown = " and ".join(f"`{e}` in {n.unit or 'no unit'}" for e, n in zip(exprs, nums, strict=True))
        raise ModelError(f"`{where}` mixes {shown}; convert with a factor that has a unit.")
    steps = [n.resolution for e, n in zip(exprs, nums, strict=True) if not isinstance(e, Const)]
    for e, num in zip(exprs, nums, strict=True):
        if isinstance(e, Const) and (not steps or in_resolution(e.value, num.resolution, steps[0]) is None):
            steps.append(num.resolution)  # a constant needs no finer steps than its value does
    step = reduce(common_resolution, steps)
    sort = Num(step, nums[0].unit)
    return tuple(rescale(e, sort) for e in exprs), sort


def _compare(op: Op, left: object, right: object) -> Expr:
    like = _sort_of(left, right)
    binds = BINDS if {getattr(left, "op", None), getattr(right, "op", None)} & {Op.AND, Op.OR, Op.NOT} else ""
    one = left if isinstance(left, Expr) else _joined(lift, left, like, binds=binds)
    two = right if isinstance(right, Expr) else _joined(lift, right, like, binds=binds)
    if isinstance(one.sort, Num) and isinstance(two.sort, Num):
        return Apply(op, aligned(op.value, one, two)[0], Bool())
    if one.sort != two.sort:
        raise ModelError(f"{apart(one, two)}; compare values of one sort.{binds}")
    if op not in (Op.EQ, Op.NE):
        none = f"{with_article(one.sort)} has no order"
        raise ModelError(f"`{infix(one, op.value, two)}`: {none}; compare with == or !=.{binds}")
    return Apply(op, (one, two), Bool())


def linear(op: Op, left: Operand, right: Operand) -> Expr:
    like = _sort_of(left, right)
    args, sort = aligned(op.value, lift(left, like), lift(right, like))
    return Apply(op, args, sort)


def _product(left: Operand, right: Operand) -> Expr:
    a, b = lift(left, Num()), lift(right, Num())
    sa, sb = as_number(a, "*").sort, as_number(b, "*").sort
    assert isinstance(sa, Num) and isinstance(sb, Num)
    return Apply(Op.MUL, (a, b), Num(sa.resolution * sb.resolution, sa.unit * sb.unit))


def _joined(make: Callable[..., Expr], *parts: object, binds: str) -> Expr:
    """What Python makes of an operator; ``binds`` says how it was read, where that has no meaning."""
    try:
        return make(*parts)
    except ModelError as error:
        raise ModelError(f"{error}{binds}") from None


def _negated(value: object) -> Expr:
    return Apply(Op.NOT, (as_boolean(value, "not"),), Bool())


def _flat(op: Op, parts: tuple[object, ...]) -> tuple[Expr, ...]:
    flat: list[Expr] = []
    for part in parts:
        expr = as_boolean(part, op.value)
        flat.extend(expr.args if isinstance(expr, Apply) and expr.op is op else (expr,))
    return tuple(flat)


def all_of(*parts: Operand) -> Expr:
    """The conjunction; true when empty."""
    args = _flat(Op.AND, parts)
    return args[0] if len(args) == 1 else Apply(Op.AND, args, Bool()) if args else TRUE


def any_of(*parts: Operand) -> Expr:
    """The disjunction; false when empty."""
    args = _flat(Op.OR, parts)
    return args[0] if len(args) == 1 else Apply(Op.OR, args, Bool()) if args else FALSE


def implies(premise: Operand, conclusion: Operand) -> Expr:
    """Where the premise is true, the conclusion is."""
    return any_of(~as_boolean(premise, "implies"), conclusion)


def ite(condition: Operand, then: Operand, otherwise: Operand) -> Expr:
    """``then`` where the condition holds, ``otherwise`` elsewhere."""
    test = as_boolean(condition, "ite")
    like = _sort_of(then, otherwise) if isinstance(then, Expr) or isinstance(otherwise, Expr) else Num()
    one, two = lift(then, like), lift(otherwise, like)
    if isinstance(one.sort, Num) and isinstance(two.sort, Num):
        (one, two), sort = aligned("ite", one, two)
        return Apply(Op.ITE, (test, one, two), sort)
    if one.sort != two.sort:
        raise ModelError(f"{apart(one, two)}; both branches need one sort.")
    return Apply(Op.ITE, (test, one, two), one.sort)
