"""What comes of checking a certificate, and the words for a state that refutes it."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Union

from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import Var


@dataclass(frozen=True)
class Accepted:
    """Every obligation is met; ``how`` says who showed it."""

    how: str


@dataclass(frozen=True)
class Rejected:
    """The certificate proves nothing: which obligation it does not meet, and what shows that."""

    obligation: str
    shown: str


@dataclass(frozen=True)
class Undecided:
    """Neither could be shown; the reason."""

    reason: str


@dataclass(frozen=True)
class TooMuch:
    """One way of checking would take too long, or does not apply; the reason."""

    reason: str


Outcome = Union[Accepted, Rejected, Undecided]


def assignment_text(variables: Iterable[Var], values: Mapping[str, int]) -> str:
    """``mode = IDLE, age = 140``: the variables that have a value, in their own terms."""
    return ", ".join(f"{v.name} = {_shown(v, values[v.name])}" for v in variables if v.name in values)


def _shown(var: Var, raw: int) -> str:
    try:
        return var.domain.show(raw)
    except ModelError:  # a value that is none of the domain's
        return str(raw)
