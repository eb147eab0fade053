"""Symbolic execution of a step: the value of every variable after a tick as a formula over the
valuation before it, the frozen variables and the inputs.

Temporaries disappear.  Inside a branch, the condition is used as a fact: a location tested on the
way in is a constant further down.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from checker.encode.intervals import Interval, postorder
from checker.encode.terms import Terms, is_apply
from spec_model.lang.action import Action, Assign, If
from spec_model.lang.errors import ModelError
from spec_model.lang.expr import Apply, Const, Expr, Named, Op, Var
from spec_model.lang.system import TransitionSystem

Store = dict[str, Expr]


@dataclass(frozen=True)
class Transition:
    """One tick as functions.

    ``next`` gives every variable, by name, after the tick; ``assume`` are conjuncts on the valuation
    before the tick and the inputs.  All formulas belong to ``terms``.
    """

    system: TransitionSystem
    next: Mapping[str, Expr]
    assume: tuple[Expr, ...]
    terms: Terms

    def escapes(self) -> dict[str, Expr]:
        """Variables whose value after a tick is not obviously within the hull of their domain."""
        hulls = {v.name: Interval(v.domain.low, v.domain.high) for v in self.system.variables}
        return {n: e for n, e in self.next.items() if not self.terms.range(e).within(hulls[n])}


def transition(system: TransitionSystem) -> Transition:
    """Execute the step symbolically.  Raises ``ModelError`` on a temporal word."""
    terms = Terms()
    store: Store = {v.name: terms.var(v) for v in (*system.variables, *system.inputs, *system.frozen)}
    executor = _Executor(terms)
    assume = executor.value(system.assume, store, _Facts())
    executor.run(system.step, store, _Facts())
    parts = assume.args if is_apply(assume, Op.AND) else () if assume is terms.true else (assume,)
    return Transition(system, {v.name: store[v.name] for v in system.variables}, parts, terms)


@dataclass(frozen=True)
class _Facts:
    """What is known inside a branch, by ``id`` of the formula: truth values and bounds."""

    truth: Mapping[int, bool] = field(default_factory=dict)
    bounds: Mapping[int, Interval] = field(default_factory=dict)

    def bounds_of(self, expr: Expr, terms: Terms) -> Interval:
        return self.bounds.get(id(expr)) or terms.range(expr)

    def decide(self, expr: Expr, terms: Terms) -> bool | None:
        """The truth value that the facts imply, as far as it is easily seen."""
        if id(expr) in self.truth:
            return self.truth[id(expr)]
        if is_apply(expr, Op.NOT):
            inner = self.decide(expr.args[0], terms)
            return None if inner is None else not inner
        if not isinstance(expr, Apply) or not isinstance(expr.args[-1], Const):
            return None
        bounds, limit = self.bounds_of(expr.args[0], terms), expr.args[-1].value
        if expr.op is Op.EQ and (limit not in bounds or bounds.low == bounds.high):
            return limit in bounds
        if expr.op is Op.LE and (bounds.high <= limit or bounds.low > limit):
            return bounds.high <= limit
        return None


def _assuming(facts: _Facts, expr: Expr, value: bool, terms: Terms) -> _Facts:
    """The facts when a formula is also known to be true, or false."""
    truth, bounds = dict(facts.truth), dict(facts.bounds)
    todo = [(expr, value)]
    while todo:
        expr, value = todo.pop()
        truth[id(expr)] = value
        if is_apply(expr, Op.NOT):
            todo.append((expr.args[0], not value))
        elif is_apply(expr, Op.AND if value else Op.OR):
            todo.extend((a, value) for a in expr.args)
        elif isinstance(expr, Apply) and expr.op in (Op.EQ, Op.LE) and isinstance(expr.args[1], Const):
            subject = expr.args[0]
            known = bounds.get(id(subject)) or terms.range(subject)
            bounds[id(subject)] = _narrowed(known, expr.op, expr.args[1].value, value)
    return _Facts(truth, bounds)


def _narrowed(known: Interval, op: Op, limit: int, value: bool) -> Interval:
    low, high = known.low, known.high
    if op is Op.LE:
        low, high = (low, min(high, limit)) if value else (max(low, limit + 1), high)
    elif value:
        low = high = limit
    else:
        low, high = low + (low == limit), high - (high == limit)
    return Interval(low, high) if low <= high else known  # a dead branch: anything goes


class _Executor:
    """Runs programs on stores of formulas."""

    def __init__(self, terms: Terms) -> None:
        self._terms = terms

    def run(self, program: Sequence[Action], store: Store, facts: _Facts) -> None:
        """Run the statements, updating the store in place."""
        for statement in program:
            if isinstance(statement, Assign):
                store[statement.var.name] = self.value(statement.value, store, facts)
            elif isinstance(statement, If):
                self._branch(statement, store, facts)
            else:
                raise ModelError(f"`{statement}` is left in the step; lower the chart first.")

    def _branch(self, statement: If, store: Store, facts: _Facts) -> None:
        test = self.value(statement.condition, store, facts)
        if isinstance(test, Const):
            self.run(statement.then if test.value else statement.otherwise, store, facts)
            return
        then, other = dict(store), dict(store)
        self.run(statement.then, then, _assuming(facts, test, True, self._terms))
        self.run(statement.otherwise, other, _assuming(facts, test, False, self._terms))
        # A temporary written in one branch only is read later under the same condition only.
        for name, value in {**other, **then}.items():
            alternative = other.get(name, value)
            store[name] = value if value is alternative else self._terms.ite(test, value, alternative)

    def value(self, expr: Expr, store: Store, facts: _Facts) -> Expr:
        """The value of an expression in a store."""
        done: dict[int, Expr] = {}
        for node in postorder(expr):
            done[id(node)] = self._known(self._node(node, store, done), facts)
        return done[id(expr)]

    def _node(self, node: Expr, store: Store, done: Mapping[int, Expr]) -> Expr:
        match node:
            case Const(value, sort):
                return self._terms.const(value, sort)
            case Var(name):  # a temporary without a value is only read where the result does not matter
                return store[name] if name in store else self._terms.const(node.init, node.sort)
            case Named(_, body):
                return done[id(body)]
            case Apply(op, args, sort):
                return self._terms.apply(op, [done[id(a)] for a in args], sort)
        raise ModelError(f"`{node}` speaks of the past; lower the chart or reduce the property first.")

    def _known(self, expr: Expr, facts: _Facts) -> Expr:
        """The formula with what the facts say about it and about its case distinctions used."""
        while is_apply(expr, Op.ITE):
            chosen = facts.decide(expr.args[0], self._terms)
            if chosen is None:
                break
            expr = expr.args[1 if chosen else 2]
        if isinstance(expr, Const) or not facts.truth:
            return expr
        value = facts.decide(expr, self._terms) if expr.sort == self._terms.true.sort else None
        if value is not None:
            return self._terms.truth(value)
        bounds = facts.bounds.get(id(expr))
        pinned = bounds is not None and bounds.low == bounds.high
        return self._terms.const(bounds.low, expr.sort) if bounds and pinned else expr
