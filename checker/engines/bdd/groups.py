"""Goals that are searched together: those that depend on nearly the same variables."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from checker.encode.bits import Circuit
from checker.encode.bits.blast import bits_needed
from checker.encode.bits.model import cut
from checker.encode.cone import cone, constants, folded
from checker.encode.symbolic import transition
from spec_model.lang.expr import Var
from spec_model.lang.system import TransitionSystem

EXTRA = 8
"""Bits that a goal may add to those of others and still be searched with them."""


@dataclass
class _Group:
    state: dict[str, Var]
    goals: list[str] = field(default_factory=list)


@dataclass(frozen=True)
class Group:
    """A circuit for some goals, and the constants among the variables that the goals depend on.

    Constants keep their value in every run because all of them together do; the circuit has none.
    """

    circuit: Circuit
    constants: tuple[tuple[Var, int], ...]


def groups(system: TransitionSystem, goals: Sequence[str]) -> Iterator[Group]:
    """The groups, those with few latches first."""
    whole = transition(system)
    fixed = constants(whole)
    moving = folded(whole, fixed)
    cones = {
        goal: {v.name: v for v in cone(moving, [goal]).variables if v.name not in goals} for goal in goals
    }
    for group in _grouped(cones):
        part = cone(whole, group.goals)
        kept = tuple((v, fixed[v.name]) for v in part.variables if v.name in fixed)
        yield Group(cut(moving, group.goals), kept)


def _grouped(cones: Mapping[str, dict[str, Var]]) -> list[_Group]:
    found: list[_Group] = []
    for goal, state in sorted(cones.items(), key=lambda item: _bits(item[1])):
        near = [g for g in found if _bits(g.state | state) <= min(_bits(g.state), _bits(state)) + EXTRA]
        if not near:
            found.append(_Group(state))
            near = found[-1:]
        near[0].state |= state
        near[0].goals.append(goal)
    return found


def _bits(state: Mapping[str, Var]) -> int:
    return sum(bits_needed(v) for v in state.values())
