"""A thing of the wrong kind in a user's model: a text where a formula belongs, a number where a time does.

Python takes anything for an argument.  What was given is compared with the annotations of the language before
some part of the checker stumbles over it, with no line of the model to show.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import fields, is_dataclass
from fractions import Fraction
from functools import cache
from types import UnionType
from typing import Any, Union, get_args, get_origin, get_type_hints

from rovercheck.properties.forms import Form, Property
from rovercheck.spec_model.lang.action import Action
from rovercheck.spec_model.lang.chart import Block, Chart, Component, Enabled, Junction, State, Transition
from rovercheck.spec_model.lang.domain import Domain
from rovercheck.spec_model.lang.errors import brief, with_article
from rovercheck.spec_model.lang.expr import Expr, Var
from rovercheck.spec_model.lang.place import Place
from rovercheck.spec_model.lang.system import Assumption, System
from rovercheck.spec_model.lang.time import Span

PLAIN: Mapping[type, Mapping[str, Any]] = {
    Chart: {"name": str, "text": str, "local_to": tuple[tuple[Var, tuple[str, ...]], ...], "root": State},
    Block: {"name": str, "text": str, "do": tuple[Action, ...]},
    Enabled: {"name": str, "by": Expr, "components": tuple[Component, ...]},
}
"""What belongs into the things of the language that are no data classes."""
DERIVED = ("place", "area", "about", "step_ms", "label")
"""What no user writes."""
ARGUMENTS = {"guard": "when", "event": "on", "arg": "the condition"}
"""How a user writes what is kept under another name."""
WORDS: Mapping[Any, str] = {
    str: "a text",
    bool: "True or False",
    int: "a whole number",
    Expr: "a formula, such as `level > 80`",
    Var: "a variable, made with var() or flag()",
    Span: "a length of time, such as `3 * sec` or `2 * ticks`",
    Action: "an action, assign(), when() or send()",
    Transition: "a transition, to(...)",
    State: "a state, State(...)",
    Junction: "a junction, Junction(...)",
    Component: "a chart, a block or an enabled subsystem",
    Assumption: "an assumption, Assumption(...)",
    Domain: "a domain, such as integer(0, 100)",
    Form: "a form of rovercheck, such as always(...)",
}


def kind_faults(thing: object, file: str) -> Iterator[str]:
    """What is of the wrong kind in a system, a chart or a property, a line each.

    Each names the line of the transition, state, chart or property that it is in, else the ``file``.
    """
    seen = set[int]()
    todo: list[tuple[object, Place | str, str]] = [(thing, file, "")]
    while todo:
        one, place, owner = todo.pop()
        if isinstance(one, tuple):
            todo += ((each, place, owner) for each in reversed(one))
        elif id(one) not in seen and (hints := _hints(one)):
            seen.add(id(one))
            place, owner = getattr(one, "place", None) or place, _named(one) or owner
            for name, hint in hints.items():
                value = getattr(one, name)
                if fits(value, hint):
                    todo.append((value, place, owner))
                else:
                    yield f"{place}: {owner}: {_described(one, name, value, hint)}"


def _hints(thing: object) -> Mapping[str, Any]:
    """What kind each part of a thing of the language must be of; nothing for other things."""
    kind: Any = type(thing)
    return _hints_of(kind)


@cache
def _hints_of(kind: Any) -> Mapping[str, Any]:
    if kind in PLAIN:
        return PLAIN[kind]
    if issubclass(kind, Place) or not is_dataclass(kind):
        return {}
    hints = get_type_hints(kind)
    return {f.name: hints[f.name] for f in fields(kind) if f.name not in DERIVED}


def fits(value: object, hint: Any) -> bool:
    """Whether a value is of the annotated kind; a truth value is no number."""
    origin, parts = get_origin(hint), get_args(hint)
    if origin in (Union, UnionType):
        return any(fits(value, part) for part in parts)
    if origin is tuple and Ellipsis not in parts:
        return isinstance(value, tuple) and len(value) == len(parts) and all(map(fits, value, parts))
    if origin in (tuple, Sequence, Iterable):
        return (
            isinstance(value, Sequence)
            and not isinstance(value, str)
            and all(fits(v, parts[0]) for v in value)
        )
    if hint in (int, Fraction) and isinstance(value, bool):
        return False
    return isinstance(value, origin or hint)


def _described(thing: object, name: str, value: object, hint: Any) -> str:
    of = ARGUMENTS.get(name, name)
    if isinstance(thing, Property) and name == "on":
        return f"on is {brief(value)}, {_kind(value)}; write a system, its name, or a chart that runs alone."
    if get_origin(hint) is tuple and isinstance(value, tuple) and Ellipsis in get_args(hint):
        each = get_args(hint)[0]
        wrong = next(v for v in value if not fits(v, each))
        return f"{of} holds {brief(wrong)}, {_kind(wrong)}; write {_words(each)} there."
    return f"{of} is {brief(value)}, {_kind(value)}; write {_words(hint)}."


def _named(thing: object) -> str:
    """What a thing is called in a message; nothing if it is but a part of one."""
    match thing:
        case Property(id):
            return brief(id) if not isinstance(id, str) else id
        case Transition(target):
            return f"the transition to {brief(target)}"
        case State() | Junction() | Chart() | Block() | Enabled() | System() | Var():
            return f"{type(thing).__name__} {brief(thing.name)}"
    return ""


def _words(hint: Any) -> str:
    if hint in WORDS:
        return WORDS[hint]
    options = [part for part in get_args(hint) if part is not type(None)]
    if get_origin(hint) in (Union, UnionType) and options:
        return " or ".join(dict.fromkeys(map(_words, options)))
    if get_origin(hint) is tuple:
        each = [part for part in get_args(hint) if part is not Ellipsis]
        return f"a list, each {_words(each[0])}" if len(each) == 1 else f"({', '.join(map(_words, each))})"
    return with_article(getattr(hint, "__name__", str(hint)))


def _kind(value: object) -> str:
    match value:
        case bool():
            return "a truth value"
        case str():
            return "a text"
        case int() | float() | Fraction():
            return "a number"
        case None:
            return "nothing"
        case Expr():
            return with_article(value.sort)
    return with_article(type(value).__name__)
