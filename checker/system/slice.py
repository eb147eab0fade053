"""Slicing: the part of a transition system that a set of goals depends on, and nothing else.

A variable belongs to a state only if the next tick may read it before writing it and what is
read can reach a goal.  Wires and outputs that every tick rewrites first therefore cost nothing.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from itertools import product

from rovercheck.checker.system.live_variables import LiveCycle, Names, live_cycle
from rovercheck.checker.system.partition import conjuncts, partition
from rovercheck.checker.system.wide_cells import TooManyValues
from rovercheck.properties.forms import Property, Recoverable
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.evaluate import evaluate
from rovercheck.spec_model.lang.expr import TRUE, Expr, Var, all_of
from rovercheck.spec_model.lang.system import TransitionSystem
from rovercheck.spec_model.lang.walk import variables

_MOST_TRIED = 1 << 14


def sliced(system: TransitionSystem, goals: Sequence[Var]) -> TransitionSystem:
    """The least part of the system in which the goals behave as in the whole.

    ``variables`` are those of the state at the tick boundary, in the order of the system; what
    else the sliced step writes is in ``temps``.  Conjuncts of the assumption that can always be met
    by inputs which nothing else reads are left out.
    """
    wanted, own = frozenset(g.name for g in goals), frozenset(v.name for v in system.variables)
    open_groups, kept = assumption_groups(system), list[Expr]()
    while True:
        cycle = live_cycle(system.step, wanted, names(kept), own)
        read = cycle.live | names(kept) | cycle.read
        needed = [_needed(system, group, read) for group in open_groups]
        if not any(needed):
            return _cut(system, cycle, read, kept)
        kept += [c for group, is_so in zip(open_groups, needed, strict=True) if is_so for c in group]
        open_groups = [group for group, is_so in zip(open_groups, needed, strict=True) if not is_so]


def names(exprs: Iterable[Expr]) -> Names:
    """The names of the variables that occur."""
    return frozenset(variables(*exprs))


# --- the assumption ------------------------------------------------------------------------------


def assumption_groups(system: TransitionSystem) -> list[list[Expr]]:
    """The conjuncts of the assumption, those that share inputs together."""
    inputs = {v.name for v in system.inputs}
    groups: list[tuple[Names, list[Expr]]] = []
    for conjunct in conjuncts(system.assume):
        own = names([conjunct]) & inputs
        joined = [g for g in groups if g[0] & own]
        groups = [g for g in groups if not g[0] & own]
        merged = [c for _, group in joined for c in group]
        groups.append((own.union(*(g[0] for g in joined)), [*merged, conjunct]))
    return [group for _, group in groups]


def _needed(system: TransitionSystem, group: list[Expr], read: Names) -> bool:
    inputs = {v.name: v for v in system.inputs}
    found = variables(*group)
    if any(name in inputs and name in read for name in found):
        return True
    return not _always_met(group, found, inputs)


def _always_met(group: list[Expr], found: Mapping[str, Var], inputs: Mapping[str, Var]) -> bool:
    """Whether inputs that satisfy the group exist in every state (False when too many to try)."""
    free = [v for n, v in found.items() if n in inputs]
    given = [v for n, v in found.items() if n not in inputs]
    try:
        cells = {v.name: [c.value for c in partition(v, group, found).cells] for v in found.values()}
    except TooManyValues:
        return False
    size = 1
    for values in cells.values():
        size *= len(values)
    if size > _MOST_TRIED:
        return False
    return all(_met(group, at, free, cells) for at in _vectors(given, cells))


def _met(
    group: list[Expr], given: Mapping[str, int], free: Sequence[Var], cells: Mapping[str, Sequence[int]]
) -> bool:
    return any(all(evaluate(c, {**given, **at}) for c in group) for at in _vectors(free, cells))


def _vectors(chosen: Sequence[Var], cells: Mapping[str, Sequence[int]]) -> Iterable[dict[str, int]]:
    domains = [cells[v.name] for v in chosen]
    return (dict(zip([v.name for v in chosen], values, strict=True)) for values in product(*domains))


def always_met(system: TransitionSystem, condition: Expr) -> bool:
    """Whether in every state some admissible inputs meet a condition on inputs alone.

    False also when there are too many combinations to try.
    """
    inputs = {v.name: v for v in system.inputs}
    if not names([condition]) <= inputs.keys():
        return False
    demanded = replace(system, assume=all_of(system.assume, condition))
    groups = assumption_groups(demanded)
    return all(_always_met(group, variables(*group), inputs) for group in groups)


def check_way_back(prop: Property, system: TransitionSystem) -> None:
    """Raises ``ModelError`` if inputs are to lead back (``by``) that need not be there."""
    match prop.form:
        case Recoverable(by=Expr() as by) if not always_met(system, by):
            raise ModelError(
                f"{prop.id}: by = {by} must be a condition on inputs of {system.name} that can be met "
                "in every tick; leave variables and other inputs out of it."
            )


# --- the result ----------------------------------------------------------------------------------


def _cut(system: TransitionSystem, cycle: LiveCycle, read: Names, kept: Sequence[Expr]) -> TransitionSystem:
    temps = (*system.temps, *(v for v in system.variables if v.name not in cycle.live))
    return replace(
        system,
        inputs=tuple(v for v in system.inputs if v.name in read),
        frozen=tuple(v for v in system.frozen if v.name in read),
        variables=tuple(v for v in system.variables if v.name in cycle.live),
        temps=tuple(v for v in temps if v.name in cycle.written),
        step=cycle.program,
        assume=all_of(*kept) if kept else TRUE,
    )
