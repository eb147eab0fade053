"""Hash-consed formulas, simplified as they are made, so that the DAGs of a step stay small.

Structurally equal formulas made in one table are one object.  Comparisons are brought to two
shapes, ``a == b`` and ``a <= b`` (constants on the right, offsets moved into the constant); a
comparison of a case distinction with a constant becomes a case distinction of truth values.
Simplification relies on variables being within the hulls of their domains.
"""

from collections.abc import Sequence
from typing import TypeGuard

from rovercheck.checker.encode.facts import Facts
from rovercheck.checker.system.intervals import Interval, interval, transfer
from rovercheck.spec_model.lang.domain import Bool, Sort
from rovercheck.spec_model.lang.evaluate import operate
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Var
from rovercheck.spec_model.lang.operators import COMPARISONS, Op

_FLAT = 8  # longer conjunctions are not copied into larger ones: chains would grow quadratically


def is_apply(expr: Expr, op: Op) -> TypeGuard[Apply]:
    """Whether the formula is an application of that operator."""
    return isinstance(expr, Apply) and expr.op is op


class Terms:
    """A table of formulas; its methods build simplified formulas from formulas of the same table."""

    def __init__(self) -> None:
        self._table: dict[tuple[object, ...], Expr] = {}
        self._range: dict[int, Interval] = {}
        self._compared: dict[tuple[Op, int, int], Expr] = {}
        self.true = self.const(1, Bool())
        self.false = self.const(0, Bool())

    def range(self, expr: Expr) -> Interval:
        """The interval of a formula of this table."""
        return self._range[id(expr)]

    def const(self, value: int, sort: Sort) -> Expr:
        return self._intern(("const", value, sort), Const(value, sort))

    def truth(self, value: bool) -> Expr:
        return self.true if value else self.false

    def var(self, var: Var) -> Expr:
        return self._intern(("var", var.name), var)

    def apply(self, op: Op, args: Sequence[Expr], sort: Sort) -> Expr:
        """An operator applied to formulas of this table, simplified."""
        if op in COMPARISONS:
            return self._compare(op, args[0], args[1])
        match op:
            case Op.NOT:
                return self.negation(args[0])
            case Op.AND:
                return self.conjunction(args)
            case Op.OR:
                return self.disjunction(args)
            case Op.ITE:
                return self.ite(args[0], args[1], args[2])
            case _:
                return self._arithmetic(op, tuple(args), sort)

    def _intern(self, key: tuple[object, ...], node: Expr) -> Expr:
        found = self._table.setdefault(key, node)
        if found is node:
            self._range[id(node)] = interval(node, self._range)
        return found

    def _node(self, op: Op, args: Sequence[Expr], sort: Sort) -> Expr:
        return self._intern((op, *map(id, args)), Apply(op, tuple(args), sort))

    # --- truth values ----------------------------------------------------------------------------

    def negation(self, a: Expr) -> Expr:
        if isinstance(a, Const):
            return self.truth(not a.value)
        return a.args[0] if is_apply(a, Op.NOT) else self._node(Op.NOT, (a,), Bool())

    def conjunction(self, args: Sequence[Expr]) -> Expr:
        return self._chain(Op.AND, args, self.true, self.false)

    def disjunction(self, args: Sequence[Expr]) -> Expr:
        return self._chain(Op.OR, args, self.false, self.true)

    def _chain(self, op: Op, args: Sequence[Expr], unit: Expr, zero: Expr) -> Expr:
        parts: dict[int, Expr] = {}
        for arg in args:
            flat = arg.args if is_apply(arg, op) and len(arg.args) <= _FLAT else (arg,)
            parts.update((id(a), a) for a in flat if a is not unit)
        if id(zero) in parts or any(is_apply(a, Op.NOT) and id(a.args[0]) in parts for a in parts.values()):
            return zero
        kept = tuple(parts.values())
        return self._node(op, kept, Bool()) if len(kept) > 1 else kept[0] if kept else unit

    def ite(self, test: Expr, then: Expr, other: Expr) -> Expr:
        """A case distinction; equal branches, constant tests and repeated tests disappear."""
        if isinstance(test, Const):
            return then if test.value else other
        if is_apply(test, Op.NOT):
            return self.ite(test.args[0], other, then)
        then, other = self._under(test, then, 1), self._under(test, other, 2)
        if then is other:
            return then
        if isinstance(then.sort, Bool):
            return self._choice(test, then, other)
        return self._merged(test, then, other)

    @staticmethod
    def _under(test: Expr, branch: Expr, side: int) -> Expr:
        while is_apply(branch, Op.ITE) and branch.args[0] is test:
            branch = branch.args[side]
        return branch

    def _choice(self, test: Expr, then: Expr, other: Expr) -> Expr:
        if then is self.true or then is test:
            return self.disjunction((test, other))
        if then is self.false:
            return self.conjunction((self.negation(test), other))
        if other is self.true:
            return self.disjunction((self.negation(test), then))
        if other is self.false or other is test:
            return self.conjunction((test, then))
        return self._node(Op.ITE, (test, then, other), Bool())

    def _merged(self, test: Expr, then: Expr, other: Expr) -> Expr:
        if is_apply(other, Op.ITE) and other.args[1] is then:
            return self.ite(self.disjunction((test, other.args[0])), then, other.args[2])
        if is_apply(then, Op.ITE) and then.args[2] is other:
            return self.ite(self.conjunction((test, then.args[0])), then.args[1], other)
        result = self._node(Op.ITE, (test, then, other), then.sort)
        self._range[id(result)] = self._range_of_case(test, then, other)
        return result

    def _range_of_case(self, test: Expr, then: Expr, other: Expr) -> Interval:
        """The hull of the branches, each under its condition: a guarded count stays in its domain."""
        facts = Facts(self.range)
        return facts.assuming(test, True).interval(then) | facts.assuming(test, False).interval(other)

    # --- comparisons -----------------------------------------------------------------------------

    def _compare(self, op: Op, a: Expr, b: Expr) -> Expr:
        match op:
            case Op.EQ:
                return self.equal(a, b)
            case Op.NE:
                return self.negation(self.equal(a, b))
            case Op.LE:
                return self.at_most(a, b)
            case Op.GE:
                return self.at_most(b, a)
            case Op.LT:
                return self.negation(self.at_most(b, a))
            case _:
                return self.negation(self.at_most(a, b))

    def equal(self, a: Expr, b: Expr) -> Expr:
        if a is b:
            return self.true
        if isinstance(a, Const):
            a, b = b, a
        x, y = self.range(a), self.range(b)
        if x.high < y.low or y.high < x.low:
            return self.false
        if isinstance(b, Const):
            return self._equals(a, b)
        swapped = (Op.EQ, id(b), id(a))
        return self._table[swapped] if swapped in self._table else self._node(Op.EQ, (a, b), Bool())

    def _equals(self, a: Expr, b: Const) -> Expr:
        """``a == b`` for a constant within the interval of ``a``."""
        if isinstance(a, Const):
            return self.truth(a.value == b.value)
        if isinstance(a.sort, Bool):
            return a if b.value else self.negation(a)
        if is_apply(a, Op.ITE) and _has_constant(a):
            return self._into_branches(Op.EQ, a, b)
        if is_apply(a, Op.ADD) and isinstance(a.args[1], Const):
            return self.equal(a.args[0], self.const(b.value - a.args[1].value, b.sort))
        return self._node(Op.EQ, (a, self.const(b.value, b.sort)), Bool())

    def at_most(self, a: Expr, b: Expr) -> Expr:
        if self.range(a).high <= self.range(b).low or a is b:
            return self.true
        if self.range(a).low > self.range(b).high:
            return self.false
        if isinstance(a, Const):
            return self.negation(self.at_most(b, self.const(a.value - 1, a.sort)))
        if isinstance(b, Const):
            return self._below(a, b)
        return self._node(Op.LE, (a, b), Bool())

    def _below(self, a: Expr, b: Const) -> Expr:
        """``a <= b`` for a constant; undecided by the intervals."""
        if is_apply(a, Op.ITE) and _has_constant(a):
            return self._into_branches(Op.LE, a, b)
        if is_apply(a, Op.ADD) and isinstance(a.args[1], Const):
            return self.at_most(a.args[0], self.const(b.value - a.args[1].value, b.sort))
        return self._node(Op.LE, (a, self.const(b.value, b.sort)), Bool())

    def _into_branches(self, op: Op, case: Apply, b: Const) -> Expr:
        key = (op, id(case), b.value)
        if key not in self._compared:
            then, other = (self._compare(op, branch, b) for branch in case.args[1:])
            self._compared[key] = self.ite(case.args[0], then, other)
        return self._compared[key]

    # --- numbers ---------------------------------------------------------------------------------

    def _arithmetic(self, op: Op, args: tuple[Expr, ...], sort: Sort) -> Expr:
        values = [a.value for a in args if isinstance(a, Const)]
        if len(values) == len(args):
            return self.const(operate(op, *values), sort)
        known = transfer(op, [self.range(a) for a in args])
        if known.low == known.high and op is not Op.BIT:
            return self.const(known.low, sort)
        for simpler in (self._kept(op, args), self._sum(op, args, sort)):
            if simpler is not None:
                return simpler
        return self._node(op, args, sort)

    def _kept(self, op: Op, args: tuple[Expr, ...]) -> Expr | None:
        """The argument that an operator leaves as it is."""
        a, last = args[0], args[-1]
        match op:
            case Op.ABS if self.range(a).low >= 0:
                return a
            case Op.MOD if 0 <= self.range(a).low and self.range(a).high < self.range(last).low:
                return a
            case Op.SCALE | Op.DIV if self.range(last) == Interval(1, 1):
                return a
            case Op.ADD if self.range(a) == Interval(0, 0):
                return last
            case Op.ADD | Op.SUB if self.range(last) == Interval(0, 0):
                return a
            case Op.MIN | Op.MAX:
                lower, upper = (a, last) if self.range(a).low <= self.range(last).low else (last, a)
                if self.range(lower).high <= self.range(upper).low:
                    return lower if op is Op.MIN else upper
        return None

    def _sum(self, op: Op, args: tuple[Expr, ...], sort: Sort) -> Expr | None:
        """``x + constant`` with one constant, on the right."""
        if op is Op.SUB and isinstance(args[1], Const):
            return self.apply(Op.ADD, (args[0], self.const(-args[1].value, sort)), sort)
        if op is not Op.ADD:
            return None
        if isinstance(args[0], Const):
            return self.apply(Op.ADD, (args[1], args[0]), sort)
        inner = args[0]
        if isinstance(args[1], Const) and is_apply(inner, Op.ADD) and isinstance(inner.args[1], Const):
            total = self.const(inner.args[1].value + args[1].value, sort)
            return self.apply(Op.ADD, (inner.args[0], total), sort)
        return None


def _has_constant(case: Apply) -> bool:
    return isinstance(case.args[1], Const) or isinstance(case.args[2], Const)
