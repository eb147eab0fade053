"""The search for a proof: plain k-induction first, then with invariants from cheap to rich templates.

Goals with the same cone of influence share simulation and invariants.  What the templates leave open
is attacked from its counterexamples to induction: each suggests clauses that exclude it.
"""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace

import z3

from rovercheck.checker.encode.cone import as_written, by_cone, cone, constants, folded, straying, with_values
from rovercheck.checker.encode.invariants import TemplateCube
from rovercheck.checker.encode.simulate import Simulator, Trail
from rovercheck.checker.encode.symbolic import transition
from rovercheck.checker.encode.unrolling import Outside, Unrolling, literal, satisfiable
from rovercheck.checker.engines.kinduction.houdini import Consecution, of_given
from rovercheck.checker.engines.kinduction.invariant_search import InvariantSearch
from rovercheck.checker.engines.kinduction.ticks import GaveUp, Scope, Ticks, excluded
from rovercheck.checker.results.verdict import Inductive, Run
from rovercheck.checker.search import (
    DepthSearched,
    GoalReached,
    GoalsExcluded,
    GoalsLeftOpen,
    SearchEvent,
    SearchPhase,
)
from rovercheck.spec_model.lang.expr import Expr, Var
from rovercheck.spec_model.lang.system import TransitionSystem

# --- k-induction ---------------------------------------------------------------------------------------

WINDOW = 6
"""Ticks of the longest induction that is tried at first; half of the goals never reached need three."""


@dataclass(frozen=True)
class InductionStep:
    """The goal is not true after ``ticks`` ticks, by the conjuncts named; ``simple`` as in ``Inductive``."""

    ticks: int
    conjuncts: tuple[Expr, ...]
    simple: bool


def induction(
    scope: Scope, goal: str, invariant: Sequence[Expr], window: int, patience: int, *, simple: bool = False
) -> InductionStep | TemplateCube:
    """Whether the goal is inductive in at most ``window`` ticks, or else where the longest one fails.

    ``simple`` takes the states before the ticks to differ from each other.  Raises ``GaveUp``.
    """
    ticks = Ticks(scope, patience)
    literals = ticks.assumed(invariant)
    cube = TemplateCube({}, frozenset())
    for length in range(1, window + 1):
        ticks.tick()
        if simple:
            _differ(ticks, length - 1)
        hit = ticks.after(length, goal)
        if not ticks.sat(ticks.mark(hit), *map(z3.Bool, literals)):
            return InductionStep(length, tuple(literals[name] for name in ticks.core(literals)), simple)
        if length == window:
            cube = ticks.cube(ticks.start_and_inputs(), hit)
        ticks.solver.add(z3.Not(hit))
    return cube


def _differ(ticks: Ticks, last: int) -> None:
    """The state after the last tick is none of those before it."""
    state = ticks.valuation(last)
    for tick in range(last):
        earlier = ticks.valuation(tick)
        ticks.solver.add(z3.Or([earlier[name] != state[name] for name in state]))


BASE = 12
"""Ticks that are searched exhaustively for a run, one by one: the base case of every induction."""
SIMULATED = 1000
"""Ticks of the random runs."""
PLAIN = 3_000_000
"""Steps of Z3 that one query without invariants may take, a second or two."""
HELPED = 30_000_000
"""Steps of Z3 that one with invariants may take."""


def _unheard(_: TemplateCube) -> None:
    """Nothing is made of what stands in the way of a proof."""


def search(system: TransitionSystem, goals: Sequence[str], depth: int | None) -> Iterator[SearchEvent]:
    """Events about each goal; runs are not longer than ``depth``, if that is given.

    Raises ``ArithmeticError`` when Z3 gives up on the base case.
    """
    model = InductionModel(system)
    for names in by_cone(model.folded, goals):
        yield from InductionGroup(model, names, depth).decide()


