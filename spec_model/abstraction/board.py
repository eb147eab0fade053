"""What a board is to its firmware: named concrete inputs and outputs, and how the charts see them.

A number of a snapshot enters the charts as it was measured, exactly, whether or not it is one of the
representative values of the model; a time stamp enters as an age and as an update.
"""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property

from rovercheck.spec_model.abstraction.interface import (
    BoardInterface,
    Carriage,
    InterfaceReader,
    InterfaceWriter,
)
from rovercheck.spec_model.abstraction.readings import StampReading
from rovercheck.spec_model.abstraction.signals import BoardSignal, Output, Raw, Value, computed, whole
from rovercheck.spec_model.lang.domain import Num
from rovercheck.spec_model.lang.system import System


@dataclass(frozen=True)
class Board:
    """A board: its charts without environment, and the concrete signals around them.

    The inputs of ``system`` are what ``interface`` carries, and ``constants``: raw values that no signal
    gives.  ``grid_ms``: all stamps are multiples of it after the first step, or 1 if stamps may lie
    anywhere.  ``supervisor`` is the one of this project, ``KIND:WHAT``, which is run unless another is
    named; ``model`` the file or folder of a user's own model.
    """

    name: str
    system: System
    interface: BoardInterface
    grid_ms: int
    supervisor: str = ""
    model: str = ""
    constants: tuple[tuple[str, Raw], ...] = ()

    @property
    def tick_ms(self) -> int:
        """The time from one step to the next."""
        return self.system.tick_ms

    @cached_property
    def inputs(self) -> tuple[BoardSignal, ...]:
        """The inputs of the firmware, the clock first."""
        return tuple(row.signal for row in self.interface.inputs)

    @cached_property
    def outputs(self) -> tuple[Output, ...]:
        """What the firmware produces, and the charts require."""
        return tuple(row.output for row in self.interface.outputs)

    def reader(self) -> InterfaceReader:
        """The inputs of the charts from those of the firmware, step by step from power-up."""
        return InterfaceReader(self.interface, self.constants)

    def writer(self) -> InterfaceWriter:
        """Concrete inputs that a run of the model stands for, step by step from power-up."""
        return InterfaceWriter(self.interface, self.tick_ms)

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


def with_readings(board: Board, readings: Iterable[StampReading]) -> Board:
    """The board with stamps taken otherwise."""
    interface = board.interface
    return replace(board, interface=replace(interface, taken=(*interface.taken, *readings)))


def made_of(board: Board, reading: StampReading) -> tuple[str, ...]:
    """The variables of the charts that are otherwise if a stamp is: all that are made of it.

    Those are what tells of the means, too, of all stamps that go into one record with it.
    """
    if reading.of_age:
        views = with_readings(board, [reading]).interface.views
        return tuple(v.var.name for v in views if v.taken == reading)
    shared = [{one.stamp, one.other} for one in (*board.interface.taken, reading) if one.other]
    together = set[str]().union(*(pair for pair in shared if reading.stamp in pair))
    stamps = () if reading.other else (reading.stamp,)
    return tuple(
        v.var.name
        for v in board.interface.views
        if v.how is not Carriage.SAMPLE
        and (v.signal.name in stamps or (v.how is Carriage.SLOW and v.signal.name in together))
    )


def in_steps_of(board: Board, system: System, at: Mapping[str, int]) -> dict[str, int]:
    """The state with each number in the resolution that it has on the board: systems differ in grids."""
    found = dict(at)
    for name, there in {**system.written, **system.inputs}.items():
        here = board.system.inputs.get(name)
        if here is not None and name in at and isinstance(here.sort, Num) and isinstance(there.sort, Num):
            found |= computed({name: whole(at[name] * there.sort.resolution / here.sort.resolution)})
    return found
