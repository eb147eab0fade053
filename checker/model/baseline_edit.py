"""Acceptances written into a baseline: comments, order and layout of the rest stay as they are."""

from collections.abc import Mapping
from datetime import date
from pathlib import Path
from typing import Any

import tomlkit
from tomlkit import TOMLDocument
from tomlkit.container import Container
from tomlkit.exceptions import TOMLKitError
from tomlkit.items import Table, Whitespace

from rovercheck.checker.model import Model, shown
from rovercheck.checker.model.records import baseline_of
from rovercheck.properties import catalogue
from rovercheck.properties.expected import ACCEPTED, Acceptance, VerdictWord
from rovercheck.spec_model.lang.errors import ModelError

HEAD = "# Expected verdicts.  A property that is not listed is expected to be proved.\n"


def file_of(model: Model) -> Path:
    """The file that says what is expected of a model, there or not.

    A new one beside a single file gets the name of that: ``baseline.toml`` would speak of every model of the
    folder.
    """
    if model.path is None:
        return Path(catalogue.__file__).parent / "baseline.toml"
    there = baseline_of(model.path)
    own = model.path.with_name(f"{model.path.stem}.baseline.toml")
    return there if there.exists() or model.path.is_dir() else own


def edited(
    file: Path, decisions: Mapping[str, Acceptance | None], verdicts: Mapping[str, VerdictWord], today: date
) -> str:
    """The text of a baseline with some decisions, by id; None takes an acceptance back.

    ``verdicts`` are those of findings that have no entry yet, which get one.  An entry that nothing but its
    acceptance gave a reason goes with it.  Raises ``ModelError`` for a file that cannot be read.
    """
    text = _read(file) if file.exists() else HEAD
    unix = text.replace("\r\n", "\n")
    try:
        document = tomlkit.parse(unix)
    except TOMLKitError as error:
        raise ModelError(f"{shown(file)} is no TOML: {error}.") from error
    for id, one in decisions.items():
        if one is None:
            _withdraw(document, id)
        else:
            _accept(document, id, one, verdicts.get(id, "violated"), today)
    made = tomlkit.dumps(document).rstrip("\n") + "\n"
    return made.replace("\n", "\r\n") if unix != text else made


def _read(file: Path) -> str:
    try:
        return file.read_bytes().decode()
    except UnicodeDecodeError as error:
        raise ModelError(f"{shown(file)} is no TOML: {error}.") from error
    except OSError as error:
        raise ModelError(f"{shown(file)} cannot be read: {error.strerror}.") from error


def _accept(document: TOMLDocument, id: str, one: Acceptance, verdict: VerdictWord, today: date) -> None:
    if id not in document:
        entry = tomlkit.table()
        entry.add("verdict", verdict)
        entry.add("since", today)
        document.add(tomlkit.nl())
        document.add(tomlkit.key(id), entry)
    found: Any = document[id]
    if ACCEPTED in found:
        _fill(found[ACCEPTED], one)
        return
    table = tomlkit.table()
    _fill(table, one)
    _behind(found, table)


def _fill(table: Any, one: Acceptance) -> None:
    """Say what was decided, and nothing that an earlier decision said."""
    said = {"because": one.because, "owner": one.owner, "on": one.on, "until": one.until}
    for name, value in said.items():
        if value:
            table[name] = value
        elif name in table:
            del table[name]


def _behind(entry: Any, table: Table) -> None:
    """Put the table below the last line of an entry, and the empty lines and comments below it behind it."""
    below = _cut_off(entry.value)
    entry.append(ACCEPTED, table)
    table.value.body.append((None, Whitespace(below)))


def _withdraw(document: TOMLDocument, id: str) -> None:
    found: Any = document[id]
    below = _cut_off(found[ACCEPTED].value)
    if found.get("because"):
        found.value.remove(ACCEPTED)
        above = _cut_off(found.value).removesuffix("\n")  # the empty line in front of the table
        found.value.body.append((None, Whitespace(above + below)))
        return
    place = next(number for number, (key, _) in enumerate(document.body) if key is not None and key.key == id)
    document.remove(id)
    document.body[place] = (None, Whitespace(below))


def _cut_off(container: Container) -> str:
    """Take the empty lines and comments at the end of a table out of it: they belong to what comes next."""
    keep = len(container.body)
    while keep and container.body[keep - 1][0] is None:
        keep -= 1
    below = "".join(item.as_string() for _, item in container.body[keep:])
    del container.body[keep:]
    return below
