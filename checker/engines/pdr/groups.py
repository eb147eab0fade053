"""Goals with the same cone of influence share frames; all goals take turns, least work first."""

from collections.abc import Generator, Iterable, Iterator, Mapping, Sequence
from typing import Protocol

from pysat.solvers import Minisat22

from rovercheck.checker.encode.bits import Bit, Circuit, Literal
from rovercheck.checker.encode.bits.blast import bits_needed
from rovercheck.checker.encode.bits.cnf import Cnf
from rovercheck.checker.encode.bits.model import cut
from rovercheck.checker.encode.cone import as_written, by_cone, cone, constants, folded, straying
from rovercheck.checker.encode.symbolic import SymbolicTransition, transition
from rovercheck.checker.engines.pdr.cubes import Cube
from rovercheck.checker.engines.pdr.machine import LEAVES, machine
from rovercheck.checker.engines.pdr.search import BoundedDepth, PdrInvariant, PdrRun, PdrSearch
from rovercheck.checker.engines.pdr.seeds import LARGE, Seed, mined, proved
from rovercheck.checker.engines.pdr.support import needed
from rovercheck.checker.results.verdict import Inductive, Run
from rovercheck.checker.search import DepthSearched, GoalReached, GoalsExcluded, GoalsLeftOpen, SearchEvent
from rovercheck.spec_model.lang.domain import Bool, Num
from rovercheck.spec_model.lang.evaluate import admissible, step
from rovercheck.spec_model.lang.expr import FALSE, TRUE, Apply, Const, Expr, Var, any_of
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.system import TransitionSystem

# --- traces of a circuit as runs of the system, and their replay by the reference semantics ------------


def others(circuit: Circuit) -> dict[Literal, int] | None:
    """Values of the inputs outside the cone that the assumption allows; None if there are none, so that
    the system has no run at all."""
    bits = [bit.literal for bit in circuit.others]
    cnf = Cnf(circuit.aig, bits, [circuit.loose])
    solver = Minisat22([*cnf.clauses, [cnf.literal(circuit.loose)]])
    if not solver.solve():
        return None
    return {bit: int(x > 0) for bit, x in zip(bits, solver.get_model(), strict=False)}


def run_of(traced: PdrRun, circuit: Circuit, outside: dict[Literal, int]) -> Run:
    """The run of the whole system that a trace stands for."""
    leaves = [*(latch.literal for latch in circuit.latches), *(bit.literal for bit in circuit.inputs)]

    def values(literals: tuple[int, ...]) -> dict[Literal, int]:
        return {leaves[abs(x) - 1]: int(x > 0) for x in literals}

    return circuit.run(values(traced.latches), [values(tick) | outside for tick in traced.inputs])


def replayed(system: TransitionSystem, run: Run) -> list[dict[str, int]]:
    """The state before the first tick and after each.  Raises ``ArithmeticError`` if the run is none."""
    if any(run.frozen[v.name] not in v.domain for v in system.frozen):
        raise ArithmeticError("the engine is wrong: its run has frozen values outside their domains")
    at = {**system.init, **run.frozen}
    visited = [at]
    for number, inputs in enumerate(run.inputs, 1):
        if not admissible(system, at, inputs):
            raise ArithmeticError(f"the engine is wrong: its run is not admissible in tick {number}")
        at = step(system, at, inputs)
        visited.append(at)
    return visited


# --- lemmas over bits as formulas over the variables of the system, for certificates and people --------

_LISTED = 1 << 12
"""Values of a domain that are looked at one by one to find a readable formula."""


def conjuncts(cubes: Iterable[Cube], latches: Sequence[Bit]) -> tuple[Expr, ...]:
    """The negation of each cube; variables are taken to be within their domains."""
    found = (_negated(excluded, latches) for excluded in cubes)
    return tuple(formula for formula in found if formula is not TRUE)


def equal(var: Var, value: int) -> Expr:
    """The variable has a value."""
    if isinstance(var.sort, Bool):
        return var if value else ~var
    return _compared(Op.EQ, var, value)


def _negated(excluded: Cube, latches: Sequence[Bit]) -> Expr:
    """Some variable does not have the bits that the cube demands of it; ``TRUE`` if none ever has."""
    wanted: dict[str, dict[int, bool]] = {}
    known: dict[str, Var] = {}
    for literal in excluded.literals:
        bit = latches[abs(literal) - 1]
        known[bit.var.name] = bit.var
        wanted.setdefault(bit.var.name, {})[bit.number] = literal > 0
    parts = [_different(known[name], bits) for name, bits in wanted.items()]
    if any(part is TRUE for part in parts):
        return TRUE
    return any_of(*(part for part in parts if part is not FALSE))


