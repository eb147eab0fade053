"""A user's own model: a Python file, or a folder of them, whose charts, systems and properties are found."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from types import ModuleType

from checker.model import EXAMPLE, Model, shown
from checker.model.checks import check_meaning, check_portable
from checker.model.execute import files_of, modules_of
from checker.model.records import REGISTER, recorded, register
from checker.model.texts import check_texts, one_line
from properties.forms import Property
from spec_model.lang.chart import Chart
from spec_model.lang.errors import ModelError, did_you_mean
from spec_model.lang.system import System, in_order


def load(path: Path) -> Model:
    """The model that a file or a folder holds.

    Every ``System``, ``Chart`` and ``Property`` at the level of a module, in tuples and lists too, is part
    of it.  A chart that is in no system becomes one of its own, with free inputs and its name.  Verdicts on
    record are read from ``baseline.toml`` beside it, requirements from ``requirements.toml`` or a mapping
    ``REQUIREMENTS``.  Raises ``ModelError`` for what has no meaning.
    """
    files = files_of(path)
    neighbours, modules = modules_of(files)
    found = _found(zip(files, modules, strict=True))
    systems, properties = _systems(found, path), _properties(found)
    _meant(found, systems)
    check_texts(systems.values(), properties.values())
    check_meaning(systems.values(), properties.values())
    check_portable((systems, properties), neighbours.package, path)
    beside = files[0].parent / f"{REGISTER.lower()}.toml"
    requirements = register(_declared(modules), beside, properties)
    return Model(systems, properties, recorded(path, properties), requirements, path)


@dataclass
class _Found:
    """The things of a model, each once, with the file in which it was met first."""

    systems: list[tuple[System, Path]] = field(default_factory=list)
    charts: list[tuple[Chart, Path]] = field(default_factory=list)
    properties: list[tuple[Property, Path]] = field(default_factory=list)


def _found(modules: Iterable[tuple[Path, ModuleType]]) -> _Found:
    found, seen = _Found(), set[int]()
    for file, module in modules:
        for thing in _things(vars(module).values()):
            if id(thing) in seen:
                continue
            seen.add(id(thing))
            match thing:
                case System():
                    found.systems.append((thing, file))
                case Chart():
                    found.charts.append((thing, file))
                case Property():
                    found.properties.append((thing, file))
    return found


def _things(values: Iterable[object]) -> Iterator[object]:
    """The values, and what is in tuples and lists of them."""
    for value in values:
        if isinstance(value, tuple | list):
            yield from _things(value)
        else:
            yield value


def _systems(found: _Found, path: Path) -> dict[str, System]:
    """The systems by name, and one for each chart that is in none of them."""
    inside = {id(chart) for system, _ in found.systems for chart in system.charts}
    alone = [(_alone(chart), file) for chart, file in found.charts if id(chart) not in inside]
    by_name: dict[str, tuple[System, Path]] = {}
    for system, file in (*found.systems, *alone):
        if system.name in by_name:
            other = by_name[system.name][1]
            raise ModelError(
                f"{shown(file)}: the name {system.name!r} is taken"
                f"{f' in {shown(other)}' if other != file else ''}: two systems have it, or a system and a "
                "chart outside of it. Rename one of them."
            )
        by_name[system.name] = system, file
    if not by_name:
        raise ModelError(
            f"{shown(path)} holds no chart and no system at the level of a module. "
            f"Write `name = Chart(...)` there; {EXAMPLE}"
        )
    return {name: system for name, (system, _) in by_name.items()}


def _alone(chart: Chart) -> System:
    return in_order(chart.name, chart, text=f"{chart.name} alone, with free inputs. {chart.text}".strip())


def _properties(found: _Found) -> dict[str, Property]:
    by_id: dict[str, Property] = {}
    for written, file in found.properties:
        prop = one_line(written)
        if prop.id in by_id:
            first = by_id[prop.id].place
            also = f", here and in {first}" if first else ""
            raise ModelError(
                f"{_where(prop, file)}: the id {prop.id} names two properties{also}. Rename one."
            )
        by_id[prop.id] = replace(prop, area=Path(prop.place.file if prop.place else file).stem)
    return by_id


def _where(prop: Property, file: Path) -> str:
    return str(prop.place or shown(file))


def _meant(found: _Found, systems: Mapping[str, System]) -> None:
    """Raises ``ModelError`` for a system that is named and not there."""
    for prop, file in found.properties:
        if prop.on not in systems:
            near = did_you_mean(prop.on, systems)
            raise ModelError(
                f"{_where(prop, file)}: {prop.id} is about {prop.on!r}, no system of this model. {near}"
            )
    for system, file in found.systems:
        if system.concrete and system.concrete not in systems:
            near = did_you_mean(system.concrete, systems)
            named = f"{system.name} names concrete={system.concrete!r}"
            raise ModelError(f"{shown(file)}: {named}, no system of this model. {near}")


def _declared(modules: Iterable[ModuleType]) -> dict[str, object]:
    """The mappings named REQUIREMENTS, put together."""
    found: dict[str, object] = {}
    for module in modules:
        declared = getattr(module, REGISTER, {})
        if not isinstance(declared, Mapping):
            raise ModelError(
                f"{shown(Path(str(module.__file__)))}: {REGISTER} is no mapping of ids to sentences."
            )
        found |= {str(id): said for id, said in declared.items()}
    return found


__all__ = ["load"]
