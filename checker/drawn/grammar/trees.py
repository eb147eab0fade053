"""All expressions of labels, sections and statements, wherever they stand."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import fields, is_dataclass
from typing import Any, get_args

from rovercheck.checker.drawn.grammar.actions import Assignment, ForLoop, Increment
from rovercheck.checker.drawn.grammar.syntax import Applied, Expression, Indexed, Member, Name

__all__ = ["assigned_names", "expressions_of"]

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


def assigned_names(*things: Any) -> Iterator[str]:
    """The names that labels, statements, and collections of them may give a value, wholly or in part."""
    for thing in things:
        match thing:
            case Assignment(targets):
                yield from (_changed(one) for one in targets if one is not None)
            case Increment(target):
                yield _changed(target)
            case ForLoop(variable, _, body):
                yield variable
                yield from assigned_names(body)
            case Mapping():
                yield from assigned_names(*thing.values())
            case Sequence() if not isinstance(thing, str):
                yield from assigned_names(*thing)
            case _ if is_dataclass(thing) and not isinstance(thing, (type, *_EXPRESSIONS)):
                yield from assigned_names(*(getattr(thing, one.name) for one in fields(thing)))


def _changed(target: Expression) -> str:
    """The name of the datum that an assignment changes."""
    while not isinstance(target, Name):
        match target:
            case Member(inner) | Applied(inner) | Indexed(inner):
                target = inner
            case _:
                return ""
    return target.name
