"""Orders of the variables of a circuit in which sets of its states have small decision diagrams.

Variables that depend on each other should be near each other, and an input near what reads it.  No order
is best for every circuit, so there are several to try.  The bits of a variable stay together.
"""

from collections.abc import Iterable, Iterator, Sequence
from statistics import fmean

from rovercheck.checker.encode.bits.aig import Literal
from rovercheck.checker.encode.bits.model import Bit, Circuit

ROUNDS = 200
"""Rounds after which an order that still changes is taken as it is."""


def orders(circuit: Circuit) -> Iterator[tuple[str, ...]]:
    """Distinct orders of all latched variables and inputs, by name; the first to be tried first."""
    reads = _reads(circuit)
    declared = _with_inputs(circuit, reads)
    yield from dict.fromkeys((forced(declared, _edges(circuit, reads)), declared, _explored(circuit)))


def forced(start: Sequence[str], edges: Sequence[frozenset[str]]) -> tuple[str, ...]:
    """The order with the smallest sum of the spans of the edges that forces lead to.

    Aloul, Markov, Sakallah, *FORCE: a fast and easy-to-implement variable-ordering heuristic*, GLSVLSI 2003.
    """
    best = order = tuple(start)
    least = _span(order, edges)
    for _ in range(ROUNDS):
        moved = _pulled(order, edges)
        if moved == order:
            break
        order = moved
        if (span := _span(order, edges)) < least:
            best, least = order, span
    return best


def _pulled(order: Sequence[str], edges: Sequence[frozenset[str]]) -> tuple[str, ...]:
    """Every variable moved to the mean of the centres of its edges."""
    place = {name: i for i, name in enumerate(order)}
    pulls: dict[str, list[float]] = {name: [] for name in order}
    for edge in edges:
        centre = fmean(sorted(place[name] for name in edge))
        for name in edge:
            pulls[name].append(centre)
    goal = {name: fmean(pulls[name]) if pulls[name] else float(place[name]) for name in order}
    return tuple(sorted(order, key=lambda name: (goal[name], place[name])))


def _span(order: Sequence[str], edges: Sequence[frozenset[str]]) -> int:
    place = {name: i for i, name in enumerate(order)}
    return sum(max(place[n] for n in edge) - min(place[n] for n in edge) for edge in edges)


# --- what depends on what ----------------------------------------------------------------------------


def _bits(circuit: Circuit) -> list[Bit]:
    return [*(latch.bit for latch in circuit.latches), *circuit.inputs]


def _names(circuit: Circuit) -> list[str]:
    return list(dict.fromkeys(bit.var.name for bit in _bits(circuit)))


def _reads(circuit: Circuit) -> dict[Literal, list[str]]:
    """For what the circuit computes, the variables that it depends on, in the order of their declaration."""
    names = _names(circuit)
    number = {name: i for i, name in enumerate(names)}
    masks = [0] * len(circuit.aig)
    for bit in _bits(circuit):
        masks[bit.literal >> 1] = 1 << number[bit.var.name]
    for node, (a, b) in enumerate(circuit.aig.fanins):
        masks[node] = masks[node] or masks[a >> 1] | masks[b >> 1]
    roots = [*(latch.next for latch in circuit.latches), *circuit.goals.values(), circuit.assume]
    return {root: [n for i, n in enumerate(names) if masks[root >> 1] >> i & 1] for root in roots}


def _edges(circuit: Circuit, reads: dict[Literal, list[str]]) -> list[frozenset[str]]:
    """Groups of variables that should be near each other: a latch and what it reads, what a goal reads."""
    found = [frozenset([*reads[latch.next], latch.bit.var.name]) for latch in circuit.latches]
    return found + [frozenset(reads[goal]) for goal in circuit.goals.values() if reads[goal]]


def _with_inputs(circuit: Circuit, reads: dict[Literal, list[str]]) -> tuple[str, ...]:
    """As declared, which is the order of the charts; an input stands before the first variable reading it."""
    inputs = {bit.var.name for bit in circuit.inputs}
    found: dict[str, None] = {}
    for latch in circuit.latches:
        if latch.bit.var.name not in found:
            following = [x for x in circuit.latches if x.bit.var is latch.bit.var]
            found |= dict.fromkeys(n for x in following for n in reads[x.next] if n in inputs)
            found[latch.bit.var.name] = None
    return tuple(found | dict.fromkeys(_names(circuit)))


def _explored(circuit: Circuit) -> tuple[str, ...]:
    """As a depth-first exploration of the circuit from the goals comes upon them."""
    owner = {bit.literal >> 1: bit.var.name for bit in _bits(circuit)}
    following: dict[str, list[Literal]] = {}
    for latch in circuit.latches:
        following.setdefault(latch.bit.var.name, []).append(latch.next)
    found: dict[str, None] = {}
    seen: set[int] = set()
    todo = _nodes([*circuit.goals.values(), circuit.leaves, circuit.assume])
    while todo:
        node = todo.pop()
        if node not in seen:
            seen.add(node)
            todo += _nodes(circuit.aig.fanins[node])
            if node in owner and owner[node] not in found:
                found[owner[node]] = None
                todo += _nodes(following.get(owner[node], ()))
    return tuple(found | dict.fromkeys(_names(circuit)))


def _nodes(literals: Iterable[Literal]) -> list[int]:
    """Their nodes, to be taken from the end."""
    return [literal >> 1 for literal in literals][::-1]
