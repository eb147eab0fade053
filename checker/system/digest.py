"""A short key of a system that is equal where it is written alike, made of the keys of its parts.

A part is looked at once, in however many systems it is; slices of one system have most of theirs in common.
"""

from collections.abc import Iterable
from hashlib import sha256

from rovercheck.spec_model.lang.action import Assign, If
from rovercheck.spec_model.lang.domain import Domain, Sort
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Named, Var
from rovercheck.spec_model.lang.system import TransitionSystem

_KEPT = 500_000
"""Parts that are remembered at most, before all are forgotten."""


class PartDigests:
    """SHA-256 of formulas, domains, statements and systems; equal for equal ones, be they one or several."""

    def __init__(self) -> None:
        self._known: dict[int, tuple[bytes, object]] = {}
        """By ``id``; what is remembered is held, so that ids stay unique."""

    def system(self, system: TransitionSystem) -> bytes:
        """That of all that engines read of a system."""
        if len(self._known) > _KEPT:
            self._known.clear()
        parts = system.inputs, system.variables, system.frozen, system.temps
        kinds = (_digest("variables", *map(self.expr, variables)) for variables in parts)
        return _digest("system", *kinds, self.expr(system.assume), self.program(system.step))

    def program(self, program: Iterable[object]) -> bytes:
        """That of statements one after the other."""
        return _digest("program", *map(self._statement, program))

    def expr(self, expr: Expr) -> bytes:
        """That of a formula."""
        known = self._known.get(id(expr))
        return known[0] if known else self._kept(expr, self._formula(expr))

    def _statement(self, statement: object) -> bytes:
        known = self._known.get(id(statement))
        if known:
            return known[0]
        match statement:
            case Assign(var, value):
                found = _digest("assign", self.expr(var), self.expr(value))
            case If(condition, then, otherwise):
                found = _digest("if", self.expr(condition), self.program(then), self.program(otherwise))
            case _:
                raise AssertionError(statement)
        return self._kept(statement, found)

    def _formula(self, expr: Expr) -> bytes:
        match expr:
            case Const(value, sort):
                return _digest(f"const {value}", self._plain(sort))
            case Var(name, domain, init):
                return _digest(f"var {name!r} {init}", self._plain(domain))
            case Named(_, body):
                return _digest("named", self.expr(body))
            case Apply(op, args, sort):
                return _digest(f"apply {op.value}", self._plain(sort), *map(self.expr, args))
        raise AssertionError(expr.__class__)

    def _plain(self, value: Domain | Sort) -> bytes:
        known = self._known.get(id(value))
        return known[0] if known else self._kept(value, _digest(f"plain {value!r}"))

    def _kept(self, value: object, digest: bytes) -> bytes:
        self._known[id(value)] = digest, value
        return digest


def _digest(words: str, *parts: bytes) -> bytes:
    """Of words on one line, and of parts, which are of one length."""
    return sha256(b"".join((words.encode(), b"\n", *parts))).digest()


__all__ = ["PartDigests"]
