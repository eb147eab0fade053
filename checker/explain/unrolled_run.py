"""A run as a question to a SAT solver: with which other inputs would it end otherwise?

The circuit of the system is unrolled for as many ticks as the run has, from the same start.  The solver
looks for admissible inputs with which the goal is false after the last tick, while some inputs are kept
within values that are assumed; if there are none, what was assumed forces the end of the run.
"""

from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

from pysat.solvers import Minisat22

from rovercheck.checker.encode.bits import FALSE, TRUE, Aig, Circuit, Literal
from rovercheck.checker.encode.bits.cnf import Cnf
from rovercheck.checker.results.verdict import Run

CONFLICTS = 20_000
"""What the solver may spend on one question; counted, so that the answer is the same on every machine."""
LANES = 1024
"""Runs that are simulated at once."""

Place = tuple[int, str]
"""An input in a tick: the number of the tick, from 1, and the name."""


Over = Callable[[], bool]
"""Whether the time for an explanation is over."""


def never() -> bool:
    """A time that is never over."""
    return False


class OutOfTime(Exception):
    """The time was over before anything was found out; the message says how far it went."""


@dataclass(frozen=True)
class ForcedEnd:
    """Whether what was assumed forces the end (None: the solver gave up), and which part of it does."""

    forced: bool | None
    core: frozenset[int] = frozenset()


