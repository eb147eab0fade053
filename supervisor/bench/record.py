"""What is kept of a run: every step of both boards, the motion of the rover, and the frames of the link."""

from collections import Counter
from dataclasses import dataclass, field, fields
from enum import IntEnum

from rovercheck.supervisor.bench.columns import Scalar
from rovercheck.supervisor.board1 import Board1Inputs, Board1Outputs
from rovercheck.supervisor.board2.signals import Board2Inputs, Board2Outputs

SAMPLE_US = 10_000
"""Time between two samples of the rover; more are taken when who drives changes."""


class Driver(IntEnum):
    """Whose command the motors follow."""

    NOBODY = 0
    BOARD_1 = 1
    BOARD_2 = 2


class Side(IntEnum):
    """The board that the relay connects to the motor line."""

    BOARD_1 = 1
    BOARD_2 = 2


@dataclass(frozen=True, slots=True)
class Step1:
    """An execution of the supervisor of Board 1, at a time of the scenario."""

    time_us: int
    inputs: Board1Inputs
    outputs: Board1Outputs


@dataclass(frozen=True, slots=True)
class Step2:
    """An execution of the supervisor of Board 2, at a time of the scenario."""

    time_us: int
    inputs: Board2Inputs
    outputs: Board2Outputs


@dataclass(frozen=True, slots=True)
class Sample:
    """What the rover really does at a time, whatever the boards know of it."""

    time_us: int
    wheel_FL: float = 0.0
    """Speed of a wheel in rpm, positive forward."""
    wheel_FR: float = 0.0
    wheel_RL: float = 0.0
    wheel_RR: float = 0.0
    left_rpm: float = 0.0
    """What the driver asks of the left wheels."""
    right_rpm: float = 0.0
    heading: float = 0.0
    """Degrees in [0;360[, clockwise positive, 0 at the start."""
    yaw_rate: float = 0.0
    """Degrees per second, clockwise positive."""
    speed: float = 0.0
    """Metres per second, forward positive."""
    travelled: float = 0.0
    """Metres along the path; backward ones count as negative."""
    relay: Side = Side.BOARD_2
    driven_by: Driver = Driver.NOBODY
    stop_level: bool = True
    """Whether the stop pin of the connected board is at stop level."""

    @property
    def switches(self) -> tuple[Side, Driver, bool]:
        """Who drives, and whether the rover is held."""
        return self.relay, self.driven_by, self.stop_level

    def columns(self) -> dict[str, Scalar]:
        """Everything but the time, by name."""
        return {f.name: getattr(self, f.name) for f in fields(self) if f.name != "time_us"}


@dataclass
class Traffic:
    """The frames of one direction of the link."""

    sent: int = 0
    dropped: int = 0
    """Not sent, because the frame before was still on its way out."""
    accepted: int = 0
    refused: Counter[str] = field(default_factory=Counter)
    """By reason; what the line damaged or lost in part may also be seen as no frame at all."""


@dataclass
class Record:
    """A run as it was."""

    board1: list[Step1] = field(default_factory=list)
    board2: list[Step2] = field(default_factory=list)
    samples: list[Sample] = field(default_factory=list)
    b1_to_b2: Traffic = field(default_factory=Traffic)
    b2_to_b1: Traffic = field(default_factory=Traffic)
