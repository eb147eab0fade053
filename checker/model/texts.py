"""Names and sentences of a user's model: what every exit can show, and every shell can pass on."""

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import fields, is_dataclass, replace

from properties.forms import Property
from spec_model.lang.chart import Block, Chart, Enabled
from spec_model.lang.errors import ModelError
from spec_model.lang.system import System

ID = re.compile(r"\w[\w.:+/-]*")
PROSE = frozenset({"text", "doc", "notes"})
"""Fields with sentences, which may have several lines."""
HIDDEN = re.compile(
    r"[\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f\u202a-\u202e\u2066-\u2069\ufffe\uffff\ud800-\udfff]"
)
"""What no screen shows, or what makes text look other than it is (Unicode technical report 36)."""
LINES = re.compile(r"[\n\r\t\u2028\u2029]")


def one_line(prop: Property) -> Property:
    """A property with its sentence on one line.

    Raises ``ModelError`` for a sentence that is no text, and for an id that a command line cannot name.
    """
    if not isinstance(prop.id, str) or not ID.fullmatch(prop.id):
        raise ModelError(
            f"{_at(prop)}{prop.id!r} can be no id of a property: commands and test runners name it. "
            "Write letters, digits and . : + / - only, a letter or a digit first."
        )
    if not isinstance(prop.text, str) or not prop.text.strip():
        raise ModelError(f"{_at(prop)}{prop.id} has no sentence. Write in words what is meant.")
    return replace(prop, text=" ".join(prop.text.split()))


def check_texts(systems: Iterable[System], properties: Iterable[Property]) -> None:
    """Raises ``ModelError`` for a name or a sentence with signs that cannot be shown."""
    for prop in properties:
        _check(prop, _at(prop))
    for system in systems:
        _check(system, f"{system.name!r}: ")


def _check(thing: object, where: str) -> None:
    for field, text in _texts(thing):
        if HIDDEN.search(text) or (field not in PROSE and LINES.search(text)):
            raise ModelError(
                f"{where}{text!r} has signs that cannot be shown, such as line ends in a name. "
                "Write it without them."
            )


def _at(prop: Property) -> str:
    return f"{prop.place}: " if prop.place else ""


def _texts(thing: object) -> Iterator[tuple[str, str]]:
    """Every text in a thing made of data classes, collections, charts and blocks, with the field it is in."""
    todo: list[tuple[str, object]] = [("", thing)]
    seen = set[int]()
    while todo:
        field, one = todo.pop()
        if isinstance(one, str):
            yield field, one
            continue
        if id(one) in seen:
            continue
        seen.add(id(one))
        if isinstance(one, Mapping):
            todo += ((field, each) for pair in one.items() for each in pair)
        elif isinstance(one, tuple | list | frozenset):
            todo += ((field, each) for each in one)
        elif is_dataclass(one) and not isinstance(one, type):
            todo += ((f.name, getattr(one, f.name, None)) for f in fields(one) if f.name != "place")
        elif isinstance(one, Chart | Block | Enabled):
            todo += list(vars(one).items())
