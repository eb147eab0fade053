"""Walking formulas: sub-expressions, variables, structure."""

from collections.abc import Iterator

from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Named, Temporal, Var
from rovercheck.spec_model.lang.operators import Op


def children(expr: Expr) -> tuple[Expr, ...]:
    """The direct sub-expressions."""
    if isinstance(expr, Apply):  # asked of every node of every formula: a pattern takes three times as long
        return expr.args
    if isinstance(expr, Named):
        return (expr.body,)
    if isinstance(expr, Temporal):
        return () if expr.arg is None else (expr.arg,)
    return ()


def nodes(*roots: Expr) -> Iterator[Expr]:
    """Every node reachable from the roots once, parents before children."""
    seen: set[int] = set()
    stack = list(roots[::-1])
    while stack:
        expr = stack.pop()
        if id(expr) not in seen:
            seen.add(id(expr))
            yield expr
            stack += children(expr)[::-1]


def variables(*roots: Expr) -> dict[str, Var]:
    """The variables that occur, by name, in order of first occurrence."""
    found: dict[str, Var] = {}
    seen: set[int] = set()
    stack = list(roots[::-1])
    while stack:  # as `nodes` does, in half the time: slicing asks little else
        expr = stack.pop()
        if isinstance(expr, Var):
            found[expr.name] = expr
        elif not isinstance(expr, Const) and id(expr) not in seen:
            seen.add(id(expr))
            stack += children(expr)[::-1]
    return found


def plain(expr: Expr) -> Expr:
    """The formula under any names."""
    while isinstance(expr, Named):
        expr = expr.body
    return expr


def outermost(expr: Expr) -> tuple[Expr, ...]:
    """The parts of a conjunction, which are not looked into; else the formula alone."""
    inner = plain(expr)
    return inner.args if isinstance(inner, Apply) and inner.op is Op.AND else (expr,)


def structure(expr: Expr) -> tuple[object, ...]:
    """A key equal for two formulas iff they are built alike (names see-through)."""
    match expr:
        case Const(value, sort):
            return ("const", value, sort)
        case Var(name):
            return ("var", name)
        case Named(_, body):
            return structure(body)
        case Apply(op, args, _):
            return (op, *(structure(a) for a in args))
        case Temporal(when, arg, span, strict):
            return (when, None if arg is None else structure(arg), span, strict)
    raise AssertionError(expr.__class__)


class Shapes:
    """A number for each formula, one for all that are built alike: ``structure`` for many questions."""

    def __init__(self) -> None:
        self._numbers: dict[tuple[object, ...], int] = {}
        self._known: dict[int, tuple[Expr, int]] = {}

    def __call__(self, expr: Expr) -> int:
        known = self._known.get(id(expr))
        if known is None:
            known = self._known[id(expr)] = (expr, self._number(expr))  # kept, so that its id stays its own
        return known[1]

    def _number(self, expr: Expr) -> int:
        match expr:
            case Named(_, body):
                return self(body)
            case Apply(op, args, _):
                key: tuple[object, ...] = (op, *map(self, args))
            case Temporal(when, arg, span, strict):
                key = (when, None if arg is None else self(arg), span, strict)
            case _:
                key = structure(expr)
        return self._numbers.setdefault(key, len(self._numbers))
