"""The transition relation in parts, and the image of a set under it.

The relation is the conjunction of one equation per latch.  Neighbours are multiplied into clusters, and
a variable is quantified as soon as no further cluster speaks of it (Burch, Clarke, Long, *Symbolic model
checking with partitioned transition relations*, VLSI 1991; Ranjan et al., *Efficient BDD algorithms for
FSM synthesis and verification*, IWLS 1995).
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from rovercheck.checker.engines.bdd.space import Function, Space, product, support

CLUSTER = 5000
"""Nodes up to which neighbours are multiplied."""


@dataclass(frozen=True)
class Cluster:
    """Some equations, and the variables that no later cluster speaks of, as a conjunction."""

    relation: Function
    away: Function


@dataclass(frozen=True)
class Relation:
    """Clusters in the order in which they are to be multiplied.

    ``first`` are the variables that no cluster speaks of: latches, and inputs chosen, that nothing reads.
    """

    space: Space
    first: Function
    clusters: tuple[Cluster, ...]

    def image(self, states: Function) -> Function:
        """The states after one tick from these."""
        result = states.exists(self.first)
        for cluster in self.clusters:
            self.space.pause()
            result = product(result, cluster.relation, cluster.away)
        return self.space.renamed(result)

    @property
    def nodes(self) -> int:
        return sum(cluster.relation.node_count() for cluster in self.clusters)


def relation(space: Space, assume: Function, choosing: bool = False) -> Relation:
    """The transition relation of the circuit, ``assume`` being what every tick fulfils.

    ``choosing``: the sets whose images are asked for also choose inputs, so that none is taken out before.
    """
    clusters = list(_clusters([*_assumed(assume), *equations(space)]))
    supports = [support(c) for c in clusters]
    changing = {space.current[literal] for literal in space.next}
    quantified = changing.union(space.inputs)
    own = _last(supports, quantified)
    parts = [Cluster(c, space.all(away)) for c, away in zip(clusters, own, strict=True)]
    spoken = set().union(*own)
    if choosing:
        return Relation(space, space.all(quantified - spoken), tuple(parts))
    return Relation(space, space.all(changing - spoken), tuple(_local(space, parts, supports)))


def equations(space: Space) -> Iterator[Function]:
    """For every latch that may change: its next value is as its function says.  Upper latches first."""
    changing = [latch for latch in space.circuit.latches if latch.literal in space.next]
    for latch in sorted(changing, key=lambda x: space.next[x.literal]):
        yield space.manager.var(space.next[latch.literal]).equiv(space(latch.next))


def _assumed(assume: Function) -> list[Function]:
    return [] if assume.valid() else [assume]


def _clusters(parts: Sequence[Function]) -> Iterator[Function]:
    """Neighbours multiplied as long as the product is small."""
    open_: Function | None = None
    for part in parts:
        together = part if open_ is None else open_ & part
        if open_ is not None and together.node_count() > CLUSTER:
            yield open_
            together = part
        open_ = together
    if open_ is not None:
        yield open_


def _last(supports: Sequence[set[int]], quantified: set[int]) -> list[set[int]]:
    """For each cluster the variables to quantify that no later one speaks of."""
    last = {v: i for i, own in enumerate(supports) for v in own & quantified}
    found: list[set[int]] = [set() for _ in supports]
    for variable, i in last.items():
        found[i].add(variable)
    return found


def _local(space: Space, parts: Sequence[Cluster], supports: Sequence[set[int]]) -> Iterator[Cluster]:
    """The clusters without the inputs that they alone speak of."""
    inputs = set(space.inputs)
    for i, part in enumerate(parts):
        others = set().union(*(own for k, own in enumerate(supports) if k != i))
        local = (supports[i] & inputs) - others
        yield Cluster(part.relation.exists(space.all(local)), part.away)
