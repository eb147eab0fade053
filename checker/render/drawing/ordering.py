"""Second step of a layered layout: the order inside each rank, with few crossings."""

import itertools
from bisect import bisect_right, insort
from collections.abc import Mapping, Sequence

from checker.render.drawing.graph import Chain, Item

SWEEPS = 24

Layers = list[list[Item]]
Links = dict[Item, list[tuple[Item, float, float]]]
"""For an item its neighbours in the next rank: the neighbour, and where each end meets its item (0..1)."""


def untangled(layers: Layers, chains: Mapping[str, Chain]) -> Layers:
    """The layers in the best order found: barycentre sweeps in both directions, then exchanges."""
    right, left = links(chains)
    best, fewest = [list(layer) for layer in layers], crossings(layers, right)
    current = best
    for sweep in range(SWEEPS):
        if fewest == 0:
            break
        current = [list(layer) for layer in (best if sweep % 8 == 0 else current)]
        _sweep(current, right if sweep % 2 else left, backwards=bool(sweep % 2))
        _exchange(current, right, left)
        count = crossings(current, right)
        if count < fewest:
            best, fewest = [list(layer) for layer in current], count
    return best


def links(chains: Mapping[str, Chain]) -> tuple[Links, Links]:
    """The neighbours of each item in the next rank, and in the rank before."""
    right: Links = {}
    left: Links = {}
    for name, chain in chains.items():
        for a, b in itertools.pairwise(chain):
            pa, pb = _meets(a, name), _meets(b, name)
            right.setdefault(a, []).append((b, pa, pb))
            left.setdefault(b, []).append((a, pb, pa))
    return right, left


def _meets(item: Item, edge: str) -> float:
    if item.node is None or edge not in item.node.ports:
        return 0.5
    return min(0.95, max(0.05, item.node.ports[edge] / max(1, item.node.height)))


def _index(layer: Sequence[Item]) -> dict[Item, int]:
    return {item: i for i, item in enumerate(layer)}


def crossings(layers: Layers, right: Links) -> int:
    """The number of pairs of lines that cross between neighbouring ranks."""
    total = 0
    for layer, following in itertools.pairwise(layers):
        place = _index(following)
        lines = sorted((i + pa, place[b] + pb) for i, a in enumerate(layer) for b, pa, pb in right.get(a, ()))
        seen: list[float] = []
        for _, end in lines:
            total += len(seen) - bisect_right(seen, end)
            insort(seen, end)
    return total


def _sweep(layers: Layers, towards: Links, backwards: bool) -> None:
    numbers = range(len(layers) - 2, -1, -1) if backwards else range(1, len(layers))
    for number in numbers:
        fixed = _index(layers[number + (1 if backwards else -1)])
        key: dict[Item, float] = {}
        for i, item in enumerate(layers[number]):
            ends = [fixed[b] + pb - pa + 0.5 for b, pa, pb in towards.get(item, ())]
            key[item] = sum(ends) / len(ends) if ends else float(i)
        layers[number].sort(key=key.__getitem__)


def _exchange(layers: Layers, right: Links, left: Links) -> None:
    """Swap neighbours in a rank as long as that removes crossings."""
    index: dict[Item, int] = {}
    for layer in layers:
        index |= _index(layer)
    for _ in range(4):
        swapped = False
        for layer in layers:
            for i in range(len(layer) - 1):
                a, b = layer[i], layer[i + 1]
                gain = _between(a, b, right, left, index) - _between(b, a, right, left, index)
                if gain > 0:
                    layer[i], layer[i + 1] = b, a
                    index[a], index[b] = i + 1, i
                    swapped = True
        if not swapped:
            return


def _between(upper: Item, lower: Item, right: Links, left: Links, index: Mapping[Item, int]) -> int:
    """Crossings among the lines of two items when ``upper`` lies above ``lower``."""
    total = 0
    for side in (right, left):
        ends = sorted(index[b] + pb for b, _, pb in side.get(lower, ()))
        for b, _, pb in side.get(upper, ()):
            total += bisect_right(ends, index[b] + pb - 1e-9)
    return total
