"""Numbers in formulas for which a datum has no room: variables of which the name says the value.

Constants are whole multiples of their resolution.  A number that firmware has in place of one of them may lie
between these.
"""

import re
from fractions import Fraction

from rovercheck.spec_model.lang.domain import Num, fixed
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.system import System

PARAMETER = "(limit that is tried)"
"""The name of a number that is left open, and given with every step."""

_WIDE = 10**9
_NAME = re.compile(r"\(the number (-?\d+(?:/\d+)?)\)")


def open_number(sort: Num) -> Var:
    """A number of a sort that is left open."""
    return _number(PARAMETER, sort)


def number_between(raw: Fraction, sort: Num) -> Var:
    """A number between the multiples of a resolution, raw."""
    return _number(f"(the number {raw})", sort)


def _number(name: str, sort: Num) -> Var:
    high = _WIDE * sort.resolution
    return Var(name, fixed(-high, high, sort.resolution, str(sort.unit)), 0)


def value_of(name: str) -> Fraction | None:
    """The raw value of a number between others; ``None`` for any other variable."""
    found = _NAME.fullmatch(name)
    return None if found is None else Fraction(found[1])


def is_number(name: str) -> bool:
    """Whether a variable is a number of a formula, and no signal."""
    return name == PARAMETER or value_of(name) is not None


def numbers_in(system: System) -> tuple[tuple[str, Fraction], ...]:
    """All numbers between others that a system reads, by their names, with their raw values."""
    found = ((name, value_of(name)) for name in system.inputs)
    return tuple((name, value) for name, value in found if value is not None)


__all__ = ["PARAMETER", "is_number", "number_between", "numbers_in", "open_number", "value_of"]
