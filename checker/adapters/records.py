"""Between flat names and nested records: dataclasses, tuples and enumerations, by the path of each name.

A path is written as in Python, ``payload.command`` or ``wheel_speed_rpm[0]``.
"""

import re
from collections.abc import Callable, Mapping
from dataclasses import fields, is_dataclass
from enum import Enum
from typing import Any, get_args, get_type_hints

from rovercheck.checker.adapters.implementation import Value, Values
from rovercheck.checker.adapters.lines import plain

Path = tuple[str | int, ...]
Build = Callable[[Values], Any]
Fetch = Callable[[Any], Any]


def path(text: str) -> Path:
    """The attributes and indexes of a written path."""
    return tuple(int(part) if part.isdigit() else part for part in re.findall(r"\w+", text))


def builder(record: type, paths: Mapping[str, str]) -> Build:
    """Makes a record of this type from values by name; fields that no path reaches keep their defaults.

    Raises ``AttributeError`` for a path that the type does not have.
    """
    return _builder(record, {path(written): name for name, written in paths.items()})


def _builder(kind: Any, leaves: Mapping[Path, str]) -> Build:
    if () in leaves:
        return _leaf(kind, leaves[()])
    parts = {first: _below(leaves, first) for first in dict.fromkeys(at[0] for at in leaves)}
    if is_dataclass(kind):
        return _dataclass(kind, parts)
    builds = [_builder(item, parts.get(index, {})) for index, item in enumerate(get_args(kind))]
    return lambda values: tuple([build(values) for build in builds])


def _dataclass(kind: Any, parts: Mapping[str | int, Mapping[Path, str]]) -> Build:
    hints = get_type_hints(kind)
    known = {field.name for field in fields(kind)}
    if unknown := [part for part in parts if part not in known]:
        raise AttributeError(f"{kind.__name__} has no field {unknown[0]!r}")
    builds = {str(field): _builder(hints[str(field)], below) for field, below in parts.items()}
    return lambda values: kind(**{field: build(values) for field, build in builds.items()})


def _below(leaves: Mapping[Path, str], first: str | int) -> dict[Path, str]:
    return {at[1:]: name for at, name in leaves.items() if at[0] == first}


def _leaf(kind: Any, name: str) -> Build:
    if not (isinstance(kind, type) and issubclass(kind, Enum)):
        return lambda values: values[name]

    def member(values: Values) -> Enum:
        try:
            return kind(values[name])
        except ValueError:
            raise ValueError(f"{name} = {values[name]} is no {kind.__name__}") from None

    return member


def reader(paths: Mapping[str, str]) -> Callable[[Any], dict[str, Value]]:
    """Values by name from a record; a name whose path leads through None is left out.

    A path that ends in ``?`` says whether there is something.
    """
    fetches = {name: _fetch(written) for name, written in paths.items()}

    def read(record: Any) -> dict[str, Value]:
        found = {name: fetch(record) for name, fetch in fetches.items()}
        return {name: plain(name, value) for name, value in found.items() if value is not None}

    return read


def _fetch(written: str) -> Fetch:
    steps = path(written)

    def fetch(record: Any) -> Any:
        for step in steps:
            if record is None:
                return None
            record = record[step] if isinstance(step, int) else getattr(record, step)
        return record

    return (lambda record: fetch(record) is not None) if written.endswith("?") else fetch
