"""The values that each variable can take, or more: abstract interpretation of the step of a system.

A variable is known by a few values or by the interval between two.  Conditions are looked at where they say
which branch is taken, and what a compared variable is worth in it; otherwise variables are unrelated.
"""

from collections.abc import Mapping, Sequence
from itertools import count
from typing import cast

from rovercheck.checker.encode.value_sets import (
    CONTRARY,
    EITHER,
    FALSE,
    TRUE,
    TURNED,
    NoValue,
    Values,
    applied,
    compared,
    hull,
    joined,
    whole,
    within,
)
from rovercheck.checker.system.intervals import Interval, postorder
from rovercheck.spec_model.lang.action import Assign, If
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Named, Var
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.system import Program, Statement, TransitionSystem

_PATIENCE = 12
"""Rounds in which a variable may gain values before it is taken to have all of its domain."""
_DEEP = 12
"""Choices within one another up to which it is looked at what their conditions say."""
_EFFORT, _NODE = 200_000_000, 100
"""Values that are copied, and for how many of them a formula counts: some seconds.  After half of them the
conditions of choices are taken to say nothing, after all nothing is known: that costs memory only."""


class TooMuch(Exception):
    """The effort is spent."""


def values(system: TransitionSystem) -> dict[str, Values]:
    """For each frozen variable and variable what it is worth at the end of any tick, or before the first.

    Sound as long as no tick leaves a domain.  Of a step that takes too long to look at nothing is said.
    """
    try:
        return settled(system, AnalysisEffort())
    except TooMuch:
        return {}


def settled(system: TransitionSystem, effort: "AnalysisEffort") -> dict[str, Values]:
    """The least values that a tick does not add to, each variable growing for some rounds only."""
    before: dict[str, Values] = {v.name: frozenset({system.init[v.name]}) for v in system.variables}
    before |= {v.name: whole(v.domain) for v in system.frozen}
    free = {v.name: whole(v.domain) for v in (*system.inputs, *system.temps)}
    domains = {v.name: hull(whole(v.domain)) for v in (*system.variables, *system.temps)}
    step = StepOnValues(system.step, domains, effort)
    for tick in count():
        try:
            after = assumed(system.assume, True, KnownValues({**before, **free}), effort)
            step.run(after)
        except NoValue:  # the assumption can never be met
            return before
        more = {name: joined(values, after[name]) for name, values in before.items()}
        if more == before:
            return before
        if tick >= _PATIENCE:
            grown = (v for v in system.variables if more[v.name] != before[v.name])
            more |= {v.name: whole(v.domain) for v in grown}
        before = more
    raise AssertionError("a finite domain grows for ever")


class KnownValues:
    """What variables are worth at some place of a step: what is known there only, over what is everywhere.

    A branch, or a choice, thus copies what conditions and assignments around it have changed, and no more.
    """

    __slots__ = ("_everywhere", "here")

    def __init__(self, everywhere: dict[str, Values], here: dict[str, Values] | None = None) -> None:
        self._everywhere = everywhere
        self.here: dict[str, Values] = {} if here is None else here

    def __getitem__(self, name: str) -> Values:
        found = self.here.get(name)
        return self._everywhere[name] if found is None else found

    def __setitem__(self, name: str, values: Values) -> None:
        self.here[name] = values

    def inside(self) -> "KnownValues":
        """The same, for a place within this one."""
        return KnownValues(self._everywhere, dict(self.here))

    def join(self, a: "KnownValues", b: "KnownValues") -> None:
        """Know here what is known at either of two places within this one."""
        here = self.here
        for name, one in a.here.items():
            other = b[name]
            here[name] = one if one is other else joined(one, other)
        for name in b.here.keys() - a.here.keys():
            here[name] = joined(a[name], b.here[name])

    def settle(self) -> None:
        """Take what is known here to be known everywhere from now on."""
        self._everywhere.update(self.here)
        self.here.clear()


class AnalysisEffort:
    """Counts what is looked at, and knows in which order formulas are."""

    def __init__(self) -> None:
        self._left = _EFFORT
        self._orders: dict[int, tuple[Expr, tuple[Expr, ...]]] = {}

    def order(self, expr: Expr) -> tuple[Expr, ...]:
        """The parts of a formula, those within others first."""
        known = self._orders.get(id(expr))
        if known is None:  # the formula is held, so that its id stays its own
            known = self._orders[id(expr)] = expr, tuple(postorder(expr))
        return known[1]

    @property
    def half(self) -> bool:
        """Whether half of it is spent."""
        return 2 * self._left < _EFFORT

    def spend(self, amount: int) -> None:
        """Raises ``TooMuch`` when nothing is left."""
        self._left -= amount
        if self._left < 0:
            raise TooMuch


def possible(system: TransitionSystem) -> bool:
    """False where no inputs and frozen values ever meet the assumption."""
    everything = (*system.variables, *system.frozen, *system.inputs)
    try:
        assumed(
            system.assume, True, KnownValues({v.name: whole(v.domain) for v in everything}), AnalysisEffort()
        )
    except NoValue:
        return False
    except TooMuch:
        return True
    return True


