"""Proposed repairs: variants of charts in which a property holds that fails on the chart as specified.

A repair lies in a file of its own beside the specified charts, which it does not change: it names the
findings it repairs, the charts or function blocks it edits and how, or the interpretations it takes.
``repaired`` applies it to systems, ``in_force`` makes one of several.  Whatever lies in this folder
is found.
"""

import importlib
import pkgutil
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from functools import cache, reduce
from typing import TypeVar

from rovercheck.spec_model.lang.chart import Block, Chart, parts
from rovercheck.spec_model.lang.edit import in_system
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.system import System

ALL = "all"
"""The name of all repairs that edit charts, together."""

Part = TypeVar("Part", Chart, Block)


@dataclass(frozen=True)
class Repair:
    """One proposed change of the specification.

    name       as on the command line
    text       what changes, in one sentence
    fixes      ids of properties that fail as specified and hold with the repair
    charts     how each chart changes, by its name
    blocks     how each function block changes, by its name
    interpretations   interpretations it takes instead of the default
    gives_up   ids of properties that no longer hold, each with the reason
    """

    name: str
    text: str
    fixes: tuple[str, ...]
    charts: Mapping[str, Callable[[Chart], Chart]] = field(default_factory=dict)
    blocks: Mapping[str, Callable[[Block], Block]] = field(default_factory=dict)
    interpretations: Mapping[str, str] = field(default_factory=dict)
    gives_up: Mapping[str, str] = field(default_factory=dict)


@cache
def repairs() -> dict[str, Repair]:
    """Every repair by name.  Raises ``ModelError`` for a name used twice."""
    found: dict[str, Repair] = {}
    for entry in sorted(pkgutil.iter_modules(__path__), key=lambda e: e.name):
        module = importlib.import_module(f"{__name__}.{entry.name}")
        for thing in vars(module).values():
            if isinstance(thing, Repair):
                if thing.name in (*found, ALL):
                    raise ModelError(f"Two repairs are named {thing.name!r}; rename one of them.")
                found[thing.name] = thing
    return found


def in_force(chosen: Iterable[Repair], name: str = ALL) -> Repair:
    """One repair of several: their edits in the order given.

    Repairs that take another interpretation are left out: of those of one sentence only one can hold.
    """
    edits = [one for one in chosen if not one.interpretations]
    fixes = dict.fromkeys(id for one in edits for id in one.fixes)
    given_up = {id: why for one in edits for id, why in one.gives_up.items() if id not in fixes}
    return Repair(
        name,
        f"All that edit charts: {', '.join(one.name for one in edits)}.",
        tuple(fixes),
        charts=_together([one.charts for one in edits]),
        blocks=_together([one.blocks for one in edits]),
        gives_up=given_up,
    )


def _together(
    edits: Iterable[Mapping[str, Callable[[Part], Part]]],
) -> dict[str, Callable[[Part], Part]]:
    """The edits of each chart or block, one after the other."""
    by_part: dict[str, list[Callable[[Part], Part]]] = {}
    for one in edits:
        for name, edit in one.items():
            by_part.setdefault(name, []).append(edit)
    return {name: _in_turn(found) for name, found in by_part.items()}


def _in_turn(edits: list[Callable[[Part], Part]]) -> Callable[[Part], Part]:
    return lambda part: reduce(lambda changed, edit: edit(changed), edits, part)


def proposals() -> dict[str, Repair]:
    """Every repair by name, and all that edit charts as one."""
    return {**repairs(), ALL: in_force(repairs().values())}


def repaired(system: System, repair: Repair) -> System:
    """The system with the charts and blocks in it edited; itself when it has none of them."""

    def edited(part: Chart | Block) -> Chart | Block:
        return repair.charts[part.name](part) if isinstance(part, Chart) else repair.blocks[part.name](part)

    for part in parts(system.components):
        if part.name in (repair.charts if isinstance(part, Chart) else repair.blocks):
            system = in_system(system, part.name, edited)
    return system


def touches(system: System, repair: Repair) -> bool:
    """Whether an edit of the repair concerns the system."""
    names = {part.name for part in parts(system.components)}
    return not names.isdisjoint(repair.charts.keys() | repair.blocks.keys())
