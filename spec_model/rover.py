"""The systems that are checked, by name: every chart with its environment, and each board as a whole."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from functools import cache
from importlib import import_module
from importlib.util import find_spec
from types import MappingProxyType

from rovercheck.spec_model.ambiguity import ambiguities, fixed, left_open, modelled_only
from rovercheck.spec_model.interpretations import woven
from rovercheck.spec_model.lang.chart import Chart
from rovercheck.spec_model.lang.system import System, charts_of
from rovercheck.spec_model.system_table import SystemTable, unlike

AS_READ: Mapping[str, str] = MappingProxyType({})
"""Every interpretation at its default."""

BOARDS = (
    "rovercheck.spec_model.board1.systems",
    "rovercheck.spec_model.board1.fine_systems",
    "rovercheck.spec_model.board2.systems",
    "rovercheck.spec_model.board2.motion_systems",
    "rovercheck.spec_model.board2.monitor_systems",
    "rovercheck.spec_model.board2.supervisor_systems",
    "rovercheck.spec_model.plain_systems",
    "rovercheck.spec_model.composition.systems",
    "rovercheck.spec_model.composition.fine_systems",
    "rovercheck.spec_model.composition.rover_ms",
    "rovercheck.spec_model.composition.weather",
    "rovercheck.spec_model.composition.receiver",
    "rovercheck.spec_model.composition.counters",
    "rovercheck.spec_model.board1.jitter_systems",
    "rovercheck.spec_model.board2.jitter_systems",
)
"""Modules with a table SYSTEMS, in the order in which the systems are listed."""


def systems(choices: Mapping[str, str] = AS_READ) -> Mapping[str, System]:
    """Every system by name, under chosen interpretations; an interpretation not mentioned takes its default.

    One chosen as ``any`` is a frozen variable of every system.  Raises ``ModelError`` for a name
    used twice, an unknown interpretation or choice.
    """
    return _systems(tuple(sorted(choices.items())))


@cache
def _systems(chosen: tuple[tuple[str, str], ...]) -> "_Read":
    return _Read(dict(chosen))


class _Read(Mapping[str, System]):
    """The systems under chosen interpretations: modules are read until a name is found, and that is built."""

    def __init__(self, choices: Mapping[str, str]) -> None:
        self._choices, self._fixing, self._open = choices, fixed(choices), left_open(choices)
        self._modelled = modelled_only(choices)
        self._modules = list(BOARDS)
        self._tables: tuple[SystemTable, ...] = ()
        self._listed: dict[str, SystemTable] = {}
        self._read: dict[str, System] = {}

    def __getitem__(self, name: str) -> System:
        if name not in self._read:
            system = self._fixing.system(woven(self.declared(name), self._choices))
            if self._open:
                frozen = (*system.frozen, *self._open)
                system = replace(system, frozen=frozen, assume=system.assume & self._modelled)
            self._read[name] = system
        return self._read[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._all())

    def __len__(self) -> int:
        return len(self._all())

    def declared(self, name: str) -> System:
        """A system as its module declares it, its charts as drawn.  Raises ``KeyError`` if none does."""
        while name not in self._listed:
            if not self._modules:
                raise KeyError(name)
            self._read_one()
        return self._listed[name][name]

    def _all(self) -> Mapping[str, SystemTable]:
        while self._modules:
            self._read_one()
        return self._listed

    def _read_one(self) -> None:
        """Read the next module, which is left for the next time if that is interrupted."""
        module, *rest = self._modules
        tables = (*self._tables, _systems_of(module))
        self._listed, self._tables, self._modules = merged(tables), tables, rest


def as_written() -> Iterator[System]:
    """Every system with its interpretations open, the alternatives of its charts included."""
    return (woven(system) for module in BOARDS for system in _systems_of(module).values())


@cache
def interpretations_of(name: str) -> frozenset[str]:
    """The interpretations that a system depends on.  Raises ``KeyError`` for an unknown one."""
    return frozenset(woven(_systems(()).declared(name)).inputs.keys() & ambiguities().keys())


def _systems_of(module: str) -> SystemTable:
    package = module.rpartition(".")[0]
    if find_spec(package) is None or find_spec(module) is None:
        return SystemTable()
    found: SystemTable = import_module(module).SYSTEMS
    return found


def merged(tables: Iterable[SystemTable]) -> dict[str, SystemTable]:
    """The table that lists each system, by name.  Raises ``ModelError`` for a name used twice."""
    every = tuple(tables)
    unlike(name for table in every for name in table)
    return {name: table for table in every for name in table}


def charts(choices: Mapping[str, str] = AS_READ) -> dict[str, Chart]:
    """Every chart by name, as drawn under chosen interpretations."""
    return charts_of(systems(choices))


@cache
def left_to_read(name: str) -> System:
    """A system with every interpretation open, each a frozen variable; other choices are not excluded.

    It is for asking what depends on an interpretation, not for runs.  Raises ``KeyError`` for an unknown one.
    """
    system = woven(_systems(()).declared(name))
    return replace(system, frozen=(*system.frozen, *(one.var for one in ambiguities().values())))
