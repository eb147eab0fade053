"""Conditions as people type them: ``Relay.B2_actuating and heartbeat_age > 100``; parsed, never executed."""

import ast
import re
from collections.abc import Callable, Mapping
from dataclasses import replace
from math import isfinite
from operator import add, eq, ge, gt, le, lt, mul, ne, sub
from typing import Any

from rovercheck.checker.explore.by_hand.names import Names
from rovercheck.checker.explore.by_hand.value_syntax import RefusedInput
from rovercheck.spec_model.lang.chart import Chart
from rovercheck.spec_model.lang.domain import Bool, Enum
from rovercheck.spec_model.lang.errors import ModelError, did_you_mean
from rovercheck.spec_model.lang.expr import Expr, all_of, any_of, const, lift

_AS_DRAWN = ((r"&&", " and "), (r"\|\|", " or "), (r"!(?!=)", " not "))
"""What transitions are labelled with, and what it is called in Python."""
_QUOTED = r"'[^']*'|\"[^\"]*\""

_COMPARED: Mapping[type[ast.cmpop], Callable[[Any, Any], Any]] = {
    ast.Eq: eq, ast.NotEq: ne, ast.Lt: lt, ast.LtE: le, ast.Gt: gt, ast.GtE: ge,
}  # fmt: skip
_COMPUTED: Mapping[type[ast.operator], Callable[[Any, Any], Any]] = {
    ast.Add: add, ast.Sub: sub, ast.Mult: mul,
}  # fmt: skip


def condition(written: str, names: Names) -> Expr:
    """The formula that is meant.  Raises ``RefusedInput`` for what has no meaning, saying what to write.

    Where a name and a difference are written alike (``B2-B1``), it is the name.
    """
    for drawn, called in _AS_DRAWN:
        written = re.sub(drawn, called, written)
    parsable, names = _spelled(written.strip(), names)
    try:
        tree = ast.parse(parsable, mode="eval")
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        raise RefusedInput(f"{written.strip()!r} is no condition. {names.help}") from None
    try:
        found = _meant(tree.body, names)
    except ModelError as error:
        raise RefusedInput(str(error)) from None
    except RecursionError:
        raise RefusedInput("The condition is nested too deeply. Split it.") from None
    if not isinstance(found.sort, Bool):
        raise RefusedInput(f"`{found}` is neither true nor false ({found.sort}); compare it. {names.help}")
    return found


def _spelled(written: str, names: Names) -> tuple[str, Names]:
    """The condition with every variable spelled as Python can read it, and the names with these spellings."""
    odd = [n for n in names.variables if not all(part.isidentifier() for part in n.split("."))]
    if not odd:
        return written, names
    spelled = {name: f"__{number}__" for number, name in enumerate(odd)}
    longest_first = "|".join(re.escape(name) for name in sorted(odd, key=len, reverse=True))
    parsable = re.sub(
        rf"{_QUOTED}|(?<![\w.])(?:{longest_first})(?![\w.])",
        lambda found: spelled.get(found.group(), found.group()),
        written,
    )
    known = {s: names.variables[n] for n, s in spelled.items()}
    return parsable, replace(names, variables={**names.variables, **known}, spelled=known)


def _meant(node: ast.expr, names: Names) -> Expr:
    match node:
        case ast.BoolOp(op, parts):
            joined = all_of if isinstance(op, ast.And) else any_of
            return joined(*(_meant(part, names) for part in parts))
        case ast.UnaryOp(ast.Not(), part):
            return ~_meant(part, names)
        case ast.UnaryOp(ast.USub(), part):
            return -_meant(part, names)
        case ast.Compare():
            return _comparison(node, names)
        case ast.BinOp(left, op, right) if type(op) in _COMPUTED:
            return _lifted(_COMPUTED[type(op)](_side(left, None, names), _side(right, None, names)))
        case ast.Constant(bool() | int() | float() as number) if isfinite(number):
            return const(number)
        case ast.Name() | ast.Attribute():
            return _named(_dotted(node, names), names)
    raise _meaningless(node, names)


def _meaningless(node: ast.expr, names: Names) -> RefusedInput:
    shown = ast.unparse(node)
    for spelled, var in names.spelled.items():
        shown = shown.replace(spelled, var.name)
    return RefusedInput(f"`{shown}` has no meaning in a condition. {names.help}")


def _comparison(node: ast.Compare, names: Names) -> Expr:
    sides = [node.left, *node.comparators]
    pairs = zip(sides, sides[1:], node.ops, strict=False)
    return all_of(*(_compared(left, right, op, names) for left, right, op in pairs))


def _compared(left: ast.expr, right: ast.expr, op: ast.cmpop, names: Names) -> Expr:
    if type(op) not in _COMPARED:
        raise RefusedInput(f"`in` and `is` have no meaning in a condition. {names.help}")
    like = _enum(left, names) or _enum(right, names)
    first, second = (_side(side, like, names) for side in (left, right))
    found = _COMPARED[type(op)](first, second)
    return _lifted(found)


def _lifted(found: Expr | float) -> Expr:
    """What Python computed of numbers alone is a constant."""
    return found if isinstance(found, Expr) else const(found)


def _enum(node: ast.expr, names: Names) -> Enum | None:
    """The enumeration that a side of a comparison belongs to, if it is a variable of one."""
    if isinstance(node, ast.Name | ast.Attribute):
        var = names.variables.get(_dotted(node, names))
        return var.sort if var is not None and isinstance(var.sort, Enum) else None
    return None


def _side(node: ast.expr, like: Enum | None, names: Names) -> Expr | int | float:
    """A side of a comparison; beside an enumeration a name is a member, beside a number one has its unit."""
    match node:
        case ast.Constant(int() | float() as number) if not isinstance(number, bool) and isfinite(number):
            return number
        case ast.UnaryOp(ast.USub(), ast.Constant(int() | float() as number)) if isfinite(number):
            return -number
    if like is not None and isinstance(node, ast.Name) and node.id not in names.variables:
        return lift(node.id, like)
    if like is not None and isinstance(node, ast.Constant) and isinstance(node.value, str):
        return lift(node.value, like)
    return _meant(node, names)


def _dotted(node: ast.expr, names: Names) -> str:
    match node:
        case ast.Name(name):
            return name
        case ast.Attribute(inner, name):
            return f"{_dotted(inner, names)}.{name}"
    raise _meaningless(node, names)


def _named(name: str, names: Names) -> Expr:
    if name in ("true", "false"):
        return const(name == "true")
    if name in names.variables:
        return names.variables[name]
    chart, _, state = name.partition(".")
    if chart in names.charts and state:
        return names.charts[chart].active(state)
    if chart in names.charts:
        raise ModelError(
            f"{chart} is a chart; write one of its states, such as {_a_state(names.charts[chart])}."
        )
    known = [*(v.name for v in names.variables.values()), *names.states]
    known = [one for one in known if one.startswith(f"{name}-")] or known
    raise RefusedInput(f"There is no variable or state {name!r}. {did_you_mean(name, known)}")


def _a_state(chart: Chart) -> str:
    return next(f"{chart.name}.{'.'.join(path)}" for path in chart.states if path)
