"""In which order blocks are executed that use a data store, as far as a diagram says it."""

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from rovercheck.checker.drawn.faults import DrawnFault
from rovercheck.checker.drawn.records import DrawnBlock, names_of

MEMORY, READ, WRITE = "DataStoreMemory", "DataStoreRead", "DataStoreWrite"


@dataclass(frozen=True)
class StoreUse:
    """That something uses the memory of that path, and whether it may write to it."""

    memory: str
    writes: bool


Uses = Mapping[str, Sequence[StoreUse]]
"""What blocks use, by their paths."""


def used_by(block: DrawnBlock, uses: Uses) -> list[StoreUse]:
    """The memories outside of a block that it and all that is in it use."""
    inside = [one for system in block.systems() for one in system.every_block()]
    every = [use for one in (block, *inside) for use in uses.get(one.path, ())]
    return [one for one in every if not one.memory.startswith(f"{block.path}/")]


def order_by_stores(
    before: dict[str, list[str]], groups: Mapping[str, Sequence[DrawnBlock]], uses: Uses
) -> None:
    """Add to what is executed ``before`` each block what its use of memories asks for.

    Signals decide between two of which one writes what the other uses, else their priorities.
    Raises ``DrawnFault`` where neither does: which of them Simulink then executes first is not drawn.
    """
    used = {name: [use for one in group for use in used_by(one, uses)] for name, group in groups.items()}
    names = [name for name in before if used[name]]
    above = {name: _reached(before, name) for name in names}
    for at, one in enumerate(names):
        for other in names[:at]:
            memory = _shared(used[one], used[other])
            if not memory or one in above[other] or other in above[one]:
                continue
            first, second = groups[one][-1], groups[other][-1]
            ranks = [_priority(block) for block in (first, second)]
            beside = names_of(first.path)[:-1] == names_of(second.path)[:-1]
            if None in ranks or ranks[0] == ranks[1] or not beside:
                raise DrawnFault(
                    f"{first.shown_path} and {second.shown_path} use the data store {memory}, and nothing "
                    "says which of them is executed first: connect them by a signal, or draw them beside "
                    "each other, each with a Priority"
                )
            early, late = sorted((one, other), key=lambda name: _priority(groups[name][-1]) or 0)
            before[late].append(early)


def _shared(some: Iterable[StoreUse], others: Iterable[StoreUse]) -> str:
    """A memory that both use, and one of them writes; empty if there is none."""
    for one in some:
        for other in others:
            if one.memory == other.memory and (one.writes or other.writes):
                return one.memory.rpartition("/")[2]
    return ""


def _reached(before: Mapping[str, Sequence[str]], name: str) -> set[str]:
    found, waiting = set[str](), [name]
    while waiting:
        for one in before[waiting.pop()]:
            if one not in found:
                found.add(one)
                waiting.append(one)
    return found


def _priority(block: DrawnBlock) -> int | None:
    said = block.parameters.get("Priority", "").strip()
    return int(said) if re.fullmatch(r"-?\d{1,9}", said) else None


__all__ = ["MEMORY", "READ", "WRITE", "StoreUse", "Uses", "order_by_stores", "used_by"]
