"""Deepening: goals with the same cone of influence are searched together, block after block of ticks.

A block of ticks is searched in one query, and a run found is shortened until no shorter one exists
in its block.  Goals that k-induction shows to be out of reach need no unrolling.  Groups take turns:
the one for which Z3 has done the least goes on.  Work is counted in Z3's own steps, not in seconds,
so that the same question has the same answer on a busy machine.
"""

from collections.abc import Iterator, Mapping, Sequence
from itertools import chain

import z3

from checker.encode.bitvector import Term
from checker.encode.cone import Slice, cone, folded, leaving
from checker.encode.symbolic import Transition, transition
from checker.engines.bmc.events import Bound, Event, Found, Inductive, Undefined
from checker.engines.bmc.unroll import Unrolling, model_of, satisfiable
from checker.verdict import Run
from spec_model.lang.expr import Expr
from spec_model.lang.system import TransitionSystem

ALONE = 16
"""Ticks that are searched one by one: short runs are found before blocks are worth while."""
BLOCK = 32
WINDOW = 6
"""Ticks of the longest induction that is tried; half of the goals that are never reached need three."""
_PATIENCE = 3_000_000
"""Steps of Z3 that one induction query may take, a second or two."""


def search(system: TransitionSystem, goals: Sequence[str], most: int) -> Iterator[Event]:
    """Events until every goal is reached or known not to be within ``most`` ticks.

    Raises ``ArithmeticError`` when Z3 gives up.
    """
    whole = folded(transition(system))
    groups = [_Group(whole, names) for names in _by_cone(whole, goals)]
    while groups := [g for g in groups if g.open and g.depth < most]:
        yield from min(groups, key=lambda g: g.spent).go_on(most)


def _by_cone(whole: Transition, goals: Sequence[str]) -> list[list[str]]:
    """Goals that depend on the same variables, inputs and frozen variables, apart from goals."""
    found: dict[frozenset[str], list[str]] = {}
    for goal in goals:
        part = cone(whole, [goal])
        names = {v.name for v in chain(part.variables, part.inputs, part.frozen)}
        found.setdefault(frozenset(names.difference(goals)), []).append(goal)
    return list(found.values())


