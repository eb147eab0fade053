"""Past-time logic: what a form of properties says of a tick, from the formulas in it and the ticks so far.

It is stated once, and read twice: as monitors for engines (``properties.reduce``) and on the rows of a log
(``checker.logs.form_monitors``).
"""

from abc import ABC, abstractmethod
from typing import Any, Protocol, TypeVar

from rovercheck.spec_model.lang.expr import Expr
from rovercheck.spec_model.lang.time import Span


class Truth(Protocol):
    """What is true or false in a tick, or in each of many."""

    def __and__(self, other: Any, /) -> Any: ...
    def __or__(self, other: Any, /) -> Any: ...
    def __invert__(self) -> Any: ...


T = TypeVar("T", bound=Truth)


class Past(Protocol[T]):
    """What a form says of a tick, from the formulas in it and from the ticks so far.

    Before the first tick nothing was true.  The words are those of past-time logic with metric bounds
    (Havelund, Rosu, *Synthesizing Monitors for Safety Properties*, TACAS 2002).
    """

    @property
    def armed(self) -> T:
        """The property is required in this tick."""

    def __call__(self, formula: Expr, /) -> T:
        """The formula is true in this tick."""

    def previous(self, that: T, /) -> T:
        """It was true in the tick before."""

    def once(self, that: T, /) -> T:
        """It is or was true in some tick."""

    def held(self, that: T, for_: Span, /) -> T:
        """If this is tick k+for_, it was true in every tick of k..k+for_."""

    def within(self, that: T, for_: Span, /) -> T:
        """It was true in some tick k, and this is one of k..k+for_."""

    def since(self, start: T, release: T, /) -> T:
        """The start is or was true, and in no tick from that one to this one was the release."""

    def overdue(self, trigger: T, response: T, within: Span, /) -> T:
        """``held(since(trigger, response), within)``.

        Where ticks last unlike times and the length is in ms, a response in this tick may come too late.
        """


def begins(past: Past[T], that: T) -> T:
    """It is true in this tick, and was not in the one before."""
    found: T = ~past.previous(that) & that
    return found


Implication = tuple[Expr | None, Expr | None]


class Bounded(ABC):
    """A form that a finite run breaks (or that it reaches): always a formula about the past."""

    @abstractmethod
    def monitor(self, past: Past[T]) -> tuple[T, T]:
        """Whether the form is put to the test in a tick, and whether it is broken (or reached) in it."""

    @abstractmethod
    def implication(self) -> Implication:
        """In which case the form asks for anything, if that is not in every tick, and what is false where it
        is broken, if it is not to be reached."""

    @property
    def case(self) -> Expr | None:
        return self.implication()[0]

    @property
    def wanted(self) -> Expr | None:
        return self.implication()[1]
