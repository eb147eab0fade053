"""Facts: what is known of formulas in a branch, from the conditions on the way in."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from rovercheck.checker.system.intervals import Interval
from rovercheck.spec_model.lang.expr import Apply, Const, Expr
from rovercheck.spec_model.lang.operators import Op

Range = Callable[[Expr], Interval]
"""The interval of a formula."""


@dataclass(frozen=True)
class Facts:
    """Truth values and bounds, by ``id`` of the formula (formulas of one table of terms)."""

    range: Range
    truth: Mapping[int, bool] = field(default_factory=dict)
    bounds: Mapping[int, Interval] = field(default_factory=dict)

    def assuming(self, expr: Expr, value: bool) -> "Facts":
        """These facts and that a formula is true, or false."""
        truth, bounds = dict(self.truth), dict(self.bounds)
        todo = [(expr, value)]
        while todo:
            expr, value = todo.pop()
            truth[id(expr)] = value
            if not isinstance(expr, Apply):
                continue
            if expr.op is Op.NOT:
                todo.append((expr.args[0], not value))
            elif expr.op is (Op.AND if value else Op.OR):
                todo.extend((a, value) for a in expr.args)
            elif _is_bound(expr):
                subject, limit = expr.args[0], expr.args[1]
                assert isinstance(limit, Const)
                known = bounds.get(id(subject)) or self.range(subject)
                bounds[id(subject)] = _narrowed(known, expr.op, limit.value, value)
        return Facts(self.range, truth, bounds)

    def interval(self, expr: Expr) -> Interval:
        """The interval of a formula, or of one plus a constant, as far as it is easily seen."""
        known = self.bounds.get(id(expr))
        if known is not None:
            return known
        if isinstance(expr, Apply) and expr.op is Op.ADD and isinstance(expr.args[1], Const):
            base, offset = self.bounds.get(id(expr.args[0])), expr.args[1].value
            return self.range(expr) if base is None else Interval(base.low + offset, base.high + offset)
        return self.range(expr)

    def decide(self, expr: Expr) -> bool | None:
        """The truth value that the facts imply, as far as it is easily seen."""
        if id(expr) in self.truth:
            return self.truth[id(expr)]
        if not isinstance(expr, Apply):
            return None
        if expr.op is Op.NOT:
            inner = self.decide(expr.args[0])
            return None if inner is None else not inner
        limit = expr.args[-1]
        if not _is_bound(expr) or not isinstance(limit, Const):
            return None
        known = self.interval(expr.args[0])
        if expr.op is Op.EQ:
            decided = limit.value not in known or known.low == known.high
            return limit.value in known if decided else None
        return True if known.high <= limit.value else False if known.low > limit.value else None


def _is_bound(expr: Apply) -> bool:
    return expr.op in (Op.EQ, Op.LE) and isinstance(expr.args[1], Const)


def _narrowed(known: Interval, op: Op, limit: int, value: bool) -> Interval:
    low, high = known.low, known.high
    if op is Op.LE:
        low, high = (low, min(high, limit)) if value else (max(low, limit + 1), high)
    elif value:
        low = high = limit
    else:
        low, high = low + (low == limit), high - (high == limit)
    return Interval(low, high) if low <= high else known  # a dead branch: anything goes
