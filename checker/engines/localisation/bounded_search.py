"""Bounded search in a system with switches: a run to a goal, or the variables that stand in its way.

The core of an unrolling without a model names the switches it rests on: with these variables as they are
computed and all others free, the goal is still out of reach within those ticks (McMillan and Amla,
Automatic Abstraction without Counterexamples, TACAS 2003).
"""

from collections.abc import Mapping
from dataclasses import dataclass

from rovercheck.checker.encode.bitvector import Term
from rovercheck.checker.encode.cone import as_written, cone, folded, straying
from rovercheck.checker.encode.symbolic import SymbolicTransition, transition
from rovercheck.checker.encode.unrolling import Outside, Unrolling, literal, satisfiable
from rovercheck.checker.engines.localisation.cuts import with_switches
from rovercheck.checker.process.isolate import Send
from rovercheck.checker.results.verdict import Run
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.system import TransitionSystem


@dataclass(frozen=True)
class BoundedHit:
    """A run of the system itself."""

    run: Run


@dataclass(frozen=True)
class Core:
    """The goal is not reached after so many ticks, and these variables are why."""

    kept: frozenset[str]


class BoundedEngine:
    """Answers orders about one system: how far a goal is out of reach, and why."""

    def __init__(self, system: TransitionSystem) -> None:
        switched, self._switches = with_switches(system)
        self._plain = transition(system)
        self._whole = folded(transition(switched))
        self._searches: dict[str, _Search] = {}

    def __call__(self, send: Send, goal: str, depth: int, kept: frozenset[str]) -> None:
        """Send a ``BoundedHit``, a ``Core`` that adds to what is ``kept``, or why there is none as a text."""
        if goal not in self._searches:
            own = self._plain.system
            if straying(self._plain, as_written(own, [goal])):  # a cut variable would never leave its domain
                send(Core(frozenset(v.name for v in own.variables)))
                return
            self._searches[goal] = _Search(self._whole, self._plain.system, goal, self._switches)
        try:
            send(self._searches[goal].within(depth, kept))
        except ArithmeticError as error:
            send(str(error))


class _Search:
    """The unrolling for one goal."""

    def __init__(
        self, whole: SymbolicTransition, system: TransitionSystem, goal: str, switches: Mapping[str, Var]
    ) -> None:
        self._system, self._goal = system, goal
        part = cone(whole, [goal])
        self._outside = Outside(whole.system, part)
        self._unrolling = Unrolling(part)
        inside, first = {v.name for v in part.frozen}, self._unrolling.valuation(0)
        self._on = {name: first[s.name] for name, s in switches.items() if s.name in inside}
        self._size = {v.name: len(v.domain) for v in part.variables}

    def within(self, depth: int, kept: frozenset[str]) -> BoundedHit | Core:
        """A run of so many ticks, or why there is none.  Raises ``ArithmeticError`` when Z3 gives up."""
        if not self._outside.possible:  # there is no run at all
            return Core(kept)
        unrolling = self._unrolling
        while len(unrolling) < depth:
            unrolling.tick()
        reached = literal(unrolling, unrolling.after(depth, self._goal))
        if satisfiable(unrolling.solver, reached, *self._on.values()):
            run = unrolling.run(unrolling.solver.model(), depth)
            return BoundedHit(self._own(self._outside.complete(run)))
        return Core(self._least(reached, kept))

    def _least(self, reached: Term, kept: frozenset[str]) -> frozenset[str]:
        """What is kept, and a least set of further variables with which the goal is out of reach.

        Variables of large domains are dropped first: those that stay make the system small.
        """
        solver, fixed = self._unrolling.solver, [self._on[n] for n in sorted(kept) if n in self._on]
        more = self._rests_on(kept)
        for name in sorted(more, key=lambda n: (-self._size.get(n, 1), n)):
            if name in more:
                rest = [self._on[n] for n in sorted(more) if n != name]
                if not satisfiable(solver, reached, *fixed, *rest):
                    more &= self._rests_on(kept)
        return kept | more

    def _rests_on(self, kept: frozenset[str]) -> frozenset[str]:
        core = {str(term) for term in self._unrolling.solver.unsat_core()}
        return frozenset(n for n, term in self._on.items() if str(term) in core and n not in kept)

    def _own(self, run: Run) -> Run:
        """The run without the switches, and without the inputs that stand for cut variables."""
        frozen = {v.name: run.frozen[v.name] for v in self._system.frozen}
        ticks = ({v.name: tick[v.name] for v in self._system.inputs} for tick in run.inputs)
        return Run(frozen, tuple(ticks))
