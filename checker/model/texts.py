"""Names and sentences of a user's model: what every format can show, and every shell can pass on."""

import re
from collections.abc import Iterator, Mapping
from dataclasses import fields, is_dataclass, replace

from rovercheck.checker.model.kinds import PLAIN
from rovercheck.properties.forms import Property
from rovercheck.spec_model.lang.chart import Enabled
from rovercheck.spec_model.lang.place import Place
from rovercheck.spec_model.lang.system import System

ID = re.compile(r"\w[\w.:+/-]*")
PROSE = frozenset({"text", "doc", "notes"})
"""Fields with sentences, which may have several lines."""
HIDDEN = re.compile(
    r"[\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f\u202a-\u202e\u2066-\u2069\ud800-\udfff\ufdd0-\ufdef"
    + "".join(f"\\U{plane:04x}fffe\\U{plane:04x}ffff" for plane in range(17))
    + "]"
)
"""What no screen shows, what is no character, or what makes text look other than it is (Unicode technical
report 36)."""
LINES = re.compile(r"[\n\r\t\u2028\u2029]")


def one_line(prop: Property) -> Property:
    """A property with its sentence on one line."""
    return replace(prop, text=" ".join(prop.text.split()))


def text_faults(thing: Property | System, place: str) -> Iterator[str]:
    """Ids that a command line cannot name, what is empty, and signs that cannot be shown, a line each."""
    if isinstance(thing, Property):
        yield from (f"{place}: {fault}" for fault in _property_faults(thing))
    of = thing.id if isinstance(thing, Property) else thing.name
    for where, owner, name, text in _texts(thing, place):
        if name == "name" and not text.strip() and not isinstance(owner, Enabled):
            yield f"{where}: {of!r} has an empty name, or a part of it has; write one."
        elif HIDDEN.search(text) or (name not in PROSE and LINES.search(text)):
            yield (
                f"{where}: {'' if text == of else f'{of!r}: '}{text!r} has signs that cannot be shown, such "
                "as line ends in a name. Write it without them."
            )


def _property_faults(prop: Property) -> Iterator[str]:
    if not ID.fullmatch(prop.id):
        yield (
            f"{prop.id!r} can be no id of a property: commands and test runners name it. "
            "Write letters, digits and . : + / - only, a letter or a digit first."
        )
    if not prop.text.strip():
        yield f"{prop.id} has no sentence. Write in words what is meant."
    if not all(id.strip() for id in prop.covers or [""]):
        yield f"{prop.id}: covers={list(prop.covers)} names no requirement; write the ids of some."
    if prop.from_tick < 1:
        yield f"{prop.id}: from_tick={prop.from_tick} is no tick; the first is 1."
    if prop.interpretations:
        given = list(prop.interpretations)
        yield f"{prop.id}: interpretations={given} are of the rover only; leave interpretations= out."


def _texts(thing: object, place: object) -> Iterator[tuple[object, object, str, str]]:
    """Every text in a thing made of data classes, collections, charts and blocks.

    Each with its place, what it is in, and the name of the field.
    """
    todo: list[tuple[object, object, str, object]] = [(place, None, "", thing)]
    seen = set[int]()
    while todo:
        place, owner, name, one = todo.pop()
        if isinstance(one, str):
            yield place, owner, name, one
            continue
        if id(one) in seen or isinstance(one, Place):
            continue
        seen.add(id(one))
        place = getattr(one, "place", None) or place
        if isinstance(one, Mapping):
            todo += ((place, owner, name, each) for pair in one.items() for each in pair)
        elif isinstance(one, tuple | list | frozenset):
            todo += ((place, owner, name, each) for each in one)
        elif is_dataclass(one) and not isinstance(one, type):
            todo += ((place, one, f.name, getattr(one, f.name, None)) for f in fields(one))
        else:  # only what is written: what a chart has derived of it names each state many times
            written = next((names for kind, names in PLAIN.items() if isinstance(one, kind)), ())
            todo += ((place, one, name, getattr(one, name, None)) for name in written)
