"""The file beside a machine of XState: what its guards, actions and delays that have only names mean.

```toml
version = 4                              # of XState, where the machine does not say it

[guards]
full = "count >= 3"

[actions]
increment = { count = "count + 1" }
ping = { raise = "PING" }

[delays]
TIMEOUT = 500                            # milliseconds
```
"""

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from rovercheck.checker.io.bounded import bounded_bytes
from rovercheck.spec_model.lang.errors import ModelError, brief, did_you_mean

LARGEST = 1 << 20
KEYS = ("version", "guards", "actions", "delays")
RAISE = "raise"


@dataclass(frozen=True)
class Bindings:
    """What such a file says; ``path`` is where it would be, if there is none."""

    path: Path
    version: int | None = None
    guards: Mapping[str, str] = field(default_factory=dict)
    """Conditions by the name of a guard."""
    actions: Mapping[str, Mapping[str, str]] = field(default_factory=dict)
    """By the name of an action the data that it assigns, with their values; ``raise`` is an event."""
    delays: Mapping[str, int] = field(default_factory=dict)
    """Milliseconds."""


def bindings_path(model: Path) -> Path:
    """Where the bindings of a machine are: ``NAME.bindings.toml`` beside it."""
    return model.with_name(f"{model.stem}.bindings.toml")


def read_bindings(path: Path) -> Bindings:
    """What a file says; nothing if there is none.  Raises ``ModelError`` for what has no meaning."""
    if not path.exists():
        return Bindings(path)
    try:
        told = tomllib.loads(bounded_bytes(path, LARGEST, "Name a file of bindings.").decode("utf-8"))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError, RecursionError) as error:
        raise ModelError(f"{path}: this is no TOML: {error}") from error
    for key in told:
        if key not in KEYS:
            raise ModelError(f"{path}: {brief(key)} means nothing. {did_you_mean(key, KEYS)}")
    version = told.get("version")
    if version is not None and (version not in (4, 5) or isinstance(version, bool)):
        raise ModelError(f"{path}: version = {brief(version)}: machines of XState 4 and 5 are read.")
    guards = {name: _text(path, name, one) for name, one in _table(path, told, "guards").items()}
    actions = {name: _action(path, name, one) for name, one in _table(path, told, "actions").items()}
    delays = {name: _delay(path, name, one) for name, one in _table(path, told, "delays").items()}
    return Bindings(path, version, guards, actions, delays)


def _text(path: Path, name: str, told: object) -> str:
    if not isinstance(told, str):
        raise ModelError(f'{path}: the guard {brief(name)} is no text. Write {name} = "count >= 3".')
    return told


def _action(path: Path, name: str, told: object) -> dict[str, str]:
    made = told if isinstance(told, dict) else {}
    if not made or not all(isinstance(one, str) for one in made.values()):
        raise ModelError(
            f"{path}: the action {brief(name)} says nothing that is known. Write {name} = "
            '{ count = "count + 1" }, or { raise = "EVENT" }.'
        )
    return made


def _delay(path: Path, name: str, told: object) -> int:
    if not isinstance(told, int) or isinstance(told, bool) or not 0 < told < 10**9:
        raise ModelError(f"{path}: the delay {brief(name)} is a whole number of milliseconds above 0.")
    return told


def _table(path: Path, told: Mapping[str, object], key: str) -> dict[str, object]:
    found = told.get(key, {})
    if not isinstance(found, dict):
        raise ModelError(f"{path}: `{key}` is a table; write [{key}], and below it a line for each name.")
    return found


__all__ = ["RAISE", "Bindings", "bindings_path", "read_bindings"]
