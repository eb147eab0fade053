"""Variables of a model declared anew, in wider domains or finer steps; all that speaks of them goes along."""

from collections.abc import Iterable

from rovercheck.spec_model.lang.action import Action, Assign, assign, kept
from rovercheck.spec_model.lang.domain import Bool, Num
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import Apply, Expr, Var, aligned
from rovercheck.spec_model.lang.operators import COMPARISONS, Op
from rovercheck.spec_model.lang.specialise import Specialiser


class Redeclarer(Specialiser):
    """Replaces variables by others of the same names in formulas, charts and systems.

    In finer steps, formulas are brought to a common resolution again.  ``ModelError`` is raised for one that
    means something else then, such as a remainder, and for what is too coarse to take such a value.
    """

    def __init__(self, variables: Iterable[Var]) -> None:
        super().__init__({v.name: v for v in variables})

    def _expr(self, expr: Expr) -> Expr:
        if not isinstance(expr, Apply):
            return super()._expr(expr)
        args = tuple(self.expr(a) for a in expr.args)
        if all(a is b for a, b in zip(args, expr.args, strict=True)):
            return expr
        if all(a.sort == b.sort for a, b in zip(args, expr.args, strict=True)):
            return Apply(expr.op, args, expr.sort)
        return _aligned(expr, args)

    def _action(self, action: Action) -> tuple[Action, ...]:
        if not isinstance(action, Assign):
            return super()._action(action)
        var, value = self._declared(action.var), self.expr(action.value)
        same = value.sort == var.sort
        return (kept(action, Assign(var, value) if same else assign(var, value)),)


def _aligned(expr: Apply, args: tuple[Expr, ...]) -> Expr:
    """A formula some of whose arguments have other steps."""
    match expr.op, args:
        case Op.SCALE, (number, _):
            return number  # what it stands in is aligned in its turn
        case ((Op.NEG | Op.ABS), (number,)):
            return Apply(expr.op, args, number.sort)
        case ((Op.ADD | Op.SUB | Op.MIN | Op.MAX), _):
            numbers, sort = aligned(expr.op.value, *args)
            return Apply(expr.op, numbers, sort)
        case Op.ITE, (test, *branches):
            numbers, sort = aligned("ite", *branches)
            return Apply(Op.ITE, (test, *numbers), sort)
        case Op.MUL, (left, right):
            assert isinstance(left.sort, Num) and isinstance(right.sort, Num)
            resolution = left.sort.resolution * right.sort.resolution
            return Apply(Op.MUL, args, Num(resolution, left.sort.unit * right.sort.unit))
        case op, _ if op in COMPARISONS:
            return Apply(op, aligned(op.value, *args)[0], Bool())
    raise ModelError(f"`{expr}` means something else in finer steps.")
