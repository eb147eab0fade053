"""Proposed repairs: variants of charts in which a property holds that fails on the chart as specified.

A repair lies in a file of its own beside the specified charts, which it does not change: it names the
findings it repairs, the charts or function blocks it edits and how, or the readings it takes.
``repaired`` applies it to systems.  Whatever lies in this folder is found.
"""

import importlib
import pkgutil
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cache

from spec_model.lang.chart import Block, Chart, parts
from spec_model.lang.edit import in_system
from spec_model.lang.errors import ModelError, did_you_mean
from spec_model.lang.system import System


@dataclass(frozen=True)
class Repair:
    """One proposed change of the specification.

    name       as on the command line
    text       what changes, in one sentence
    fixes      ids of properties that fail as specified and hold with the repair
    charts     how each chart changes, by its name
    blocks     how each function block changes, by its name
    readings   readings it takes instead of the default
    gives_up   ids of properties that no longer hold, each with the reason
    """

    name: str
    text: str
    fixes: tuple[str, ...]
    charts: Mapping[str, Callable[[Chart], Chart]] = field(default_factory=dict)
    blocks: Mapping[str, Callable[[Block], Block]] = field(default_factory=dict)
    readings: Mapping[str, str] = field(default_factory=dict)
    gives_up: Mapping[str, str] = field(default_factory=dict)


@cache
def repairs() -> dict[str, Repair]:
    """Every repair by name.  Raises ``ModelError`` for a name used twice."""
    found: dict[str, Repair] = {}
    for entry in sorted(pkgutil.iter_modules(__path__), key=lambda e: e.name):
        module = importlib.import_module(f"{__name__}.{entry.name}")
        for thing in vars(module).values():
            if isinstance(thing, Repair):
                if thing.name in found:
                    raise ModelError(f"Two repairs are named {thing.name!r}; rename one of them.")
                found[thing.name] = thing
    return found


def repair(name: str) -> Repair:
    """The repair of that name.  Raises ``ModelError`` offering near names."""
    if name not in repairs():
        raise ModelError(f"There is no repair {name!r}. {did_you_mean(name, repairs())}")
    return repairs()[name]


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
