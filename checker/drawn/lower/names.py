"""What names mean in the texts of a chart: data, functions and states, from the inside to the outside."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from rovercheck.checker.drawn.grammar.functions import ScriptFunction
from rovercheck.checker.drawn.grammar.syntax import Expression, Member, Name
from rovercheck.checker.drawn.lower.conversions import IntegerRules
from rovercheck.checker.drawn.lower.symbols import NotLowered
from rovercheck.checker.drawn.parsed import FunctionNode, StateNode
from rovercheck.checker.drawn.records import DrawnData
from rovercheck.checker.drawn.stores import DATA_STORE, NO_GLOBAL
from rovercheck.spec_model.lang.expr import Expr, Var


@dataclass
class TextScope:
    """Where a text stands: its state, and the function if it is in one.

    ``left`` is raised once what the text still does is dropped, as its state was left: it goes on while
    ``alive`` gives a condition that holds.  ``returned``, ``broken`` and ``continued`` are raised once a
    function, a loop or a turn of it ends.  ``results`` are the names of what a function gives, ``last`` is
    the meaning of ``end``.
    """

    node: StateNode
    rules: IntegerRules
    event: str = ""
    function: str = ""
    script: dict[str, ScriptFunction] = field(default_factory=dict)
    kept: set[str] = field(default_factory=set)
    results: tuple[str, ...] = ()
    keeper: str = ""
    calls: tuple[str, ...] = ()
    left: Var | None = None
    alive: Callable[[], Expr] | None = None
    returned: Var | None = None
    broken: Var | None = None
    continued: Var | None = None
    last: int = 0


def datum_in(node: StateNode, name: str) -> DrawnData | None:
    """The datum of the nearest state around that has one of this name."""
    for one in node.lineage():
        if name in one.data:
            return one.data[name]
    return None


def refuse_other_globals(names: Sequence[str], node: StateNode) -> None:
    """Raises ``NotLowered`` for a global variable that is no data store."""
    for name in names:
        one = datum_in(node, name)
        if one is None or one.scope != DATA_STORE:
            raise NotLowered(f"`global` {name}: {NO_GLOBAL}")


def function_in(node: StateNode, name: str) -> FunctionNode | None:
    """The function of the nearest state around that has one of this name."""
    for one in node.lineage():
        if name in one.functions:
            return one.functions[name]
    return None


def words(expression: Expression) -> list[str]:
    """The names of a path, ``A.B``.  Raises ``NotLowered``."""
    match expression:
        case Name(name):
            return [name]
        case Member(owner, name):
            return [*words(owner), name]
    raise NotLowered("it is no name of a state or an event")


def state_in(node: StateNode, path: Sequence[str]) -> StateNode:
    """The state that a path means in a state: the nearest, looking outward; else the only one so named."""
    around = list(node.lineage())
    for one in around:
        start = [one] if one.parent is not None and one.name == path[0] else []
        start += [child for child in one.children if child.name == path[0]]
        for first in start:
            found = _down(first, path[1:])
            if found is not None:
                return found
    every = [one for one in around[-1].every() if _names_end(one, path)]
    if len(every) != 1:
        raise NotLowered(f"{'.'.join(path)} is {'several states' if every else 'no state'} of the chart")
    return every[0]


def _down(node: StateNode, path: Sequence[str]) -> StateNode | None:
    for name in path:
        below = [child for child in node.children if child.name == name]
        if not below:
            return None
        node = below[0]
    return node


def _names_end(node: StateNode, path: Sequence[str]) -> bool:
    names = [one.name for one in node.lineage()]
    return names[: len(path)] == list(path)[::-1]


__all__ = ["TextScope", "datum_in", "function_in", "refuse_other_globals", "state_in", "words"]
