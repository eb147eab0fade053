"""Parts of pages that are kept: what they show is as it was, and so is all code that makes them."""

import json
from dataclasses import dataclass
from functools import cache
from typing import Any

from rovercheck.checker.cache import entries
from rovercheck.checker.store.tree import CODE, as_loaded, tree_key
from rovercheck.checker.store.verdicts import VerdictStore


@cache
def code_key() -> str:
    """The key of all code; empty where it is not what was loaded."""
    return tree_key(folders=CODE) if as_loaded() else ""


@dataclass(frozen=True)
class PartStore:
    """Keeps parts beside the verdicts; with no store for these it keeps nothing."""

    verdicts: VerdictStore | None = None

    def name(self, kind: str, *values: object) -> str | None:
        """The name of a part of that kind about some values; None where none can be kept."""
        try:
            if self.verdicts is None or self.verdicts.recheck or not code_key():
                return None
            return self.verdicts.about(kind, code_key(), *values)
        except OSError:
            return None

    def name_now(self, kind: str, *values: object) -> str | None:
        """The same while no file has changed that commands about the rover read."""
        try:
            return None if self.verdicts is None else self.name(kind, tree_key(), *values)
        except OSError:
            return None

    def read(self, name: str | None) -> Any:
        """The JSON that is kept under a name; None where there is none."""
        try:
            whole = None if name is None else entries.read(name, code=False)
            return None if whole is None else json.loads(whole)
        except entries.MEANINGLESS:
            return None

    def write(self, name: str | None, part: object) -> None:
        """Keep what can be written as JSON, unless code has changed meanwhile."""
        if name is not None and as_loaded():
            entries.write(name, json.dumps(part, separators=(",", ":")).encode())


UNKEPT = PartStore()