class StepOnValues:
    """Runs a program on all values at once, one time after another.

    A statement, however deep, that finds what it found the last time is not looked at again.
    """

    def __init__(self, program: Program, domains: Mapping[str, Interval], effort: AnalysisEffort) -> None:
        self._program, self._domains, self._effort = program, domains, effort
        self._names: dict[int, tuple[str, ...]] = {}
        self._last: dict[int, tuple[list[Values], dict[str, Values] | None]] = {}
        """By the id of a statement what its variables were worth, and what it then changed; None: no way."""

    def run(self, at: KnownValues) -> None:
        """Run it from what is known before it, which becomes what is known after it."""
        for statement in self._program:
            at.settle()
            self._run((statement,), at)
        at.settle()

    def _run(self, program: Program, at: KnownValues) -> None:
        for statement in program:
            names = self._names.get(id(statement))
            if names is None:
                names = self._names[id(statement)] = (*(statement.read_inside | statement.written),)
            given = [at[name] for name in names]
            last = self._last.get(id(statement))
            if last is None or last[0] != given:
                last = self._last[id(statement)] = given, self._changed(statement, names, given, at)
            if last[1] is None:
                raise NoValue
            for name, found in last[1].items():
                at[name] = found

    def _changed(
        self, statement: Statement, names: Sequence[str], given: Sequence[Values], at: KnownValues
    ) -> dict[str, Values] | None:
        inside = at.inside()
        if isinstance(statement, Assign):
            found = ValuesOf(at, self._effort)(statement.value)
            return {statement.var.name: within(found, self._domains[statement.var.name])}
        try:
            self._branch(statement, inside)
        except NoValue:
            return None
        return {n: inside[n] for n, before in zip(names, given, strict=True) if inside[n] is not before}

    def _branch(self, statement: If, at: KnownValues) -> None:
        after: list[KnownValues] = []
        for truth, actions in ((True, statement.then), (False, statement.otherwise)):
            try:
                inside = assumed(statement.condition, truth, at, self._effort)
                self._run(cast(Program, actions), inside)
            except NoValue:
                continue
            after.append(inside)
        if not after:
            raise NoValue
        at.join(after[0], after[-1])


def assumed(
    condition: Expr, truth: bool, at: KnownValues, effort: AnalysisEffort, depth: int = 0
) -> KnownValues:
    """What is known where a condition is true, or false.  Raises ``NoValue`` where it cannot be."""
    found = ValuesOf(at, effort, depth)(condition)
    if found == (FALSE if truth else TRUE):
        raise NoValue
    effort.spend(len(at.here))
    known = at.inside()
    if found != (TRUE if truth else FALSE):
        _learn(condition, truth, known)
    return known


def _learn(condition: Expr, truth: bool, known: KnownValues) -> None:
    todo = [(condition, truth)]
    while todo:
        condition, truth = todo.pop()
        match condition:
            case Named(_, body):
                todo.append((body, truth))
            case Var(name):
                known[name] = TRUE if truth else FALSE
            case Apply(Op.NOT, (inner,), _):
                todo.append((inner, not truth))
            case Apply(Op.AND | Op.OR as op, parts, _) if (op is Op.AND) is truth:
                todo += ((part, truth) for part in parts)
            case Apply(op, (Var(name), Const(value)), _):
                known[name] = compared(known[name], op if truth else CONTRARY.get(op, op), value)
            case Apply(op, (Const(value), Var(name)), _):
                op = TURNED.get(op, op)
                known[name] = compared(known[name], op if truth else CONTRARY.get(op, op), value)


class ValuesOf:
    """The values of formulas where variables have some; ``depth`` counts the choices around them."""

    def __init__(self, at: KnownValues, effort: AnalysisEffort, depth: int = 0) -> None:
        self._at, self._effort, self._depth = at, effort, depth
        self._done: dict[int, Values] = {}

    def __call__(self, expr: Expr) -> Values:
        done = self._done
        for node in self._effort.order(expr):
            if id(node) not in done:
                self._effort.spend(_NODE)
                done[id(node)] = self._of(node)
        return done[id(expr)]

    def known(self, expr: Expr) -> Values:
        """What a part of a formula is worth that was looked at."""
        return self._done[id(expr)]

    def _of(self, expr: Expr) -> Values:
        match expr:
            case Const(value, _):
                return frozenset({value})
            case Var(name):
                return self._at[name]
            case Named(_, body):
                return self._done[id(body)]
            case Apply(Op.ITE, (test, then, other), _):
                return self._chosen(test, then, other)
            case Apply(Op.AND | Op.OR as op, parts, _):
                return self._junction(parts, 0 if op is Op.AND else 1)
            case Apply(op, args, _):
                return applied(op, [self._done[id(a)] for a in args])
        raise AssertionError(f"{expr} speaks of the past")

    def _chosen(self, test: Expr, then: Expr, other: Expr) -> Values:
        known = self._done[id(test)]
        if known != EITHER:
            return self._done[id(then if known == TRUE else other)]
        if self._depth >= _DEEP or self._effort.half:
            return joined(self._done[id(then)], self._done[id(other)])
        found: Values | None = None
        for truth, value in ((True, then), (False, other)):
            try:
                inside = assumed(test, truth, self._at, self._effort, self._depth + 1)
            except NoValue:
                continue
            here = ValuesOf(inside, self._effort, self._depth + 1)(value)
            found = here if found is None else joined(found, here)
        if found is None:
            raise NoValue
        return found

    def _junction(self, parts: Sequence[Expr], ends: int) -> Values:
        """False for `and`, true for `or` ends it."""
        found = [self._done[id(part)] for part in parts]
        if frozenset({ends}) in found:
            return frozenset({ends})
        return EITHER if EITHER in found else frozenset({1 - ends})
