"""All expressions of labels, sections and statements, wherever they stand."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import fields, is_dataclass
from typing import Any, get_args

from rovercheck.checker.drawn.grammar.syntax import Expression

__all__ = ["expressions_of"]

_EXPRESSIONS = get_args(Expression)


def expressions_of(*things: Any) -> Iterator[Expression]:
    """The outermost expressions in labels, statements, and collections of them, in their order."""
    for thing in things:
        if isinstance(thing, _EXPRESSIONS):
            yield thing
        elif isinstance(thing, Mapping):
            yield from expressions_of(*thing.values())
        elif isinstance(thing, Sequence) and not isinstance(thing, str):
            yield from expressions_of(*thing)
        elif is_dataclass(thing) and not isinstance(thing, type):
            yield from expressions_of(*(getattr(thing, one.name) for one in fields(thing)))
