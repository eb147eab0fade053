"""Names in the texts of a chart that stand for others: with a box in front, or of an atomic subchart."""

from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, fields, is_dataclass, replace
from typing import Any, TypeVar

from rovercheck.checker.drawn.grammar.actions import ForLoop
from rovercheck.checker.drawn.grammar.errors import GrammarError
from rovercheck.checker.drawn.grammar.expressions import parse_expression
from rovercheck.checker.drawn.grammar.syntax import ActionLanguage, Expression, Member, Name
from rovercheck.checker.drawn.records import DrawnChart, DrawnContent, DrawnState

Tree = TypeVar("Tree")


class BoxNames:
    """The boxes of one chart."""

    def __init__(self, chart: DrawnChart) -> None:
        every = list(chart.content.every_state())
        self._names = Counter(name for level in chart.content.every_level() for name in _names(level))
        own = {one.name for one in every if one.kind == "box"}
        self._boxes = {name for name in own if not self._names[name]}

    def plain(self, tree: Tree, text: str) -> Tree:
        """The tree of a text with ``Box.f(x)`` as ``f(x)``, and ``in(A.Box.S)`` as ``in(A.S)``.

        Raises ``GrammarError`` where the name alone may mean something else.
        """

        def change(one: Expression) -> Expression | None:
            path = _path(one) if isinstance(one, Member) else []
            return self._without(one, path, text) if isinstance(one, Member) and path else None

        return _changed(tree, change) if self._boxes else tree

    def _without(self, one: Member, path: list[str], text: str) -> Expression:
        left = [name for name in path[:-1] if name not in self._boxes] + path[-1:]
        if len(left) == len(path):
            return one
        if self._names[left[0]] > 1:
            raise GrammarError(
                f"{'.'.join(path)} is in a box, and there are {self._names[left[0]]} of the name {left[0]} "
                "in the chart: give each its own",
                text, one.at,
            )  # fmt: skip
        found: Expression = Name(left[0], one.at)
        for name in left[1:]:
            found = Member(found, name, one.arrow, one.at)
        return found


@dataclass(frozen=True)
class Aliases:
    """Names that stand for others, which are names, elements of data, or values."""

    names: Mapping[str, str]

    def plain(self, tree: Tree, text: str) -> Tree:
        """The tree of a text with what the names stand for.  Raises ``GrammarError``."""

        def change(one: Any) -> Expression | None:
            match one:
                case Name(name) if name in self.names:
                    return parse_expression(self.names[name], ActionLanguage.MATLAB)
                case ForLoop(variable) if variable in self.names:
                    said = f"{variable} counts the turns of a loop, and stands for {self.names[variable]}"
                    raise GrammarError(f"{said}: count with another name", text, 0)
            return None

        return _changed(tree, change) if self.names else tree


def _changed(thing: Any, change: Callable[[Any], Any]) -> Any:
    """A tree with other expressions in the place of those that ``change`` gives any for."""
    if (made := change(thing)) is not None:
        return made
    if isinstance(thing, tuple | list):
        return type(thing)(_changed(one, change) for one in thing)
    if is_dataclass(thing) and not isinstance(thing, type):
        new = {one.name: _changed(getattr(thing, one.name), change) for one in fields(thing)}
        changed = {name: value for name, value in new.items() if value is not getattr(thing, name)}
        return replace(thing, **changed) if changed else thing
    return thing


def _names(level: DrawnContent) -> Iterator[str]:
    """The names that a level gives to states, functions, data and events."""
    yield from (_name(one) for one in level.states if one.kind not in ("box", "note"))
    yield from (one.name for one in level.data)
    yield from (one.name for one in level.events)


def _name(state: DrawnState) -> str:
    """The name of a state; of a function the label is its whole signature."""
    if state.kind != "function":
        return state.name
    return state.name.partition("(")[0].rpartition("=")[2].strip()


def _path(one: Expression) -> list[str]:
    """The names of a path of names; empty for anything else, as an element of what a function gives."""
    if isinstance(one, Name):
        return [one.name]
    if isinstance(one, Member):
        inner = _path(one.owner)
        return [*inner, one.name] if inner else []
    return []


__all__ = ["Aliases", "BoxNames", "Tree"]
