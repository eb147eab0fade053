"""What a name on the command line means, with the nearest names when it means nothing."""

from collections.abc import Iterable, Mapping, Sequence
from typing import TypeVar

from rovercheck.checker.commands.shared.codes import UsageError
from rovercheck.checker.engines import ALL, AUTO, engines
from rovercheck.properties.forms import Property
from rovercheck.spec_model.lang.errors import did_you_mean
from rovercheck.spec_model.lang.system import System
from rovercheck.spec_model.rover import systems

Thing = TypeVar("Thing")


def pick(kind: str, name: str, known: Mapping[str, Thing]) -> Thing:
    """The thing of that name.  Raises ``UsageError`` offering near names."""
    if name not in known:
        raise UsageError(f"There is no {kind} {name!r}. {did_you_mean(name, known)}")
    return known[name]


def pick_engine(name: str, every: bool = False) -> str:
    """The name of an engine, ``auto`` or ``all``.

    Raises ``UsageError`` where there is none of that name, or one is named and ``every`` one wanted.
    """
    if name not in (AUTO, ALL):
        pick("engine", name, {**engines(), AUTO: None, ALL: None})
        if every:
            raise UsageError(
                f"--engine {name} asks one engine and --all-engines every one; write one of them."
            )
    return ALL if every else name


def pick_properties(
    ids: Sequence[str],
    about: Sequence[str],
    known: Mapping[str, Property],
    full: bool = False,
    among: Mapping[str, System] | None = None,
) -> list[Property]:
    """Properties by id, or by the beginning that its forms share (PB1-16 is PB1-16a, PB1-16b...).

    All of them when no id is given, the costly ones only in ``full``; only those ``about`` some systems
    where any are named, systems ``among`` those given, by default the rover's.
    """
    chosen = (
        _distinct(p for id in ids for p in _matching(id, known))
        if ids
        else [p for p in known.values() if full or not p.costly]
    )
    for name in about:
        pick("system", name, systems() if among is None else among)
    return [p for p in chosen if not about or p.on in about]


def _matching(id: str, known: Mapping[str, Property]) -> list[Property]:
    if id in known:
        return [known[id]]
    forms = [name for name in known if name.startswith(id) and not name[len(id)].isdigit()]
    return [known[name] for name in forms] or [pick("property", id, known)]


def _distinct(properties: Iterable[Property]) -> list[Property]:
    return list({p.id: p for p in properties}.values())
