"""Names of states and events in the texts of a chart."""

from collections.abc import Iterator, Sequence

from rovercheck.checker.drawn.faults import DrawnFault
from rovercheck.checker.drawn.grammar.syntax import Expression, Member, Name
from rovercheck.checker.drawn.parsed import StateNode


def state_of(expression: Expression, node: StateNode) -> StateNode:
    """The state that a path means in a state: from the nearest one around it in which it is found.

    Otherwise the only one in the chart whose path ends so.  Raises ``DrawnFault``.
    """
    names = names_in(expression)
    *_, root = node.lineage()
    for around in node.lineage():
        found = _below(around, names)
        if found is not None:
            return found
    every = [one for one in root.every() if _ends(one, names)]
    if len(every) != 1:
        raise DrawnFault(f"{'.'.join(names)} is {'no state' if not every else 'several states'}")
    return every[0]


def names_in(expression: Expression) -> list[str]:
    """The names of a path, as `Cars.Red`.  Raises ``DrawnFault``."""
    match expression:
        case Name(name):
            return [name]
        case Member(owner, name):
            return [*names_in(owner), name]
    raise DrawnFault("it is no name of a state or an event")


def _below(node: StateNode, names: Sequence[str]) -> StateNode | None:
    found: StateNode | None = node
    for number, name in enumerate(names):
        if number == 0 and found is not None and found.name == name and found.parent is not None:
            continue
        found = None if found is None else next((one for one in found.children if one.name == name), None)
    return found if found is not node or names == [node.name] else None


def _ends(node: StateNode, names: Sequence[str]) -> bool:
    own: Iterator[str] = (one.name for one in node.lineage())
    return all(name == next(own, None) for name in reversed(names))


__all__ = ["names_in", "state_of"]