class Unrolled:
    """The ticks of a run with every input left open, and a solver that holds them.

    A run that takes some variable out of its domain counts as one that avoids the end, whatever comes
    after that: nothing is claimed of it.  Raises ``OutOfTime`` when the time is over before all ticks are
    there.
    """

    def __init__(self, made: Circuit, goal: str, run: Run, over: Over = never) -> None:
        self.run = run
        self._over = over
        self.graph = Aig()
        self._bits: dict[Place, list[Literal]] = {}
        self._negative = {v.name for v in made.system.inputs if v.domain.low < 0}
        assumed, leaves, hit = self._ticks(made, goal)
        self._facts = [*assumed, self.graph.any([hit ^ 1, *leaves])]
        roots = [fact for fact in self._facts if fact != TRUE]
        self._cnf = Cnf(self.graph, [], roots)
        self._solver = Minisat22(bootstrap_with=self._cnf.clauses)
        self._variables = self._cnf.variables
        for root in roots:
            self._solver.add_clause([self._cnf.literal(root)])
        self._numbers = dict(self._read())

    def __enter__(self) -> "Unrolled":
        return self

    def __exit__(self, *_: object) -> None:
        self._solver.delete()

    @property
    def places(self) -> list[Place]:
        """The inputs, tick by tick, that the end or what is admissible depends on."""
        return list(self._numbers)

    def own(self, place: Place) -> int:
        """The value of an input in the run."""
        return self.run.inputs[place[0] - 1][place[1]]

    # --- questions ---------------------------------------------------------------------------------

    def within(self, place: Place, ranges: Iterable[tuple[int, int]]) -> int:
        """An assumption: the input has a value in one of the ranges, ends included."""
        either = list[int]()
        for low, high in ranges:
            either.append(self._fresh())
            for clause in self._between(place, low, high):
                self._solver.add_clause([-either[-1], *clause])
        if len(either) == 1:
            return either[0]
        assumption = self._fresh()
        self._solver.add_clause([-assumption, *either])
        return assumption

    def asked(self, assumptions: Collection[int], conflicts: int = CONFLICTS) -> ForcedEnd:
        """Whether the end can be avoided with these assumptions."""
        self._solver.conf_budget(conflicts)
        found = self._solver.solve_limited(assumptions=list(assumptions), expect_interrupt=True)
        core = self._solver.get_core() if found is False else None
        return ForcedEnd(None if found is None else not found, frozenset(core or ()))

    def changed(self) -> set[Place]:
        """The inputs that have other values than in the run, in that just found to avoid the end."""
        model = self._solver.get_model()
        return {
            place
            for place, numbers in self._numbers.items()
            if any((model[abs(n) - 1] == n) != self.own(place) >> i & 1 for i, n in enumerate(numbers))
        }

    def avoids(self, changes: Sequence[tuple[Place, int]]) -> Iterator[bool]:
        """For each change of one input of the run: whether it alone is admissible and avoids the end."""
        for start in range(0, len(changes), LANES):
            yield from self._simulated(changes[start : start + LANES])

    def _simulated(self, changes: Sequence[tuple[Place, int]]) -> Iterator[bool]:
        full = (1 << len(changes)) - 1
        words = {
            bit >> 1: full * (self.own(place) >> i & 1)
            for place, bits in self._bits.items()
            for i, bit in enumerate(bits)
        }
        for lane, (place, value) in enumerate(changes):
            for i, bit in enumerate(self._bits[place]):
                words[bit >> 1] ^= ((value ^ self.own(place)) >> i & 1) << lane
        word = [0] * len(self.graph)
        for node, given in words.items():
            word[node] = given
        for node, a, a_not, b, b_not in self._gates:
            word[node] = (word[a] ^ a_not) & (word[b] ^ b_not)
        found = full
        for fact in self._facts:
            found &= word[fact >> 1] ^ -(fact & 1)
        return (bool(found >> lane & 1) for lane in range(len(changes)))

    @cached_property
    def _gates(self) -> list[tuple[int, int, int, int, int]]:
        """The conjunctions in order, with the nodes that they conjoin and what negates these."""
        return [(n, a >> 1, -(a & 1), b >> 1, -(b & 1)) for n, a, b in self.graph.gates(self._facts)]

    # --- clauses -----------------------------------------------------------------------------------

    def _read(self) -> Iterator[tuple[Place, list[int]]]:
        """The numbers of the bits of inputs; those of inputs that nothing depends on are left out."""
        for place, bits in self._bits.items():
            numbers = [self._number(bit) for bit in bits]
            if any(numbers):
                yield place, [n or self._fresh() for n in numbers]

    def _number(self, bit: Literal) -> int:
        try:
            return self._cnf.literal(bit)
        except KeyError:
            return 0

    def _fresh(self) -> int:
        self._variables += 1
        return self._variables

    def _between(self, place: Place, low: int, high: int) -> Iterator[list[int]]:
        bits, lift = list(self._numbers[place]), 0
        if place[1] in self._negative:  # by half the range: the order of signed numbers becomes that of bits
            bits[-1], lift = -bits[-1], 1 << len(bits) - 1
        yield from _at_most(bits, high + lift)
        yield from _at_most([-bit for bit in bits], (1 << len(bits)) - 1 - (low + lift))

    # --- ticks -------------------------------------------------------------------------------------

    def _ticks(self, made: Circuit, goal: str) -> tuple[list[Literal], list[Literal], Literal]:
        """For each tick what is assumed and that it leaves a domain; the goal after the last one."""
        roots = [made.assume, made.leaves, made.goals[goal], *(latch.next for latch in made.latches)]
        gates = [(n, a >> 1, a & 1, b >> 1, b & 1) for n, a, b in made.aig.gates(roots)]
        value, both = self._start(made), self.graph.both
        assumed, leaves, hit, gone = list[Literal](), list[Literal](), FALSE, FALSE
        for number in range(1, len(self.run) + 1):
            if self._over():
                raise OutOfTime(f"the time was over when {number - 1} of {len(self.run)} ticks were unrolled")
            self._open(made, number, value)
            for node, a, a_not, b, b_not in gates:
                one, other = value[a] ^ a_not, value[b] ^ b_not
                if one > 1 < other:
                    value[node] = both(one, other)
                elif one < 2:
                    value[node] = other if one else FALSE
                else:
                    value[node] = one if other else FALSE
            asked = [made.assume, made.leaves, made.goals[goal], *(latch.next for latch in made.latches)]
            now, left, hit, *after = (value[x >> 1] ^ (x & 1) for x in asked)
            assumed.append(self.graph.any([now, gone]))
            leaves.append(left)
            gone = self.graph.any([gone, left])
            for latch, literal in zip(made.latches, after, strict=True):
                value[latch.literal >> 1] = literal
        return assumed, leaves, hit

    def _start(self, made: Circuit) -> list[Literal]:
        """The nodes of the circuit before the first tick; frozen variables are as in the run."""
        value = [FALSE] * len(made.aig)
        for latch in made.latches:
            bit = latch.bit
            first = self.run.frozen[bit.var.name] >> bit.number & 1 if latch.init is None else latch.init
            value[latch.literal >> 1] = TRUE if first else FALSE
        return value

    def _open(self, made: Circuit, number: int, value: list[Literal]) -> None:
        """New inputs for a tick."""
        for bit in made.inputs:
            value[bit.literal >> 1] = self.graph.input()
            self._bits.setdefault((number, bit.var.name), []).append(value[bit.literal >> 1])


def _at_most(bits: Sequence[int], bound: int) -> Iterator[list[int]]:
    """Clauses that say that a number with these bits, least significant first, is at most the bound."""
    above: list[int] = []
    for i in reversed(range(len(bits))):
        if bound >> i & 1:
            above.append(-bits[i])
        else:
            yield [*above, -bits[i]]
