"""What a proof rests on: of the seeds and lemmas, those that exclude the goal and carry themselves."""

from collections.abc import Iterable, Sequence

from pysat.solvers import Minisat22

from rovercheck.checker.encode.bits import Circuit
from rovercheck.checker.encode.bits.cnf import Clause, Cnf
from rovercheck.checker.engines.pdr.cubes import Cube
from rovercheck.checker.engines.pdr.seeds import Seed


def needed(
    circuit: Circuit, goal: str, seeds: Sequence[Seed], cubes: Sequence[Cube]
) -> tuple[list[Seed], list[Cube]]:
    """A part of an invariant that is inductive and keeps every tick from the goal and in the domains.

    Raises ``ArithmeticError`` if the invariant does not, so that no proof is claimed without this check.
    """
    proof = _Proof(circuit, goal, seeds, cubes)
    places = proof.places()
    count = len(seeds)
    return [seeds[p] for p in places if p < count], [cubes[p - count] for p in places if p >= count]


class _Proof:
    """One tick from where chosen conjuncts hold, each under a variable of its own."""

    def __init__(self, circuit: Circuit, goal: str, seeds: Sequence[Seed], cubes: Sequence[Cube]) -> None:
        bad = [circuit.goals[goal], circuit.leaves]
        following = [latch.next for latch in circuit.latches]
        ends = [literal for seed in seeds for literal in (seed.before, seed.after)]
        given = [circuit.assume, circuit.within]
        cnf = Cnf(
            circuit.aig, [latch.literal for latch in circuit.latches], [*given, *bad, *following, *ends]
        )
        after = [cnf.literal(x) for x in following]
        self._solver = Minisat22([*cnf.clauses, *([cnf.literal(x)] for x in given)])
        self._bad = [cnf.literal(x) for x in bad]
        self._first = cnf.variables + 1
        self._broken = [[-cnf.literal(seed.after)] for seed in seeds]
        self._broken += [[after[x - 1] if x > 0 else -after[-x - 1] for x in c.literals] for c in cubes]
        held: list[Clause] = [[cnf.literal(seed.before)] for seed in seeds]
        held += [[-x for x in c.literals] for c in cubes]
        for number, clause in enumerate(held, self._first):
            self._solver.add_clause([-number, *clause])

    def places(self) -> list[int]:
        """The conjuncts, by their places, that the proof rests on."""
        chosen = dict[int, None]()
        todo = [place for literal in self._bad for place in self._why([literal], chosen)]
        while todo:
            place = todo.pop()
            if place not in chosen:
                chosen[place] = None
                todo += self._why(self._broken[place], chosen)
        return sorted(chosen)

    def _why(self, event: Sequence[int], chosen: Iterable[int]) -> list[int]:
        """The conjuncts, of those chosen if they suffice, under which no tick does what the literals say."""
        for places in (list(chosen), range(len(self._broken))):
            numbers = [self._first + place for place in places]
            if not self._solver.solve([*numbers, *event]):
                core = frozenset(self._solver.get_core() or ())
                return [number - self._first for number in numbers if number in core]
        raise ArithmeticError("the engine is wrong: its invariant is not inductive")
