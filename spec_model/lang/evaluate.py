"""Meaning of expressions and programs: the reference every encoder is compared with."""

from collections.abc import Mapping, MutableMapping, Sequence

from spec_model.lang.action import Action, Assign, If, Send
from spec_model.lang.errors import ModelError
from spec_model.lang.expr import Apply, Const, Expr, Named, Op, Temporal, Var
from spec_model.lang.system import TransitionSystem


def evaluate(expr: Expr, at: Mapping[str, int]) -> int:
    """The raw value of a formula without temporal words in a valuation (booleans are 0 and 1)."""
    match expr:
        case Const(value, _):
            return value
        case Var(name):
            return at[name]
        case Named(_, body):
            return evaluate(body, at)
        case Apply(op, args, _):
            return _apply(op, args, at)
        case Temporal():
            raise ModelError(f"`{expr}` speaks of the past; lower the chart or reduce the property first.")
    raise AssertionError(expr.__class__)


def _apply(op: Op, args: tuple[Expr, ...], at: Mapping[str, int]) -> int:
    match op:
        case Op.AND:
            return int(all(evaluate(a, at) for a in args))
        case Op.OR:
            return int(any(evaluate(a, at) for a in args))
        case Op.ITE:
            return evaluate(args[1] if evaluate(args[0], at) else args[2], at)
        case _:
            return operate(op, *(evaluate(a, at) for a in args))


def operate(op: Op, *v: int) -> int:
    """An operator on raw values."""
    match op:
        case Op.NOT:
            return 1 - v[0]
        case Op.AND:
            return int(all(v))
        case Op.OR:
            return int(any(v))
        case Op.ITE:
            return v[1] if v[0] else v[2]
        case Op.EQ:
            return int(v[0] == v[1])
        case Op.NE:
            return int(v[0] != v[1])
        case Op.LT:
            return int(v[0] < v[1])
        case Op.LE:
            return int(v[0] <= v[1])
        case Op.GT:
            return int(v[0] > v[1])
        case Op.GE:
            return int(v[0] >= v[1])
        case Op.ADD:
            return v[0] + v[1]
        case Op.SUB:
            return v[0] - v[1]
        case Op.NEG:
            return -v[0]
        case Op.MUL | Op.SCALE:
            return v[0] * v[1]
        case Op.DIV:
            return v[0] // v[1]
        case Op.MOD:
            return v[0] % v[1]
        case Op.ABS:
            return abs(v[0])
        case Op.MIN:
            return min(v)
        case Op.MAX:
            return max(v)
        case Op.BIT:
            return v[0] >> v[1] & 1


def run(program: Sequence[Action], at: MutableMapping[str, int]) -> None:
    """Run the statements of a lowered program in place."""
    for statement in program:
        match statement:
            case Assign(var, value):
                at[var.name] = evaluate(value, at)
            case If(condition, then, otherwise):
                run(then if evaluate(condition, at) else otherwise, at)
            case Send():
                raise ModelError(f"`{statement}` belongs to a chart; lower the chart first.")


def step(system: TransitionSystem, before: Mapping[str, int], inputs: Mapping[str, int]) -> dict[str, int]:
    """The valuation after one tick: ``before`` with every variable that the step writes updated.

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