def with_given(
    system: TransitionSystem, goals: Sequence[str], candidates: Sequence[Expr]
) -> Iterator[SearchEvent]:
    """Events about all goals together, with those of the candidates that are inductive as the invariant.

    No run is told: other engines find shorter and plainer ones.
    """
    yield from InductionGroup(InductionModel(system), goals, WINDOW).decide_with(candidates)


class InductionModel:
    """A system's tick as functions, as written and with the variables that never change folded away."""

    def __init__(self, system: TransitionSystem) -> None:
        self.system = system
        self.plain = transition(system)
        self.fixed = constants(self.plain)
        self.folded = folded(self.plain, self.fixed)

    def as_folded(self, formulas: Iterable[Expr]) -> list[Expr]:
        """Formulas over the variables that do change, each once, without those that are then true."""
        terms = self.plain.terms
        made = (with_values(terms, self.fixed, formula) for formula in formulas)
        return list({id(formula): formula for formula in made if formula is not terms.true}.values())

    def unchanging(self, among: Iterable[Var]) -> tuple[Expr, ...]:
        """The conjuncts that folding relied on, about some variables."""
        terms = self.plain.terms
        return tuple(
            terms.equal(terms.var(v), terms.const(self.fixed[v.name], v.sort))
            for v in among
            if v.name in self.fixed
        )


