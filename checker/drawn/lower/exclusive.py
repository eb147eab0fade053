"""Conditions that never hold together, as far as their few values tell."""

from itertools import product
from math import prod

from rovercheck.spec_model.lang.evaluate import evaluate
from rovercheck.spec_model.lang.expr import Expr
from rovercheck.spec_model.lang.walk import variables

MOST_VALUES = 1024
"""Values of what two conditions read that are tried."""


def exclude(one: Expr, other: Expr) -> bool:
    """Whether no values of their variables make both conditions true; unknown is no."""
    read = list(variables(one, other).values())
    if prod(len(var.domain) for var in read) > MOST_VALUES:
        return False
    every = product(*(var.domain.values for var in read))
    named = (dict(zip((var.name for var in read), values, strict=True)) for values in every)
    return not any(evaluate(one, at) and evaluate(other, at) for at in named)


__all__ = ["exclude"]
