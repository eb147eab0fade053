"""What a circuit reads of its inputs: of a distance often only whether it is above this or that bound.

The largest functions of inputs alone form a cut of the graph.  Where they are much fewer than the
bits that they depend on, they can stand for them: fewer variables, and simpler functions of them.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from rovercheck.checker.encode.bits.aig import Literal
from rovercheck.checker.encode.bits.model import Bit, Circuit
from rovercheck.spec_model.lang.expr import flag


@dataclass(frozen=True)
class InputCut:
    """Bits that stand for the inputs of a circuit.

    ``kept`` are inputs as they are.  Each of the ``parts`` are functions, by literals of inner nodes, of
    inputs that occur in no other part; ``hidden`` are all inputs that they depend on.
    """

    kept: tuple[Bit, ...]
    parts: tuple[tuple[Bit, ...], ...]
    hidden: tuple[Bit, ...]

    @property
    def bits(self) -> tuple[Bit, ...]:
        """All bits that stand for the inputs."""
        return (*self.kept, *(bit for part in self.parts for bit in part))


def input_cut(circuit: Circuit) -> InputCut:
    """The cut, where it has at most half as many bits as the inputs: what its bits can be together must be
    worked out, which does not pay for less."""
    reads = _reads(circuit)
    parts = [(mask, nodes) for mask, nodes in _parts(reads) if 2 * len(nodes) <= mask.bit_count()]
    covered = sum(mask for mask, _ in parts)  # no two have a bit in common
    numbered = list(enumerate(circuit.inputs))
    return InputCut(
        tuple(bit for i, bit in numbered if not covered >> i & 1),
        tuple(tuple(Bit(flag(f"@{node}", hidden=True), 0, 2 * node) for node in nodes) for _, nodes in parts),
        tuple(bit for i, bit in numbered if covered >> i & 1),
    )


def _reads(circuit: Circuit) -> dict[int, int]:
    """The nodes of the cut, each with the inputs that it depends on as a mask."""
    fanins = circuit.aig.fanins
    masks = {bit.literal >> 1: 1 << i for i, bit in enumerate(circuit.inputs)}
    latched = {latch.literal >> 1 for latch in circuit.latches}
    found: dict[int, int] = {}
    roots = list(_roots(circuit))
    for node in circuit.aig.cone(roots):
        below = [x >> 1 for x in fanins[node] if x > 1]
        if node in latched or node in masks:
            continue
        if all(x in masks for x in below):
            masks[node] = masks[below[0]] | masks[below[1]]
        else:
            found |= {x: masks[x] for x in below if x in masks}
    return found | {root >> 1: masks[root >> 1] for root in roots if root >> 1 in masks}


def _roots(circuit: Circuit) -> Iterator[Literal]:
    yield from (circuit.assume, circuit.leaves)
    yield from circuit.goals.values()
    yield from (latch.next for latch in circuit.latches)


def _parts(reads: dict[int, int]) -> Sequence[tuple[int, list[int]]]:
    """The nodes grouped so that different groups depend on different inputs."""
    groups: list[tuple[int, list[int]]] = []
    for node, mask in sorted(reads.items()):
        touched = [g for g in groups if g[0] & mask]
        groups = [g for g in groups if not g[0] & mask]
        nodes = sorted([node, *(n for _, own in touched for n in own)])
        for own, _ in touched:
            mask |= own
        groups.append((mask, nodes))
    return groups
