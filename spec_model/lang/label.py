"""Print expressions and actions the way Stateflow writes them on a transition."""

import re
from collections.abc import Callable, Collection, Mapping, Sequence

from rovercheck.spec_model.lang.domain import Bool, Enum, Num, show
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Named, Temporal, Var, When
from rovercheck.spec_model.lang.operators import COMPARISONS, Op

_ATOM = re.compile(r"[\w.]+(\(.*\))?")
"""Names that need no parentheses beside an operator; ``nearest <= 300`` does."""


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
            shown = constant(value, sort)
            return f"({shown})" if above > 5 and isinstance(sort, Num) and "/" in shown else shown
        case Var(name):
            return name
        case Named(name):
            return name if above < 3 or _ATOM.fullmatch(name) else f"({name})"
        case Temporal(when):
            shown = _temporal(expr)
            return f"({shown})" if when is When.DURATION and above >= 3 else shown
        case Apply(op, args, _):
            return OPERATIONS[op](args, above)
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


Row = Callable[[Sequence[Expr], int], str]
"""Shows an operator with its arguments, in parentheses where the level around it, ``above``, asks for it."""


def _between(level: int, sign: str, alike: Collection[Op] = ()) -> Row:
    """A sign between the arguments; ``alike``: however such arguments are grouped, the value is the same."""

    def inner(arg: Expr, first: bool) -> int:
        while isinstance(arg, Apply) and arg.op is Op.SCALE:
            arg = arg.args[0]
        grouped = arg.op in alike if isinstance(arg, Apply) else bool(alike)
        return level if first or grouped else level + 1

    def row(args: Sequence[Expr], above: int) -> str:
        shown = sign.join(_show(a, inner(a, at == 0)) for at, a in enumerate(args))
        return f"({shown})" if above > level or (above == level == 3) else shown

    return row


def _before(sign: str) -> Row:
    return lambda args, above: sign + _show(args[0], 6)


def _called(name: str) -> Row:
    return lambda args, above: f"{name}({', '.join(_show(a, 0) for a in args)})"


def _choice(args: Sequence[Expr], above: int) -> str:
    shown = f"{_show(args[0], 1)} ? {_show(args[1], 1)} : {_show(args[2], 0)}"
    return f"({shown})" if above else shown


OPERATIONS: Mapping[Op, Row] = {
    Op.ITE: _choice,
    Op.OR: _between(1, " || ", tuple(Op)),
    Op.AND: _between(2, " && ", tuple(Op)),
    **{op: _between(3, f" {op} ") for op in COMPARISONS},
    Op.ADD: _between(4, " + ", tuple(Op)),
    Op.SUB: _between(4, " - "),
    Op.MUL: _between(5, "*", (Op.MUL,)),
    Op.DIV: _between(5, " div "),
    Op.MOD: _between(5, " mod "),
    Op.NOT: _before("!"),
    Op.NEG: _before("-"),
    Op.SCALE: lambda args, above: _show(args[0], above),
    Op.ABS: _called("abs"),
    Op.MIN: _called("min"),
    Op.MAX: _called("max"),
    Op.BIT: _called("bit"),
}
"""Every operator as it is shown, those that bind least tightly first."""


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
