"""Goals that are searched together: those that depend on nearly the same variables."""

from collections.abc import Mapping
from dataclasses import dataclass

from rovercheck.checker.encode.bits.blast import bits_needed
from rovercheck.spec_model.lang.expr import Var

Part = Mapping[str, Var]
"""The variables that a goal depends on, by name."""


@dataclass
class _Gathered:
    part: Part
    goals: list[str]


def gathered(parts: Mapping[str, Part], extra: int) -> list[list[str]]:
    """The goals in groups, those that depend on few bits first.

    A goal joins others if together they depend on at most ``extra`` bits more than either does alone.
    Unrelated parts in one search would multiply their states.
    """
    found: list[_Gathered] = []
    for goal, part in sorted(parts.items(), key=lambda item: bits(item[1])):
        near = (g for g in found if bits({**g.part, **part}) <= min(bits(g.part), bits(part)) + extra)
        group = next(near, None)
        if group is None:
            found.append(_Gathered(part, [goal]))
        else:
            group.part = {**group.part, **part}
            group.goals.append(goal)
    return [group.goals for group in found]


def bits(part: Part) -> int:
    """Of a state of the part."""
    return sum(bits_needed(v) for v in part.values())