class InductionGroup:
    """Goals that are decided together: those still open, and the ticks they are not reached in.

    What is ``given`` is tried as part of an invariant before anything else is.
    """

    def __init__(
        self, model: InductionModel, goals: Sequence[str], depth: int | None, given: Sequence[Expr] = ()
    ) -> None:
        self._model, self._most = model, depth
        self._given = model.as_folded(given)
        self.open = list(goals)
        self.deep = 0
        near = as_written(model.system, goals)
        escapes = straying(model.folded, near)
        self._unchanging = model.unchanging(near)
        part = cone(model.folded, [*goals, *escapes])
        self._outside = Outside(model.system, part)
        self._names = tuple(escapes)
        self._scope = Scope(part, tuple(escapes.values()))
        self._whole = replace(self._scope, part=cone(model.folded, [*goals, *(v.name for v in near)]))
        self._reason = "no invariant was found that makes it inductive"

    def decide(self) -> Iterator[SearchEvent]:
        """Events until every goal is decided or stuck."""
        if not self._outside.possible:  # there is no run at all
            yield from (GoalsExcluded((goal,), Inductive(self._unchanging)) for goal in self.open)
            return
        try:
            for phase in (self._first_ticks, self._plainly, self._by_simulation):
                yield from phase()
                if not self.open:
                    return
            yield GoalsLeftOpen(tuple(self.open), self._reason)
        except GaveUp as gave_up:
            yield GoalsLeftOpen(tuple(self.open), f"Z3 took more steps than one query may ({gave_up})")

    def decide_with(self, candidates: Sequence[Expr]) -> Iterator[SearchEvent]:
        """Events until every goal is closed or stuck."""
        if not self._outside.possible:
            yield from (GoalsExcluded((goal,), Inductive(self._unchanging)) for goal in self.open)
            return
        try:
            invariant = of_given(self._scope, self._model.as_folded(candidates))
            yield from self._attempts(invariant, 1)
            if self.open:
                for event in self._first_ticks():
                    yield (
                        GoalsLeftOpen((event.goal,), "a run reaches it")
                        if isinstance(event, GoalReached)
                        else event
                    )
                yield from self._attempts(invariant, self.deep)
            yield GoalsLeftOpen(tuple(self.open), "the given candidates make no invariant that excludes it")
        except GaveUp as gave_up:
            yield GoalsLeftOpen(tuple(self.open), f"Z3 took more steps than one query may ({gave_up})")

    # --- the base case ---------------------------------------------------------------------------

    def _first_ticks(self) -> Iterator[SearchEvent]:
        """Runs of the first few ticks, shortest first."""
        unrolling = Unrolling(self._scope.part, self._scope.escapes)
        for tick in range(1, BASE + 1 if self._most is None else min(BASE, self._most) + 1):
            unrolling.tick()
            yield from self._leaves(unrolling, tick)
            for goal in list(self.open):
                if satisfiable(unrolling.solver, literal(unrolling, unrolling.after(tick, goal))):
                    run = unrolling.run(unrolling.solver.model(), tick)
                    yield self._found(goal, self._outside.complete(run), shortest=True)
            self.deep = tick
            yield DepthSearched(tuple(self.open), tick)
            if not self.open:
                return

    def _leaves(self, unrolling: Unrolling, tick: int) -> Iterator[SearchEvent]:
        """Give up where a run takes a variable out of its domain: nothing is said of what follows."""
        for name, event in zip(self._names, unrolling.events(tick), strict=True):
            if self.open and satisfiable(unrolling.solver, literal(unrolling, event)):
                yield GoalsLeftOpen(tuple(self.open), f"{name} may leave its domain in tick {tick}")
                self.open = []

    def _found(self, goal: str, run: Run, *, shortest: bool) -> GoalReached:
        self.open.remove(goal)
        return GoalReached(goal, run, shortest)

    # --- proofs ----------------------------------------------------------------------------------

    def _plainly(self) -> Iterator[SearchEvent]:
        """k-induction over the domains alone."""
        yield SearchPhase("k-induction over the domains alone")
        if excluded(self._scope, (), PLAIN) is None:
            return
        for goal in list(self.open):
            try:
                step = induction(self._scope, goal, (), min(WINDOW, self.deep), PLAIN)
            except GaveUp:
                continue
            if isinstance(step, InductionStep):
                yield self._closed(goal, step, ())

    def _closed(self, goal: str, step: InductionStep, conjuncts: Sequence[Expr]) -> GoalsExcluded:
        self.open.remove(goal)
        return GoalsExcluded((goal,), Inductive((*self._unchanging, *conjuncts), step.ticks, step.simple))

    def _by_simulation(self) -> Iterator[SearchEvent]:
        """Runs that random inputs find, then invariants that held in all of them."""
        yield SearchPhase("random runs")
        simulator = Simulator(self._scope.part, self._scope.escapes)
        most = SIMULATED if self._most is None else min(SIMULATED, self._most)
        trail = simulator.run(simulator.start(), most)
        frozen = [v.name for v in self._scope.part.frozen]
        for goal in list(self.open):
            hit = trail.first(goal)
            if hit is not None:
                run = self._outside.complete(trail.extract(*hit, frozen))
                yield self._found(goal, run, shortest=False)
        if self.open and self.deep:
            yield from self._with_invariants(trail)

    def _with_invariants(self, trail: Trail) -> Iterator[SearchEvent]:
        found = InvariantSearch(self._scope, trail, self._given)
        for text in found.phases():
            yield SearchPhase(text)
            yield from self._attempts(found.invariant, min(WINDOW, self.deep), found.note)
            if not self.open:
                return
        self._reason += f", {found.answered} counterexamples to induction answered"
        yield SearchPhase("k-induction along simple paths")
        yield from self._attempts(found.invariant, self.deep, simple=True)

    def _attempts(
        self,
        invariant: Consecution,
        window: int,
        note: Callable[[TemplateCube], None] = _unheard,
        *,
        simple: bool = False,
    ) -> Iterator[SearchEvent]:
        """Try to close each goal with the invariant so far; ``note`` is told what stands in the way.

        ``simple``: along paths whose states, of all that the goals depend on as written, differ; whoever
        checks the proof does not know what was simplified away.
        """
        scope = self._whole if simple else self._scope
        safe = excluded(scope, invariant.known, HELPED)
        if safe is None:
            self._reason = f"no invariant was found that keeps {', '.join(self._names)} in the domain"
            return
        for goal in list(self.open):
            step = induction(scope, goal, invariant.known, window, HELPED, simple=simple)
            if isinstance(step, InductionStep):
                yield self._closed(goal, step, invariant.support((*step.conjuncts, *safe)))
            else:
                note(step)
