"""What was told of the rover while nothing has changed: it is said again without reading a chart.

All that was told is kept under one key of every file of rovercheck; where one differs, the verdicts are
asked for one by one (``checker.store.verdicts``).
"""

import json
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, fields, replace
from datetime import date
from hashlib import sha256
from typing import Any, Literal, TypeVar, get_args, get_origin

from rovercheck.checker.cache import entries
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.commands.shared.options import SearchOptions, SelectionOptions
from rovercheck.checker.commands.shared.told import ToldDecision, ToldVerdict
from rovercheck.checker.results.gravity import Gravity
from rovercheck.checker.store.tree import tree_key

SCHEMA = "rovercheck/told/1"


@dataclass(frozen=True)
class ToldProperty:
    """What is needed of a property to choose it: whether it takes long, and its system."""

    on: str
    costly: bool


@dataclass(frozen=True)
class ToldModel:
    """What was told of a model: properties in their order, and systems."""

    properties: Mapping[str, ToldProperty]
    systems: Sequence[str]
    verdicts: Mapping[str, ToldVerdict]

    def chosen(self, selection: SelectionOptions) -> list[ToldVerdict] | None:
        """What was told of the selected properties; None where not all was, or a name means nothing here."""
        if not set(selection.ids) <= self.properties.keys() or not set(selection.about) <= {*self.systems}:
            return None
        ids = dict.fromkeys(selection.ids) or [
            id for id, one in self.properties.items() if selection.full or not one.costly
        ]
        asked = [id for id in ids if not selection.about or self.properties[id].on in selection.about]
        known = [self.verdicts[id] for id in asked if id in self.verdicts]
        return known if known and len(known) == len(asked) else None


@dataclass(frozen=True)
class ToldStore:
    """Where that is kept, for the files as they were when the command began and for such searches."""

    tree: str
    name: str

    @staticmethod
    def now(search: SearchOptions) -> "ToldStore | None":
        """For the files as they are now, and today: what was accepted may be so no longer tomorrow.

        None where they cannot be read.
        """
        try:
            tree = tree_key()
        except OSError:
            return None
        asked = json.dumps(
            [SCHEMA, tree, date.today().isoformat(), search.engine, search.timers, search.depth]
        )
        return ToldStore(tree, f"{sha256(asked.encode()).hexdigest()}-told-json")

    def read(self) -> ToldModel | None:
        """What was told; None if nothing was, or what is kept has no meaning."""
        whole = entries.read(self.name, code=False)
        if whole is None:
            return None
        try:
            return _model(json.loads(whole))
        except entries.MEANINGLESS:
            return None

    def forget(self) -> None:
        """Keep nothing of what was told."""
        entries.remove(self.name)

    def add(self, model: ToldModel) -> None:
        """Keep what was told now beside what was before, unless a file has changed meanwhile."""
        before = self.read()
        verdicts = {**(before.verdicts if before else {}), **model.verdicts}
        try:
            same = tree_key() == self.tree
        except OSError:
            return
        if same:
            whole = asdict(replace(model, verdicts=verdicts))
            entries.write(self.name, json.dumps(whole, separators=(",", ":")).encode())


def keepable(one: ToldVerdict) -> bool:
    """Whether it would be told again: not what was open, or not asked."""
    return one.word != "unknown" and not (one.asked and one.occurs is None)


def _model(found: Any) -> ToldModel:
    return ToldModel(
        {str(id): _record(ToldProperty, row) for id, row in found["properties"].items()},
        list(map(str, found["systems"])),
        {str(id): told_of(row) for id, row in found["verdicts"].items()},
    )


def told_of(row: Mapping[str, Any]) -> ToldVerdict:
    """What was told of a verdict, from its fields as JSON.  Raises one of ``entries.MEANINGLESS``."""
    codes = {name: Exit(row[name]) for name in ("code", "strict_code")}
    lists = {name: tuple(row[name]) for name in ("covers", "fired")}
    gravity = row["gravity"]
    how = _record(Gravity, {**gravity, "within": tuple(gravity["within"])})
    decision = None if row["decision"] is None else _record(ToldDecision, row["decision"])
    return _record(ToldVerdict, {**row, **codes, **lists, "gravity": how, "decision": decision})


Record = TypeVar("Record", Gravity, ToldDecision, ToldProperty, ToldVerdict)


def _record(kind: type[Record], row: Mapping[str, Any]) -> Record:
    """The record with these fields.  Raises ``TypeError`` where one is of another type."""
    made = kind(**row)
    for one in fields(made):
        if not _is(getattr(made, one.name), one.type):
            raise TypeError(f"{one.name} is {getattr(made, one.name)!r}, no {one.type}")
    return made


def _is(value: object, wanted: Any) -> bool:
    if isinstance(wanted, type) and not get_args(wanted):
        return type(value) is wanted
    match get_origin(wanted), get_args(wanted):
        case (kind, words) if kind is Literal:
            return any(value == word for word in words)
        case (kind, (member, end)) if kind is tuple and end is ...:
            return isinstance(value, tuple) and all(_is(one, member) for one in value)
        case (kind, members) if kind is tuple:
            return isinstance(value, tuple) and len(value) == len(members) and all(map(_is, value, members))
        case (kind, (key, member)) if kind is Mapping:
            return isinstance(value, dict) and all(_is(k, key) and _is(v, member) for k, v in value.items())
        case _, either:
            return any(_is(value, one) for one in either)
