"""Ranges for the data of a machine that are computed, for a person to correct."""

from collections.abc import Iterator, Mapping

from rovercheck.checker.scxml.records import (
    AssignDatum,
    Constant,
    DatumName,
    Operation,
    ScxmlExpression,
    StateMachine,
)
from rovercheck.checker.scxml.system import every_action, every_condition

_COMPARED = ("==", "!=", "<", "<=", ">", ">=")


def proposed_ranges(machine: StateMachine) -> Mapping[str, tuple[int, int]]:
    """The lowest and the highest value of each datum that is computed.

    They are the least and the greatest of its first value, of what it is compared with and of what it is
    assigned, and one beyond each.
    """
    computed, values = set[str](), {
        name: {int(one)} for name, one in machine.data.items() if not isinstance(one, bool)
    }  # fmt: skip
    for one in every_action(machine):
        if isinstance(one, AssignDatum) and one.name in values:
            if not isinstance(one.value, Constant):
                computed.add(one.name)
            values[one.name] |= set(_constants(one.value))
            _compared(one.value, values)
    for condition in every_condition(machine):
        _compared(condition, values)
    return {
        name: (min(found) - 1 if min(found) < 0 else min(found), max(found) + 1)
        for name, found in values.items() if name in computed
    }  # fmt: skip


def _constants(one: ScxmlExpression) -> Iterator[int]:
    """The numbers that an expression may be, without those that are only added to another."""
    match one:
        case Constant(value) if not isinstance(value, bool):
            yield int(value)
        case Operation("?", (_, then, other)):
            yield from _constants(then)
            yield from _constants(other)


def _compared(one: ScxmlExpression, values: dict[str, set[int]]) -> None:
    if not isinstance(one, Operation):
        return
    match one:
        case Operation(operator, (DatumName(name), Constant(value)) | (Constant(value), DatumName(name))):
            if operator in _COMPARED and name in values:
                values[name].add(int(value))
    for inner in one.operands:
        _compared(inner, values)


__all__ = ["proposed_ranges"]
