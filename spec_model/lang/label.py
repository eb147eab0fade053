"""Print expressions and actions the way Stateflow writes them on a transition."""

import re

from spec_model.lang.domain import Bool, Enum, Num, show
from spec_model.lang.expr import Apply, Const, Expr, Named, Temporal, Var, When
from spec_model.lang.operators import Op

_INFIX = {
    Op.OR: (1, " || "), Op.AND: (2, " && "),
    Op.EQ: (3, " == "), Op.NE: (3, " != "), Op.LT: (3, " < "), Op.LE: (3, " <= "),
    Op.GT: (3, " > "), Op.GE: (3, " >= "),
    Op.ADD: (4, " + "), Op.SUB: (4, " - "), Op.MUL: (5, "*"), Op.DIV: (5, " div "), Op.MOD: (5, " mod "),
}  # fmt: skip
_ATOM = re.compile(r"[\w.]+(\(.*\))?")
"""Names that need no parentheses beside an operator; ``nearest <= 300`` does."""
_CALL = {Op.ABS: "abs", Op.MIN: "min", Op.MAX: "max", Op.BIT: "bit"}


def text(expr: Expr, unfold: bool = False) -> str:
    """The formula in one line; ``unfold`` shows what stands behind the outermost name."""
    return _show(expr.body if unfold and isinstance(expr, Named) else expr, 0)


def beside(operand: object, sign: str, right: bool = False) -> str:
    """An operand of an operator of Python's as it is written there, in parentheses where it needs them."""
    level = 5 if sign in ("%", "/", "//") else 4
    return _show(operand, level + right) if isinstance(operand, Expr) else str(operand)


def _show(expr: Expr, above: int) -> str:
    match expr:
        case Const(value, sort):
            return constant(value, sort)
        case Var(name):
            return name
        case Named(name):
            return name if above < 3 or _ATOM.fullmatch(name) else f"({name})"
        case Temporal():
            return _temporal(expr)
        case Apply(op, args, _):
            return _apply(op, args, above)
    raise AssertionError(expr.__class__)


def constant(value: int, sort: Bool | Enum | Num) -> str:
    """A raw value as a person writes it."""
    match sort:
        case Bool():
            return "true" if value else "false"
        case Enum() as enum:
            return enum.member(value)
        case Num(resolution, _):
            return show(value * resolution)


def _apply(op: Op, args: tuple[Expr, ...], above: int) -> str:
    match op:
        case Op.NOT:
            return "!" + _show(args[0], 6)
        case Op.NEG:
            return "-" + _show(args[0], 6)
        case Op.SCALE:
            return _show(args[0], above)
        case Op.ITE:
            shown = f"{_show(args[0], 1)} ? {_show(args[1], 1)} : {_show(args[2], 0)}"
            return f"({shown})" if above else shown
    if op in _CALL:
        return f"{_CALL[op]}({', '.join(_show(a, 0) for a in args)})"
    level, sign = _INFIX[op]
    shown = sign.join(
        _show(a, level if position == 0 or op in (Op.AND, Op.OR, Op.ADD, Op.MUL) else level + 1)
        for position, a in enumerate(args)
    )
    return f"({shown})" if above > level or (above == level == 3) else shown


def _temporal(expr: Temporal) -> str:
    inner = "" if expr.arg is None else _show(expr.arg, 0)
    match expr.when:
        case When.AFTER:
            return f"after({expr.span})"
        case When.DURATION:
            return f"duration({inner}) {'>' if expr.strict else '>='} {expr.span}"
        case When.HELD:
            return f"held({inner}, {expr.span})"
        case When.RISING:
            return f"rising({inner})"
        case When.PREVIOUS:
            return f"previous({inner})"
        case When.ONCE:
            return f"once({inner})"
