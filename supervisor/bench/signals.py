"""The signals of a run by name, and the values that a scenario may expect of them."""

from collections.abc import Mapping
from dataclasses import dataclass
from enum import IntEnum
from types import MappingProxyType

from rovercheck.supervisor.bench.columns import Scalar, inputs1, inputs2, outputs1, outputs2
from rovercheck.supervisor.bench.errors import ScenarioError, nearest, quoted
from rovercheck.supervisor.bench.record import Sample
from rovercheck.supervisor.bench.table import number, truth
from rovercheck.supervisor.board1 import Board1Inputs, Board1Outputs
from rovercheck.supervisor.board2.signals import Board2Inputs, Board2Outputs

__all__ = ["SIGNALS", "Scalar", "Signal", "name_of", "parse_value", "pick_signal"]


@dataclass(frozen=True)
class Signal:
    """A signal by its sort: a truth value, an enumeration, or a number."""

    initial: Scalar

    @property
    def is_number(self) -> bool:
        """Whether it may be compared with bounds."""
        return not isinstance(self.initial, bool | IntEnum)


_AT_POWER_UP: Mapping[str, Mapping[str, Scalar]] = {
    "board1": inputs1(Board1Inputs()) | outputs1(Board1Outputs()),
    "board2": inputs2(Board2Inputs()) | outputs2(Board2Outputs()),
    "rover": Sample(0).columns(),
}
SIGNALS: Mapping[str, Signal] = MappingProxyType(
    {
        f"{place}.{name}": Signal(value)
        for place, columns in _AT_POWER_UP.items()
        for name, value in columns.items()
    }
)
"""Every column of both boards, and what the rover itself does."""


def pick_signal(path: str, name: object) -> Signal:
    """The signal of that name; ScenarioError if there is none."""
    if isinstance(name, str) and name in SIGNALS:
        return SIGNALS[name]
    near = nearest(str(name), SIGNALS) if isinstance(name, str) else ""
    if not near.startswith("Did"):
        near = "Write board1., board2. or rover. and the name of a column of its log."
    raise ScenarioError(path, f"there is no signal {quoted(name)}. {near}")


def parse_value(path: str, signal: Signal, written: object) -> Scalar:
    """The value of the signal that is written; ScenarioError for one that it cannot have."""
    if isinstance(signal.initial, IntEnum):
        members = type(signal.initial).__members__
        if isinstance(written, str) and written in members:
            return members[written]
        raise ScenarioError(path, f"{quoted(written)} is no value of it. {nearest(str(written), members)}")
    return truth(path, written) if isinstance(signal.initial, bool) else number(path, written)


def name_of(value: Scalar) -> str:
    """A value as a person reads it."""
    if isinstance(value, IntEnum):
        return value.name
    if isinstance(value, bool):
        return "true" if value else "false"
    return f"{value:g}"
