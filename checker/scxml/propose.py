"""Ranges for the data of a machine that are computed, for a person to correct."""

from collections.abc import Iterator, Mapping

from networkx import Graph, connected_components

from rovercheck.checker.scxml.records import (
    AssignDatum,
    Constant,
    DatumName,
    EventDatum,
    Operation,
    ScxmlExpression,
    StateMachine,
    carried_name,
)
from rovercheck.checker.scxml.walk import every_action, every_condition

_COMPARED = ("==", "!=", "<", "<=", ">", ">=")


def proposed_ranges(machine: StateMachine) -> Mapping[str, tuple[int, int]]:
    """The lowest and the highest value of each datum that is computed, and of what events carry.

    They are the least and the greatest of its first value, of what it is compared with and of what it is
    assigned, and one beyond each.  What is a copy of something else has the values of both.
    """
    return _Proposal(machine).ranges()


class _Proposal:
    def __init__(self, machine: StateMachine) -> None:
        numbers = {name: int(one) for name, one in machine.data.items() if not isinstance(one, bool)}
        assigned = [one for one in every_action(machine) if isinstance(one, AssignDatum)]
        self.constants = {n: v for n, v in numbers.items() if not any(one.name == n for one in assigned)}
        carried = {carried_name(name) for name, kind in machine.carried.items() if kind == "integer"}
        self.values = {**{name: {first} for name, first in numbers.items()}, **{n: {0} for n in carried}}
        self.computed, self.copies = carried, list[tuple[str, str]]()
        for one in assigned:
            if one.name in numbers:
                self._assigned(one)
            self._compared(one.value)
        for condition in every_condition(machine):
            self._compared(condition)

    def ranges(self) -> Mapping[str, tuple[int, int]]:
        """The ends, by name."""
        for names in connected_components(Graph(self.copies)):
            values = set().union(*(self.values[name] for name in names))
            self.values |= dict.fromkeys(names, values)
        return {
            name: (min(found) - 1 if min(found) < 0 else min(found), max(found) + 1)
            for name, found in self.values.items() if name in self.computed
        }  # fmt: skip

    def _assigned(self, one: AssignDatum) -> None:
        if not isinstance(one.value, Constant):
            self.computed.add(one.name)
        self.copies += [(one.name, name) for name in self._copied(one.value) if name in self.values]
        self.values[one.name] |= set(self._constants(one.value))

    def _copied(self, one: ScxmlExpression) -> Iterator[str]:
        """What a value may be as it stands."""
        if isinstance(one, Operation) and one.operator == "?":
            yield from self._copied(one.operands[1])
            yield from self._copied(one.operands[2])
        elif name := self._name(one):
            yield name

    def _constants(self, one: ScxmlExpression) -> Iterator[int]:
        """The numbers that an expression may be, without those that are only added to another."""
        match one:
            case Constant(value) if not isinstance(value, bool):
                yield int(value)
            case DatumName(name) if name in self.constants:
                yield self.constants[name]
            case Operation("?", (_, then, other)):
                yield from self._constants(then)
                yield from self._constants(other)

    def _compared(self, one: ScxmlExpression) -> None:
        if not isinstance(one, Operation):
            return
        if one.operator in _COMPARED:
            for side, other in (one.operands, one.operands[::-1]):
                name = self._name(side)
                if name in self.values:
                    self.values[name] |= set(self._constants(other))
        for inner in one.operands:
            self._compared(inner)

    @staticmethod
    def _name(one: ScxmlExpression) -> str:
        match one:
            case DatumName(name):
                return name
            case EventDatum(name):
                return carried_name(name)
        return ""


__all__ = ["proposed_ranges"]
