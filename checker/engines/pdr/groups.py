"""Goals with the same cone of influence share frames; all goals take turns, least work first."""

from collections.abc import Generator, Iterator, Mapping, Sequence
from typing import Protocol

from checker.encode.bits import Circuit, Literal
from checker.encode.bits.model import cut
from checker.encode.cone import as_written, by_cone, cone, constants, folded, straying
from checker.encode.symbolic import SymbolicTransition, transition
from checker.engines.pdr.cubes import Cube
from checker.engines.pdr.events import Decided, Event, PdrBound, PdrUndefined
from checker.engines.pdr.invariant import conjuncts, equal
from checker.engines.pdr.machine import LEAVES, machine
from checker.engines.pdr.runs import others, replayed, run_of
from checker.engines.pdr.search import BoundedDepth, Excluded, PdrSearch, Traced
from checker.engines.pdr.seeds import LARGE, Seed, mined, proved
from checker.engines.pdr.support import needed
from checker.results.verdict import Inductive, Reached, Run, Unreachable
from spec_model.lang.expr import Expr
from spec_model.lang.system import TransitionSystem


def decisions(
    system: TransitionSystem,
    goals: Sequence[str],
    depth: int | None,
    candidates: Sequence[Expr] | None = None,
) -> Iterator[Event]:
    """Events until every goal is decided or known not to be reached within ``depth`` ticks.

    Of the ``candidates`` (None: what random runs suggest), which may be wrong, those that are inductive
    together hold in every frame.
    Raises ``ArithmeticError`` when a run does not replay.
    """
    raw = transition(system)
    fixed = constants(raw)
    whole = folded(raw, fixed)
    groups = []
    for names in by_cone(whole, goals):
        circuit = cut(whole, names)
        seeds = proved(circuit, _suggested(whole, circuit) if candidates is None else candidates)
        groups.append(_Group(circuit, _kept(system, names, fixed), seeds, depth))
    yield from _in_turns(groups)


def _suggested(whole: SymbolicTransition, circuit: Circuit) -> list[Expr]:
    """Candidate invariants, for a circuit that is not too large."""
    part = cone(whole, circuit.goals)
    few = 0 < len(circuit.latches) <= LARGE
    return mined(part, list(straying(whole, part.variables).values())) if few else []


def _kept(system: TransitionSystem, goals: Sequence[str], fixed: Mapping[str, int]) -> list[Expr]:
    """That variables which never change have their values, of all that the goals depend on: the circuit takes
    it for granted, and it is inductive, since what such a variable depends on is among them too."""
    return [equal(v, fixed[v.name]) for v in as_written(system, goals) if v.name in fixed]


class _Work(Protocol):
    """Something with events; ``spent`` counts its questions to the solver."""

    events: Iterator[Event]

    @property
    def spent(self) -> int: ...


def _in_turns(work: Sequence[_Work]) -> Iterator[Event]:
    """The events of all, the next one always from where the least work was done."""
    left = list(work)
    while left:
        turn = min(left, key=lambda w: w.spent)
        event = next(turn.events, None)
        if event is None:
            left.remove(turn)
        else:
            yield event


class _Group:
    """The search for the goals of one circuit."""

    def __init__(
        self, circuit: Circuit, fixed: Sequence[Expr], seeds: Sequence[Seed], depth: int | None
    ) -> None:
        self.circuit = circuit
        self._fixed, self._seeds = fixed, seeds
        self.depth = depth
        self.search = PdrSearch(machine(circuit, [seed.before for seed in seeds]))
        self.events = self._events()

    @property
    def spent(self) -> int:
        return self.search.frames.queries

    def _events(self) -> Iterator[Event]:
        outside = others(self.circuit)
        if outside is None:  # there is no run at all
            because = Inductive(tuple(self._fixed))
            yield from (Decided(goal, Unreachable(because)) for goal in self.circuit.goals)
        elif not self.circuit.leaves or (yield from self._stays(outside)):
            yield from _in_turns([_Goal(self, goal, outside) for goal in self.circuit.goals])

    def _stays(self, outside: dict[Literal, int]) -> Generator[Event, None, bool]:
        """Whether no tick of a run takes a variable out of its domain, which all else takes for granted."""
        goals, system = tuple(self.circuit.goals), self.circuit.system
        for event in self.search.decide(LEAVES):
            match event:
                case Traced():
                    at = replayed(system, run_of(event, self.circuit, outside))
                    yield PdrUndefined(goals, _leavers(system, at[-1]), len(at) - 1)
                    return False
                case _:
                    yield from (PdrBound(goal, 0, self.search.frames.size) for goal in goals)
        return True

    def invariant(self, goal: str, cubes: Sequence[Cube]) -> tuple[Expr, ...]:
        """The formulas that a proof rests on: what the circuit was simplified by, seeds, lemmas."""
        seeds, lemmas = needed(self.circuit, goal, self._seeds, cubes)
        latches = [latch.bit for latch in self.circuit.latches]
        return (*self._fixed, *(seed.condition for seed in seeds), *conjuncts(lemmas, latches))


class _Goal:
    """The search for one goal."""

    def __init__(self, group: _Group, goal: str, outside: dict[Literal, int]) -> None:
        self.spent = 0
        self.events = self._events(group, goal, outside)

    def _events(self, group: _Group, goal: str, outside: dict[Literal, int]) -> Iterator[Event]:
        bound, before = 0, group.spent
        for event in group.search.decide(goal):
            self.spent += group.spent - before
            match event:
                case Traced():
                    run = _reaching(run_of(event, group.circuit, outside), goal, group.circuit.system)
                    yield Decided(goal, Reached(run, shortest=len(run) == bound + 1))
                case Excluded(cubes):
                    yield Decided(goal, Unreachable(Inductive(group.invariant(goal, cubes))))
                case BoundedDepth(bound):
                    yield PdrBound(goal, bound, group.search.frames.size)
                    if group.depth is not None and bound >= group.depth:
                        return
            before = group.spent


def _reaching(run: Run, goal: str, system: TransitionSystem) -> Run:
    """The run, which must reach the goal in its last tick."""
    if not replayed(system, run)[-1][goal]:
        raise ArithmeticError(f"the engine is wrong: its run of {len(run)} ticks does not reach {goal}")
    return run


def _leavers(system: TransitionSystem, at: Mapping[str, int]) -> tuple[str, ...]:
    """The variables that are outside their domains."""
    return tuple(v.name for v in system.variables if at[v.name] not in v.domain)
