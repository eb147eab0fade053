"""Cuts: a transition system in which some variables take any value of their domain after each tick.

Every run of the system is a run of the one with cuts, since a value that is computed is one of those that
are free.  What computes a cut variable no longer matters, and slicing takes it away.
"""

from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import replace

from rovercheck.spec_model.lang.action import Action, Assign, If, assign
from rovercheck.spec_model.lang.expr import Expr, Var, flag, ite
from rovercheck.spec_model.lang.system import Program, Statement, TransitionSystem

Names = frozenset[str]


def with_cuts(system: TransitionSystem, kept: Collection[str]) -> TransitionSystem:
    """The system in which all variables are cut but those kept."""
    return _cut(system, lambda var, free: None if var.name in kept else free)


def with_switches(system: TransitionSystem) -> tuple[TransitionSystem, dict[str, Var]]:
    """The system in which a frozen switch for each variable says whether it is kept, and the switches."""
    switches = {v.name: flag(f"{v.name}@kept", hidden=True) for v in system.variables}
    switched = _cut(system, lambda var, free: ite(switches[var.name], var, free))
    return replace(switched, frozen=(*switched.frozen, *switches.values())), switches


def _cut(system: TransitionSystem, given: Callable[[Var, Var], Expr | None]) -> TransitionSystem:
    """After each part of the step, what it writes is ``given`` anew: by the variable and a free input."""
    pieces = _Pieces()
    own = {v.name: v for v in system.variables}
    step: list[Statement] = []
    inputs: list[Var] = []
    for piece in pieces.of(system.step):
        step.append(piece)
        for name in sorted(written(piece) & own.keys()):
            var = own[name]
            free = Var(f"{name}@any{len(inputs) + 1}", var.domain, var.init, hidden=True)
            value = given(var, free)
            if value is not None:
                inputs.append(free)
                step.append(assign(var, value))
    return replace(
        system,
        inputs=(*system.inputs, *inputs),
        temps=(*system.temps, *pieces.conditions),
        step=tuple(step),
        checks=(),
        source=None,
    )


class _Pieces:
    """A step in pieces, as small as they can be without two of them writing the same in one branch."""

    def __init__(self) -> None:
        self.conditions: list[Var] = []

    def of(self, program: Program) -> Iterator[Statement]:
        """The pieces in order; the condition of a branch is computed once, before its first piece."""
        for statement in program:
            if isinstance(statement, Assign):
                yield statement
                continue
            then, otherwise = _apart(statement.then), _apart(statement.otherwise)
            if len(then) + len(otherwise) < 2:
                yield statement
                continue
            condition = flag(f"condition@{len(self.conditions) + 1}", hidden=True)
            self.conditions.append(condition)
            yield assign(condition, statement.condition)
            yield from self.of(tuple(If(condition, part) for part in then))
            yield from self.of(tuple(If(condition, (), part) for part in otherwise))


def _apart(actions: Sequence[Action]) -> list[tuple[Action, ...]]:
    """The actions in groups, in order, no two of which write the same variable."""
    writes = [written(a) for a in actions]
    groups: list[tuple[Action, ...]] = []
    start = 0
    for end in range(1, len(actions) + 1):
        before = frozenset().union(*writes[start:end])
        if before.isdisjoint(frozenset().union(*writes[end:])):
            groups.append(tuple(actions[start:end]))
            start = end
    return groups


def written(action: Action) -> Names:
    """The names of what an action writes."""
    if isinstance(action, Assign):
        return frozenset([action.var.name])
    if isinstance(action, If):
        return frozenset().union(*map(written, (*action.then, *action.otherwise)))
    return frozenset()
