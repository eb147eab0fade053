"""Expressions: a small closed language of typed formulas over finite variables.

``Var``, ``Const``, ``Apply`` of an ``Op``, ``Named`` (a formula with a name, transparent to every
reader) and ``Temporal`` (removed by lowering and by property reduction).  All arithmetic is on raw
integers; the sort of a node says which numbers they stand for.
"""

from dataclasses import dataclass
from enum import StrEnum
from fractions import Fraction
from functools import reduce
from typing import Union

from spec_model.lang.domain import (
    Bool,
    Domain,
    Enum,
    Num,
    Number,
    Sort,
    Unit,
    boolean,
    common_resolution,
    exact,
)
from spec_model.lang.errors import ModelError
from spec_model.lang.time import Span

Operand = Union["Expr", Number, bool]


class Op(StrEnum):
    """The closed set of operators; every reader of expressions handles all of them.

    SCALE multiplies by a positive constant to change resolution (it is not written by people).
    DIV rounds down, MOD is never negative; both take a positive constant on the right.
    BIT(x, i) is bit i of a non-negative integer.
    """

    NOT = "not"
    AND = "and"
    OR = "or"
    ITE = "ite"
    EQ = "=="
    NE = "!="
    LT = "<"
    LE = "<="
    GT = ">"
    GE = ">="
    ADD = "+"
    SUB = "-"
    NEG = "neg"
    MUL = "*"
    SCALE = "scale"
    DIV = "div"
    MOD = "mod"
    ABS = "abs"
    MIN = "min"
    MAX = "max"
    BIT = "bit"


COMPARISONS = frozenset({Op.EQ, Op.NE, Op.LT, Op.LE, Op.GT, Op.GE})


class Expr:
    """A formula.  Operators build larger formulas; ``==`` too, so compare nodes with ``is``."""

    __slots__ = ()
    sort: Sort

    def __and__(self, other: Operand) -> "Expr":
        return all_of(self, other)

    def __rand__(self, other: Operand) -> "Expr":
        return all_of(other, self)

    def __or__(self, other: Operand) -> "Expr":
        return any_of(self, other)

    def __ror__(self, other: Operand) -> "Expr":
        return any_of(other, self)

    def __invert__(self) -> "Expr":
        return Apply(Op.NOT, (as_boolean(self, "not"),), Bool())

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

    def __truediv__(self, other: Number) -> "Expr":
        if isinstance(other, Expr) or exact(other) == 0:
            raise ModelError(f"`{self} / {other}` divides by no constant; divide by a non-zero number.")
        return _product(self, 1 / exact(other))

    def __hash__(self) -> int:
        return object.__hash__(self)

    def __bool__(self) -> bool:
        raise ModelError(
            f"`{self}` is a formula, not a Python truth value. Write & | ~ for and, or, not, "
            "and split `a < x < b` into `(a < x) & (x < b)`."
        )

    def __str__(self) -> str:
        from spec_model.lang.label import text  # the printer reads expressions

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
    raw = domain.raw(init) if init is not None else (0 if 0 in domain else domain.low)
    return Var(name, domain, raw, doc, hidden)


def flag(name: str, doc: str = "", hidden: bool = False) -> Var:
    """A boolean variable, false before the first tick."""
    return Var(name, boolean, 0, doc, hidden)


def member(domain: Domain, name: str) -> Const:
    """The member of an enumeration as a constant."""
    return Const(domain.raw(name), domain.sort)


def const(value: Number | bool, unit: str = "") -> Const:
    """A constant; a number takes the resolution it needs and the unit given."""
    if isinstance(value, bool):
        return Const(int(value), Bool())
    number = exact(value)
    return Const(number.numerator, Num(Fraction(1, number.denominator), Unit.of(unit)))


TRUE, FALSE = const(True), const(False)


def lift(value: object, like: Sort) -> Expr:
    """A Python value met beside a formula of sort ``like``."""
    if isinstance(value, Expr):
        return value
    if isinstance(value, bool) and isinstance(like, Bool):
        return TRUE if value else FALSE
    if isinstance(value, str) and isinstance(like, Enum):
        return Const(like.number(value), like)
    if isinstance(value, int | float | Fraction) and not isinstance(value, bool) and isinstance(like, Num):
        return _rescaled(const(value), like.unit)
    raise ModelError(f"{value!r} has no meaning beside a {like}; write a value of that sort.")


def _rescaled(literal: Const, unit: Unit) -> Const:
    assert isinstance(literal.sort, Num)
    return Const(literal.value, Num(literal.sort.resolution, unit))


