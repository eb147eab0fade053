"""The interface of a board as one table: signals, what the charts see of each, where firmware holds it.

The reader and the writer of a board, the decoder of its logs, the places in firmware and the surroundings of
stimuli are all derived from these rows.
"""

from collections.abc import Iterable, Iterator, Mapping
from copy import deepcopy
from dataclasses import dataclass, replace
from enum import StrEnum
from functools import cached_property

from rovercheck.spec_model.abstraction.readings import AGES, StampReading, StampsTaken
from rovercheck.spec_model.abstraction.signals import (
    BoardSignal,
    Output,
    Raw,
    Value,
    Values,
    computed,
    units,
    whole,
)
from rovercheck.spec_model.abstraction.stamps import NOW, MeanOfTen, Stamp, Updates, age, since
from rovercheck.spec_model.environment.jitter import step_ms
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.system import TICK_MS


class Carriage(StrEnum):
    """How a signal enters the charts."""

    SAMPLE = "sample"
    """As it was measured."""
    AGE = "age"
    """A stamp as the time since it, in ticks."""
    ADVANCE = "advance"
    """A stamp as the ms by which it has advanced since the step before."""
    UPDATE = "update"
    """A stamp as whether it is new."""
    SLOW = "slow"
    """A stamp as whether the mean of its last ten intervals is too long."""


@dataclass(frozen=True)
class Carried:
    """A variable of the charts that is made of a signal; ``mean_ms`` is the limit of a slow mean."""

    var: Var
    how: Carriage
    mean_ms: int = 0


@dataclass(frozen=True)
class ModelAge:
    """How systems of the model hold the age of a stamp, from which a run of theirs gets its stamps.

    From ``stops`` on, a raw age stands for all larger ones.  ``ms`` is the age of systems in which a stamp
    may lie at any ms.
    """

    var: Var
    stops: int
    ms: Var | None = None


@dataclass(frozen=True)
class InputRow:
    """An input of the firmware.

    ``place`` is where the supervisor of this project holds it, in Python.  ``arrives_with`` names the stamp
    of what it comes with, "" if it may change in any step.  ``rests_at`` is its value when nothing is wrong,
    ``in_charge_at`` that when the board also has the motors, each the initial one unless given.
    """

    signal: BoardSignal
    place: str
    carried: tuple[Carried, ...] = ()
    age: ModelAge | None = None
    arrives_with: str = ""
    rests_at: Value | None = None
    in_charge_at: Value | None = None

    def at(self, place: str) -> "InputRow":
        """The row with another place than the signal's name."""
        return replace(self, place=place)

    def inside(self, record: str) -> "InputRow":
        """The row with its place inside a record of the firmware."""
        return replace(self, place=f"{record}.{self.place}")


@dataclass(frozen=True)
class OutputRow:
    """An output of the firmware, and where the supervisor of this project holds it."""

    output: Output
    place: str


def clock() -> InputRow:
    """The time of the step itself."""
    signal = BoardSignal.stamped(NOW, "start of the step")
    return InputRow(signal, signal.name)


def sample(signal: BoardSignal, var: Var, arrives_with: str = "", rests_at: Value | None = None) -> InputRow:
    """A measurement or a message, which the charts see as it is."""
    return InputRow(signal, signal.name, (Carried(var, Carriage.SAMPLE),), None, arrives_with, rests_at)


def stamped(name: str, doc: str, age: ModelAge, *carried: Carried) -> InputRow:
    """A time stamp, and what the charts see of it."""
    signal = BoardSignal.stamped(name, doc)
    return InputRow(signal, name, carried, age)


def produced(outputs: Iterator[Output] | tuple[Output, ...], **places: str) -> tuple[OutputRow, ...]:
    """Rows of outputs, at places of their names unless others are given."""
    return tuple(OutputRow(o, places.get(o.name, o.name)) for o in outputs)


@dataclass(frozen=True)
class SignalView:
    """What the charts see of one signal in one way; ``taken``: how an age is held, if not as it is."""

    var: Var
    how: Carriage
    signal: BoardSignal
    mean_ms: int = 0
    taken: StampReading | None = None

    def age(self, now_ms: int, then_ms: int) -> Raw:
        """The raw age of the stamp."""
        if self.taken is None:
            return age(now_ms, then_ms)
        return whole(self.taken.age(since(now_ms, then_ms)) / TICK_MS)


