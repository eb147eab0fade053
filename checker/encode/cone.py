"""Cone of influence: the part of a transition that a set of goals depends on.

Assumptions are kept whole unless they speak only of inputs outside the cone: such a group of
conjuncts does not restrict the rest, provided it can be satisfied at all, which the engine checks.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

from rovercheck.checker.encode.symbolic import SymbolicTransition
from rovercheck.checker.encode.terms import Terms
from rovercheck.checker.system.intervals import Interval, postorder
from rovercheck.checker.system.slice import sliced
from rovercheck.spec_model.lang.domain import Domain
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Var
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.system import TransitionSystem
from rovercheck.spec_model.lang.walk import variables


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


def cone(transition: SymbolicTransition, goals: Iterable[str]) -> Slice:
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


def by_cone(transition: SymbolicTransition, goals: Iterable[str]) -> list[list[str]]:
    """Goals that depend on the same variables, inputs and frozen variables, apart from goals."""
    found: dict[frozenset[str], list[str]] = {}
    wanted = list(goals)
    for goal in wanted:
        part = cone(transition, [goal])
        names = {v.name for v in (*part.variables, *part.inputs, *part.frozen)}
        found.setdefault(frozenset(names.difference(wanted)), []).append(goal)
    return list(found.values())


def folded(transition: SymbolicTransition, fixed: Mapping[str, int] | None = None) -> SymbolicTransition:
    """The transition with variables that never change (``fixed``, as in ``constants``) and inputs that the
    assumption leaves one value replaced by these values.  The assumption still says so of the inputs."""
    fixed = constants(transition) if fixed is None else fixed
    fold = _Folder(transition.terms, {**settled(transition), **fixed})
    assumed = _Folder(transition.terms, fixed)
    following = {n: fold(e) for n, e in transition.next.items()}
    return replace(transition, next=following, assume=tuple(map(assumed, transition.assume)))


def constants(transition: SymbolicTransition) -> dict[str, int]:
    """Variables that keep their initial value in every run: the greatest set that justifies itself."""
    inputs, fixed = settled(transition), transition.system.init
    while True:
        folded = _Folder(transition.terms, {**inputs, **fixed})
        kept = {n: v for n, v in fixed.items() if _is(folded(transition.next[n]), v)}
        if len(kept) == len(fixed):
            return kept
        fixed = kept


def settled(transition: SymbolicTransition) -> dict[str, int]:
    """Inputs to which a conjunct of the assumption gives their value: ``i``, ``~i`` or ``i == 3``."""
    inputs = {v.name for v in transition.system.inputs}
    pairs = (_settles(conjunct) for conjunct in transition.assume)
    return {name: value for name, value in filter(None, pairs) if name in inputs}


def _settles(conjunct: Expr) -> tuple[str, int] | None:
    match conjunct:
        case Var(name):
            return name, 1
        case Apply(Op.NOT, (Var(name),), _):
            return name, 0
        case Apply(Op.EQ, (Var(name), Const(value)), _):
            return name, value
    return None


def _is(expr: Expr, value: int) -> bool:
    return isinstance(expr, Const) and expr.value == value


def with_values(terms: Terms, values: Mapping[str, int], formula: Expr) -> Expr:
    """A formula of any table as one of this table, with values in place of some variables."""
    done: dict[int, Expr] = {}
    for node in postorder(formula):
        match node:
            case Var(name) if name in values:
                done[id(node)] = terms.const(values[name], node.sort)
            case Var():
                done[id(node)] = terms.var(node)
            case Const(value, sort):
                done[id(node)] = terms.const(value, sort)
            case Apply(op, args, sort):
                done[id(node)] = terms.apply(op, [done[id(a)] for a in args], sort)
    return done[id(formula)]


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


def as_written(system: TransitionSystem, goals: Iterable[str]) -> tuple[Var, ...]:
    """The variables that some goals, and the assumption, depend on as the system is written.

    What is said of the goals is true if these stay in their domains, see ``straying``.  A cone may have
    fewer: formulas were simplified on the assumption that no variable leaves its domain, and may no
    longer mention the one that does.
    """
    wanted, assumed = set(goals), variables(system.assume)
    roots = [v for v in system.variables if v.name in wanted or v.name in assumed]
    read = {v.name for v in sliced(system, roots).variables}
    return tuple(v for v in system.variables if v.name in read or v.name in assumed)


def straying(transition: SymbolicTransition, among: Iterable[Var]) -> dict[str, Expr]:
    """For the variables that might leave their domain, the condition under which a tick takes them out of
    it; a value between two members of a domain with gaps is outside, too."""
    terms = transition.terms
    found = {v.name: _outside(transition.next[v.name], v, terms) for v in among}
    return {name: condition for name, condition in found.items() if condition is not terms.false}


def _outside(value: Expr, var: Var, terms: Terms) -> Expr:
    """The value is not in the domain of the variable."""
    low, high = var.domain.low, var.domain.high
    if terms.range(value).within(Interval(low, high)) if var.domain.dense else _keeps(value, var):
        return terms.false
    if not var.domain.dense or low == high:  # also a truth value, which has no order
        inside = [terms.equal(value, terms.const(v, var.sort)) for v in var.domain.values]
        return terms.negation(terms.disjunction(inside))
    below = terms.at_most(value, terms.const(low - 1, var.sort))
    above = terms.negation(terms.at_most(value, terms.const(high, var.sort)))
    return terms.disjunction((below, above))


def _keeps(expr: Expr, var: Var) -> bool:
    """Whether every case of the formula is a member of the domain, as far as it is easily seen."""
    cases, todo = set[int](), [expr]
    while todo:
        case = todo.pop()
        if id(case) in cases:
            continue
        cases.add(id(case))
        if isinstance(case, Apply) and case.op is Op.ITE:
            todo += case.args[1:]
        elif not _is_member(case, var):
            return False
    return True


def _is_member(expr: Expr, var: Var) -> bool:
    if isinstance(expr, Const):
        return expr.value in var.domain
    return expr is var or (isinstance(expr, Var) and _is_part(expr.domain, var.domain))


def _is_part(one: Domain, whole: Domain) -> bool:
    """Whether all values of a domain are in another one, which may have more than can be listed."""
    if whole.dense:
        return whole.low <= one.low and one.high <= whole.high
    return len(one) <= len(whole) and set(one.values) <= set(whole.values)
