"""Names of boxes in the texts of a chart: what is in a box is of the level around it."""

from collections import Counter
from collections.abc import Iterator
from dataclasses import fields, is_dataclass, replace
from typing import Any, TypeVar

from rovercheck.checker.drawn.grammar.errors import GrammarError
from rovercheck.checker.drawn.grammar.syntax import Expression, Member, Name
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
        return self._changed(tree, text) if self._boxes else tree

    def _changed(self, thing: Any, text: str) -> Any:
        if isinstance(thing, Member) and (path := _path(thing)):
            return self._without(thing, path, text)
        if isinstance(thing, tuple | list):
            return type(thing)(self._changed(one, text) for one in thing)
        if is_dataclass(thing) and not isinstance(thing, type):
            new = {one.name: self._changed(getattr(thing, one.name), text) for one in fields(thing)}
            changed = {name: value for name, value in new.items() if value is not getattr(thing, name)}
            return replace(thing, **changed) if changed else thing
        return thing

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


__all__ = ["BoxNames"]
