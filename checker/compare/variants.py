"""Boards whose charts are changed: other interpretations of the document, a proposed repair."""

from collections.abc import Mapping
from dataclasses import replace

from rovercheck.spec_model.abstraction import Board, boards
from rovercheck.spec_model.ambiguity import ANY, fixed
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.repairs import Repair, repaired


def varied(choices: Mapping[str, str], repair: Repair | None = None) -> Mapping[str, Board]:
    """Every board under chosen interpretations, with a repair.

    Raises ``ModelError`` for interpretations that are left open or that boards cannot follow.
    """
    for id, choice in choices.items():
        if choice == ANY:
            raise ModelError(
                f"{id}={ANY} leaves the sentence open, and what a board did is compared with charts that "
                "read it in one way; write one of the choices that `rovercheck list interpretations` shows."
            )
    found = boards(choices)
    if repair is None:
        return found
    fixing = fixed(choices)
    return {n: replace(b, system=fixing.system(repaired(b.system, repair))) for n, b in found.items()}
