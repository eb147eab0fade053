"""The waves of a trace: which quantities a wave viewer is shown, and under which names."""

import re
from dataclasses import dataclass
from enum import StrEnum
from unicodedata import combining, normalize

from rovercheck.checker.render.story import TIMER
from rovercheck.checker.results.trace import Trace
from rovercheck.spec_model.lang.domain import Bool, Enum


class WaveGroup(StrEnum):
    """What a wave belongs to: the scopes of a dump, and the groups in which a viewer shows them."""

    PROPERTY = "property"
    CHARTS = "charts"
    INPUTS = "inputs"
    TIMERS = "timers"
    VALUES = "values"
    HIDDEN = "bookkeeping"


class Sort(StrEnum):
    """Types of a value change dump: a wire, a text (which GTKWave shows), a number in its unit."""

    WIRE = "wire"
    TEXT = "string"
    NUMBER = "real"


@dataclass(frozen=True)
class Wave:
    """A quantity, ``name`` in the trace, and the unique path of identifiers that it has in a dump."""

    name: str
    group: WaveGroup
    path: tuple[str, ...]
    sort: Sort

    @property
    def full(self) -> str:
        """The path as viewers write it."""
        return ".".join(self.path)


def waves(trace: Trace) -> tuple[Wave, ...]:
    """Every variable of which the trace holds a value, group by group."""
    held = {*trace.before, *(n for t in trace.ticks for n in (*t.inputs, *t.after))}
    groups = list(WaveGroup)
    names = sorted(
        (n for n in trace.system.variables if n in held or n in trace.system.inputs),
        key=lambda n: groups.index(_group(trace, n)),
    )
    taken: set[tuple[str, ...]] = {(WaveGroup.PROPERTY, word) for word in ("violated", "reached", "repeats")}
    found = []
    for name in names:
        group = _group(trace, name)
        path = _unique((group.value, *_identifiers(name)), taken)
        found.append(Wave(name, group, path, _sort(trace, name)))
    return tuple(found)


def outcome(trace: Trace) -> str:
    """``violated`` for a counterexample, ``reached`` for a witness."""
    return "violated" if trace.breaks() else "reached"


def _group(trace: Trace, name: str) -> WaveGroup:
    sort = trace.system.variables[name].sort
    if name in trace.system.inputs:
        return WaveGroup.INPUTS
    if trace.system.variables[name].hidden or name == trace.property.id:
        return WaveGroup.HIDDEN
    if TIMER.search(name):
        return WaveGroup.TIMERS
    if isinstance(sort, Enum) and sort.name.startswith("states of "):
        return WaveGroup.CHARTS
    return WaveGroup.VALUES


def _sort(trace: Trace, name: str) -> Sort:
    match trace.system.variables[name].sort:
        case Bool():
            return Sort.WIRE
        case Enum():
            return Sort.TEXT
        case _:
            return Sort.NUMBER


def _identifiers(name: str) -> tuple[str, ...]:
    """The parts of a dotted name; what is no name, such as ``previous(x > 3)``, is one identifier."""
    plain = "".join(c for c in normalize("NFKD", name) if not combining(c))  # é is e
    parts = plain.split(".") if re.fullmatch(r"[\w.]+", plain) else [plain]
    return tuple(re.sub(r"\W+", "_", part, flags=re.ASCII).strip("_") or "_" for part in parts)


def _unique(path: tuple[str, ...], taken: set[tuple[str, ...]]) -> tuple[str, ...]:
    found, number = path, 1
    while found in taken:
        number += 1
        found = (*path[:-1], f"{path[-1]}_{number}")
    taken.add(found)
    return found
