"""Many runs of a circuit at once: bit ``r`` of every word belongs to run ``r``."""

from collections.abc import Iterable, Mapping, Sequence
from types import MappingProxyType

from rovercheck.checker.encode.bits.aig import Literal
from rovercheck.checker.encode.bits.model import Bit, Circuit

Values = dict[str, list[int]]
"""The value of each input, by name, one for each run."""


class BitSimulation:
    """The circuit in some state for each run; frozen variables have the values given, or initial ones."""

    def __init__(self, circuit: Circuit, runs: int, frozen: Mapping[str, int] = MappingProxyType({})) -> None:
        self.circuit, self.full = circuit, (1 << runs) - 1
        self.runs = runs
        roots = [circuit.assume, circuit.leaves, *circuit.goals.values()]
        roots += [latch.next for latch in circuit.latches]
        first = circuit.aig.cone([circuit.assume, circuit.loose])
        known = set(first)
        self._assumed = self._gates(first)
        self._others = self._gates(n for n in circuit.aig.cone(roots) if n not in known)
        self._word = [0] * len(circuit.aig)
        self._given: Values = {}
        for latch in circuit.latches:
            var, number = latch.bit.var, latch.bit.number
            start = latch.init if latch.init is not None else frozen.get(var.name, var.init) >> number & 1
            self._word[latch.literal >> 1] = self.full if start else 0

    def _gates(self, nodes: Iterable[int]) -> list[tuple[int, int, int, int, int]]:
        """For each conjunction its node, and of both sides the node and what negates it."""
        full, fanins = self.full, self.circuit.aig.fanins
        pairs = ((n, *fanins[n]) for n in nodes if not self.circuit.aig.is_input(n))
        return [(n, a >> 1, full * (a & 1), b >> 1, full * (b & 1)) for n, a, b in pairs]

    def _run(self, gates: Sequence[tuple[int, int, int, int, int]]) -> None:
        word = self._word
        for node, a, a_not, b, b_not in gates:
            word[node] = (word[a] ^ a_not) & (word[b] ^ b_not)

    def value(self, literal: Literal) -> int:
        """The word of a literal, after ``given`` or ``allowed`` has computed it."""
        return self._word[literal >> 1] ^ self.full * (literal & 1)

    def allowed(self, values: Values) -> int:
        """The runs in which inputs with these values are admissible in the next tick."""
        for bit in (*self.circuit.inputs, *self.circuit.others):
            if values[bit.var.name] is not self._given.get(bit.var.name):
                self._word[bit.literal >> 1] = word_of(bit, values[bit.var.name])
        self._given = values
        self._run(self._assumed)
        return self.value(self.circuit.assume) & self.value(self.circuit.loose)

    def given(self, values: Values) -> int:
        """Compute all that the tick with these inputs leads to; the runs in which they are admissible."""
        admissible = self.allowed(values)
        self._run(self._others)
        return admissible & ~self.value(self.circuit.leaves)

    def advance(self) -> None:
        """Go on to the states after the tick that was given."""
        following = [(latch.literal >> 1, self.value(latch.next)) for latch in self.circuit.latches]
        for node, word in following:
            self._word[node] = word


def word_of(bit: Bit, values: Sequence[int]) -> int:
    """The word of one bit of an input."""
    return int("".join("1" if v >> bit.number & 1 else "0" for v in reversed(values)), 2)
