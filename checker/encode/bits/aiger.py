"""Circuits in the binary AIGER 1.9 format (Biere, Heljanko, Wieringa, 2011) for outside model checkers."""

from collections.abc import Sequence

from checker.encode.bits.aig import Aig, Literal
from checker.encode.bits.model import Bit, Circuit, Latch

LEAVES = "a variable leaves its domain"
"""The name of the bad state that stands for a model without meaning."""


def aiger(circuit: Circuit, goals: Sequence[str], *, hwmcc: bool = True) -> bytes:
    """A bad state for each goal, in order, and one more for variables that leave their domains, if some may.

    The assumption is an invariant constraint.  With ``hwmcc`` false it is a latch instead (older tools
    know outputs only): the bad states are outputs that need the assumption to have held so far.  Frozen
    variables get their values from inputs in the first step, so every latch starts at a constant.
    """
    made = _Started(circuit)
    bad = [made.moved(circuit.goals[g]) for g in goals]
    names = [*goals]
    if circuit.leaves:
        bad.append(made.moved(circuit.leaves))
        names.append(LEAVES)
    allowed = made.aig.all([made.moved(circuit.assume), made.begun])
    if not hwmcc:
        allowed = made.only_while(allowed)
        bad = [made.aig.both(allowed, b) for b in bad]
    return _Writer(made).text(bad, names, [allowed] if hwmcc else [])


class _Started:
    """The circuit in a new graph in which every latch starts at a constant."""

    def __init__(self, circuit: Circuit) -> None:
        self.aig, self._old = Aig(), circuit.aig
        self._map: dict[int, Literal] = {0: 0}
        self.inputs: list[tuple[Literal, str]] = []
        self.latches: list[tuple[Literal, int, Literal, str]] = []
        for bit in circuit.inputs:
            self._map[bit.literal >> 1] = self._input(_name(bit))
        held = [latch for latch in circuit.latches if latch.init is None]
        first = self.aig.input() if held else 0  # false in the first step only
        if held:
            self.latches.append((first, 0, 1, "not the first step"))
        places = {latch.literal: self._place(latch, first) for latch in circuit.latches}
        self.begun = self.aig.either(first, self.moved(circuit.start)) if held else 1
        for latch in circuit.latches:
            following = self.moved(latch.next)
            self.latches.append((places[latch.literal], latch.init or 0, following, _name(latch.bit)))

    def _input(self, name: str) -> Literal:
        literal = self.aig.input()
        self.inputs.append((literal, name))
        return literal

    def _place(self, latch: Latch, first: Literal) -> Literal:
        """The node of the latch itself; its value in the first step is an input where it is free."""
        place = self.aig.input()
        value = place
        if latch.init is None:
            value = self.aig.mux(first, place, self._input(f"{_name(latch.bit)} at the start"))
        self._map[latch.literal >> 1] = value
        return place

    def only_while(self, condition: Literal) -> Literal:
        """Whether a condition holds and has held in every step before."""
        broken = self.aig.input()
        now = self.aig.both(condition, broken ^ 1)
        self.latches.append((broken, 0, now ^ 1, "assumption broken"))
        return now

    def moved(self, literal: Literal) -> Literal:
        """A literal of the circuit in the new graph."""
        known = self._map
        for node in self._old.cone([literal]):
            if node not in known:
                a, b = self._old.fanins[node]
                known[node] = self.aig.both(known[a >> 1] ^ a & 1, known[b >> 1] ^ b & 1)
        return known[literal >> 1] ^ literal & 1


def _name(bit: Bit) -> str:
    return f"{bit.var.name}[{bit.number}]"


class _Writer:
    """Renumbers nodes as the format wants: inputs, latches, conjunctions; writes the sections."""

    def __init__(self, made: _Started) -> None:
        self._made = made
        leaves = [*(i for i, _ in made.inputs), *(place for place, *_ in made.latches)]
        self._number = {0: 0} | {literal >> 1: n for n, literal in enumerate(leaves, 1)}

    def text(self, bad: Sequence[Literal], names: Sequence[str], constraints: Sequence[Literal]) -> bytes:
        made, number = self._made, self._number
        roots = [*(following for _, _, following, _ in made.latches), *bad, *constraints]
        gates = [node for node in made.aig.cone(roots) if node not in number]
        for node in gates:
            number[node] = len(number)
        counts = f"{len(number) - 1} {len(made.inputs)} {len(made.latches)}"
        if constraints:
            head = f"aig {counts} 0 {len(gates)} {len(bad)} {len(constraints)}\n"
        else:
            head = f"aig {counts} {len(bad)} {len(gates)}\n"
        lines = [self._latch(following, init) for _, init, following, _ in made.latches]
        lines += [f"{self._of(literal)}\n" for literal in (*bad, *constraints)]
        kind = "b" if constraints else "o"
        symbols = [f"i{n} {name}\n" for n, (_, name) in enumerate(made.inputs)]
        symbols += [f"l{n} {name}\n" for n, (*_, name) in enumerate(made.latches)]
        symbols += [f"{kind}{n} {name}\n" for n, name in enumerate(names)]
        body = b"".join(self._gate(node) for node in gates)
        return (head + "".join(lines)).encode() + body + "".join(symbols).encode()

    def _of(self, literal: Literal) -> int:
        return 2 * self._number[literal >> 1] | literal & 1

    def _latch(self, following: Literal, init: int) -> str:
        return f"{self._of(following)} {init}\n" if init else f"{self._of(following)}\n"

    def _gate(self, node: int) -> bytes:
        a, b = sorted(map(self._of, self._made.aig.fanins[node]), reverse=True)
        return _delta(2 * self._number[node] - a) + _delta(a - b)


def _delta(number: int) -> bytes:
    """Seven bits a byte, the low ones first."""
    out = bytearray()
    while number >= 0x80:
        out.append(number & 0x7F | 0x80)
        number >>= 7
    out.append(number)
    return bytes(out)
