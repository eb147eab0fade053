"""Cone of influence: the part of a transition that a set of goals depends on.

Assumptions are kept whole unless they speak only of inputs outside the cone: such a group of
conjuncts does not restrict the rest, provided it can be satisfied at all, which the engine checks.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

from checker.encode.intervals import Interval, postorder
from checker.encode.symbolic import Transition
from checker.encode.terms import Terms
from spec_model.lang.expr import Apply, Const, Expr, Var
from spec_model.lang.walk import variables


@dataclass(frozen=True)
class Slice:
    """What is left of a transition.

    ``variables``, ``inputs`` and ``frozen`` are those in the cone; ``next`` and ``assume`` speak of
    these only.  ``loose`` are the conjuncts on other inputs that were left out.
    """

    variables: tuple[Var, ...]
    inputs: tuple[Var, ...]
    frozen: tuple[Var, ...]
    next: Mapping[str, Expr]
    assume: tuple[Expr, ...]
    loose: tuple[Expr, ...]


def cone(transition: Transition, goals: Iterable[str]) -> Slice:
    """The cone of influence of some variables."""
    system, following = transition.system, transition.next
    tight, loose = _split(transition.assume, goals, following, {v.name for v in system.inputs})
    names = _closure([*goals, *_names(tight)], following)
    return Slice(
        tuple(v for v in system.variables if v.name in names),
        tuple(v for v in system.inputs if v.name in names),
        tuple(v for v in system.frozen if v.name in names),
        {n: e for n, e in following.items() if n in names},
        tuple(tight),
        tuple(loose),
    )


def folded(transition: Transition) -> Transition:
    """The transition with variables that never change replaced by their values."""
    fold = _Folder(transition.terms, constants(transition))
    following = {n: fold(e) for n, e in transition.next.items()}
    return replace(transition, next=following, assume=tuple(map(fold, transition.assume)))


def constants(transition: Transition) -> dict[str, int]:
    """Variables that keep their initial value in every run: the greatest set that justifies itself."""
    fixed = transition.system.init
    while True:
        folded = _Folder(transition.terms, fixed)
        kept = {n: v for n, v in fixed.items() if _is(folded(transition.next[n]), v)}
        if len(kept) == len(fixed):
            return kept
        fixed = kept


def _is(expr: Expr, value: int) -> bool:
    return isinstance(expr, Const) and expr.value == value


class _Folder:
    """Replaces variables by constants in formulas of a table."""

    def __init__(self, terms: Terms, fixed: Mapping[str, int]) -> None:
        self._terms, self._fixed = terms, fixed
        self._done: dict[int, Expr] = {}

    def __call__(self, expr: Expr) -> Expr:
        for node in postorder(expr):
            if id(node) not in self._done:
                self._done[id(node)] = self._node(node)
        return self._done[id(expr)]

    def _node(self, node: Expr) -> Expr:
        if isinstance(node, Var) and node.name in self._fixed:
            return self._terms.const(self._fixed[node.name], node.sort)
        if isinstance(node, Apply):
            return self._terms.apply(node.op, [self._done[id(a)] for a in node.args], node.sort)
        return node


def _names(exprs: Sequence[Expr]) -> list[str]:
    return list(variables(*exprs))


def _closure(roots: Iterable[str], following: Mapping[str, Expr]) -> set[str]:
    names: set[str] = set()
    todo = list(roots)
    while todo:
        name = todo.pop()
        if name not in names:
            names.add(name)
            todo.extend(_names([following[name]]) if name in following else ())
    return names


def _split(
    assume: Sequence[Expr], goals: Iterable[str], following: Mapping[str, Expr], inputs: set[str]
) -> tuple[list[Expr], list[Expr]]:
    """The conjuncts that bear on the cone and those on inputs outside it."""
    tight = [e for e in assume if not set(_names([e])) <= inputs]
    loose = [e for e in assume if set(_names([e])) <= inputs]
    names: set[str] = set()
    while True:
        names = _closure([*goals, *_names(tight), *names], following)
        moved = [e for e in loose if names & set(_names([e]))]
        if not moved:
            return tight, loose
        tight += moved
        loose = [e for e in loose if all(e is not m for m in moved)]


def leaving(part: Slice, terms: Terms) -> dict[str, Expr]:
    """For the variables that might leave the hull of their domain, the condition under which they do."""
    found = {}
    for var in part.variables:
        value, low, high = part.next[var.name], var.domain.low, var.domain.high
        if not terms.range(value).within(Interval(low, high)):
            below = terms.at_most(value, terms.const(low - 1, var.sort))
            above = terms.negation(terms.at_most(value, terms.const(high, var.sort)))
            found[var.name] = terms.disjunction((below, above))
    return {name: condition for name, condition in found.items() if condition is not terms.false}
