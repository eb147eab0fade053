"""Problems written for other model checkers: one file per format.

The formats are discovered automatically: every module of this folder with a record ``FORMAT``
and ``export(problem)``, which returns text or bytes that are the same from run to run.  It raises
``ModelError`` for what its format cannot say.
"""

import importlib
import pkgutil
from typing import Any, Protocol

from rovercheck.checker.export.problem import Bad, Problem, problem
from rovercheck.checker.results.format import Format


class Exporter(Protocol):
    """A format that some other model checker reads."""

    FORMAT: Format

    def export(self, problem: Problem, /) -> str | bytes: ...


def exporters() -> dict[str, Exporter]:
    """The formats in this folder, by name."""
    found: dict[str, Exporter] = {}
    for entry in sorted(pkgutil.iter_modules(__path__), key=lambda e: e.name):
        module: Any = importlib.import_module(f"{__name__}.{entry.name}")
        if hasattr(module, "FORMAT"):
            found[module.FORMAT.name] = module
    return found


__all__ = ["Bad", "Exporter", "Problem", "exporters", "problem"]
