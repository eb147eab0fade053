"""Whether a system has a run at all: an assumption that nothing meets would prove everything."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from rovercheck.checker.system.partition import conjuncts, partitions
from rovercheck.checker.system.slice import names
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.evaluate import evaluate
from rovercheck.spec_model.lang.expr import Expr
from rovercheck.spec_model.lang.system import TransitionSystem

TRIED = 100_000
"""Combinations of values after which the search for a first tick is given up."""


def require_initial_tick(system: TransitionSystem) -> None:
    """Raises ``ModelError`` if no inputs at all are allowed in the first tick."""
    if has_initial_tick(system) is False:
        place = system.source.place if system.source is not None else None
        where = f"{place}: {system.name}" if place else system.name
        raise ModelError(
            f"{where}: its assumption allows no first tick, whatever the inputs, so that anything "
            f"would be true of it: {system.assume}. Drop what contradicts the rest or the start."
        )


def has_initial_tick(system: TransitionSystem) -> bool | None:
    """Whether some inputs, with some frozen values, are allowed in the first tick; None: not found out."""
    asked = tuple((names([c]), c) for c in conjuncts(system.assume))
    concerned = frozenset[str]().union(*(read for read, _ in asked))
    cells = partitions(replace(system, step=()))
    choices = {v.name: tuple(v.domain.values) for v in system.frozen if v.name in concerned}
    choices |= {n: tuple(c.value for c in cells[n].cells) for n in cells if n in concerned}
    order = sorted(choices, key=lambda name: len(choices[name]))
    fixed = {name: raw for name, raw in system.init.items() if name not in choices}
    search = _Search(choices, asked, TRIED)
    if not search.allowed(fixed, frozenset(concerned) - choices.keys()):
        return False
    found = next(search.extended(fixed, order), None)
    return True if found is not None else None if search.left <= 0 else False


@dataclass
class _Search:
    """Values one after the other; a conjunct is looked at as soon as all that it reads has a value."""

    choices: Mapping[str, Sequence[int]]
    asked: Sequence[tuple[frozenset[str], Expr]]
    left: int

    def extended(self, at: Mapping[str, int], order: Sequence[str]) -> Iterator[Mapping[str, int]]:
        """States with a value for each variable of ``order``, too, in which every conjunct holds."""
        if not order:
            yield at
            return
        for raw in self.choices[order[0]]:
            self.left -= 1
            more = {**at, order[0]: raw}
            if self.left > 0 and self.allowed(more, frozenset(order[:1])):
                yield from self.extended(more, order[1:])

    def allowed(self, at: Mapping[str, int], new: frozenset[str]) -> bool:
        """Whether the conjuncts that have got their last value with the ``new`` ones hold."""
        return all(
            evaluate(c, at) for read, c in self.asked if (read & new or not read) and read <= at.keys()
        )
