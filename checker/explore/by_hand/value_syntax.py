"""What people write for a variable and its value, read as they mean it, or refused in words that help."""

from collections.abc import Mapping

from rovercheck.spec_model.lang.domain import Bool, Enum
from rovercheck.spec_model.lang.errors import ModelError, did_you_mean
from rovercheck.spec_model.lang.expr import Var


class RefusedInput(Exception):
    """What a person asked for is not possible here; the sentence says why, and what is."""


def outside(var: Var, written: str) -> str:
    """That a value is none of a variable's."""
    return f"{var.name} = {written} is outside its domain, {var.domain}."


def variable(name: str, known: Mapping[str, Var], kind: str) -> Var:
    """The variable of that name.  Raises ``RefusedInput`` with the nearest names."""
    if name not in known:
        raise RefusedInput(f"There is no {kind} {name!r}. {did_you_mean(name, known)}")
    return known[name]


def value(var: Var, written: str) -> int:
    """The raw value of what a person wrote.  Raises ``RefusedInput`` outside the domain."""
    try:
        if isinstance(var.sort, Bool) and written.lower() not in ("true", "false", "0", "1"):
            raise RefusedInput(f"{var.name} = {written}: {var.name} is a boolean; write true or false.")
        if isinstance(var.sort, Enum) and written.lstrip("-").isdigit():
            return var.domain.raw(int(written))
        return var.domain.raw(written.lower() if isinstance(var.sort, Bool) else written)
    except ModelError as error:
        raise RefusedInput(f"{var.name} = {written}: {error}") from None
    except (ValueError, ZeroDivisionError):
        raise RefusedInput(f"{var.name} = {written} is no number; {var.name} is {var.domain}.") from None
