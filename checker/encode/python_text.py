"""Formulas as Python text: charts that are run many times over are compiled to Python functions."""

from collections.abc import Callable, Mapping

from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Named, Var
from rovercheck.spec_model.lang.operators import SIGNS, Op


def text_of(expr: Expr, read: Callable[[Var], str], operations: "Mapping[Op, Row] | None" = None) -> str:
    """The text of a formula without temporal words; ``read`` gives that of a variable.

    It means what ``spec_model.lang.evaluate`` says; Python's truth values are as good as 0 and 1.
    ``operations``: how operators are written, if not as in ``OPERATIONS``.
    """
    written = OPERATIONS if operations is None else operations
    match expr:
        case Const(value, _):
            return f"({value})" if value < 0 else str(int(value))
        case Var():
            return read(expr)
        case Named(_, body):
            return text_of(body, read, written)
        case Apply(op, args, _):
            return written[op](*(text_of(a, read, written) for a in args))
    raise AssertionError(f"{expr} speaks of the past")


Row = Callable[..., str]
"""The text of an operator's arguments becomes that of its result."""


def between(sign: str) -> Row:
    return lambda *args: f"({f' {sign} '.join(args)})"


def _called(name: str) -> Row:
    return lambda *args: f"{name}({', '.join(args)})"


OPERATIONS: Mapping[Op, Row] = {
    **{op: between(sign) for op, sign in SIGNS.items()},
    Op.NOT: lambda a: f"(0 if {a} else 1)",
    Op.AND: lambda *args: f"(1 if {between('and')(*args)} else 0)",
    Op.OR: lambda *args: f"(1 if {between('or')(*args)} else 0)",
    Op.ITE: lambda test, then, otherwise: f"({then} if {test} else {otherwise})",
    Op.NEG: lambda a: f"(-{a})",
    Op.DIV: between("//"),
    Op.MOD: between("%"),
    Op.ABS: _called("abs"),
    Op.MIN: _called("min"),
    Op.MAX: _called("max"),
    Op.BIT: lambda a, index: f"({a} >> {index} & 1)",
}
"""Every operator in Python; the fingerprint of a board is taken of these texts."""