def _sort_of(*operands: object) -> Sort:
    for operand in operands:
        if isinstance(operand, Expr):
            return operand.sort
    raise ModelError(f"{operands!r} holds no formula; write at least one variable or const().")


def as_boolean(value: object, where: str) -> Expr:
    expr = lift(value, Bool())
    if not isinstance(expr.sort, Bool):
        raise ModelError(f"`{expr}` is a {expr.sort}; `{where}` needs a condition, such as a comparison.")
    return expr


def as_number(expr: Expr, where: str) -> Expr:
    if not isinstance(expr.sort, Num):
        raise ModelError(f"`{expr}` is a {expr.sort}; `{where}` needs a number.")
    return expr


def rescale(expr: Expr, sort: Num) -> Expr:
    """The same number in a resolution that divides its own (for a constant: its value)."""
    assert isinstance(expr.sort, Num)
    if expr.sort.resolution == sort.resolution:
        return expr
    factor = expr.sort.resolution / sort.resolution
    if isinstance(expr, Const):
        assert (expr.value * factor).denominator == 1
        return Const(int(expr.value * factor), sort)
    assert factor.denominator == 1
    return Apply(Op.SCALE, (expr, Const(int(factor), Num())), sort)


def is_multiple(literal: Const, resolution: Fraction) -> bool:
    """Whether the constant is a whole number of steps of the resolution."""
    assert isinstance(literal.sort, Num)
    if literal.sort.resolution == resolution:
        return True
    return (literal.value * literal.sort.resolution / resolution).denominator == 1


def aligned(where: str, *exprs: Expr) -> tuple[tuple[Expr, ...], Num]:
    """Numbers of one unit in one resolution."""
    sorts = [as_number(e, where).sort for e in exprs]
    nums = [s for s in sorts if isinstance(s, Num)]
    if len({n.unit for n in nums}) > 1:
        shown = " and ".join(f"`{e}` in {n.unit or 'no unit'}" for e, n in zip(exprs, nums, strict=True))
        raise ModelError(f"`{where}` mixes {shown}; convert with a factor that has a unit.")
    steps = [n.resolution for e, n in zip(exprs, nums, strict=True) if not isinstance(e, Const)]
    for e, num in zip(exprs, nums, strict=True):
        if isinstance(e, Const) and not (steps and is_multiple(e, steps[0])):
            steps.append(num.resolution)  # a constant needs no finer steps than its value does
    step = reduce(common_resolution, steps)
    sort = Num(step, nums[0].unit)
    return tuple(rescale(e, sort) for e in exprs), sort


def _compare(op: Op, left: object, right: object) -> Expr:
    like = _sort_of(left, right)
    a, b = lift(left, like), lift(right, like)
    if isinstance(a.sort, Num) and isinstance(b.sort, Num):
        return Apply(op, aligned(op.value, a, b)[0], Bool())
    if a.sort != b.sort:
        raise ModelError(f"`{a}` is a {a.sort} and `{b}` a {b.sort}; compare values of one sort.")
    if op not in (Op.EQ, Op.NE):
        raise ModelError(f"`{a} {op.value} {b}`: a {a.sort} has no order; compare with == or !=.")
    return Apply(op, (a, b), Bool())


def linear(op: Op, left: Operand, right: Operand) -> Expr:
    like = _sort_of(left, right)
    args, sort = aligned(op.value, lift(left, like), lift(right, like))
    return Apply(op, args, sort)


def _product(left: Operand, right: Operand) -> Expr:
    a, b = lift(left, Num()), lift(right, Num())
    sa, sb = as_number(a, "*").sort, as_number(b, "*").sort
    assert isinstance(sa, Num) and isinstance(sb, Num)
    return Apply(Op.MUL, (a, b), Num(sa.resolution * sb.resolution, sa.unit * sb.unit))


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
    return any_of(~as_boolean(premise, "implies"), conclusion)


def ite(condition: Operand, then: Operand, otherwise: Operand) -> Expr:
    """``then`` where the condition holds, ``otherwise`` elsewhere."""
    test = as_boolean(condition, "ite")
    like = _sort_of(then, otherwise) if isinstance(then, Expr) or isinstance(otherwise, Expr) else Num()
    a, b = lift(then, like), lift(otherwise, like)
    if isinstance(a.sort, Num) and isinstance(b.sort, Num):
        (a, b), sort = aligned("ite", a, b)
        return Apply(Op.ITE, (test, a, b), sort)
    if a.sort != b.sort:
        raise ModelError(f"`{a}` is a {a.sort} and `{b}` a {b.sort}; both branches need one sort.")
    return Apply(Op.ITE, (test, a, b), a.sort)
