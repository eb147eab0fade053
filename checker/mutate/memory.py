"""Data of a part in other places of memory: shared, or read and written as others."""

import re
from collections.abc import Iterable, Iterator, Mapping
from functools import partial
from itertools import combinations

from rovercheck.checker.mutate.rewrites import Rewrite, renamed
from rovercheck.spec_model.lang.action import Action, Assign, If
from rovercheck.spec_model.lang.chart import Block, Chart
from rovercheck.spec_model.lang.edit import in_actions
from rovercheck.spec_model.lang.expr import Var

FEWEST_CELLS = 3
"""Data named alike but for a number that are taken for an array."""


def shared_memory(part: Chart | Block) -> Iterator[Rewrite]:
    """Two data of a part in one place of memory; of arrays only as wholes, with how many cells are in use."""
    cells = _cells(part.written)
    data = [v for n, v in part.written.items() if n not in cells]
    for one, two in combinations(data, 2):
        if one.domain == two.domain:
            changed = partial(with_memory, part, {two.name: one})
            yield Rewrite("shared", "memory", two.name, one.name, changed)
    for first, second in _families(part):
        pairs = dict(_pairs(part, first, second))
        yield Rewrite("shared", "buffers", second, first, partial(with_memory, part, pairs))
    for first, second in combinations(dict.fromkeys(head for head, _ in _arrays(part.written)), 2):
        own, other = _named_like(part, first), _named_like(part, second)
        if [(n.removeprefix(first), v.domain) for n, v in own.items()] == [
            (n.removeprefix(second), v.domain) for n, v in other.items()
        ]:
            instead = dict(zip(other, own.values(), strict=True))
            yield Rewrite("shared", "arrays", second, first, partial(with_memory, part, instead))


def _named_like(part: Chart | Block, head: str) -> dict[str, Var]:
    """The cells of an array, and what is named like them: how many are in use."""
    return {name: var for name, var in sorted(part.written.items()) if name.startswith(head)}


def _cells(names: Iterable[str]) -> frozenset[str]:
    return frozenset(name for some in _arrays(names).values() for name in some)


def _arrays(names: Iterable[str]) -> dict[tuple[str, str], list[str]]:
    """Names that differ in one number, as those of the cells of an array do, by what is around it."""
    found: dict[tuple[str, str], list[str]] = {}
    for name in names:
        if cell := re.fullmatch(r"(.*?)\d+(\D*)", name):
            found.setdefault((cell[1], cell[2]), []).append(name)
    return {key: some for key, some in found.items() if len(some) >= FEWEST_CELLS}


def _families(part: Chart | Block) -> Iterator[tuple[str, str]]:
    """Beginnings of names after which several data are named alike: buffers of two links."""
    names = list(part.written)
    heads = list(dict.fromkeys(n.rsplit("_", k)[0] + "_" for n in names for k in (1, 2) if n.count("_") >= k))
    for number, one in enumerate(heads):
        for two in heads[number + 1 :]:
            if sum(1 for _ in _pairs(part, one, two)) > 1:
                yield one, two


def _pairs(part: Chart | Block, one: str, two: str) -> Iterator[tuple[str, Var]]:
    for name, var in part.written.items():
        twin = part.written.get(one + name.removeprefix(two)) if name.startswith(two) else None
        if twin is not None and twin.name != name and twin.domain == var.domain:
            yield name, twin


def with_memory(part: Chart | Block, instead_of: Mapping[str, Var]) -> Chart | Block:
    """The part with other data read and written in place of some."""

    def act(action: Action) -> Action:
        match action:
            case Assign(var, value):
                return Assign(instead_of.get(var.name, var), value)
            case If(condition, then, otherwise):
                return If(condition, tuple(map(act, then)), tuple(map(act, otherwise)))
        return action

    read = renamed(part, instead_of)
    if isinstance(read, Block):
        return Block(read.name, tuple(map(act, read.do)), text=read.text, place=read.place)
    return in_actions(read, act)


__all__ = ["shared_memory", "with_memory"]
