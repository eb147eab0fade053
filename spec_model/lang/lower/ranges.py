"""Assignments that provably stay in their domain, and checks for those that might not."""

from collections.abc import Callable, Mapping, Sequence
from itertools import product

from rovercheck.spec_model.lang.action import Action, Assign, If
from rovercheck.spec_model.lang.domain import Bool, Domain, boolean
from rovercheck.spec_model.lang.evaluate import operate
from rovercheck.spec_model.lang.expr import TRUE, Apply, Const, Expr, Named, Var, all_of, any_of
from rovercheck.spec_model.lang.operators import COMPARISONS, Op
from rovercheck.spec_model.lang.system import Statement
from rovercheck.spec_model.lang.walk import plain

_FEW = 4096
_CLOSED = (Op.ADD, Op.SUB, Op.NEG, Op.MIN, Op.MAX)
"""Operators that make of all numbers between two of each argument all between two."""

Possible = range | frozenset[int]
Ends = tuple[int, int]


class _Known:
    """What is known of formulas that were looked at last: they are in many others."""

    def __init__(self) -> None:
        self._values: dict[int, tuple[Expr, Possible]] = {}
        self._room = 0

    def of(self, expr: Expr) -> Possible | None:
        """What is known of a formula; ``None`` if nothing is."""
        found = self._values.get(id(expr))
        return found[1] if found is not None and found[0] is expr else None

    def note(self, expr: Expr, values: Possible) -> None:
        """Know this, and forget all before if that takes too much room."""
        self._room -= 1 if isinstance(values, range) else len(values)
        if self._room < 0:
            self._values.clear()
            self._room = _ROOM
        self._values[id(expr)] = expr, values


_ROOM = 200_000
"""Values that are known at most."""
_KNOWN = _Known()


def possible(expr: Expr) -> Possible:
    """A superset of the raw values a formula can take, its variables ranging over their domains."""
    if not isinstance(expr, Apply):
        return _possible(expr)
    found = _KNOWN.of(expr)
    if found is None:
        found = _possible(expr)
        _KNOWN.note(expr, found)
    return found


def _possible(expr: Expr) -> Possible:
    match plain(expr):
        case Const(value, _):
            return frozenset({value})
        case Var(_, domain):
            if domain.dense or len(domain) > _FEW:
                return range(domain.low, domain.high + 1)
            return frozenset(domain.values)
        case Apply(op, _, _) if OPERATIONS[op] is _truth:
            return frozenset({0, 1})
        case Apply(Op.ITE, (_, then, otherwise), _):
            return _union(possible(then), possible(otherwise))
        case Apply(op, args, _):
            return _image(op, [possible(a) for a in args])
        case Named(_, body):
            return possible(body)
    return frozenset({0, 1})


def _union(a: Possible, b: Possible) -> Possible:
    if isinstance(a, range) and isinstance(b, range) and a.start <= b.stop and b.start <= a.stop:
        return range(min(a.start, b.start), max(a.stop, b.stop))
    if len(a) + len(b) <= _FEW:
        return _plainest(frozenset(a) | frozenset(b))
    ends = (*_ends(a), *_ends(b))
    return range(min(ends), max(ends) + 1)


def _ends(values: Possible) -> Ends:
    """The least and the greatest; Python would look for them through all of a range."""
    return (values[0], values[-1]) if isinstance(values, range) else (min(values), max(values))


def _image(op: Op, args: list[Possible]) -> Possible:
    count = 1
    for arg in args:
        count *= len(arg)
    if op in _CLOSED and all(map(_is_dense, args)):
        return _interval(op, [_ends(a) for a in args])
    if count <= _FEW:
        return _plainest(frozenset(operate(op, *values) for values in product(*args)))
    return _interval(op, [_ends(a) for a in args])


def _plainest(values: frozenset[int]) -> Possible:
    """The same values as a range, if they are one."""
    return range(min(values), max(values) + 1) if _is_dense(values) else values


def _is_dense(values: Possible) -> bool:
    """Whether all whole numbers between two are there."""
    if isinstance(values, range):
        return True
    low, high = _ends(values)
    return len(values) == high - low + 1


