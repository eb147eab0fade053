"""What a user's model must satisfy before anything is searched; faults are reported with file and line."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import replace
from io import BytesIO
from pathlib import Path
from pickle import PicklingError, Unpickler
from typing import Any

from rovercheck.checker.model import shown
from rovercheck.checker.model.texts import text_faults
from rovercheck.checker.process.isolate import pickled
from rovercheck.checker.system.slice import check_way_back
from rovercheck.properties.forms import Property, formulas
from rovercheck.properties.reduce import reduce, without_step
from rovercheck.spec_model.lang.chart import Chart, parts
from rovercheck.spec_model.lang.domain import Bool
from rovercheck.spec_model.lang.errors import ModelError, did_you_mean, with_article
from rovercheck.spec_model.lang.place import Place
from rovercheck.spec_model.lang.system import System, enabled_in
from rovercheck.spec_model.lang.walk import variables
from rovercheck.spec_model.lang.wellformed import check_system
from rovercheck.spec_model.lang.wellformed.data import twin_faults
from rovercheck.spec_model.lang.wellformed.places import name_of, transition_names


def system_faults(system: System, place: str) -> Iterator[str]:
    """What has no meaning in a system that is written at a place, a line each."""
    yield from text_faults(system, place)
    labels = [fault for chart in system.charts for fault in chart.label_faults]
    if labels:
        yield from labels
        return
    try:
        check_system(system)
    except ModelError as error:
        yield from (_placed(fault, system, place) for fault in str(error).splitlines())


def concrete_faults(systems: Mapping[str, System], known: Collection[str] | None) -> Iterator[str]:
    """Systems that are named by others and are not ``known`` (None: all may be), or lead back to those."""
    for system in systems.values():
        said = f"{system.place}: {system.name} names concrete={system.concrete!r}"
        if system.concrete and known is not None and system.concrete not in known:
            yield f"{said}, no system of this model. {did_you_mean(system.concrete, known)}"
        passed, at = [system.name], system.concrete
        while at in systems and at not in passed:
            passed, at = [*passed, at], systems[at].concrete
        if system.concrete and at == system.name:
            yield f"{said}, which leads back to {system.name}; name the system with the charts themselves."


def not_about(prop: Property, systems: Mapping[str, System], names: Collection[str]) -> str:
    """That a property is about no system of the model."""
    inside = [s.name for s in systems.values() if prop.on in {c.name for c in s.charts}]
    near = (
        f"It is a chart of {', '.join(inside)}: write on={inside[0]!r}."
        if inside
        else did_you_mean(prop.on, names)
    )
    return f"{prop.id} is about {prop.on!r}, no system of this model. {near}"


def _is_another(prop: Property, system: System) -> bool:
    """Whether a property is about something else than the system of that name."""
    if isinstance(prop.about, Chart):
        return all(chart is not prop.about for chart in system.charts)
    return prop.about is not None and prop.about is not system


def monitor_faults(system: System, properties: Sequence[Property]) -> Iterator[str]:
    """Names that the monitors of properties would share; they may be searched together."""
    try:
        reduce(without_step(system), properties)
    except ModelError as error:
        places = (p.place for p in properties if str(error).startswith(f"{p.id}: "))
        yield f"{next(places, None) or system.place or 'the model'}: {error}"


def property_faults(prop: Property, systems: Mapping[str, System]) -> list[str]:
    """What has no meaning in a property about a system that has one."""
    system = systems[prop.on]
    if _is_another(prop, system):
        given = f"{'chart' if isinstance(prop.about, Chart) else 'system'} named {prop.on}"
        said = f"{prop.id}: on= is a {given}, and the system of that name in the model is another"
        return [f"{said}; write the one at the level of a module, or its name."]
    bare = without_step(system)
    known = {v.name: v for v in (*bare.variables, *bare.inputs, *bare.frozen)}
    faults = list[str]()
    for name, var in variables(*formulas(prop.form)).items():
        if name not in known:
            said = f"{prop.id} reads {name}, which system {prop.on} does not have. "
            faults.append(said + did_you_mean(name, known))
        else:
            faults += (f"{prop.id} and system {prop.on}: {f}" for f in twin_faults(known[name], var))
    for formula in formulas(prop.form):
        if not isinstance(formula.sort, Bool):
            kind = with_article(formula.sort)
            faults.append(f"{prop.id}: `{formula}` is {kind}; write a condition, such as a comparison.")
    if faults:
        return faults
    try:
        reduce(bare, [prop])
        concrete = systems.get(system.concrete, system)
        check_way_back(prop, replace(without_step(concrete), assume=concrete.assumed))
    except ModelError as error:
        return [str(error) if str(error).startswith(prop.id) else f"{prop.id}: {error}"]
    return []


def _placed(fault: str, system: System, place: str) -> str:
    """The fault with the line of the transition, state or enable it names, else of its part or system."""
    for enabled in enabled_in(system.components):
        if f"the enable `{enabled.by}`" in fault:
            return f"{enabled.place or place}: {fault}"
    for part in parts(system.components):
        if fault.startswith(f"{part.name}: "):
            places = _places(part) if isinstance(part, Chart) else ()
            named = (at for words, at in places if f" {words} " in fault)
            return f"{next(named, None) or part.place or place}: {fault}"
    return f"{place}: {fault}"


def _places(chart: Chart) -> Iterator[tuple[str, Place | None]]:
    """How faults name transitions and actions, and where these are written."""
    for path, state in chart.states.items():
        transitions = transition_names(state.default, path, default=True) + transition_names(
            state.transitions, path
        )
        yield from ((words, transition.place) for words, transition in transitions)
        yield f"action of {name_of(path)}", state.place
    for path, junction in chart.junctions.items():
        yield from (
            (words, transition.place) for words, transition in transition_names(junction.transitions, path)
        )


class _Own(Exception):
    """The name of a class or function that the model itself defines."""


class _Reader(Unpickler):
    """Reads a pickled model until it meets something of the model's own modules."""

    def __init__(self, whole: bytes, package: str) -> None:
        super().__init__(BytesIO(whole))
        self._package = package

    def find_class(self, module: str, name: str) -> Any:
        if module.startswith(f"{self._package}."):
            raise _Own(name)
        return super().find_class(module, name)


def check_portable(model: object, package: str, path: Path) -> None:
    """Raises ``ModelError`` if the model cannot be sent to another process, where searches run.

    ``package`` holds the modules of the model, which other processes do not have.
    """
    try:
        whole = pickled(model)
        if package.encode() not in whole:
            return
        _Reader(whole, package).load()
    except _Own as own:
        why = f"`{own}` is a class or function of its own"
    except (PicklingError, TypeError, AttributeError) as error:
        why = str(error)
    else:
        return
    raise ModelError(
        f"{shown(path)}: the model cannot be sent to the processes that search it: {why}. "
        "Build charts and properties from plain texts, numbers and the words of rovercheck only."
    )
