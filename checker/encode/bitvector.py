"""Formulas as Z3 terms: truth values as Booleans, numbers and enumerations as signed bit-vectors.

The width of every bit-vector follows from the interval of what it stands for, and operators work
in a width that holds arguments and result, so nothing can overflow.
"""

from collections.abc import Callable, Mapping, Sequence
from operator import add, eq, ge, gt, le, lt, mod, mul, ne, neg, sub
from typing import Any

import z3

from rovercheck.checker.system.intervals import Interval, interval, postorder
from rovercheck.spec_model.lang.domain import Bool, Domain, Sort
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Named, Var
from rovercheck.spec_model.lang.operators import Op

Term = Any
"""A Z3 Boolean or bit-vector (Z3 has no types for the checker to read)."""


def width(domain: Domain) -> int:
    """Bits of a variable of that domain."""
    return Interval(domain.low, domain.high).width


def symbol(var: Var, name: str) -> Term:
    """A Z3 constant that stands for the variable."""
    return z3.Bool(name) if isinstance(var.sort, Bool) else z3.BitVec(name, width(var.domain))


def literal(value: int, sort: Sort, bits: int) -> Term:
    """A constant of that sort; ``bits`` is ignored for a truth value."""
    return z3.BoolVal(bool(value)) if isinstance(sort, Bool) else z3.BitVecVal(value, bits)


def member(term: Term, domain: Domain) -> list[Term]:
    """Constraints that confine the term of a variable to its domain."""
    if isinstance(domain.sort, Bool):
        return [] if len(domain) == 2 else [term == z3.BoolVal(bool(domain.low))]
    bits = term.size()
    ends = []
    if domain.low > -(1 << bits - 1):
        ends.append(term >= domain.low)
    if domain.high < (1 << bits - 1) - 1:
        ends.append(term <= domain.high)
    return ends if domain.dense else [z3.Or([term == v for v in domain.values])]


def value(term: Term) -> int:
    """The raw value of a Z3 literal."""
    return int(z3.is_true(term)) if z3.is_bool(term) else int(term.as_signed_long())


def fitted(term: Term, bits: int) -> Term:
    """The bit-vector in another width that holds its value."""
    size = term.size()
    if size == bits:
        return term
    return z3.SignExt(bits - size, term) if size < bits else z3.Extract(bits - 1, 0, term)


class Encoder:
    """Translates formulas; equal nodes are translated once.

    ``symbols`` gives the Z3 term of every variable, by name, in the width of its domain.
    """

    def __init__(self, symbols: Mapping[str, Term]) -> None:
        self._symbols = symbols
        self._range: dict[int, Interval] = {}
        self._term: dict[int, Term] = {}
        self._alive: list[Expr] = []

    def __call__(self, expr: Expr) -> Term:
        """The Z3 term of a formula."""
        if id(expr) in self._term:
            return self._term[id(expr)]
        for node in postorder(expr):
            if id(node) not in self._term:
                self._range[id(node)] = interval(node, self._range)
                self._term[id(node)] = self._node(node)
                self._alive.append(node)
        return self._term[id(expr)]

    def number(self, expr: Expr, bits: int) -> Term:
        """The term of a formula as a bit-vector of that width (truth values stay Booleans)."""
        term = self(expr)
        return term if z3.is_bool(term) else fitted(term, bits)

    def _node(self, node: Expr) -> Term:
        match node:
            case Const(value, sort):
                return literal(value, sort, self._range[id(node)].width)
            case Var(name):
                return self._symbols[name]
            case Named(_, body):
                return self._term[id(body)]
            case Apply(op, args, _):
                ranges = [self._range[id(a)] for a in args]
                terms = [self._term[id(a)] for a in args]
                return OPERATIONS[op](terms, ranges, self._range[id(node)])
        raise AssertionError(f"{node} speaks of the past")


Row = Callable[[Sequence[Term], Sequence[Interval], Interval], Term]
"""An operator on terms of which the intervals are known; the result has the width of its own."""


def _joined(join: Callable[[list[Term]], Term]) -> Row:
    return lambda args, ranges, result: join(list(args))


def _compared(compare: Callable[[Term, Term], Term]) -> Row:
    return lambda args, ranges, result: compare(*_aligned(args))


def _computed(compute: Callable[..., Term]) -> Row:
    """In a width that holds arguments and result."""

    def row(args: Sequence[Term], ranges: Sequence[Interval], result: Interval) -> Term:
        bits = max([result.width, *(r.width for r in ranges)])
        return fitted(compute(*(fitted(a, bits) for a in args)), result.width)

    return row


def _aligned(args: Sequence[Term]) -> list[Term]:
    if z3.is_bool(args[0]):
        return list(args)
    bits = max(a.size() for a in args)
    return [fitted(a, bits) for a in args]


def _divided(a: Term, b: Term) -> Term:
    """Rounded down; the divisor is positive.  One more bit holds the multiple below the least value."""
    bits = a.size() + 1
    a, b = fitted(a, bits), fitted(b, bits)
    return (a - a % b) / b


def _bit(args: Sequence[Term], ranges: Sequence[Interval], result: Interval) -> Term:
    index = ranges[1].low
    return z3.Extract(index, index, fitted(args[0], max(args[0].size(), index + 1))) == 1


OPERATIONS: Mapping[Op, Row] = {
    Op.NOT: lambda args, ranges, result: z3.Not(args[0]),
    Op.AND: _joined(z3.And),
    Op.OR: _joined(z3.Or),
    Op.ITE: lambda args, ranges, result: z3.If(args[0], *_aligned(args[1:])),
    Op.EQ: _compared(eq),
    Op.NE: _compared(ne),
    Op.LT: _compared(lt),
    Op.LE: _compared(le),
    Op.GT: _compared(gt),
    Op.GE: _compared(ge),
    Op.ADD: _computed(add),
    Op.SUB: _computed(sub),
    Op.NEG: _computed(neg),
    Op.MUL: _computed(mul),
    Op.SCALE: _computed(mul),
    Op.DIV: _computed(_divided),
    Op.MOD: _computed(mod),  # bvsmod: the sign of the divisor, as in Python
    Op.ABS: _computed(lambda a: z3.If(a >= 0, a, -a)),
    Op.MIN: _computed(lambda a, b: z3.If(a <= b, a, b)),
    Op.MAX: _computed(lambda a, b: z3.If(a >= b, a, b)),
    Op.BIT: _bit,
}
