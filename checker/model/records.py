"""The tables beside a user's model: expected verdicts, the requirements that are covered, and hazards."""

import ast
import tomllib
from collections.abc import Collection, Iterable, Mapping
from dataclasses import fields
from pathlib import Path
from types import ModuleType
from typing import Any

from rovercheck.checker.io.toml_lines import line_of
from rovercheck.checker.model import shown
from rovercheck.properties.expected import Expected, on_record
from rovercheck.properties.forms import Property
from rovercheck.properties.hazards import Hazard, hazards_in
from rovercheck.properties.requirements import Requirement
from rovercheck.spec_model.lang.errors import ModelError, did_you_mean
from rovercheck.spec_model.lang.place import Place

REGISTER = "REQUIREMENTS"
_KEYS = tuple(f.name for f in fields(Requirement) if f.name != "id")


def baseline_of(path: Path) -> Path:
    """Where the verdicts on a model are: ``NAME.baseline.toml`` beside a file, if there, or baseline.toml."""
    if path.is_dir():
        return path / "baseline.toml"
    own = path.with_name(f"{path.stem}.baseline.toml")
    return own if own.exists() else path.with_name("baseline.toml")


def recorded(path: Path, known: Collection[str], hazards: Collection[str] = ()) -> dict[str, Expected]:
    """The expected verdicts beside a model, none if there is no such file.  Raises ``ModelError``."""
    file = baseline_of(path)
    return on_record(_table(file), known, shown(file), hazards) if file.exists() else {}


def hazards_of(folder: Path, known: Collection[str]) -> dict[str, Hazard]:
    """The hazards beside a model with the requirements ``known``, none if there is no ``hazards.toml``.

    Raises ``ModelError`` for what it says that has no meaning.
    """
    file = folder / "hazards.toml"
    return hazards_in(_table(file), known, shown(file)) if file.exists() else {}


def register(
    modules: Iterable[tuple[Path, ModuleType]], file: Path, properties: Iterable[Property]
) -> tuple[dict[str, Requirement], list[str]]:
    """The requirements that modules declare and those of the file, by id; and what is wrong with them.

    Where none is declared, what properties cover are requirements.  Raises ``ModelError`` for a file that
    is no TOML.
    """
    named = {id: (said, file) for id, said in (_table(file) if file.exists() else {}).items()}
    faults = list[str]()
    for source, module in modules:
        declared = getattr(module, REGISTER, {})
        if isinstance(declared, Mapping):
            named |= {str(id): (said, source) for id, said in declared.items()}
        else:
            faults.append(f"{_written(source, REGISTER)}: {REGISTER} is no mapping of ids to sentences.")
    if not named and not faults:
        return {id: _requirement(id, "") for prop in properties for id in prop.covers}, []
    found = dict[str, Requirement]()
    for id, (said, source) in named.items():
        try:
            found[id] = _requirement(id, said)
        except ModelError as error:
            faults.append(f"{_written(source, id)}: {error}")
    for prop in properties if named else ():
        for id in prop.covers:
            if id not in named:
                near = did_you_mean(id, named)
                faults.append(f"{prop.place or 'the model'}: {prop.id} covers {id!r}, no requirement. {near}")
    return found, faults


def _written(file: Path, name: str) -> str:
    """The line of a module that assigns a name, or has it as a key of a mapping or a table; else the file."""
    if file.suffix == ".toml":
        line = line_of(file.read_text(encoding="utf-8"), (name,))
        return str(Place(str(file), line)) if line else shown(file)
    for node in ast.walk(ast.parse(file.read_bytes())) if file.suffix == ".py" else ():
        if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store) and node.id == name:
            return str(Place(str(file), node.lineno))
        for key in node.keys if isinstance(node, ast.Dict) else ():
            if isinstance(key, ast.Constant) and str(key.value) == name:
                return str(Place(str(file), key.lineno))
    return shown(file)


def _requirement(id: str, said: object) -> Requirement:
    """A requirement from its sentence, or from a table with ``text`` and what else there is to say."""
    row: Mapping[str, Any] = {"text": said} if isinstance(said, str) else _row(id, said)
    unknown = [key for key in row if key not in _KEYS]
    if unknown:
        raise ModelError(f"the requirement {id} has no {unknown[0]!r}. {did_you_mean(unknown[0], _KEYS)}")
    return Requirement(id, **{**dict.fromkeys(_KEYS, ""), "checkable": "yes", **row})


def _row(id: str, said: object) -> Mapping[str, Any]:
    if isinstance(said, Mapping) and all(isinstance(v, str) for v in said.values()):
        return said
    raise ModelError(f"the requirement {id} is {said!r}; write its sentence, or a table of texts.")


def _table(file: Path) -> dict[str, Any]:
    try:
        return tomllib.loads(file.read_text(encoding="utf-8"))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise ModelError(f"{shown(file)} is no TOML: {error}.") from error
    except OSError as error:
        raise ModelError(f"{shown(file)} cannot be read: {error.strerror}.") from error
