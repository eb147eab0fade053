"""Houdini: the greatest subset of candidates that is inductive, and which of them a proof rests on.

A counterexample to induction is a state in which all remaining candidates hold and a tick after
which some do not.  Whatever else random runs from that state break cannot be inductive either, so
that one answer of the solver strikes out many candidates (Flanagan and Leino, FME 2001).
"""

from collections.abc import Iterable, Sequence
from functools import cached_property

import numpy as np
import z3

from rovercheck.checker.encode.bitvector import Encoder, Term
from rovercheck.checker.encode.invariants import TemplateCube
from rovercheck.checker.encode.simulate import Simulator
from rovercheck.checker.encode.unrolling import Unrolling, literal, satisfiable
from rovercheck.checker.engines.kinduction.ticks import Scope, StartAndInputs, Ticks
from rovercheck.checker.system.arrays import ArrayProgram, Columns
from rovercheck.spec_model.lang.evaluate import evaluate
from rovercheck.spec_model.lang.expr import Expr
from rovercheck.spec_model.lang.walk import variables

PATIENCE = 60_000_000
"""Steps of Z3 that one query may take, tens of seconds."""
_LANES = 64
_TICKS = 8


class Consecution:
    """One tick from any state, with an invariant that grows."""

    def __init__(self, scope: Scope) -> None:
        self._ticks = Ticks(scope, PATIENCE)
        self._ticks.tick()
        self._after = Encoder(self._ticks.valuation(1))
        self._scope = scope
        self._known: dict[str, Expr] = {}
        self._struck: list[tuple[StartAndInputs, Term]] = []

    @cached_property
    def _simulator(self) -> Simulator:
        return Simulator(self._scope.part, self._scope.escapes, lanes=_LANES, seed=1)

    @property
    def known(self) -> list[Expr]:
        """The conjuncts of the invariant so far; together they are inductive."""
        return list(self._known.values())

    def grow(self, candidates: Sequence[Expr]) -> list[Expr]:
        """The greatest subset that is inductive together with what is known; it is known from now on.

        The candidates must hold initially.  Raises ``GaveUp``.
        """
        alive = self._ticks.assumed(candidates)
        self._struck = []
        while alive:
            query = self._ticks.mark(z3.Or([self._refuted(c) for c in alive.values()]))
            if not self._ticks.sat(query, *map(z3.Bool, (*self._known, *alive))):
                break
            alive = self._survivors(alive)
        self._known |= alive
        return list(alive.values())

    def cubes(self, most: int) -> list[TemplateCube]:
        """The last counterexamples that struck out candidates of the last growth, made general."""
        return [self._ticks.cube(found, term) for found, term in self._struck[-most:]]

    def support(self, needed: Iterable[Expr]) -> list[Expr]:
        """The known conjuncts that make the needed ones, known themselves, inductive together."""
        names = {id(c): name for name, c in self._known.items()}
        found = {names[id(c)]: c for c in needed}
        todo = list(found)
        while todo:
            for name in self._rests_on(self._known[todo.pop()], found):
                if name not in found:
                    found[name] = self._known[name]
                    todo.append(name)
        return list(found.values())

    def _rests_on(self, conjunct: Expr, chosen: dict[str, Expr]) -> list[str]:
        """Conjuncts that imply this one after a tick: of those chosen already, if they suffice."""
        query = self._ticks.mark(self._refuted(conjunct))
        for names in (chosen, self._known):
            if not self._ticks.sat(query, *map(z3.Bool, names)):
                return self._ticks.core(names)
        raise ArithmeticError(f"`{conjunct}` was inductive and no longer is")

    def _survivors(self, alive: dict[str, Expr]) -> dict[str, Expr]:
        model, found = self._ticks.solver.model(), self._ticks.start_and_inputs()
        kept = {id(c) for c in unbroken(list(alive.values()), self._runs(found))}
        if len(kept) == len(alive):
            raise ArithmeticError("Z3 and the simulation disagree about a tick")
        refuted = (self._refuted(c) for c in alive.values() if id(c) not in kept)
        self._struck.append((found, next(t for t in refuted if z3.is_true(model.eval(t, True)))))
        return {name: c for name, c in alive.items() if id(c) in kept}

    def _refuted(self, conjunct: Expr) -> Term:
        return z3.Not(self._after(conjunct))

    def _runs(self, found: StartAndInputs) -> Columns:
        """States on random runs from the one of a model, the tick in the model among them."""
        start = self._simulator.everywhere(found.start)
        return self._simulator.run(start, _TICKS, found.inputs[0]).samples()


def of_given(scope: Scope, candidates: Sequence[Expr]) -> Consecution:
    """The greatest inductive subset of the candidates that speak of the scope only.  Raises ``GaveUp``."""
    found = Consecution(scope)
    found.grow(initially(scope, spoken(scope, candidates)))
    return found


def spoken(scope: Scope, conditions: Sequence[Expr]) -> list[Expr]:
    """The conditions that speak of nothing but the scope."""
    known = {v.name for v in (*scope.part.frozen, *scope.part.variables)}
    return [c for c in conditions if variables(c).keys() <= known]


def unbroken(conditions: Sequence[Expr], at: Columns) -> list[Expr]:
    """The conditions that hold in all the states."""
    truth = ArrayProgram(conditions)(at)
    return [c for c, holds in zip(conditions, truth, strict=True) if np.all(holds)]


def initially(scope: Scope, conditions: Sequence[Expr]) -> list[Expr]:
    """The conditions that hold before the first tick, whatever the frozen values."""
    start = {v.name: v.init for v in scope.part.variables}
    frozen = {v.name for v in scope.part.frozen}
    unrolling = Unrolling(scope.part)
    encode = Encoder(unrolling.valuation(0))

    def holds(condition: Expr) -> bool:
        if frozen.isdisjoint(variables(condition)):
            return bool(evaluate(condition, start))
        return not satisfiable(unrolling.solver, literal(unrolling, z3.Not(encode(condition))))

    return [c for c in conditions if holds(c)]
