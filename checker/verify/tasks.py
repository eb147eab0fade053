"""What is searched together: properties of one system whose monitors have few values between them."""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from rovercheck.checker.system.formula_json import Tree
from rovercheck.checker.system.width import driven
from rovercheck.properties.forms import Property, Unbounded
from rovercheck.properties.reduce import Question, reduce, without_step
from rovercheck.spec_model.lang.errors import ModelError, did_you_mean
from rovercheck.spec_model.lang.system import System

FEW = 64
"""Monitors with at most this many combinations of values share a search: compiling costs more."""
MOST = 16
"""Properties in one search: what is compiled grows faster than their number."""


@dataclass(frozen=True)
class Task:
    """Properties of one system that are searched together.

    ``recorded`` are the conjuncts of recorded proofs, as ``checker.system.formula_json`` writes formulas;
    None if there is no such proof.
    """

    system: System
    properties: tuple[Property, ...]
    recorded: tuple[Tree, ...] | None = None

    @property
    def title(self) -> str:
        """``relay PB1-11 and 4 more``."""
        more = f" and {len(self.properties) - 1} more" if len(self.properties) > 1 else ""
        return f"{self.system.name} {self.properties[0].id}{more}"

    @property
    def size(self) -> int:
        """The bits of all that the charts and blocks of the system write: what costs most, roughly, first."""
        return sum((len(v.domain) - 1).bit_length() for v in without_step(self.system).variables)


def tasks(properties: Sequence[Property], systems: Mapping[str, System]) -> Iterator[Task]:
    """Properties grouped by system, and within a system by the size of the monitors they need.

    Raises ``ModelError`` for a property about an unknown system, or an ill-formed one.
    """
    by_system: dict[str, list[Property]] = {}
    for prop in properties:
        if prop.on not in systems:
            near = did_you_mean(prop.on, systems)
            raise ModelError(f"{prop.id} is about {prop.on!r}, no known system. {near}")
        by_system.setdefault(prop.on, []).append(prop)
    for name, group in by_system.items():
        yield from (Task(systems[name], (p,)) for p in group if isinstance(p.form, Unbounded))
        bounded = [p for p in group if not isinstance(p.form, Unbounded)]
        for together in _together(reduce(without_step(systems[name]), bounded)):
            yield Task(systems[name], tuple(together))


def _together(question: Question) -> list[list[Property]]:
    """Properties to search together: not too many, whose monitors have few values between them.

    Of a driven system any: what monitors remember follows from what was chosen as well.
    """
    values = {v.name: len(v.domain) for v in question.system.variables}
    few = math.inf if driven(question.system) else FEW
    bins: list[tuple[set[str], list[Property]]] = []
    for goal in sorted(question.goals, key=lambda g: math.prod(values[n] for n in g.memory)):
        for memory, members in bins:
            fits = goal.memory <= memory or math.prod(values[n] for n in memory | goal.memory) <= few
            if fits and len(members) < MOST:
                memory |= goal.memory
                members.append(goal.property)
                break
        else:
            bins.append((set(goal.memory), [goal.property]))
    return [members for _, members in bins]
