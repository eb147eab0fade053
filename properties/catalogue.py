"""The catalogue: every property of ``areas`` and ``promises``, and the verdict expected of each."""

import importlib
import pkgutil
import tomllib
import traceback
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

from rovercheck.properties.expected import Expected, on_record
from rovercheck.properties.forms import Property, formulas
from rovercheck.properties.hazards import hazards
from rovercheck.properties.requirements import requirement
from rovercheck.spec_model.ambiguity import ambiguities, fixed
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.place import Place
from rovercheck.spec_model.lang.specialise import Specialiser
from rovercheck.spec_model.lang.walk import variables
from rovercheck.spec_model.rover import interpretations_of

if TYPE_CHECKING:
    from rovercheck.properties.promises.promise import Promise


@cache
def catalogue() -> Mapping[str, Property]:
    """Every property by id, area by area, every interpretation at its default."""
    return under({})


def under(choices: Mapping[str, str]) -> Mapping[str, Property]:
    """Every property by id under chosen interpretations; what reads no interpretation is the same under all.

    Raises ``ModelError`` for an unknown interpretation or choice.
    """
    return _Chosen(as_written(), fixed(choices))


class _Chosen(Mapping[str, Property]):
    """Properties with their interpretations chosen, which is done for each when it is first asked for."""

    def __init__(self, written: Mapping[str, Property], fixing: Specialiser) -> None:
        self._written, self._fixing = written, fixing
        self._made: dict[str, Property] = {}

    def __getitem__(self, id: str) -> Property:
        if id not in self._made:
            prop = self._written[id]
            self._made[id] = replace(prop, form=self._fixing.parts_of(prop.form))
        return self._made[id]

    def __iter__(self) -> Iterator[str]:
        return iter(self._written)

    def __len__(self) -> int:
        return len(self._written)

    def __contains__(self, id: object) -> bool:
        return id in self._written


def read_by(prop: Property) -> set[str]:
    """The interpretations that the property or its system depends on."""
    own = {name for e in formulas(as_written()[prop.id].form) for name in variables(e)}
    return (own & ambiguities().keys()) | interpretations_of(prop.on)


@cache
def as_written() -> dict[str, Property]:
    """Every property by id, with its interpretations open.  Raises ``ModelError`` for an id used twice."""
    found: dict[str, Property] = {}
    for folder in ("areas", "promises"):
        for area, thing in _stated_in(folder):
            if isinstance(thing, Property):
                _add(found, replace(thing, area=area))
    return found


@cache
def promises() -> tuple["Promise", ...]:
    """What the document promises of the rover, those first that it names first."""
    from rovercheck.properties.promises.promise import ORDER, Promise

    found = [thing for _, thing in _stated_in("promises") if isinstance(thing, Promise)]
    return tuple(sorted(found, key=lambda promise: ORDER.index(promise.id)))


def _stated_in(folder: str) -> Iterator[tuple[str, object]]:
    """Everything that a module of the folder names, with the module's name, in its order."""
    package = importlib.import_module(f"{__package__}.{folder}")
    for entry in sorted(pkgutil.iter_modules(package.__path__), key=lambda e: e.name):
        with _told_with_place():
            module = importlib.import_module(f"{package.__name__}.{entry.name}")
        yield from ((entry.name, thing) for thing in vars(module).values())


@contextmanager
def _told_with_place() -> Iterator[None]:
    """Raises ``ModelError`` with file and line for what Python refuses in a file of properties.

    An error inside of what such a file calls is left as it is: it may be one of ours.
    """
    try:
        yield
    except ModelError:
        raise
    except Exception as error:
        frame = traceback.extract_tb(error.__traceback__)[-1]
        if isinstance(error, SyntaxError) and error.filename is not None:
            frame = traceback.FrameSummary(error.filename, error.lineno, "", line=error.text)
        if Path(frame.filename).parent.parent != Path(__file__).parent:
            raise
        place, line = Place(frame.filename, frame.lineno or 1), (frame.line or "").strip()
        raise ModelError(f"{place}: {type(error).__name__}: {error}, in `{line}`.") from error


def _add(found: dict[str, Property], prop: Property) -> None:
    if prop.id in found:
        raise ModelError(f"The id {prop.id} names two properties; give one of them another suffix.")
    for covered in prop.covers:
        requirement(covered)
    found[prop.id] = prop


@cache
def baseline() -> dict[str, Expected]:
    """The expected verdicts; a property that is not listed is expected to be proved.

    Raises ``ModelError`` for an entry that names no property or has no reason.
    """
    table = tomllib.loads((Path(__file__).parent / "baseline.toml").read_text(encoding="utf-8"))
    return on_record(table, catalogue(), "baseline.toml", hazards())


def expected(id: str) -> Expected:
    """The verdict expected of a property."""
    return baseline().get(id, Expected())
