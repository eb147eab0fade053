"""The contract of an implementation under test: reset and step over named concrete values."""

from collections.abc import Mapping, Sequence
from typing import Protocol, runtime_checkable

Value = bool | int | float
"""A concrete value as firmware holds it: a boolean, an integer (also for enumerations) or a float."""

Values = Mapping[str, Value]
"""Concrete values by the names that ``spec_model.abstraction`` gives the signals of a board."""


KEPT = "kept:"
"""Before the name of an input that a place could not hold and was not given, in answers to odd inputs."""


class ImplementationError(Exception):
    """The implementation under test could not be run: it is missing something, crashed, hung or spoke
    garbage.

    The message says what was tried, at which step, and what to look at; it is shown to the user as it is.
    ``step`` is that step, counted from power-up, which is 0.
    """

    def __init__(self, message: str, step: int = 0) -> None:
        super().__init__(message)
        self.step = step


class Implementation(Protocol):
    """One implementation of a board, started and at power-up.

    Every adapter gives one of these.  ``reset`` returns to power-up.  ``step`` gives the concrete inputs of
    one execution, all inputs of the board, and returns its outputs by name; it may leave out outputs that
    the implementation does not have, which are then not compared.  ``close`` ends whatever runs outside; it
    may be called twice.  All three raise ``ImplementationError``.
    """

    def reset(self) -> None: ...

    def step(self, inputs: Values) -> Values: ...

    def close(self) -> None: ...


@runtime_checkable
class BatchImplementation(Protocol):
    """An implementation that is quicker when it is given many executions at once."""

    def run(self, inputs: Sequence[Values]) -> Sequence[Values]: ...


def run(implementation: Implementation, inputs: Sequence[Values]) -> Sequence[Values]:
    """The outputs of executions in a row, as ``step`` gives them one by one.

    Raises ``ImplementationError`` for the first execution that fails; the outputs before it are then lost.
    """
    if isinstance(implementation, BatchImplementation):
        return implementation.run(inputs)
    return [implementation.step(one) for one in inputs]


def notes(implementation: Implementation) -> Sequence[str]:
    """What a person should know about how it is run: warnings of a compiler, inputs that it does not read.

    Of several lines the first says it in short, and the others at length.
    """
    found: Sequence[str] = getattr(implementation, "notes", ())
    return found
