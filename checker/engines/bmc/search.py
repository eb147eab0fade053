"""Deepening: goals with the same cone of influence are searched together, block after block of ticks.

A block of ticks is searched in one query, and a run found is shortened until no shorter one exists
in its block.  Groups take turns: the one for which Z3 has done the least goes on.  Work is counted in
Z3's own steps, not in seconds, so that the same question has the same answer on a busy machine.
"""

from collections.abc import Iterator, Mapping, Sequence

import z3

from rovercheck.checker.encode.bitvector import Term
from rovercheck.checker.encode.cone import as_written, by_cone, cone, folded, straying
from rovercheck.checker.encode.symbolic import SymbolicTransition, transition
from rovercheck.checker.encode.unrolling import Outside, Unrolling, model_of, satisfiable, steps_taken
from rovercheck.checker.search import DepthSearched, GoalReached, GoalsLeftOpen, SearchEvent
from rovercheck.spec_model.lang.expr import Expr
from rovercheck.spec_model.lang.system import TransitionSystem
from rovercheck.spec_model.lang.walk import variables

ALONE = 16
"""Ticks that are searched one by one: short runs are found before blocks are worth while."""
BLOCK = 32


def search(system: TransitionSystem, goals: Sequence[str], most: int) -> Iterator[SearchEvent]:
    """Events until every goal is reached or known not to be within ``most`` ticks.

    Raises ``ArithmeticError`` when Z3 gives up.
    """
    whole = folded(transition(system))
    groups = [_Group(whole, names) for names in by_cone(whole, goals)]
    while groups := [g for g in groups if g.open and g.depth < most]:
        yield from min(groups, key=lambda g: g.spent).go_on(most)


class _Group:
    """Goals searched together: those still open, the ticks they are not reached in, Z3's work so far."""

    def __init__(self, whole: SymbolicTransition, goals: Sequence[str]) -> None:
        self.open = list(goals)
        self.depth = 0
        self.spent = 0
        self._leaving = _feasible(whole, straying(whole, as_written(whole.system, goals)))
        part = cone(whole, [*goals, *self._leaving])
        self._outside = Outside(whole.system, part)
        self._unrolling = Unrolling(part, tuple(self._leaving.values()))
        self._queries = 0

    def go_on(self, most: int) -> Iterator[SearchEvent]:
        """Search the next block of ticks."""
        start = steps_taken(self._unrolling.solver)
        if self._outside.possible:
            yield from self._block(self.depth + 1, min(most, self.depth + self._block_length()))
        else:  # there is no run at all
            self.depth = most
            yield DepthSearched(tuple(self.open), most)
        self.spent += max(0, steps_taken(self._unrolling.solver) - start)

    def _block_length(self) -> int:
        if self.depth < ALONE or self._leaving:
            return 1
        return min(BLOCK, self.depth // 2)

    def _block(self, first: int, last: int) -> Iterator[SearchEvent]:
        for _ in range(first, last + 1):
            self._unrolling.tick()
        if self._leaving and self._sat(self._unrolling.events(last)):
            yield self._undefined(last)
            self.open = []
            return
        while self.open and self._sat(self._hits(self.open, first, last)):
            yield self._shortest(first, last)
        self._exclude(self._hits(self.open, first, last))
        self.depth = last
        if self.open:
            yield DepthSearched(tuple(self.open), last)

    def _undefined(self, tick: int) -> GoalsLeftOpen:
        names = ", ".join(self._leavers(tick))
        return GoalsLeftOpen(tuple(self.open), f"{names} may leave its domain in tick {tick}")

    def _shortest(self, first: int, last: int) -> GoalReached:
        """The goal that the model reaches first, by a shortest run; closes the goal."""
        goal, tick, model = self._earliest(self.open, first, last)
        while tick > first and self._sat(self._hits([goal], first, tick - 1)):
            goal, tick, model = self._earliest([goal], first, tick - 1)
        self._exclude(self._hits([goal], first, tick - 1))
        self.open.remove(goal)
        return GoalReached(goal, self._outside.complete(self._unrolling.run(model, tick)))

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


def _feasible(whole: SymbolicTransition, conditions: Mapping[str, Expr]) -> dict[str, Expr]:
    """The conditions that can hold in one tick from some state within the domains."""

    def possible(condition: Expr) -> bool:
        together = [*whole.assume, condition]
        return model_of(together, list(variables(*together).values())) is not None

    return {name: condition for name, condition in conditions.items() if possible(condition)}
