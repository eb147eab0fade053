"""Interval analysis: the least and greatest raw value that a formula can take.

Variables range over the hull of their domains; booleans are 0..1.  The analysis knows nothing of
paths, so an interval may be wider than what is reachable, never narrower.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Named, Var
from rovercheck.spec_model.lang.operators import COMPARISONS, Op
from rovercheck.spec_model.lang.walk import children


@dataclass(frozen=True, slots=True)
class Interval:
    """The whole numbers low..high, ends included."""

    low: int
    high: int

    def __or__(self, other: "Interval") -> "Interval":
        """The hull of both."""
        return Interval(min(self.low, other.low), max(self.high, other.high))

    def __contains__(self, value: int) -> bool:
        return self.low <= value <= self.high

    def within(self, other: "Interval") -> bool:
        return other.low <= self.low and self.high <= other.high

    @property
    def width(self) -> int:
        """Bits of the narrowest signed bit-vector that holds every value."""
        return (
            max(
                self.low.bit_length() if self.low >= 0 else (~self.low).bit_length(),
                self.high.bit_length() if self.high >= 0 else (~self.high).bit_length(),
            )
            + 1
        )


TRUTH = Interval(0, 1)


def postorder(*roots: Expr) -> Iterator[Expr]:
    """Every node reachable from the roots once, children before parents; deep formulas are welcome."""
    done: set[int] = set()
    stack = [(root, False) for root in reversed(roots)]
    while stack:
        expr, ready = stack.pop()
        if id(expr) in done:
            continue
        if ready:
            done.add(id(expr))
            yield expr
        else:
            stack.append((expr, True))
            stack.extend((child, False) for child in children(expr) if id(child) not in done)


def intervals(*roots: Expr) -> dict[int, Interval]:
    """The interval of every node under the roots, by ``id``."""
    known: dict[int, Interval] = {}
    for expr in postorder(*roots):
        known[id(expr)] = interval(expr, known)
    return known


def interval(expr: Expr, known: Mapping[int, Interval]) -> Interval:
    """The interval of a node, those of its children being known by ``id``."""
    match expr:
        case Const(value, _):
            return Interval(value, value)
        case Var(_, domain):
            return Interval(domain.low, domain.high)
        case Named(_, body):
            return known[id(body)]
        case Apply(op, args, _):
            return transfer(op, [known[id(a)] for a in args])
    raise AssertionError(f"{expr} speaks of the past")


def transfer(op: Op, args: Sequence[Interval]) -> Interval:
    """The interval of an operator's result from those of its arguments."""
    return OPERATIONS[op](*args)


def _truth(*args: Interval) -> Interval:
    return TRUTH


def _product(a: Interval, b: Interval) -> Interval:
    corners = [x * y for x in (a.low, a.high) for y in (b.low, b.high)]
    return Interval(min(corners), max(corners))


OPERATIONS: Mapping[Op, Callable[..., Interval]] = {
    **dict.fromkeys((Op.NOT, Op.AND, Op.OR, Op.BIT, *COMPARISONS), _truth),
    Op.ITE: lambda test, a, b: a | b,
    Op.ADD: lambda a, b: Interval(a.low + b.low, a.high + b.high),
    Op.SUB: lambda a, b: Interval(a.low - b.high, a.high - b.low),
    Op.NEG: lambda a: Interval(-a.high, -a.low),
    Op.MUL: _product,
    Op.SCALE: _product,
    Op.DIV: lambda a, b: Interval(a.low // b.low, a.high // b.low),
    Op.MOD: lambda a, b: a if 0 <= a.low and a.high < b.low else Interval(0, b.low - 1),
    Op.ABS: lambda a: Interval(max(a.low, -a.high, 0), max(-a.low, a.high)),
    Op.MIN: lambda a, b: Interval(min(a.low, b.low), min(a.high, b.high)),
    Op.MAX: lambda a, b: Interval(max(a.low, b.low), max(a.high, b.high)),
}
