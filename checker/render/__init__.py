"""From traces, charts and graphs to what people read: one file per format.

The formats are discovered automatically: every module of this folder whose name begins with its kind.
It has a record ``FORMAT`` and ``render(thing, **options)``, which returns text or bytes that are the same
from run to run.  It raises ``ModelError`` for what its format cannot show.
"""

import importlib
import pkgutil
from typing import Any, Protocol

from rovercheck.checker.results.format import Format, Kind


class Renderer(Protocol):
    """Writes a ``Chart``, a ``StateGraph`` or a ``Trace``, as the kind of its format says."""

    FORMAT: Format

    def render(self, thing: Any, /) -> str | bytes: ...


RENDERED: tuple[Kind, ...] = ("statechart", "graph", "trace")


def renderers(kind: str) -> dict[str, Renderer]:
    """The formats for one kind of thing, by name.  Raises ``ValueError`` for an unknown kind."""
    if kind not in RENDERED:
        raise ValueError(f"{kind!r} is no kind of thing to render; write one of {', '.join(RENDERED)}.")
    found: dict[str, Renderer] = {}
    for entry in sorted(pkgutil.iter_modules(__path__), key=lambda e: e.name):
        module = _loaded(entry.name, kind) if entry.name.startswith(f"{kind}_") else None
        if module is not None:
            found[module.FORMAT.name] = module
    return found


def named(kind: str, name: str) -> Renderer | None:
    """The format of that name, None if there is none; the others, and what they need, are not loaded."""
    if f"{kind}_{name}" in (entry.name for entry in pkgutil.iter_modules(__path__)):
        module = _loaded(f"{kind}_{name}", kind)
        if module is not None and name == module.FORMAT.name:
            return module
    return renderers(kind).get(name)


def _loaded(name: str, kind: str) -> Renderer | None:
    module: Any = importlib.import_module(f"{__name__}.{name}")
    return module if hasattr(module, "FORMAT") and module.FORMAT.kind == kind else None
