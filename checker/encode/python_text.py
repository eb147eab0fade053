"""Formulas as Python text: charts that are run many times over are compiled to Python functions."""

from collections.abc import Callable, Sequence

from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Named, Var
from rovercheck.spec_model.lang.operators import Op

_BETWEEN = {
    Op.AND: " and ", Op.OR: " or ", Op.EQ: " == ", Op.NE: " != ", Op.LT: " < ", Op.LE: " <= ",
    Op.GT: " > ", Op.GE: " >= ", Op.ADD: " + ", Op.SUB: " - ", Op.MUL: " * ", Op.SCALE: " * ",
    Op.DIV: " // ", Op.MOD: " % ",
}  # fmt: skip


def text_of(expr: Expr, read: Callable[[Var], str]) -> str:
    """The text of a formula without temporal words; ``read`` gives that of a variable.

    It means what ``spec_model.lang.evaluate`` says; Python's truth values are as good as 0 and 1.
    """
    match expr:
        case Const(value, _):
            return f"({value})" if value < 0 else str(int(value))
        case Var():
            return read(expr)
        case Named(_, body):
            return text_of(body, read)
        case Apply(op, args, _):
            return _operation(op, [text_of(a, read) for a in args])
    raise AssertionError(f"{expr} speaks of the past")


def _operation(op: Op, args: Sequence[str]) -> str:
    if op in _BETWEEN:
        joined = f"({_BETWEEN[op].join(args)})"
        return joined if op not in (Op.AND, Op.OR) else f"(1 if {joined} else 0)"
    match op:
        case Op.NOT:
            return f"(0 if {args[0]} else 1)"
        case Op.ITE:
            return f"({args[1]} if {args[0]} else {args[2]})"
        case Op.NEG:
            return f"(-{args[0]})"
        case Op.BIT:
            return f"({args[0]} >> {args[1]} & 1)"
        case _:
            return f"{op.value}({', '.join(args)})"
