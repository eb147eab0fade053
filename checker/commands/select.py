"""What a name on the command line means, with the nearest names when it means nothing."""

from collections.abc import Iterable, Mapping, Sequence
from typing import TypeVar

from checker.commands.codes import UsageError
from checker.decide import ALL, AUTO
from checker.engine import engines
from properties.catalogue import read_by, under
from properties.forms import Property
from spec_model.lang.errors import did_you_mean
from spec_model.readings import ANY, readings
from spec_model.rover import AS_READ, systems

Thing = TypeVar("Thing")


def pick(kind: str, name: str, known: Mapping[str, Thing]) -> Thing:
    """The thing of that name.  Raises ``UsageError`` offering near names."""
    if name not in known:
        raise UsageError(f"There is no {kind} {name!r}. {did_you_mean(name, known)}")
    return known[name]


def pick_engine(name: str) -> str:
    """The name of an engine, ``auto`` or ``all``."""
    if name not in (AUTO, ALL):
        pick("engine", name, {**engines(), AUTO: None, ALL: None})
    return name


def pick_readings(chosen: Sequence[str]) -> dict[str, str]:
    """Readings and their choices from ``ID=CHOICE``.  Raises ``UsageError`` or ``ModelError``."""
    choices: dict[str, str] = {}
    for text in chosen:
        id, equals, choice = text.partition("=")
        one = pick("reading", id, readings())
        options = [c for c in one.choices if c not in one.not_modelled]
        if not equals or not choice:
            raise UsageError(f"{text!r} names no choice; write {id}= and one of {', '.join(options)}, {ANY}.")
        if choice != ANY:
            one.value(choice)
        choices[id] = choice
    return choices


def pick_properties(
    ids: Sequence[str], system: str | None, choices: Mapping[str, str] = AS_READ
) -> list[Property]:
    """Properties by id, or by the beginning that its forms share (PB1-16 is PB1-16a, PB1-16b...).

    All of them when no id is given; only those about ``system`` when one is.  Under chosen readings,
    without an id, only those that a chosen reading can change.
    """
    known = under(choices)
    if choices and not ids:
        known = {id: p for id, p in known.items() if choices.keys() & read_by(p)}
    chosen = _distinct(p for id in ids for p in _matching(id, known)) if ids else list(known.values())
    if system is None:
        return chosen
    pick("system", system, systems())
    return [p for p in chosen if p.on == system]


def _matching(id: str, known: Mapping[str, Property]) -> list[Property]:
    if id in known:
        return [known[id]]
    forms = [p for name, p in known.items() if name.startswith(id) and not name[len(id)].isdigit()]
    return forms or [pick("property", id, known)]


def _distinct(properties: Iterable[Property]) -> list[Property]:
    return list({p.id: p for p in properties}.values())
