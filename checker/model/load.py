"""A user's own model: a Python file, or a folder of them, whose charts, systems and properties are found."""

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

from rovercheck.checker.model import EXAMPLE, FOREIGN, SCXML, XSTATE, ForeignModel, Model, shown
from rovercheck.checker.model.checks import (
    check_portable,
    concrete_faults,
    monitor_faults,
    not_about,
    property_faults,
    system_faults,
)
from rovercheck.checker.model.execute import files_of, modules_of
from rovercheck.checker.model.kinds import kind_faults
from rovercheck.checker.model.records import REGISTER, hazards_of, recorded, register
from rovercheck.checker.model.texts import one_line, text_faults
from rovercheck.properties.forms import Property
from rovercheck.properties.hazards import Hazard
from rovercheck.properties.requirements import Requirement
from rovercheck.spec_model.lang.chart import Chart
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.system import System, in_order


def load(path: Path) -> Model:
    """The model that a file or a folder holds.

    Every ``System``, ``Chart`` and ``Property`` at the level of a module, in tuples and lists too, is part
    of it.  A chart that is in no system becomes one of its own, with free inputs and its name.  Verdicts on
    record are read from ``baseline.toml`` beside it, requirements from ``requirements.toml`` or a mapping
    ``REQUIREMENTS``, hazards from ``hazards.toml``.  Raises ``ModelError`` for what has no meaning, with a
    line for each fault; only a thing that is faulty already, or what it is about, is not looked at further.
    """
    drawn = [_drawn(path)] if path.suffix in FOREIGN and path.exists() else []
    files = files_of(path)
    folder = files[0].parent if files else path.parent
    neighbours, modules, faults = modules_of(files, folder)
    found = _Found(
        [*((path, [one]) for one in drawn), *((file, vars(module).values()) for file, module in modules)],
        faults,
    )
    found.take_all()
    on_record, requirements, hazards = {}, dict[str, Requirement](), dict[str, Hazard]()
    beside = list[str]()
    if found.whole:
        with _gathered(beside):
            file = folder / f"{REGISTER.lower()}.toml"
            requirements, wrong = register(modules, file, found.properties.values())
            beside += wrong
        with _gathered(beside):
            hazards = hazards_of(folder, None if beside else requirements)
        with _gathered(faults):
            on_record = recorded(path, found.ids, None if beside else hazards)
        faults += beside
    if faults:
        raise ModelError("\n".join(dict.fromkeys(faults)))
    if not found.systems:
        raise ModelError(
            f"{shown(path)} holds no chart and no system at the level of a module. "
            f"Write `name = Chart(...)` there; {EXAMPLE}"
        )
    check_portable((found.systems, found.properties), neighbours.package, path)
    return Model(found.systems, found.properties, on_record, requirements, path, hazards=hazards)


def _drawn(path: Path) -> ForeignModel:
    """A model of another tool: what reads it is loaded only then."""
    if path.suffix in (SCXML, XSTATE):
        from rovercheck.checker.model.machine import read_machine

        return read_machine(path)
    from rovercheck.checker.model.drawn import read_simulink

    return read_simulink(path)


def model(*things: Chart | System | Property) -> Model:
    """The model that charts, systems and properties of a script or notebook make.

    As in a file, a chart that is in no system becomes one; every verdict is expected to be "proved".
    Raises ``ModelError`` for what has no meaning.
    """
    places = (thing.place for thing in things if isinstance(thing, Chart | System | Property))
    path = next((Path(place.file) for place in places if place), Path("<script>"))
    found = _Found([(path, things)], faults := list[str]())
    found.take_all()
    if faults:
        raise ModelError("\n".join(dict.fromkeys(faults)))
    check_portable((found.systems, found.properties), "__main__", path)
    requirements, _ = register([], path / f"{REGISTER.lower()}.toml", found.properties.values())
    return Model(found.systems, found.properties, {}, requirements, path)