def _interval(op: Op, ends: Sequence[Ends]) -> range:
    """The hull of the image, or a wider one."""
    low, high = OPERATIONS[op](op, ends)
    return range(low, high + 1)


def _truth(op: Op, ends: Sequence[Ends]) -> Ends:
    return 0, 1


def _at_ends(op: Op, ends: Sequence[Ends]) -> Ends:
    """Of an operator that takes its extremes where each argument is at one of its ends."""
    corners = [operate(op, *corner) for corner in product(*ends)]
    return min(corners), max(corners)


def _absolute(op: Op, ends: Sequence[Ends]) -> Ends:
    low, high = _at_ends(op, ends)
    return (0 if ends[0][0] <= 0 <= ends[0][1] else low), high


def _remainder(op: Op, ends: Sequence[Ends]) -> Ends:
    return 0, ends[1][1] - 1


def _either(op: Op, ends: Sequence[Ends]) -> Ends:
    (_, then, otherwise) = ends
    return min(then[0], otherwise[0]), max(then[1], otherwise[1])


OPERATIONS: Mapping[Op, Callable[[Op, Sequence[Ends]], Ends]] = {
    **dict.fromkeys((*COMPARISONS, Op.NOT, Op.AND, Op.OR, Op.BIT), _truth),
    **dict.fromkeys((Op.ADD, Op.SUB, Op.NEG, Op.MUL, Op.SCALE, Op.DIV, Op.MIN, Op.MAX), _at_ends),
    Op.ABS: _absolute,
    Op.MOD: _remainder,
    Op.ITE: _either,
}
"""The least and the greatest result of each operator, or less and more, from those of its arguments."""


def fits(expr: Expr, domain: Domain) -> bool:
    """Whether every possible value of the formula belongs to the domain."""
    values = possible(expr)
    if domain.dense:
        low, high = _ends(values)
        return domain.low <= low and high <= domain.high
    return len(values) <= _FEW and frozenset(values) <= frozenset(domain.values)


def within(expr: Expr, domain: Domain) -> Expr:
    """The condition that the value of the formula belongs to the domain."""
    if isinstance(domain.sort, Bool):
        return TRUE
    raw = [Const(v, domain.sort) for v in domain.values] if not domain.dense else []
    if raw:
        return any_of(*(_raw(Op.EQ, expr, c) for c in raw))
    low, high = Const(domain.low, domain.sort), Const(domain.high, domain.sort)
    return all_of(_raw(Op.GE, expr, low), _raw(Op.LE, expr, high))


def _raw(op: Op, left: Expr, right: Expr) -> Expr:
    return Apply(op, (left, right), Bool())


_CHECK = ".out_of_domain"


def broken(var: Var) -> Var:
    """The check variable that is 1 after a tick in which ``var`` was to leave its domain."""
    doc = f"{var.name} was assigned a value outside {var.domain}"
    return Var(f"{var.name}{_CHECK}", boolean, 0, doc, hidden=True)


def checked(check: Var) -> str:
    """The name of the variable that a check variable is about."""
    return check.name.removesuffix(_CHECK)


def guarded(statement: Assign) -> Statement:
    """The assignment, or a check that raises a flag instead of leaving the domain."""
    var, value = statement.var, statement.value
    if fits(value, var.domain):
        return statement
    return If(within(value, var.domain), (statement,), (Assign(broken(var), TRUE),))


def protected(statement: If) -> Assign | None:
    """The assignment that a check leaves out where its value does not fit; None if this is no check."""
    match statement:
        case If(_, (Assign(var, _) as assignment,), (Assign(check, _),)) if check.name == broken(var).name:
            return assignment
    return None


def unguarded(program: Sequence[Action]) -> tuple[Statement, ...]:
    """A lowered program without checks of domains: what does not fit is assigned all the same."""
    found: list[Statement] = []
    for statement in program:
        if isinstance(statement, If):
            then, otherwise = unguarded(statement.then), unguarded(statement.otherwise)
            found.append(protected(statement) or If(statement.condition, then, otherwise))
        elif isinstance(statement, Assign):
            found.append(statement)
    return tuple(found)


def check_of(statement: If) -> Var | None:
    """The variable that a check raises; None if this is no check."""
    assignment = protected(statement)
    return None if assignment is None else broken(assignment.var)
