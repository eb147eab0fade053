"""The types of delays: those of what comes in, before anything came, too."""

from collections.abc import Sequence
from contextlib import suppress
from copy import deepcopy
from typing import TYPE_CHECKING

from rovercheck.checker.drawn.faults import DrawnFault
from rovercheck.checker.drawn.interpret.values import (
    LITERAL,
    TYPES,
    MatlabValue,
    NumberRules,
    Scalar,
    each_converted,
)

if TYPE_CHECKING:
    from rovercheck.checker.drawn.interpret.system import SystemAtWork


def without_type(value: MatlabValue) -> MatlabValue:
    """A whole number begins integers as well as real numbers."""
    whole = isinstance(value, Scalar) and value.kind == "double" and float(value.value).is_integer()
    return each_converted(value, LITERAL, NumberRules()) if whole else value


def settle(system: "SystemAtWork", inputs: Sequence[MatlabValue], shared: object) -> None:
    """Give delays that begin without a type that of what comes in, which a step of a copy shows.

    What none shows is a real number.  ``shared`` is what the copy has in common.
    """
    nodes = list(system.nodes())
    while waiting := {n: m for n, one in enumerate(nodes) if (m := one.memory) and m.kind == LITERAL}:
        copy = deepcopy(system, {id(shared): shared})
        tried = list(copy.nodes())
        for node in tried:
            node.tried = node.system is not None
        with suppress(DrawnFault):
            copy.step(inputs)
        seen = {n: kind for n in waiting if (m := tried[n].memory) and (kind := m.kind) in TYPES}
        for n, node in enumerate(nodes):
            if n in waiting and (n in seen or not seen):
                node.memory = each_converted(waiting[n], seen.get(n, "double"), NumberRules())


__all__ = ["settle", "without_type"]
