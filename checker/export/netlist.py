"""Circuits as the AIGER formats want them: every latch starts at a constant, nodes are numbered in order."""

from collections.abc import Mapping
from dataclasses import dataclass

from rovercheck.checker.encode.bits import Aig, Bit, Circuit, Latch, Literal
from rovercheck.checker.encode.bits.model import cut
from rovercheck.checker.export.machine import demanded
from rovercheck.checker.export.names import one_line
from rovercheck.checker.export.problem import Problem

Gate = tuple[int, int, int]
"""A conjunction: its literal and those of what it conjoins, the larger one first."""


@dataclass(frozen=True)
class Register:
    """A latch: its value in the first step, the literal of its next value, and its name."""

    init: int
    next: Literal
    name: str


@dataclass(frozen=True)
class Netlist:
    """A circuit with literals numbered as AIGER numbers them: inputs, then latches, then gates.

    ``bad`` holds a literal and a name for each bad state; ``constraint`` is true in every step of a run.
    """

    inputs: tuple[str, ...]
    latches: tuple[Register, ...]
    gates: tuple[Gate, ...]
    bad: tuple[tuple[Literal, str], ...]
    constraint: Literal

    @property
    def counts(self) -> str:
        """The numbers in the first line of AIGER 1.9, from the largest variable to the constraint."""
        inputs, latches, gates = len(self.inputs), len(self.latches), len(self.gates)
        return f"{inputs + latches + gates} {inputs} {latches} 0 {gates} {len(self.bad)} 1"

    @property
    def roots(self) -> str:
        """The sections between latches and gates: bad states and the constraint, a line each."""
        return "".join(f"{literal}\n" for literal in (*(b for b, _ in self.bad), self.constraint))

    @property
    def symbols(self) -> str:
        """The table of names."""
        named = [f"i{n} {name}" for n, name in enumerate(self.inputs)]
        named += [f"l{n} {latch.name}" for n, latch in enumerate(self.latches)]
        named += [f"b{n} {name}" for n, (_, name) in enumerate(self.bad)]
        return "".join(f"{one_line(line)}\n" for line in [*named, "c0 assumption"])


def netlist(problem: Problem) -> Netlist:
    """The netlist of a problem, cut to the cone of influence of its bad states.

    Step ``t``, the first being 0, is tick ``t + 1``.  The inputs of a step are admissible where the
    constraint is true.  Frozen variables get their values from inputs in the first step.
    """
    whole, names = demanded(problem)
    made = cut(whole, names)
    started = _Started(made)
    bad = [(started.moved(made.goals[name]), name) for name in names]
    allowed = [started.moved(made.assume), started.moved(made.loose), started.begun]
    return started.numbered(bad, started.aig.all(allowed))


class _Started:
    """The circuit in a new graph in which every latch starts at a constant.

    A latch that starts anywhere gets its first value from an input: older tools do not know uninitialised
    latches.
    """

    def __init__(self, circuit: Circuit) -> None:
        self.aig, self._old = Aig(), circuit.aig
        self._map: dict[int, Literal] = {0: 0}
        self._inputs: list[tuple[Literal, str]] = []
        self._latches: list[tuple[Literal, Register]] = []
        for bit in (*circuit.inputs, *circuit.others):
            self._map[bit.literal >> 1] = self._input(_name(bit))
        held = [latch for latch in circuit.latches if latch.init is None]
        past = self.aig.input() if held else 0  # false in the first step only
        if held:
            self._latches.append((past, Register(0, 1, "not the first step")))
        places = [self._place(latch, past) for latch in circuit.latches]
        self.begun = self.aig.either(past, self.moved(circuit.start)) if held else 1
        for place, latch in zip(places, circuit.latches, strict=True):
            register = Register(latch.init or 0, self.moved(latch.next), _name(latch.bit))
            self._latches.append((place, register))

    def _input(self, name: str) -> Literal:
        literal = self.aig.input()
        self._inputs.append((literal, name))
        return literal

    def _place(self, latch: Latch, past: Literal) -> Literal:
        """The node of the latch itself; its value in the first step is an input where it is free."""
        place = self.aig.input()
        value = place
        if latch.init is None:
            value = self.aig.mux(past, place, self._input(f"{_name(latch.bit)} at the start"))
        self._map[latch.literal >> 1] = value
        return place

    def moved(self, literal: Literal) -> Literal:
        """A literal of the circuit in the new graph."""
        known = self._map
        for node in self._old.cone([literal]):
            if node not in known:
                a, b = self._old.fanins[node]
                known[node] = self.aig.both(known[a >> 1] ^ a & 1, known[b >> 1] ^ b & 1)
        return known[literal >> 1] ^ literal & 1

    def numbered(self, bad: list[tuple[Literal, str]], constraint: Literal) -> Netlist:
        """What was made, with the literals of the formats."""
        leaves = [*(i for i, _ in self._inputs), *(place for place, _ in self._latches)]
        number = {0: 0} | {literal >> 1: n for n, literal in enumerate(leaves, 1)}
        roots = [*(r.next for _, r in self._latches), *(b for b, _ in bad), constraint]
        gates = [node for node in self.aig.cone(roots) if node not in number]
        number |= {node: n for n, node in enumerate(gates, len(number))}
        latches = (Register(r.init, _literal(r.next, number), r.name) for _, r in self._latches)
        return Netlist(
            tuple(name for _, name in self._inputs),
            tuple(latches),
            tuple(_gate(node, self.aig, number) for node in gates),
            tuple((_literal(b, number), name) for b, name in bad),
            _literal(constraint, number),
        )


def _literal(literal: Literal, number: Mapping[int, int]) -> Literal:
    return 2 * number[literal >> 1] | literal & 1


def _gate(node: int, aig: Aig, number: Mapping[int, int]) -> Gate:
    low, high = sorted(_literal(fanin, number) for fanin in aig.fanins[node])
    return 2 * number[node], high, low


def _name(bit: Bit) -> str:
    return f"{bit.var.name}[{bit.number}]"
