"""Formulas about steps before this one that more than one area states."""

from rovercheck.spec_model.lang.expr import TRUE, Expr
from rovercheck.spec_model.lang.words import once, previous

STEPPED = previous(once(TRUE))
"""A step was made before this one."""


def ago(value: Expr, steps: int) -> Expr:
    """The value so many steps before this one; the initial value before the first step."""
    return value if steps == 0 else previous(ago(value, steps - 1))


def at_least(count: int, condition: Expr) -> Expr:
    """The condition was true in at least so many steps, this one included; ``count`` is positive."""
    return once(condition if count == 1 else condition & previous(at_least(count - 1, condition)))


__all__ = ["STEPPED", "ago", "at_least"]
