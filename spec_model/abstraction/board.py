"""What a board is to its firmware: named concrete inputs and outputs, and how the charts see them.

A number of a snapshot enters the charts as it was measured, exactly, whether or not it is one of the
representative values of the model; a time stamp enters as an age and as an update.
"""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from math import isfinite
from typing import Protocol, cast

from rovercheck.spec_model.lang.domain import Bool, Domain, Enum, Num, exact
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.evaluate import evaluate
from rovercheck.spec_model.lang.expr import FALSE, Expr, Var
from rovercheck.spec_model.lang.system import System

Value = bool | int | float
"""A concrete value: a boolean, a whole number (also the number of an enumeration's member) or a float."""

Values = Mapping[str, Value]
Raw = int | Fraction
"""A raw value; a fraction lies between two values of the domain."""


def computed(values: Mapping[str, Raw]) -> dict[str, int]:
    """Raw values as evaluation takes them: every operator computes with fractions as with integers."""
    return cast(dict[str, int], dict(values))


@dataclass(frozen=True)
class BoardSignal:
    """A concrete quantity of the firmware, by the document's name.

    ``domain`` has its sort, its unit and its representative values; firmware may hold every number from
    ``low`` to ``high``, in units (whole ones only if ``whole``).  ``stamp`` marks a time in ms of the
    board's 32-bit clock, which has no domain of its own.
    """

    name: str
    domain: Domain
    initial: Value
    doc: str = ""
    low: float = 0.0
    high: float = 0.0
    whole: bool = False
    stamp: bool = False

    def raw(self, value: Value) -> Raw:
        """The value as charts compute with it.  Raises ``ModelError`` for one that firmware cannot hold."""
        if not isfinite(value):
            raise ModelError(
                f"{self.name} = {value}: the charts give no meaning to what is no finite number."
            )
        match self.domain.sort:
            case Bool() | Enum():
                if value != int(value) or int(value) not in self.domain:
                    raise ModelError(f"{self.name} = {value} is outside {self.domain}.")
                return int(value)
            case Num(resolution, _):
                if not self.low <= value <= self.high:
                    raise ModelError(f"{self.name} = {value} is outside {self.low:g}..{self.high:g}.")
                return whole(exact(value) / resolution)

    def show(self, value: Value) -> str:
        """The value as a person writes it: a member's name, ``true``, a number."""
        if not isfinite(value):
            return str(value)
        match self.domain.sort:
            case Enum() as enum if value == int(value) and int(value) in self.domain:
                return enum.member(int(value))
            case Bool() if value in (0, 1):
                return "true" if value else "false"
        return f"{value:g}"


def whole(value: Fraction) -> Raw:
    """An integer where the fraction is one: arithmetic on integers is much quicker."""
    return value.numerator if value.denominator == 1 else value


def units(domain: Domain, raw: Raw) -> Value:
    """The concrete value of a raw one."""
    match domain.sort:
        case Bool():
            return bool(raw)
        case Enum():
            return int(raw)
        case Num(resolution, _):
            value = raw * resolution
            return int(value) if value.denominator == 1 else float(value)


@dataclass(frozen=True)
class Output:
    """A quantity that the firmware produces, and the chart variable it must equal.

    ``unless``: where this holds after the step, the charts give the variable up and nothing is required.
    """

    signal: BoardSignal
    var: Var
    unless: Expr = FALSE

    @property
    def name(self) -> str:
        return self.signal.name

    def expected(self, after: Mapping[str, int]) -> Value | None:
        """What the firmware must produce, given the state of the charts; ``None``: anything."""
        if evaluate(self.unless, after):
            return None
        return units(self.var.domain, after[self.var.name])


class BoardReader(Protocol):
    """The inputs of the charts from those of the firmware, step by step from power-up."""

    def step(self, inputs: Values) -> dict[str, int]:
        """Raw inputs of the charts.  Raises ``ModelError`` for a value that the charts give no meaning to."""
        ...


class Writer(Protocol):
    """Concrete inputs that a run of the model stands for, step by step from power-up."""

    def step(self, at: Mapping[str, int]) -> dict[str, Value]:
        """The inputs of a step whose state, inputs included, is ``at`` afterwards.

        What the model does not know keeps its initial value.
        """
        ...


@dataclass(frozen=True)
class Board:
    """A board: its charts without environment, and the concrete signals around them.

    The inputs of ``system`` are what ``reader`` computes.  ``grid_ms``: all stamps are multiples of it
    after the first step, or 1 if stamps may lie anywhere.  ``prefix`` begins the names of this board's
    variables in the systems of both boards.
    """

    name: str
    system: System
    inputs: tuple[BoardSignal, ...]
    outputs: tuple[Output, ...]
    reader: Callable[[], BoardReader]
    writer: Callable[[], Writer]
    grid_ms: int

    def at_power_up(self) -> dict[str, Value]:
        """The inputs before anything was measured or received."""
        return {s.name: s.initial for s in self.inputs}

    def expected(self, after: Mapping[str, int]) -> dict[str, Value]:
        """The outputs that the charts require in a state; what they leave open is left out."""
        found = {o.name: o.expected(after) for o in self.outputs}
        return {name: value for name, value in found.items() if value is not None}

    def run(self, model: Iterator[Mapping[str, int]]) -> Iterator[dict[str, Value]]:
        """The concrete inputs of a run of any system that has this board's environment, tick by tick."""
        writer = self.writer()
        return (writer.step(at) for at in model)


def in_steps_of(board: Board, system: System, at: Mapping[str, int]) -> dict[str, int]:
    """The state with each number in the resolution that it has on the board: systems differ in grids."""
    found = dict(at)
    for name, there in {**system.written, **system.inputs}.items():
        here = board.system.inputs.get(name)
        if here is not None and name in at and isinstance(here.sort, Num) and isinstance(there.sort, Num):
            found |= computed({name: whole(at[name] * there.sort.resolution / here.sort.resolution)})
    return found
