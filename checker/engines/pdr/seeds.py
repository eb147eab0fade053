"""Candidate invariants proved before the search: the greatest inductive subset holds in every frame.

Random runs suggest relations of counters that bits show badly: two counters in step are one formula,
and hundreds of clauses.  Each counterexample to induction strikes out the candidates that it breaks
(Flanagan and Leino, FME 2001).
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from pysat.solvers import Minisat22

from rovercheck.checker.encode.bits import Blaster, Circuit, Literal
from rovercheck.checker.encode.bits.blast import Value, as_word
from rovercheck.checker.encode.bits.cnf import Cnf
from rovercheck.checker.encode.cone import Slice
from rovercheck.checker.encode.invariants import Candidates
from rovercheck.checker.encode.simulate import Simulator
from rovercheck.checker.system.arrays import ArrayProgram
from rovercheck.spec_model.lang.expr import Expr, Var
from rovercheck.spec_model.lang.walk import variables

LANES, TICKS, EVERY = 64, 200, 8
"""Random runs, their length, and which of their ticks are samples."""
MANY = 1000
"""Candidates up to which all templates are tried, and not only those about counters."""
LARGE = 400
"""Latches from which on finding and proving candidates takes longer than doing without."""


@dataclass(frozen=True, eq=False)
class Seed:
    """A condition on the state before a tick, and the same after it, as literals of the circuit."""

    condition: Expr
    before: Literal
    after: Literal


def mined(part: Slice, escapes: Sequence[Expr]) -> list[Expr]:
    """What held throughout random runs; ``escapes`` are the conditions under which a tick leaves a domain,
    which ends a run."""
    simulator = Simulator(part, escapes, lanes=LANES)
    trail = simulator.run(simulator.start(), TICKS)
    made = Candidates(part, trail.samples(EVERY))
    found = [*made.ranges(), *made.relations()]
    more = [*made.ranges_under(), *made.exclusions()]
    if len(found) + len(more) <= MANY:
        found += more
    for block in trail.blocks():
        truth = ArrayProgram(found)(block)
        found = [c for c, holds in zip(found, truth, strict=True) if np.all(holds)]
    return found


def proved(circuit: Circuit, candidates: Iterable[Expr]) -> list[Seed]:
    """The greatest subset of the candidates that is inductive; those that speak of other variables than
    the latches are left out.  That no run leaves a domain is taken for granted."""
    houdini = _Houdini(circuit, _blasted(circuit, candidates))
    houdini.drop_initially_false()
    while houdini.drop_broken():
        pass
    return list(houdini.left)


def _blasted(circuit: Circuit, candidates: Iterable[Expr]) -> list[Seed]:
    known, before, after = _words(circuit)
    now, later = Blaster(circuit.aig, before), Blaster(circuit.aig, after)
    spoken = [c for c in candidates if variables(c).keys() <= known.keys()]
    return [Seed(c, now.truth(c), later.truth(c)) for c in spoken]


def _words(circuit: Circuit) -> tuple[dict[str, Var], Mapping[str, Value], Mapping[str, Value]]:
    """The variables whose bits are latches, and their values before and after a tick."""
    known = {latch.bit.var.name: latch.bit.var for latch in circuit.latches}
    before: dict[str, list[Literal]] = {name: [] for name in known}
    after: dict[str, list[Literal]] = {name: [] for name in known}
    for latch in circuit.latches:
        before[latch.bit.var.name].append(latch.literal)
        after[latch.bit.var.name].append(latch.next)
    return (
        known,
        {name: as_word(known[name], bits) for name, bits in before.items()},
        {name: as_word(known[name], bits) for name, bits in after.items()},
    )


class _Houdini:
    """The candidates that are left, and a solver for one tick from where all of them hold."""

    def __init__(self, circuit: Circuit, seeds: Sequence[Seed]) -> None:
        self.left = list(seeds)
        self._circuit = circuit
        leaves = [latch.literal for latch in circuit.latches]
        conditions = [circuit.assume, circuit.within, circuit.start]
        ends = [literal for seed in seeds for literal in (seed.before, seed.after)]
        self._cnf = cnf = Cnf(circuit.aig, leaves, [*conditions, *ends])
        self._solver = Minisat22(cnf.clauses)
        self._solver.append_formula([[cnf.literal(circuit.within)]])
        self._next = cnf.variables

    def drop_initially_false(self) -> None:
        """Strike out what some initial state breaks."""
        init = [(n, latch.init) for n, latch in enumerate(self._circuit.latches, 1) if latch.init is not None]
        start = [self._cnf.literal(self._circuit.start), *(n if value else -n for n, value in init)]
        while broken := self._broken([seed.before for seed in self.left], start):
            self._drop(broken)

    def drop_broken(self) -> bool:
        """Strike out what some tick breaks that starts where all that is left holds."""
        held = [self._cnf.literal(seed.before) for seed in self.left]
        assume = self._cnf.literal(self._circuit.assume)
        broken = self._broken([seed.after for seed in self.left], [assume, *held])
        self._drop(broken)
        return bool(broken)

    def _broken(self, conditions: Sequence[Literal], given: Sequence[int]) -> set[int]:
        """The places of the conditions that one model breaks; none if all hold in every model."""
        numbers = [self._cnf.literal(x) for x in conditions]
        self._next += 1
        self._solver.add_clause([-self._next, *(-x for x in numbers)])
        if not self._solver.solve([self._next, *given]):
            return set()
        true = frozenset(self._solver.get_model())
        return {place for place, number in enumerate(numbers) if number not in true}

    def _drop(self, places: set[int]) -> None:
        self.left = [seed for place, seed in enumerate(self.left) if place not in places]
