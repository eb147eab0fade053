"""Interpretations: what a chart becomes where a sentence of the document is read in another way.

A chart file holds the figure, under the default of ``ambiguity.toml``.  Each other choice is a change of a
chart, a function block or a subsystem, in a module of this folder: it says what it replaces there, in the
words of ``spec_model.lang.change`` and ``spec_model.lang.edit``, as a repair does.  ``woven`` puts all of
them into a system, each under the condition that its choice is taken; ``ambiguity.fixed`` says which are.

Changes are applied in the order of their module, from top to bottom, each to what those before it made.
So a change that brings in a formula comes before those that change what is inside it.
"""

import importlib
import pkgutil
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache, reduce
from typing import Any

from rovercheck.spec_model.ambiguity import ambiguity, under
from rovercheck.spec_model.lang.chart import Component, Enabled
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import Expr, Named
from rovercheck.spec_model.lang.merge import Merge
from rovercheck.spec_model.lang.place import Place, here
from rovercheck.spec_model.lang.system import System
from rovercheck.spec_model.lang.walk import variables

Change = Callable[[Any], Component | tuple[Component, ...]]
"""What becomes of a chart or block, or of that and blocks beside it."""


def _everywhere(system: System) -> bool:
    return True


@dataclass(frozen=True, eq=False)
class Alternative:
    """What one choice of an interpretation changes in one part.

    interpretation   its id, with the ``choice`` that is not the default
    text      what changes, in one sentence
    part      the name of the chart or block, or of the condition of a subsystem
    change    what becomes of the part
    among     the systems in which it changes that
    place     where it is written
    """

    interpretation: str
    choice: str
    text: str
    part: str
    change: Change
    among: Callable[[System], bool] = _everywhere
    place: Place | None = None

    @property
    def condition(self) -> Expr:
        """The choice is taken."""
        return under(self.interpretation, self.choice)

    def applied(self, part: Component) -> tuple[Component, ...]:
        """The part as drawn, and as changed where the choice is taken.

        Raises ``ModelError``, with the line of the alternative, if it does not fit the part any more.
        """
        try:
            made = Merge(self.condition).components(self.change(part), part)
        except ModelError as error:
            raise ModelError(
                f"{self.place}: {self.interpretation}={self.choice} does not fit. {error} "
                "Write what it changes for the chart as it is now."
            ) from error
        if made == (part,):
            raise ModelError(
                f"{self.place}: {self.interpretation}={self.choice} changes nothing in {self.part}."
            )
        return made


def alternative(
    interpretation: str,
    choice: str,
    text: str,
    part: str,
    *changes: Change,
    among: Callable[[System], bool] = _everywhere,
) -> Alternative:
    """The changes that one choice makes in one part, one after the other."""

    def change(part: Any) -> Any:
        return reduce(lambda made, one: one(made), changes, part)

    return Alternative(interpretation, choice, text, part, change, among, here(__name__))


@cache
def alternatives() -> tuple[Alternative, ...]:
    """Every alternative, in the order in which they are applied."""
    found: list[Alternative] = []
    for entry in sorted(pkgutil.iter_modules(__path__), key=lambda e: e.name):
        found += importlib.import_module(f"{__name__}.{entry.name}").ALTERNATIVES
    return tuple(found)


def woven(system: System, choices: Mapping[str, str] | None = None) -> System:
    """The system as drawn, with every alternative under its condition: its interpretations are left open.

    Where all the ``choices`` are defaults the system stays as drawn, which is what fixing them would leave;
    a part that is woven already stays as it is.  Raises ``ModelError`` for an alternative that does not fit.
    """
    if choices is not None and all(choice == ambiguity(id).default for id, choice in choices.items()):
        return system
    chosen = tuple(one for one in alternatives() if one.among(system))
    return replace(system, components=_woven(system.components, chosen))


Alternatives = tuple[Alternative, ...]


def _woven(
    components: Sequence[Component], chosen: Alternatives, around: frozenset[str] = frozenset()
) -> tuple[Component, ...]:
    """The parts of a subsystem, whose conditions read the variables ``around``."""
    made: list[Component] = []
    for component in components:
        if isinstance(component, Enabled):
            inside = _woven(component.components, chosen, around | _reads(component))
            component = Enabled(component.by, *inside, name=component.name, place=component.place)
        name = name_of(component)
        own = {one.interpretation for one in chosen if one.part == name}
        if own and own.isdisjoint(around | _reads(component)):
            made += _part(component, chosen)
        else:  # as drawn whatever is read, or woven already
            made.append(component)
    return tuple(made)


def _part(drawn: Component, chosen: Alternatives) -> tuple[Component, ...]:
    """What becomes of one part, one part for all systems that share it."""
    made: tuple[Component, ...] = (drawn,)
    names = {name_of(drawn)}
    for one in chosen:
        if one.part in names:
            made = tuple(new for old in made for new in _applied(one, old))
            names.update(map(name_of, made))
    return made


def _applied(one: Alternative, part: Component) -> tuple[Component, ...]:
    if name_of(part) != one.part:
        return (part,)
    known = _done.get((id(part), one))
    if known is None:
        known = _done[id(part), one] = (part, one.applied(part))
    return known[1]


_done: dict[tuple[int, Alternative], tuple[Component, tuple[Component, ...]]] = {}
"""What parts became, each kept with it, so that its id stays its own."""


def _reads(part: Component) -> frozenset[str]:
    return frozenset(variables(part.by) if isinstance(part, Enabled) else part.read)


def name_of(part: Component) -> str:
    """Of a subsystem the name of its condition."""
    if isinstance(part, Enabled):
        return part.by.name if isinstance(part.by, Named) else ""
    return part.name
