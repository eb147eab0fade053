"""Meaning of expressions and programs: the reference every encoder is compared with."""

from collections.abc import Callable, Mapping, MutableMapping, Sequence

from rovercheck.spec_model.lang.action import Action, Assign, If
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Named, Temporal, Var
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.system import TransitionSystem


def evaluate(expr: Expr, at: Mapping[str, int]) -> int:
    """The raw value of a formula without temporal words in a state (booleans are 0 and 1)."""
    if isinstance(expr, Apply):
        op, args = expr.op, expr.args
        if op is _AND:
            for arg in args:
                if not evaluate(arg, at):
                    return 0
            return 1
        if op is _OR:
            for arg in args:
                if evaluate(arg, at):
                    return 1
            return 0
        if op is _ITE:
            return evaluate(args[1] if evaluate(args[0], at) else args[2], at)
        if len(args) == 2:
            return OPERATIONS[op](evaluate(args[0], at), evaluate(args[1], at))
        return OPERATIONS[op](*[evaluate(arg, at) for arg in args])
    if isinstance(expr, Var):
        return at[expr.name]
    if isinstance(expr, Const):
        return expr.value
    if isinstance(expr, Named):
        return evaluate(expr.body, at)
    if isinstance(expr, Temporal):
        raise ModelError(f"`{expr}` speaks of the past; lower the chart or reduce the property first.")
    raise AssertionError(expr.__class__)


_AND, _OR, _ITE = Op.AND, Op.OR, Op.ITE  # an attribute of an enumeration costs as much as the operation


def operate(op: Op, *v: int) -> int:
    """An operator on raw values, all of them known."""
    return OPERATIONS[op](*v)


OPERATIONS: Mapping[Op, Callable[..., int]] = {
    Op.NOT: lambda a: 1 - a,
    Op.AND: lambda *v: int(all(v)),
    Op.OR: lambda *v: int(any(v)),
    Op.ITE: lambda test, then, other: then if test else other,
    Op.EQ: lambda a, b: 1 if a == b else 0,
    Op.NE: lambda a, b: 1 if a != b else 0,
    Op.LT: lambda a, b: 1 if a < b else 0,
    Op.LE: lambda a, b: 1 if a <= b else 0,
    Op.GT: lambda a, b: 1 if a > b else 0,
    Op.GE: lambda a, b: 1 if a >= b else 0,
    Op.ADD: lambda a, b: a + b,
    Op.SUB: lambda a, b: a - b,
    Op.NEG: lambda a: -a,
    Op.MUL: lambda a, b: a * b,
    Op.SCALE: lambda a, b: a * b,
    Op.DIV: lambda a, b: a // b,
    Op.MOD: lambda a, b: a % b,
    Op.ABS: abs,
    Op.MIN: min,
    Op.MAX: max,
    Op.BIT: lambda a, index: a >> index & 1,
}


def run(program: Sequence[Action], at: MutableMapping[str, int]) -> None:
    """Run the statements of a lowered program in place."""
    for statement in program:
        if isinstance(statement, Assign):
            at[statement.var.name] = evaluate(statement.value, at)
        elif isinstance(statement, If):
            run(statement.then if evaluate(statement.condition, at) else statement.otherwise, at)
        else:
            raise ModelError(f"`{statement}` belongs to a chart; lower the chart first.")


def step(system: TransitionSystem, before: Mapping[str, int], inputs: Mapping[str, int]) -> dict[str, int]:
    """The state after one tick: ``before`` with every variable that the step writes updated.

    ``before`` holds the variables and the frozen variables; the result holds these and the inputs.
    """
    at = {**before, **inputs}
    run(system.step, at)
    for temp in system.temps:
        at.pop(temp.name, None)
    return at


def admissible(system: TransitionSystem, before: Mapping[str, int], inputs: Mapping[str, int]) -> bool:
    """Whether the inputs lie in their domains and satisfy the system's assumption."""
    at = {**before, **inputs}
    return all(at[v.name] in v.domain for v in system.inputs) and bool(evaluate(system.assume, at))
