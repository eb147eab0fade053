"""Numbers, units and lengths of time in labels, and the parts of a tree that hold them."""

from collections.abc import Iterator
from fractions import Fraction

from lark import Token

from rovercheck.spec_model.lang.domain import Num, Unit
from rovercheck.spec_model.lang.expr import Const, Expr, const
from rovercheck.spec_model.lang.stateflow.message import LabelError
from rovercheck.spec_model.lang.stateflow.syntax import Node, span
from rovercheck.spec_model.lang.time import Span

TIMES = {
    "tick": Span(Fraction(1), "ticks"), "ticks": Span(Fraction(1), "ticks"),
    "usec": Span(Fraction(1, 1000), "ms"), "µs": Span(Fraction(1, 1000), "ms"),
    "us": Span(Fraction(1, 1000), "ms"), "msec": Span(Fraction(1), "ms"), "ms": Span(Fraction(1), "ms"),
    "sec": Span(Fraction(1000), "ms"), "s": Span(Fraction(1000), "ms"), "min": Span(Fraction(60_000), "ms"),
}  # fmt: skip
"""Units of lengths of time."""

SCALES = (
    {"µs": Fraction(1, 1000), "ms": Fraction(1), "s": Fraction(1000), "min": Fraction(60_000),
     "h": Fraction(3_600_000)},
    {"mm": Fraction(1), "cm": Fraction(10), "m": Fraction(1000), "km": Fraction(1_000_000)},
)  # fmt: skip
"""Units in which a written number is converted to that of a datum, exactly."""


def subtree(node: Node, at: int) -> Node:
    part = node.children[at]
    assert not isinstance(part, Token)
    return part


def subtrees(node: Node) -> list[Node]:
    return [part for part in node.children if not isinstance(part, Token)]


def arguments(node: Node) -> list[Node]:
    """The arguments of a call."""
    return [one for part in subtrees(node) for one in subtrees(part)]


def is_literal(node: Node) -> bool:
    """Whether a part is a number, perhaps with a sign, or a fraction of two."""
    if node.data in ("signed", "formula"):
        return is_literal(subtree(node, -1))
    if node.data == "computed" and str(node.children[1]) == "/":
        return is_literal(subtree(node, 0)) and is_literal(subtree(node, 2))
    return node.data in ("number", "quantity")


def factors(node: Node, below: bool) -> Iterator[tuple[Node, bool]]:
    """What a product is made of, and whether it is divided by."""
    if node.data != "computed" or str(node.children[1]) not in ("*", "/"):
        yield node, below
        return
    yield from factors(subtree(node, 0), below)
    yield from factors(subtree(node, 2), below != (str(node.children[1]) == "/"))


def folded(one: Expr, other: Const) -> Expr:
    """The product of two constants, as one: a fraction such as 1/3."""
    assert isinstance(one, Const) and isinstance(one.sort, Num) and isinstance(other.sort, Num)
    value = one.value * one.sort.resolution * other.value * other.sort.resolution
    return const(value, one.sort.unit * other.sort.unit)


def inverse(unit: Unit) -> Unit:
    return Unit(tuple((symbol, -power) for symbol, power in unit.powers))


def number_in(node: Node) -> Fraction:
    return read_number(str(node.children[0]))


def read_number(number: str) -> Fraction:
    number = number.rstrip("fFuU") if not number.lower().startswith("0x") else number
    return Fraction(int(number, 16)) if number.lower().startswith("0x") else Fraction(number.rstrip("."))


def split_quantity(quantity: str) -> tuple[str, str]:
    """A number and its unit."""
    number, _, unit = quantity.partition(" ")
    if not unit:
        at = next(at for at, sign in enumerate(quantity) if not (sign.isdigit() or sign in ".eE+-"))
        number, unit = quantity[:at], quantity[at:]
    return number.strip(), unit.strip()


def unit_of_time(node: Node) -> Span:
    """The unit of `after(3, sec)`."""
    name = str(node.children[0]) if node.data == "name" else ""
    if name not in TIMES:
        raise LabelError(
            f"`{name or 'this'}` is no unit of time; write `sec`, `msec`, `usec` or `tick`. Times after "
            "an event are counted in a datum.",
            span(node),
        )
    return TIMES[name]
