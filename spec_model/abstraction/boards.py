"""The boards by name, under chosen interpretations."""

from collections.abc import Mapping
from dataclasses import replace
from functools import cache
from types import MappingProxyType

from rovercheck.spec_model.abstraction.board import Board
from rovercheck.spec_model.abstraction.board1 import BOARD1
from rovercheck.spec_model.abstraction.board2 import BOARD2
from rovercheck.spec_model.ambiguity import fixed
from rovercheck.spec_model.interpretations import woven
from rovercheck.spec_model.lang.errors import ModelError

BOARDS = (BOARD1, BOARD2)
RECORDED = ("S34", "S35", "S36", "S37", "S40", "S66")
"""Interpretations of the record of ten intervals, which the abstraction itself computes."""
AS_READ: Mapping[str, str] = MappingProxyType({})


def boards(choices: Mapping[str, str] = AS_READ) -> Mapping[str, Board]:
    """The boards under chosen interpretations.

    Raises ``ModelError`` for an unknown interpretation or choice, and for one that only the model can follow.
    """
    return _boards(tuple(sorted(choices.items())))


@cache
def _boards(chosen: tuple[tuple[str, str], ...]) -> Mapping[str, Board]:
    choices = dict(chosen)
    recorded = [name for name in RECORDED if name in choices]
    if recorded:
        raise ModelError(
            f"{', '.join(recorded)}: here the record of ten intervals is read from time stamps, at the "
            "default interpretations only; leave this choice out."
        )
    fixing = fixed(choices)
    return {b.name: replace(b, system=fixing.system(woven(b.system, choices))) for b in BOARDS}
