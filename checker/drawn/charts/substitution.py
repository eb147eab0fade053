"""The temporaries of a text put into the formulas that read them: a chart needs no variables for them."""

from collections.abc import Collection, Mapping, Sequence

from rovercheck.checker.drawn.lower.symbols import NotLowered, chosen, folded
from rovercheck.spec_model.lang.action import Assign, If
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Named, Temporal, Var
from rovercheck.spec_model.lang.programmed import is_fault
from rovercheck.spec_model.lang.system import Statement
from rovercheck.spec_model.lang.walk import children, variables

LARGEST = 300
"""Parts of a formula that may be put in place of a temporary."""


class _Kept(Exception):
    """A temporary is read after what its formula speaks of has changed: it must stay a variable."""


def condition_after(rows: Sequence[Statement], condition: Expr, temporaries: Collection[str]) -> Expr:
    """The condition before some statements that is the given one after them.

    Raises ``NotLowered`` if they change more than temporaries.
    """
    writer = _Substitution(temporaries)
    try:
        if any(writer.statements(rows)):
            raise NotLowered("a function that a condition calls changes data; call it in an action")
        return writer.formula(condition)
    except _Kept:
        raise NotLowered("a condition calls a function of too many steps; call it in an action") from None


def actions_after(
    rows: Sequence[Statement], temporaries: Mapping[str, Var], sends: Collection[str]
) -> tuple[Statement, ...]:
    """The statements without temporaries, or as they are if one must stay a variable.

    ``sends`` are variables whose assignment stands for a send, which may change everything.
    """
    refuse_faults(rows)
    try:
        return tuple(_Substitution(temporaries, sends).statements(rows))
    except _Kept:
        return tuple(rows)


def refuse_faults(rows: Sequence[Statement]) -> None:
    """Raises ``NotLowered`` where a step may have no meaning, which a chart of the language cannot say."""
    for row in rows:
        if isinstance(row, If):
            refuse_faults([one for one in (*row.then, *row.otherwise) if isinstance(one, Assign | If)])
        elif is_fault(row.var):
            raise NotLowered(row.var.doc)


class _Substitution:
    """``known`` are the formulas of temporaries at this point; ``None``: what it read has changed."""

    def __init__(self, temporaries: Collection[str], sends: Collection[str] = ()) -> None:
        self._temporaries, self._sends = temporaries, sends
        self._known: dict[str, Expr | None] = {}

    def formula(self, expr: Expr) -> Expr:
        match expr:
            case Var(name) if name in self._temporaries:
                found = self._known.get(name)
                if found is None and name in self._known:
                    raise _Kept
                return Const(expr.init, expr.sort) if found is None else found
            case Named(name, body):
                made = self.formula(body)
                return expr if made is body else Named(name, made)
            case Temporal(when, arg, span, strict) if arg is not None:
                return Temporal(when, self.formula(arg), span, strict)
            case Apply(op, args, sort):
                new = tuple(self.formula(one) for one in args)
                if all(one is other for one, other in zip(new, args, strict=True)):
                    return expr
                return folded(Apply(op, new, sort))
        return expr

    def statements(self, rows: Sequence[object]) -> list[Statement]:
        made: list[Statement] = []
        for row in rows:
            if isinstance(row, Assign):
                made += self._assigned(row)
            elif isinstance(row, If):
                made += self._choice(row)
        return made

    def _assigned(self, row: Assign) -> list[Statement]:
        refuse_faults([row])
        value = self.formula(row.value)
        if row.var.name in self._temporaries:
            if _size(value) > LARGEST:
                raise _Kept
            self._known[row.var.name] = value
            return []
        self._changed([row.var.name])
        return [Assign(row.var, value)]

    def _changed(self, names: Collection[str]) -> None:
        everything = any(name in self._sends for name in names)
        for name, value in self._known.items():
            if value is not None and (found := variables(value)) and (everything or found.keys() & names):
                self._known[name] = None

    def _choice(self, row: If) -> list[Statement]:
        condition = self.formula(row.condition)
        before = dict(self._known)
        then, first = self.statements(row.then), self._known
        self._known = dict(before)
        otherwise, second = self.statements(row.otherwise), self._known
        written = {name for one in (*then, *otherwise) for name in one.written}
        self._known = before
        self._changed(written)
        for name in first.keys() | second.keys():
            one, other = (known.get(name, before.get(name)) for known in (first, second))
            if one is other:
                self._known[name] = one
            elif name not in first or name not in second:
                self._known[name] = one if name in first else other
            elif one is None or other is None or variables(condition).keys() & written:
                self._known[name] = None
            else:
                self._known[name] = chosen(condition, one, other)
        if not then and not otherwise:
            return []
        if not then:
            return [If(folded(~condition), tuple(otherwise))]
        return [If(condition, tuple(then), tuple(otherwise))]


def _size(expr: Expr) -> int:
    """How long a formula is as it is written, or a number above ``LARGEST``."""
    count, waiting = 0, [expr]
    while waiting and count <= LARGEST:
        count += 1
        waiting += children(waiting.pop())
    return count


__all__ = ["actions_after", "condition_after", "refuse_faults"]