def _different(var: Var, bits: Mapping[int, bool]) -> Expr:
    """The variable differs in at least one of these bits."""
    if isinstance(var.sort, Bool):
        allowed = [value for value in var.domain.values if value != bits[0]]
    elif len(var.domain) <= _LISTED:
        allowed = [v for v in var.domain.values if any((v >> n & 1) != bit for n, bit in bits.items())]
    else:
        return any_of(*(_bit(var, n) if not bit else ~_bit(var, n) for n, bit in bits.items()))
    return _among(var, allowed, bits)


def _among(var: Var, allowed: Sequence[int], bits: Mapping[int, bool]) -> Expr:
    """The variable has one of the allowed values: as a comparison where there is a short one."""
    values = list(var.domain.values)
    if len(allowed) in (0, len(values)):
        return TRUE if allowed else FALSE
    if isinstance(var.sort, Bool):
        return var if allowed[0] else ~var
    excluded = sorted(set(values) - set(allowed))
    if len(excluded) == 1:
        return _compared(Op.NE, var, excluded[0])
    if len(allowed) == 1:
        return _compared(Op.EQ, var, allowed[0])
    if excluded == values[: len(excluded)]:
        return _compared(Op.GE, var, allowed[0])
    if excluded == values[-len(excluded) :]:
        return _compared(Op.LE, var, allowed[-1])
    if not isinstance(var.sort, Num):
        return any_of(*(_compared(Op.EQ, var, value) for value in allowed))
    return any_of(*(~_bit(var, n) if bit else _bit(var, n) for n, bit in bits.items()))


def _compared(op: Op, var: Var, value: int) -> Expr:
    return Apply(op, (var, Const(value, var.sort)), Bool())


def _bit(var: Var, number: int) -> Expr:
    """A bit of the two's complement, by an offset that makes the number non-negative."""
    base: Expr = var
    if var.domain.low < 0:
        base = Apply(Op.ADD, (var, Const(1 << bits_needed(var), var.sort)), var.sort)
    return Apply(Op.BIT, (base, Const(number, Num())), Bool())


def decisions(
    system: TransitionSystem,
    goals: Sequence[str],
    depth: int | None,
    candidates: Sequence[Expr] | None = None,
) -> Iterator[SearchEvent]:
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

    events: Iterator[SearchEvent]

    @property
    def spent(self) -> int: ...


def _in_turns(work: Sequence[_Work]) -> Iterator[SearchEvent]:
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

    @property
    def lemmas(self) -> str:
        """How many lemmas are in use."""
        return f"{self.search.frames.size:,} lemmas"

    def _events(self) -> Iterator[SearchEvent]:
        outside = others(self.circuit)
        if outside is None:  # there is no run at all
            because = Inductive(tuple(self._fixed))
            yield GoalsExcluded(tuple(self.circuit.goals), because)
        elif not self.circuit.leaves or (yield from self._stays(outside)):
            yield from _in_turns([_Goal(self, goal, outside) for goal in self.circuit.goals])

    def _stays(self, outside: dict[Literal, int]) -> Generator[SearchEvent, None, bool]:
        """Whether no tick of a run takes a variable out of its domain, which all else takes for granted."""
        goals, system = tuple(self.circuit.goals), self.circuit.system
        for event in self.search.decide(LEAVES):
            match event:
                case PdrRun():
                    at = replayed(system, run_of(event, self.circuit, outside))
                    yield _undefined(goals, _leavers(system, at[-1]), len(at) - 1)
                    return False
                case _:
                    yield DepthSearched(goals, 0, self.lemmas)
        return True

    def invariant(self, goal: str, cubes: Sequence[Cube]) -> tuple[Expr, ...]:
        """The formulas that a proof rests on: what the circuit was simplified by, seeds, lemmas."""
        seeds, lemmas = needed(self.circuit, goal, self._seeds, cubes)
        latches = [latch.bit for latch in self.circuit.latches]
        return (*self._fixed, *(seed.condition for seed in seeds), *conjuncts(lemmas, latches))


def _undefined(goals: tuple[str, ...], variables: tuple[str, ...], tick: int) -> GoalsLeftOpen:
    return GoalsLeftOpen(goals, f"{', '.join(variables)} may leave its domain in tick {tick}")


class _Goal:
    """The search for one goal."""

    def __init__(self, group: _Group, goal: str, outside: dict[Literal, int]) -> None:
        self.spent = 0
        self.events = self._events(group, goal, outside)

    def _events(self, group: _Group, goal: str, outside: dict[Literal, int]) -> Iterator[SearchEvent]:
        bound, before = 0, group.spent
        for event in group.search.decide(goal):
            self.spent += group.spent - before
            match event:
                case PdrRun():
                    run = _reaching(run_of(event, group.circuit, outside), goal, group.circuit.system)
                    yield GoalReached(goal, run, shortest=len(run) == bound + 1)
                case PdrInvariant(cubes):
                    yield GoalsExcluded((goal,), Inductive(group.invariant(goal, cubes)))
                case BoundedDepth(bound):
                    yield DepthSearched((goal,), bound, group.lemmas)
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
