"""Symbolic execution of a step: the value of every variable after a tick as a formula over the
state before it, the frozen variables and the inputs.

Temporaries disappear.  Inside a branch, the condition is used as a fact: a location tested on the
way in is a constant further down.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from rovercheck.checker.encode.facts import Facts
from rovercheck.checker.encode.terms import Terms, is_apply
from rovercheck.checker.system.intervals import postorder
from rovercheck.spec_model.lang.action import Action, Assign, If
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Named, Var
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.system import TransitionSystem


class SymbolicStore(dict[str, Expr]):
    """The value of each variable; in a branch only what is written there, on top of the store ``below``."""

    def __init__(self, below: "SymbolicStore | None" = None) -> None:
        super().__init__()
        self._below = below

    def find(self, name: str) -> Expr | None:
        """The value of a variable; None for a temporary without one."""
        store: SymbolicStore | None = self
        while store is not None:
            if (value := store.get(name)) is not None:
                return value
            store = store._below
        return None


@dataclass(frozen=True)
class SymbolicTransition:
    """One tick as functions.

    ``next`` gives every variable, by name, after the tick; ``assume`` are conjuncts on the state
    before the tick and the inputs.  All formulas belong to ``terms``.
    """

    system: TransitionSystem
    next: Mapping[str, Expr]
    assume: tuple[Expr, ...]
    terms: Terms


def transition(
    system: TransitionSystem, terms: Terms | None = None, known: Mapping[str, int] | None = None
) -> SymbolicTransition:
    """Execute the step symbolically, with formulas of a table of their own, or of that of another system.

    Variables of which the value before the tick is ``known`` (raw, by name) are constants.  Raises
    ``ModelError`` on a temporal word.
    """
    terms = terms or Terms()
    store, known = SymbolicStore(), known or {}
    for v in (*system.variables, *system.inputs, *system.frozen):
        store[v.name] = terms.const(known[v.name], v.sort) if v.name in known else terms.var(v)
    executor, facts = _Executor(terms), Facts(terms.range)
    assume = executor.value(system.assume, store, facts)
    executor.run(system.step, store, facts)
    parts = tuple(_conjuncts(assume, terms))
    return SymbolicTransition(system, {v.name: store[v.name] for v in system.variables}, parts, terms)


def _conjuncts(expr: Expr, terms: Terms) -> Iterator[Expr]:
    """The parts of a conjunction, or of a negated disjunction."""
    if is_apply(expr, Op.AND):
        for arg in expr.args:
            yield from _conjuncts(arg, terms)
    elif is_apply(expr, Op.NOT) and is_apply(expr.args[0], Op.OR):
        for arg in expr.args[0].args:
            yield from _conjuncts(terms.negation(arg), terms)
    elif expr is not terms.true:
        yield expr


class _Executor:
    """Runs programs on stores of formulas."""

    def __init__(self, terms: Terms) -> None:
        self._terms = terms

    def run(self, program: Sequence[Action], store: SymbolicStore, facts: Facts) -> None:
        """Run the statements, updating the store in place."""
        for statement in program:
            if isinstance(statement, Assign):
                store[statement.var.name] = self.value(statement.value, store, facts)
            elif isinstance(statement, If):
                self._branch(statement, store, facts)
            else:
                raise ModelError(f"`{statement}` is left in the step; lower the chart first.")

    def _branch(self, statement: If, store: SymbolicStore, facts: Facts) -> None:
        test = self.value(statement.condition, store, facts)
        if isinstance(test, Const):
            self.run(statement.then if test.value else statement.otherwise, store, facts)
            return
        then, other = SymbolicStore(store), SymbolicStore(store)
        self.run(statement.then, then, facts.assuming(test, True))
        self.run(statement.otherwise, other, facts.assuming(test, False))
        # A temporary written in one branch only is read later under the same condition only.
        for name in {**other, **then}:
            one, two = then.find(name), other.find(name)
            value, alternative = (two if one is None else one), (one if two is None else two)
            assert value is not None and alternative is not None, "it is written in one of the branches"
            store[name] = value if value is alternative else self._terms.ite(test, value, alternative)

    def value(self, expr: Expr, store: SymbolicStore, facts: Facts) -> Expr:
        """The value of an expression in a store."""
        done: dict[int, Expr] = {}
        for node in postorder(expr):
            done[id(node)] = self._known(self._node(node, store, done), facts)
        return done[id(expr)]

    def _node(self, node: Expr, store: SymbolicStore, done: Mapping[int, Expr]) -> Expr:
        match node:
            case Const(raw, sort):
                return self._terms.const(raw, sort)
            case Var(name):  # a temporary without a value is only read where the result does not matter
                value = store.find(name)
                return self._terms.const(node.init, node.sort) if value is None else value
            case Named(_, body):
                return done[id(body)]
            case Apply(op, args, sort):
                return self._terms.apply(op, [done[id(a)] for a in args], sort)
        raise ModelError(f"`{node}` speaks of the past; lower the chart or reduce the property first.")

    def _known(self, expr: Expr, facts: Facts) -> Expr:
        """The formula with what the facts say about it and about its case distinctions used."""
        while is_apply(expr, Op.ITE):
            chosen = facts.decide(expr.args[0])
            if chosen is None:
                break
            expr = expr.args[1 if chosen else 2]
        if isinstance(expr, Const) or not facts.truth:
            return expr
        value = facts.decide(expr) if expr.sort == self._terms.true.sort else None
        if value is not None:
            return self._terms.truth(value)
        bounds = facts.bounds.get(id(expr))
        pinned = bounds is not None and bounds.low == bounds.high
        return self._terms.const(bounds.low, expr.sort) if bounds and pinned else expr
