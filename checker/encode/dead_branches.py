"""A system without the branches that no run takes: what its values decide is written down as decided.

A scene drives most of a rover down few of its ways.  What lies beside them is neither worth compiling nor
part of what a verdict depends on.  The states of the system, and what each tick makes of them, stay the same.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import cast

from rovercheck.checker.encode.value_sets import EITHER, TRUE, NoValue, Values, hull, joined, whole, within
from rovercheck.checker.encode.values import AnalysisEffort, KnownValues, TooMuch, ValuesOf, assumed, settled
from rovercheck.spec_model.lang.action import Assign, If
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Named
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.system import Program, Statement, TransitionSystem


@dataclass(frozen=True)
class Narrowed:
    """A system without its dead branches, and what is known of the values of its variables, if it is."""

    system: TransitionSystem
    values: Mapping[str, Values]


def narrowed(system: TransitionSystem, guesses: Sequence[Mapping[str, Values]] = ()) -> Narrowed:
    """The system as it was where it takes too long to look at.

    Of ``guesses`` what its variables are worth, say those of a system before an edit, the first is used to
    which no tick adds.  Sound as long as no tick leaves a domain; no tick does of a system that was lowered,
    which raises a flag instead.
    """
    effort = AnalysisEffort()
    try:
        begun = (before for guess in guesses if (before := _begun(system, guess)) is not None)
        tried = (_Narrowing(system, before, effort) for before in begun)
        made = next((one for one in tried if one.closed), None)
        if made is None:
            made = _Narrowing(system, settled(system, effort), effort)
        step = made.step
    except TooMuch:
        return Narrowed(system, {})
    return Narrowed(system if step is None else replace(system, step=step), made.before)


def _begun(system: TransitionSystem, guess: Mapping[str, Values]) -> dict[str, Values] | None:
    """The guess for what the system has; None where it does not hold before the first tick."""
    free = {v.name: whole(v.domain) for v in system.frozen}
    for var in system.variables:
        first: Values = frozenset({system.init[var.name]})
        if joined(first, guess.get(var.name, first)) != guess.get(var.name):
            return None
    return {**free, **{v.name: guess[v.name] for v in system.variables}}


class _Narrowing:
    """Rewrites a step from what variables are worth before it."""

    def __init__(
        self, system: TransitionSystem, before: Mapping[str, Values], effort: AnalysisEffort
    ) -> None:
        self._system, self.before, self._effort = system, before, effort

    @property
    def step(self) -> Program | None:
        """None where no tick is possible."""
        return None if self._made is None else self._made[0]

    @property
    def closed(self) -> bool:
        """Whether no tick adds to what variables are worth."""
        if self._made is None:
            return True
        after = self._made[1]
        own = (v.name for v in self._system.variables)
        return all(joined(self.before[name], after[name]) == self.before[name] for name in own)

    @cached_property
    def _made(self) -> tuple[Program, KnownValues] | None:
        system = self._system
        free = {v.name: whole(v.domain) for v in (*system.inputs, *system.temps)}
        try:
            at = assumed(system.assume, True, KnownValues({**self.before, **free}), self._effort)
            out: list[Statement] = []
            for statement in system.step:
                at.settle()
                out += self._program([statement], at)
        except NoValue:
            return None
        return tuple(out), at

    def _program(self, program: Sequence[object], at: KnownValues) -> list[Statement]:
        out: list[Statement] = []
        for statement in cast(Sequence[Statement], program):
            if isinstance(statement, Assign):
                found, value = self._formula(statement.value, at)
                at[statement.var.name] = within(found, hull(whole(statement.var.domain)))
                out.append(statement if value is statement.value else replace(statement, value=value))
            else:
                out += self._choice(statement, at)
        return out

    def _choice(self, statement: If, at: KnownValues) -> list[Statement]:
        """What is left of it: one branch where the other is dead.  Raises ``NoValue`` where both are."""
        alive: list[tuple[KnownValues, list[Statement]]] = []
        for truth, actions in ((True, statement.then), (False, statement.otherwise)):
            try:
                inside = assumed(statement.condition, truth, at, self._effort)
                alive.append((inside, self._program(actions, inside)))
            except NoValue:
                continue
        if not alive:
            raise NoValue
        (a, then), (b, otherwise) = alive[0], alive[-1]
        _, condition = self._formula(statement.condition, at)
        at.join(a, b)
        if len(alive) == 1:
            return then
        return [If(condition, tuple(then), tuple(otherwise))] if then or otherwise else []

    def _formula(self, expr: Expr, at: KnownValues) -> tuple[Values, Expr]:
        """What it is worth, and the formula, the same object where nothing of it is decided."""
        found = ValuesOf(at, self._effort)
        worth = found(expr)
        made: dict[int, Expr] = {}
        for node in self._effort.order(expr):
            made[id(node)] = self._node(node, found, made)
        return worth, made[id(expr)]

    @staticmethod
    def _node(node: Expr, found: ValuesOf, made: Mapping[int, Expr]) -> Expr:
        if isinstance(node, Const):
            return node
        values = found.known(node)
        if isinstance(values, frozenset) and len(values) == 1:
            return Const(next(iter(values)), node.sort)
        match node:
            case Named(_, body):
                return node if made[id(body)] is body else made[id(body)]
            case Apply(Op.ITE, (test, then, other), _) if found.known(test) != EITHER:
                return made[id(then if found.known(test) == TRUE else other)]
            case Apply(op, args, sort):
                parts = tuple(made[id(a)] for a in args)
                if op in (Op.AND, Op.OR):
                    unit = 1 if op is Op.AND else 0
                    parts = tuple(p for p in parts if not (isinstance(p, Const) and p.value == unit))
                    if len(parts) == 1:
                        return parts[0]
                same = len(parts) == len(args) and all(p is a for p, a in zip(parts, args, strict=True))
                return node if same else Apply(op, parts, sort)
        return node