@dataclass(frozen=True)
class BoardInterface:
    """The rows of a board, in the order in which inputs and outputs are shown.

    ``taken``: stamps that a variant of the board takes otherwise.
    """

    inputs: tuple[InputRow, ...]
    outputs: tuple[OutputRow, ...]
    taken: tuple[StampReading, ...] = ()

    @cached_property
    def views(self) -> tuple[SignalView, ...]:
        """All that the charts see: samples, then what is seen of the stamps, one way after the other."""
        every = [SignalView(c.var, c.how, row.signal, c.mean_ms) for row in self.inputs for c in row.carried]
        for one in self.taken:
            if one.of_age:
                own = [v for v in every if v.signal.name == one.stamp and v.how is Carriage.AGE]
                every += [replace(v, var=beside(v.var, one), taken=one) for v in own if v.taken is None]
        return tuple(v for how in Carriage for v in every if v.how is how)

    @cached_property
    def by_carriage(self) -> Mapping[Carriage, tuple[SignalView, ...]]:
        """What the charts see in each way."""
        return {how: tuple(v for v in self.views if v.how is how) for how in Carriage}

    def records(self) -> dict[str, MeanOfTen]:
        """The records of intervals by the variable that tells of them, each new, or one for two."""
        views = {v.signal.name: v for v in self.by_carriage[Carriage.SLOW]}
        found = {v.var.name: MeanOfTen(v.mean_ms) for v in views.values()}
        for one in self.taken:
            if one.other:
                first, second = views[one.other], views[one.stamp]
                found[first.var.name] = found[second.var.name] = MeanOfTen(first.mean_ms, one.bits)
        return found

    def __deepcopy__(self, memo: object) -> "BoardInterface":
        """Readers that are copied share their table."""
        return self

    @cached_property
    def arrivals(self) -> Mapping[str, tuple[str, ...]]:
        """What arrives with each stamp."""
        stamps = dict.fromkeys(row.arrives_with for row in self.inputs if row.arrives_with)
        return {s: tuple(r.signal.name for r in self.inputs if r.arrives_with == s) for s in stamps}

    @cached_property
    def resting(self) -> Mapping[str, Value]:
        """Values when nothing is wrong, of inputs that do not rest at their initial value."""
        return {r.signal.name: r.rests_at for r in self.inputs if r.rests_at is not None}

    @cached_property
    def in_charge(self) -> Mapping[str, Value]:
        """Values when nothing is wrong and the board has the motors, as far as they are not initial."""
        own = {r.signal.name: r.in_charge_at for r in self.inputs if r.in_charge_at is not None}
        return {**self.resting, **own}

    def places(self) -> tuple[dict[str, str], dict[str, str]]:
        """Where the supervisor of this project holds inputs and outputs, by name."""
        inputs = {r.signal.name: r.place for r in self.inputs}
        return inputs, {r.output.name: r.place for r in self.outputs}


def beside(age: Var, reading: StampReading) -> Var:
    """The variable for an age as another way holds it, beside the age itself."""
    number = list(AGES).index(reading.how) + 1
    return replace(age, name=f"{age.name}.single{number}", doc=f"{age.doc}, in single precision")


class InterfaceReader:
    """Ages, updates, gaps and means in place of stamps, and the measurements as they are.

    A step sees an update whenever in the tick before it the stamp was set.
    """

    def __init__(self, interface: BoardInterface, constants: Iterable[tuple[str, Raw]] = ()) -> None:
        self._interface, self._constants = interface, tuple(constants)
        by = interface.by_carriage
        self._advances = {v.var.name: Updates() for v in by[Carriage.ADVANCE]}
        self._updates = {v.var.name: Updates() for v in by[Carriage.UPDATE]}
        self._taken = StampsTaken(interface.taken)
        self._means = interface.records()

    def copy(self) -> "InterfaceReader":
        """One that goes on from here by itself; what remembers nothing is its own copy."""
        remembered = self._advances, self._updates, self._taken.names, self._means
        return deepcopy(self) if any(remembered) else self

    def step(self, inputs: Values) -> dict[str, int]:
        """Raw inputs of the charts.  Raises ``ModelError`` for a value that the charts give no meaning to."""
        now, by = int(inputs[NOW]), self._interface.by_carriage
        if names := self._taken.names:
            taken = self._taken.step({name: int(inputs[name]) for name in names}, now)
            inputs = {**inputs, **{name: stamp for name, stamp in taken.items() if stamp is not None}}
        at = {v.var.name: v.signal.raw(inputs[v.signal.name]) for v in by[Carriage.SAMPLE]}
        for v in by[Carriage.AGE]:
            at[v.var.name] = v.age(now, int(inputs[v.signal.name]))
        for v in by[Carriage.ADVANCE]:
            latest = int(inputs[v.signal.name])
            before = self._advances[v.var.name].step(latest)
            at[v.var.name] = 0 if before is None else since(latest, before)
        for v in by[Carriage.UPDATE]:
            at[v.var.name] = int(self._updates[v.var.name].step(int(inputs[v.signal.name])) is not None)
        for v in by[Carriage.SLOW]:
            at[v.var.name] = int(self._means[v.var.name].step(int(inputs[v.signal.name])))
        return computed({**at, **dict(self._constants)})


class InterfaceWriter:
    """Stamps in place of ages; a step of the model is one of the board, of ``tick_ms``."""

    def __init__(self, interface: BoardInterface, tick_ms: int = TICK_MS) -> None:
        self._now, self._tick_ms = 0, tick_ms
        self._ages = [(r.signal.name, r.age, Stamp()) for r in interface.inputs if r.age is not None]
        self._samples = [(v.signal, v.var) for v in interface.views if v.how is Carriage.SAMPLE]

    def step(self, at: Mapping[str, int]) -> dict[str, Value]:
        """The inputs of a step whose state, inputs included, is ``at`` afterwards.

        What the model does not know keeps its initial value.
        """
        self._now += at.get(step_ms.name, self._tick_ms)
        inputs: dict[str, Value] = {NOW: self._now}
        for name, held, stamp in self._ages:
            if held.ms is not None and held.ms.name in at:
                inputs[name] = stamp.step(self._now, at[held.ms.name], held.ms.domain.high, 1)
            else:
                inputs[name] = stamp.step(self._now, at.get(held.var.name, 0), held.stops)
        for signal, var in self._samples:
            known = var.name in at
            inputs[signal.name] = units(var.domain, at[var.name]) if known else signal.initial
        return inputs
