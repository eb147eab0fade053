"""The tables beside a user's model: the verdicts on record, and the requirements that are covered."""

import tomllib
from collections.abc import Collection, Mapping
from pathlib import Path
from typing import Any

from checker.model import shown
from properties.catalogue import Expected, on_record
from properties.forms import Property
from properties.requirements import Requirement
from spec_model.lang.errors import ModelError, did_you_mean

REGISTER = "REQUIREMENTS"


def baseline_of(path: Path) -> Path:
    """Where the verdicts on a model are: ``NAME.baseline.toml`` beside a file, if there, or baseline.toml."""
    if path.is_dir():
        return path / "baseline.toml"
    own = path.with_name(f"{path.stem}.baseline.toml")
    return own if own.exists() else path.with_name("baseline.toml")


def recorded(path: Path, known: Collection[str]) -> dict[str, Expected]:
    """The verdicts on record beside a model, none if there is no such file.  Raises ``ModelError``."""
    file = baseline_of(path)
    return on_record(_table(file), known, shown(file)) if file.exists() else {}


def register(
    declared: Mapping[str, object], file: Path, properties: Mapping[str, Property]
) -> dict[str, Requirement]:
    """The requirements that the model declares and those of the file, by id.

    Where none is declared, what properties cover are requirements.  Raises ``ModelError`` for a property
    that covers none of those declared.
    """
    named = {**(_table(file) if file.exists() else {}), **declared}
    if not named:
        return {id: _requirement(id, "") for prop in properties.values() for id in prop.covers}
    for prop in properties.values():
        for id in prop.covers:
            if id not in named:
                near = did_you_mean(id, named)
                raise ModelError(
                    f"{prop.place or 'the model'}: {prop.id} covers {id!r}, no requirement. {near}"
                )
    return {id: _requirement(id, said) for id, said in named.items()}


def _requirement(id: str, said: object) -> Requirement:
    """A requirement from its sentence, or from a table with ``text`` and what else there is to say."""
    blank = dict.fromkeys(("text", "source", "bounds", "kind"), "")
    row: Mapping[str, Any] = {"text": said} if isinstance(said, str) else _row(id, said)
    try:
        return Requirement(id, **{**blank, "checkable": "yes", **row})
    except TypeError as error:
        unknown = next(k for k in row if k not in Requirement.__dataclass_fields__)
        near = did_you_mean(unknown, [*blank, "checkable", "reason"])
        raise ModelError(f"The requirement {id} has no {unknown!r}. {near}") from error


def _row(id: str, said: object) -> Mapping[str, Any]:
    if isinstance(said, Mapping) and all(isinstance(v, str) for v in said.values()):
        return said
    raise ModelError(f"The requirement {id} is {said!r}; write its sentence, or a table of texts.")


def _table(file: Path) -> dict[str, Any]:
    try:
        return tomllib.loads(file.read_text(encoding="utf-8"))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise ModelError(f"{shown(file)} is no TOML: {error}.") from error