class _Group:
    """Goals searched together: those still open, the ticks they are not reached in, Z3's work so far."""

    def __init__(self, whole: Transition, goals: Sequence[str]) -> None:
        self.open = list(goals)
        self.depth = 0
        self.spent = 0
        part = self._part = cone(whole, goals)
        self._rest = _Rest(whole.system, part)
        self._leaving = _feasible(part, leaving(part, whole.terms))
        self._unrolling = Unrolling(part, tuple(self._leaving.values()))
        self._queries = 0

    def go_on(self, most: int) -> Iterator[Event]:
        """Search the next block of ticks."""
        start = _work(self._unrolling.solver)
        if self._rest.possible:
            yield from self._block(self.depth + 1, min(most, self.depth + self._block_length()))
            if self.depth == WINDOW and not self._leaving:
                yield from self._inductions()
        else:  # there is no run at all
            self.depth = most
            yield Bound(tuple(self.open), most)
        self.spent += max(0, _work(self._unrolling.solver) - start)

    def _block_length(self) -> int:
        if self.depth < ALONE or self._leaving:
            return 1
        return min(BLOCK, self.depth // 2)

    def _block(self, first: int, last: int) -> Iterator[Event]:
        for _ in range(first, last + 1):
            self._unrolling.tick()
        if self._leaving and self._sat(self._unrolling.events(last)):
            yield Undefined(tuple(self.open), self._leavers(last), self.depth)
            self.open = []
            return
        while self.open and self._sat(self._hits(self.open, first, last)):
            yield self._shortest(first, last)
        self._exclude(self._hits(self.open, first, last))
        self.depth = last
        if self.open:
            yield Bound(tuple(self.open), last)

    def _inductions(self) -> Iterator[Event]:
        """Close the goals that no run reaches, the first ticks being searched already."""
        for goal in list(self.open):
            ticks = inductive(self._part, goal)
            if ticks is not None:
                self.open.remove(goal)
                yield Inductive(goal, ticks)

    def _shortest(self, first: int, last: int) -> Found:
        """The goal that the model reaches first, by a shortest run; closes the goal."""
        goal, tick, model = self._earliest(self.open, first, last)
        while tick > first and self._sat(self._hits([goal], first, tick - 1)):
            goal, tick, model = self._earliest([goal], first, tick - 1)
        self._exclude(self._hits([goal], first, tick - 1))
        self.open.remove(goal)
        return Found(goal, self._rest.complete(self._unrolling.run(model, tick)))

    def _earliest(self, goals: Sequence[str], first: int, last: int) -> tuple[str, int, z3.ModelRef]:
        model = self._unrolling.solver.model()
        for tick in range(first, last + 1):
            for goal in goals:
                if z3.is_true(model.eval(self._unrolling.after(tick, goal), True)):
                    return goal, tick, model
        raise ArithmeticError("Z3 gave a model that does not reach the goal")

    def _hits(self, goals: Sequence[str], first: int, last: int) -> list[Term]:
        return [self._unrolling.after(tick, g) for tick in range(first, last + 1) for g in goals]

    def _sat(self, alternatives: Sequence[Term]) -> bool:
        """Whether one of the conditions can hold, by an assumption literal of this query."""
        self._queries += 1
        active = z3.Bool(f"query@{self._queries}")
        self._unrolling.solver.add(z3.Implies(active, z3.Or(list(alternatives))))
        return satisfiable(self._unrolling.solver, active)

    def _exclude(self, impossible: Sequence[Term]) -> None:
        self._unrolling.solver.add(*(z3.Not(term) for term in impossible))

    def _leavers(self, tick: int) -> tuple[str, ...]:
        model, conditions = self._unrolling.solver.model(), self._unrolling.events(tick)
        named = zip(self._leaving, conditions, strict=True)
        return tuple(name for name, term in named if z3.is_true(model.eval(term, True)))


def inductive(part: Slice, goal: str) -> int | None:
    """The least k up to ``WINDOW`` such that the goal, false after k - 1 ticks from any valuation, is
    false after the next one too; None when there is none or Z3 takes too many steps to tell."""
    unrolling = Unrolling(part, anywhere=True)
    unrolling.solver.set("rlimit", _PATIENCE)
    for ticks in range(1, WINDOW + 1):
        unrolling.tick()
        hit = unrolling.after(ticks, goal)
        answer = unrolling.solver.check(hit)
        if answer != z3.sat:
            return ticks if answer == z3.unsat else None
        unrolling.solver.add(z3.Not(hit))
    return None


def _work(solver: z3.Solver) -> int:
    """The steps that Z3 has counted so far."""
    counts = solver.statistics()
    return int(counts.get_key_value("rlimit count")) if "rlimit count" in counts.keys() else 0  # noqa: SIM118


class _Rest:
    """Inputs and frozen variables outside the cone, with values that the assumption allows."""

    def __init__(self, system: TransitionSystem, part: Slice) -> None:
        inside = {v.name for v in part.inputs}
        outside = [v for v in system.inputs if v.name not in inside]
        inputs = model_of(part.loose, outside)
        self.possible = inputs is not None
        self._inputs = inputs or {}
        self._frozen = {v.name: v.init for v in system.frozen}

    def complete(self, run: Run) -> Run:
        """The run with values for what the search left out."""
        ticks = tuple({**self._inputs, **tick} for tick in run.inputs)
        return Run({**self._frozen, **run.frozen}, ticks)


def _feasible(part: Slice, conditions: Mapping[str, Expr]) -> dict[str, Expr]:
    """The conditions that can hold in one tick from some valuation within the domains."""
    variables = (*part.variables, *part.inputs, *part.frozen)
    return {n: c for n, c in conditions.items() if model_of([*part.assume, c], variables) is not None}
