"""What a user's model must satisfy before anything is searched; what is wrong is told with file and line."""

from collections.abc import Iterable, Iterator
from io import BytesIO
from pathlib import Path
from pickle import PicklingError, Unpickler
from typing import Any

from checker.isolate import pickled
from checker.model import names_of, shown
from properties.forms import Property, formulas
from spec_model.lang.chart import Chart
from spec_model.lang.errors import ModelError, did_you_mean
from spec_model.lang.place import Place
from spec_model.lang.system import System
from spec_model.lang.walk import variables
from spec_model.lang.wellformed import check_system
from spec_model.lang.wellformed.places import arrow_names, name_of


def check_meaning(systems: Iterable[System], properties: Iterable[Property]) -> None:
    """Raises ``ModelError`` for charts that have no meaning, and properties about what is not there."""
    by_name = {system.name: system for system in systems}
    for system in by_name.values():
        try:
            check_system(system)
        except ModelError as error:
            lines = (_placed(line, system) for line in str(error).splitlines())
            raise ModelError("\n".join(lines)) from error
    for prop in properties:
        known = names_of(by_name[prop.on])
        for name in variables(*formulas(prop.form)):
            if name not in known:
                said = f"{prop.id} reads {name}, which system {prop.on} does not have"
                raise ModelError(f"{prop.place or 'the model'}: {said}. {did_you_mean(name, known)}")


def _placed(fault: str, system: System) -> str:
    """The fault with the line of the arrow or state that it names, else of its chart."""
    for chart in system.charts:
        if fault.startswith(f"{chart.name}: "):
            named = (place for words, place in _places(chart) if f" {words} " in fault)
            place = next(named, None) or chart.root.place
            return f"{place}: {fault}" if place else fault
    return fault


def _places(chart: Chart) -> Iterator[tuple[str, Place | None]]:
    """How faults name arrows and actions, and where these are written."""
    for path, state in chart.states.items():
        arrows = arrow_names(state.default, path, default=True) + arrow_names(state.transitions, path)
        yield from ((words, arrow.place) for words, arrow in arrows)
        yield f"action of {name_of(path)}", state.place
    for path, junction in chart.junctions.items():
        yield from ((words, arrow.place) for words, arrow in arrow_names(junction.transitions, path))


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
        "Build charts and properties from plain texts, numbers and the words of spec_model.lang only."
    )
