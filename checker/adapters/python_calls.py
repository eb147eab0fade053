"""Loads a Python class and calls it, with values by name or with the dataclass that its ``step`` asks for."""

import sys
from collections.abc import Callable, Mapping
from dataclasses import is_dataclass
from importlib import import_module
from importlib.util import module_from_spec, spec_from_file_location
from inspect import signature
from pathlib import Path
from types import ModuleType
from typing import Any, get_type_hints

from rovercheck.checker.adapters.child import PowerUp, RefusedStep
from rovercheck.checker.adapters.firmware import FirmwarePlaces
from rovercheck.checker.adapters.implementation import Value, Values
from rovercheck.checker.adapters.lines import plain
from rovercheck.checker.adapters.records import builder, reader
from rovercheck.spec_model.lang.errors import did_you_mean


class Instance:
    """An instance of the user's class."""

    def __init__(self, make: Callable[[], Any], places: FirmwarePlaces) -> None:
        self._places = places
        self._step = make().step
        asked = _asked(self._step)
        self._build = None if asked is None else builder(asked, places.inputs_of(asked))
        self._readers: dict[type, Callable[[Any], dict[str, Value]]] = {}

    def step(self, inputs: Values) -> Mapping[str, Value]:
        """One step, whatever the instance asks for and gives."""
        found = self._step(dict(inputs) if self._build is None else self._build(inputs))
        if is_dataclass(found):
            return self._reader(type(found))(found)
        if isinstance(found, Mapping):
            return {name: plain(name, value) for name, value in found.items()}
        raise RefusedStep(f"step returned {found!r:.80}; return a dict of outputs by name, or a dataclass")

    def _reader(self, record: type) -> Callable[[Any], dict[str, Value]]:
        if record not in self._readers:
            self._readers[record] = reader(self._places.outputs_of(record))
        return self._readers[record]

    def end(self) -> None:
        """Nothing has to be ended."""


def made(target: str, inputs: Mapping[str, str], outputs: Mapping[str, str]) -> PowerUp:
    """Instances of ``module:Class`` or ``path/file.py:Class``, or what a function called so returns.

    ``inputs`` and ``outputs`` are the places in records of the supervisors of this project.

    Raises ``RefusedStep`` if there is none.
    """
    where, colon, name = target.rpartition(":")
    if not colon or not where or not name:
        raise RefusedStep(f"{target!r} names no class; write module:Class or path/file.py:Class")
    module = _file(Path(where)) if where.endswith(".py") else _module(where)
    if not hasattr(module, name):
        known = [n for n, thing in vars(module).items() if isinstance(thing, type)]
        raise RefusedStep(f"{where} has no {name!r}. {did_you_mean(name, known)}")
    make = getattr(module, name)
    if not callable(make):
        raise RefusedStep(f"{target} is no class; it is {make!r:.80}")
    if isinstance(make, type) and not hasattr(make, "step"):
        raise RefusedStep(f"{target} has no method 'step'; write step(self, inputs) -> outputs")
    places = FirmwarePlaces(inputs, outputs)
    return lambda: Instance(make, places)


def _module(name: str) -> ModuleType:
    try:
        return import_module(name)
    except ModuleNotFoundError as error:
        if error.name is None or not f"{name}.".startswith(f"{error.name}."):
            raise
        raise RefusedStep(
            f"there is no module {error.name!r} in the current folder or among the installed"
        ) from None


def _file(path: Path) -> ModuleType:
    if not path.is_file():
        raise RefusedStep(f"there is no file {path}")
    sys.path.append(str(path.resolve().parent))
    name = f"user_{path.stem}"  # a file called json.py does not hide the module
    spec = spec_from_file_location(name, path)
    assert spec is not None and spec.loader is not None
    module = sys.modules[name] = module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def _asked(step: Callable[..., Any]) -> type[Any] | None:
    """The dataclass with which ``step`` is annotated, if it is."""
    first = next(iter(signature(step).parameters), None)
    if first is None:
        raise RefusedStep("step takes no argument; it is given the inputs of the step")
    hint = get_type_hints(step).get(first)
    return hint if isinstance(hint, type) and is_dataclass(hint) else None
