"""Slicing: the part of a transition system that a set of goals depends on, and nothing else.

A variable belongs to a state only if the next tick may read it before writing it and what is
read can reach a goal.  Wires and outputs that every tick rewrites first therefore cost nothing.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from itertools import product
from typing import cast

from rovercheck.checker.system.partition import conjuncts, partition
from rovercheck.properties.forms import Property, Recoverable
from rovercheck.spec_model.lang.action import If
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.evaluate import evaluate
from rovercheck.spec_model.lang.expr import TRUE, Expr, Var, all_of
from rovercheck.spec_model.lang.system import Program, Statement, TransitionSystem
from rovercheck.spec_model.lang.walk import variables

Names = frozenset[str]

_MOST_TRIED = 1 << 14


def sliced(system: TransitionSystem, goals: Sequence[Var]) -> TransitionSystem:
    """The least part of the system in which the goals behave as in the whole.

    ``variables`` are those of the state at the tick boundary, in the order of the system; what
    else the sliced step writes is in ``temps``.  Conjuncts of the assumption that can always be met
    by inputs which nothing else reads are left out.
    """
    wanted = frozenset(g.name for g in goals)
    open_groups, kept = assumption_groups(system), list[Expr]()
    while True:
        live, step = _cyclic(system.step, wanted, names(kept), _written(system))
        read = live | names(kept) | _all_read(step)
        needed = [_needed(system, group, read) for group in open_groups]
        if not any(needed):
            return _cut(system, live, step, kept)
        kept += [c for group, is_so in zip(open_groups, needed, strict=True) if is_so for c in group]
        open_groups = [group for group, is_so in zip(open_groups, needed, strict=True) if not is_so]


def names(exprs: Iterable[Expr]) -> Names:
    """The names of the variables that occur."""
    return frozenset(variables(*exprs))


def live_before(program: Program, after: Names) -> tuple[Names, Program]:
    """Names whose value before the program can matter to the names ``after`` it, and the program
    without the statements that cannot matter."""
    live = set(after)
    kept = _kept(program, live)
    return frozenset(live), kept


def _kept(program: Program, live: set[str]) -> Program:
    """The program without what cannot matter to the ``live`` names, which become those before it."""
    kept: list[Statement] = []
    for statement in reversed(program):
        if statement.written.isdisjoint(live):
            continue
        if isinstance(statement, If):
            kept += _kept_choice(statement, live)
        else:
            live.discard(statement.var.name)
            live |= statement.read
            kept.append(statement)
    return tuple(reversed(kept))


def _kept_choice(statement: If, live: set[str]) -> list[Statement]:
    before_else = set(live)
    then = _kept(_program(statement.then), live)
    otherwise = _kept(_program(statement.otherwise), before_else)
    if not then and not otherwise:
        return []
    live |= before_else | statement.read
    same = _identical(then, statement.then) and _identical(otherwise, statement.otherwise)
    return [statement if same else If(statement.condition, then, otherwise)]


def _program(actions: Sequence[object]) -> Program:
    """A step holds no sends, which the type of a conditional cannot say."""
    return cast(Program, actions)


def _identical(a: Sequence[object], b: Sequence[object]) -> bool:
    return len(a) == len(b) and all(x is y for x, y in zip(a, b, strict=True))


def _cyclic(program: Program, wanted: Names, always: Names, written: Names) -> tuple[Names, Program]:
    """The least set of names live at the tick boundary, and the program sliced for it."""
    live = always
    while True:
        before, kept = live_before(program, wanted | (live & written))
        if before <= live:
            return live, kept
        live |= before


def _written(system: TransitionSystem) -> Names:
    return frozenset(v.name for v in system.variables)


def _all_read(program: Program) -> Names:
    return frozenset[str]().union(*(statement.read_inside for statement in program))


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
    cells = {v.name: [c.value for c in partition(v, group, found).cells] for v in found.values()}
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


def _cut(system: TransitionSystem, live: Names, step: Program, kept: Sequence[Expr]) -> TransitionSystem:
    read = live | _all_read(step) | names(kept)
    writes = frozenset[str]().union(*(statement.written for statement in step))
    temps = (*system.temps, *(v for v in system.variables if v.name not in live))
    return replace(
        system,
        inputs=tuple(v for v in system.inputs if v.name in read),
        frozen=tuple(v for v in system.frozen if v.name in read),
        variables=tuple(v for v in system.variables if v.name in live),
        temps=tuple(v for v in temps if v.name in writes),
        step=step,
        assume=all_of(*kept) if kept else TRUE,
    )
