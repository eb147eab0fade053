"""What every reader of an exported file offers: to run the machine in it, tick by tick."""

from collections.abc import Mapping
from typing import Protocol

Values = Mapping[str, int]


class Machine(Protocol):
    """A machine read from a file.  Variables and bad states have the names of the file."""

    @property
    def bad(self) -> tuple[str, ...]:
        """The names of the bad states."""
        ...

    def start(self, frozen: Values) -> None:
        """Before the first tick, with these frozen values."""
        ...

    def tick(self, inputs: Values) -> tuple[bool, dict[str, bool]]:
        """Whether the inputs are admissible, and which states are bad; moves on if they are."""
        ...


def wrapped(value: int, bits: int) -> int:
    """The signed number that so many low bits stand for."""
    value &= (1 << bits) - 1
    return value - (1 << bits) if value >> bits - 1 else value
