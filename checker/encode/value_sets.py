"""Values that a variable, or a formula, may be worth: a few of them, or all between two."""

from collections.abc import Iterable, Sequence
from itertools import product
from math import prod

from rovercheck.checker.system.intervals import Interval, transfer
from rovercheck.spec_model.lang.domain import Domain
from rovercheck.spec_model.lang.evaluate import operate
from rovercheck.spec_model.lang.operators import Op

Values = frozenset[int] | Interval
"""Every value there is, or two between which all are."""

FEW = 16
"""Values that are told one by one."""
_MOST_TRIED = 256

TRUE, FALSE, EITHER = frozenset({1}), frozenset({0}), frozenset({0, 1})


class NoValue(Exception):
    """Nothing can be so."""


def whole(domain: Domain) -> Values:
    """All that a domain has, or more."""
    found = domain.values
    return frozenset(found) if len(found) <= FEW else Interval(domain.low, domain.high)


def ends(values: Values) -> tuple[int, int]:
    """The least and the greatest value."""
    return (values.low, values.high) if isinstance(values, Interval) else (min(values), max(values))


def hull(values: Values) -> Interval:
    """From the least to the greatest."""
    return Interval(*ends(values))


def _few(found: Iterable[int]) -> Values:
    kept = frozenset(found)
    return kept if len(kept) <= FEW else Interval(min(kept), max(kept))


def joined(a: Values, b: Values) -> Values:
    """The values of both, or more."""
    if a == b:
        return a
    if isinstance(a, frozenset) and isinstance(b, frozenset):
        return _few(a | b)
    return hull(a) | hull(b)


def _meet(a: Values, low: int, high: int) -> Values:
    """Those from low to high.  Raises ``NoValue`` if there are none."""
    if isinstance(a, frozenset):
        a = frozenset(v for v in a if low <= v <= high)
        if not a:
            raise NoValue
        return a
    low, high = max(low, a.low), min(high, a.high)
    if low > high:
        raise NoValue
    return Interval(low, high) if high - low >= FEW else frozenset(range(low, high + 1))


def within(found: Values, span: Interval) -> Values:
    """What an assignment leaves in a variable; what leaves a domain whatever happens the search tells."""
    try:
        return _meet(found, span.low, span.high)
    except NoValue:
        return span


# --- what conditions and operators make of them -------------------------------------------------------


def compared(values: Values, op: Op, value: int) -> Values:
    """Those of them that compare so with a value.  Raises ``NoValue`` if none does."""
    span = hull(values)
    match op:
        case Op.EQ:
            return _meet(values, value, value)
        case Op.LT:
            return _meet(values, span.low, value - 1)
        case Op.LE:
            return _meet(values, span.low, value)
        case Op.GT:
            return _meet(values, value + 1, span.high)
        case Op.GE:
            return _meet(values, value, span.high)
        case Op.NE if isinstance(values, frozenset):
            if not values - {value}:
                raise NoValue
            return values - {value}
        case Op.NE if value == span.low:
            return _meet(values, value + 1, span.high)
        case Op.NE if value == span.high:
            return _meet(values, span.low, value - 1)
    return values


CONTRARY = {Op.EQ: Op.NE, Op.NE: Op.EQ, Op.LT: Op.GE, Op.GE: Op.LT, Op.GT: Op.LE, Op.LE: Op.GT}
TURNED = {Op.LT: Op.GT, Op.GT: Op.LT, Op.LE: Op.GE, Op.GE: Op.LE}


def applied(op: Op, args: Sequence[Values]) -> Values:
    """What an operator makes of any of its arguments, or more."""
    few = [arg for arg in args if isinstance(arg, frozenset)]
    if len(few) == len(args) and prod(map(len, few)) <= _MOST_TRIED:
        return _few(operate(op, *vector) for vector in product(*few))
    hulls = [hull(a) for a in args]
    match op:
        case Op.EQ if hulls[0].high < hulls[1].low or hulls[1].high < hulls[0].low:
            return FALSE
        case Op.NE if hulls[0].high < hulls[1].low or hulls[1].high < hulls[0].low:
            return TRUE
        case Op.LT | Op.LE | Op.GT | Op.GE:
            return frozenset(operate(op, x, y) for x, y in product(*map(ends, hulls)))
    found = transfer(op, hulls)
    return frozenset(range(found.low, found.high + 1)) if found.high - found.low < FEW else found