class _Found:
    """The things of a model, each once, and what is wrong with them.

    ``names`` and ``ids`` are those of all systems and properties; ``systems`` and ``properties`` are without
    those of which something is of the wrong kind; what is asked of ``sound`` systems has an answer.
    ``whole``: every file could be run, so that what is not there is nowhere.
    """

    def __init__(self, files: Iterable[tuple[Path, Iterable[object]]], faults: list[str]) -> None:
        self.whole, self.faults = not faults, faults
        self.names, self.sound, self.ids = set[str](), set[str](), set[str]()
        self.systems: dict[str, System] = {}
        self.properties: dict[str, Property] = {}
        self._files: dict[int, tuple[object, Path]] = {}
        self._written: list[System] = []
        for file, values in files:
            for thing in _things(values):
                self._files.setdefault(id(thing), (thing, file))

    def take_all(self) -> None:
        """Look at everything that was found, systems first: properties are about them."""
        self.take_systems()
        self.take_properties()

    def take_systems(self) -> None:
        """Look at the systems, and make one of each chart that is in none of them."""
        things = list(self._files.values())
        written = [s for s, _ in things if isinstance(s, System) and isinstance(s.components, tuple)]
        self._written = written
        inside = {id(chart) for system in written for chart in system.charts}
        systems: list[tuple[System | Chart, Path]] = [(s, f) for s, f in things if isinstance(s, System)]
        systems += [(c, f) for c, f in things if isinstance(c, Chart) and id(c) not in inside]
        for thing, file in systems:
            if not self._of_right_kinds(thing, file):
                self.names |= {thing.name} if isinstance(thing.name, str) else set()
                continue
            system, place = thing if isinstance(thing, System) else _alone(thing), thing.place or shown(file)
            if system.name in self.systems:
                first = self.systems[system.name].place
                self.faults.append(
                    f"{place}: the name {system.name!r} is taken{f' in {first}' if first else ''}: two "
                    "systems have it, or a system and a chart outside of it. Rename one of them."
                )
                continue
            self.names.add(system.name)
            self.systems[system.name] = system
            before = len(self.faults)
            with _gathered(self.faults, f"{place}: {system.name}: "):
                self.faults += system_faults(system, str(place))
            if len(self.faults) == before:
                self.sound.add(system.name)
        self.faults += concrete_faults(self.systems, self.names if self.whole else None)

    def take_properties(self) -> None:
        """Look at the properties, of which the meaning is asked where their system has one."""
        for written, file in self._files.values():
            if not isinstance(written, Property):
                continue
            if not self._of_right_kinds(written, file):
                self.ids |= {written.id} if isinstance(written.id, str) else set()
                continue
            prop, place = self._at_home(one_line(written)), written.place or shown(file)
            if prop.id in self.properties:
                first = self.properties[prop.id].place
                also = f", here and in {first}" if first else ""
                self.faults.append(f"{place}: the id {prop.id} names two properties{also}. Rename one.")
            self.ids.add(prop.id)
            area = Path(prop.place.file if prop.place else file).stem
            self.properties.setdefault(prop.id, replace(prop, area=area, about=None))
            with _gathered(self.faults, f"{place}: {prop.id}: "):
                self.faults += text_faults(prop, str(place))
                if prop.on in self.sound:
                    self.faults += (f"{place}: {fault}" for fault in property_faults(prop, self.systems))
                elif prop.on not in self.names and self.whole:
                    self.faults.append(f"{place}: {not_about(prop, self.systems, self.names)}")

        for name in self.sound if not self.faults else ():
            about = [p for p in self.properties.values() if p.on == name]
            self.faults += monitor_faults(self.systems[name], about)

    def _at_home(self, prop: Property) -> Property:
        """A property about a chart that runs in one system alone is about that system."""
        if prop.on in self.names:
            return prop
        inside = {s.name for s in self._written for c in s.charts if c is prop.about or c.name == prop.on}
        return replace(prop, on=inside.pop()) if len(inside) == 1 else prop

    def _of_right_kinds(self, thing: System | Chart | Property, file: Path) -> bool:
        faults = list(kind_faults(thing, shown(file)))
        self.faults += faults
        return not faults


@contextmanager
def _gathered(faults: list[str], where: str = "") -> Iterator[None]:
    """What is raised inside is reported with the other faults."""
    try:
        yield
    except ModelError as error:
        faults += str(error).splitlines()
    except RecursionError:
        faults.append(f"{where}states or formulas are nested too deeply to be read; write fewer levels.")


def _things(values: Iterable[object]) -> Iterator[object]:
    """The values, and what is in tuples and lists of them, in each once."""
    todo, seen = list(values)[::-1], set[int]()
    while todo:
        value = todo.pop()
        if isinstance(value, ForeignModel):
            value = value.system
        if not isinstance(value, tuple | list):
            yield value
        elif id(value) not in seen:
            seen.add(id(value))
            todo += reversed(value)


def _alone(chart: Chart) -> System:
    text = f"{chart.name} alone, with free inputs. {chart.text}".strip()
    return replace(in_order(chart.name, chart, text=text), place=chart.place)


__all__ = ["load", "model"]
