"""What the shell offers after the tabulator: names of the model, found without any solver."""

import pkgutil
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING

import click
from click.shell_completion import CompletionItem
from click.types import StringParamType

from rovercheck.checker.commands.shared.codes import UsageError
from rovercheck.spec_model.lang.errors import ModelError

if TYPE_CHECKING:
    from rovercheck.spec_model.lang.system import System

Completing = Callable[[click.Context, click.Parameter, str], list[CompletionItem]]


def _offering(names: Callable[[click.Context], Iterable[str]]) -> Completing:
    """Offers the names that begin as what was typed; nothing where the model cannot be read."""

    def offer(context: click.Context, parameter: click.Parameter, begun: str) -> list[CompletionItem]:
        try:
            return [CompletionItem(name) for name in names(context) if name.startswith(begun)]
        except (ModelError, OSError):
            return []

    return offer


def _properties(context: click.Context) -> Iterable[str]:
    own: Path | None = context.params.get("model")
    if own is None:
        from rovercheck.checker.model.rover import rover

        return rover({}).stated()
    from rovercheck.checker.model.load import load

    return load(own).stated()


def _systems(context: click.Context) -> "Mapping[str, System]":
    own: Path | None = context.params.get("model")
    if own is None:
        from rovercheck.spec_model.rover import systems

        return systems()
    from rovercheck.checker.model.load import load

    return load(own).systems


def _drawn(context: click.Context) -> Iterable[str]:
    from rovercheck.spec_model.lang.system import charts_of

    known = _systems(context)
    return dict.fromkeys([*charts_of(known), *known])


def _formats(kind: str) -> Callable[[click.Context], Iterable[str]]:
    """The formats of a kind, which are named as their files are: none of them is imported."""

    def names(_: click.Context) -> Iterable[str]:
        import rovercheck.checker.render as folder

        found = (e.name for e in pkgutil.iter_modules(folder.__path__))
        return sorted(n.removeprefix(f"{kind}_") for n in found if n.startswith(f"{kind}_"))

    return names


def _engines(_: click.Context) -> Iterable[str]:
    import rovercheck.checker.engines as folder

    return ["auto", *sorted(e.name for e in pkgutil.iter_modules(folder.__path__))]


def _repairs(_: click.Context) -> Iterable[str]:
    from rovercheck.spec_model.repairs import proposals

    return proposals()


def _interpretations(_: click.Context) -> Iterable[str]:
    from rovercheck.spec_model.ambiguity import ambiguities

    return [f"{id}={choice}" for id, one in ambiguities().items() for choice in one.choices]


def _pages(_: click.Context) -> Iterable[str]:
    from rovercheck.checker.commands.docs.run import installed, pages

    try:
        return pages(installed())
    except UsageError:
        return []


properties = _offering(_properties)
systems = _offering(_systems)
drawn = _offering(_drawn)
trace_formats = _offering(_formats("trace"))
graph_formats = _offering(_formats("graph"))
engines = _offering(_engines)
repairs = _offering(_repairs)
interpretations = _offering(_interpretations)
pages = _offering(_pages)

BY_NAME: dict[str, Completing] = {
    "ids": properties, "id": properties, "traced": properties, "bad": properties, "system": systems,
    "about": systems, "engine": engines, "repair": repairs, "chosen": interpretations,
}  # fmt: skip
"""What a parameter of this name means in every verb."""
IN_VERB: dict[tuple[str, str], Completing] = {
    ("trace", "format"): trace_formats, ("graph", "format"): graph_formats, ("graph", "trace"): properties,
    ("graph", "name"): drawn, ("explore", "name"): drawn,
    ("docs", "page"): pages,
}  # fmt: skip
"""What it means in one verb only."""


def meaning(verb: str, parameter: str) -> Completing | None:
    """What completes a parameter of a verb; None where click knows best."""
    return IN_VERB.get((verb, parameter)) or BY_NAME.get(parameter)


class CompletableText(StringParamType):
    """A text of which the shell offers what it may be."""

    def __init__(self, completing: Completing) -> None:
        self._completing = completing

    def shell_complete(
        self, ctx: click.Context, param: click.Parameter, incomplete: str
    ) -> list[CompletionItem]:
        """What may stand here."""
        return self._completing(ctx, param, incomplete)


def completed(verb: click.Command) -> click.Command:
    """The verb, whose parameters that are names the shell completes."""
    for parameter in verb.params:
        found = meaning(verb.name or "", parameter.name or "")
        if found is not None and isinstance(parameter.type, StringParamType):
            parameter.type = CompletableText(found)
    return verb
