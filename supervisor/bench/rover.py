"""The rover itself: a driver that obeys one board at a time, four motors, and the motion that they make.

Each wheel comes nearer to what is asked of it as a motor with a single time constant does.  The rover turns
with the difference of its sides, by the same constant with which Board 2 judges coherence, and drives with
their mean; a blocked wheel slides.
"""

from dataclasses import dataclass, field
from math import pi

from rovercheck.supervisor.bench.conditions import WHEELS
from rovercheck.supervisor.bench.record import Driver, Sample, Side
from rovercheck.supervisor.bench.scenario import Scenario
from rovercheck.supervisor.board2.coherence import WHEEL_RADIUS_M, wheel_yaw_rate

STEP_US = 1000
MOTOR_US = 120_000
"""Time constant of a motor."""
STANDS_RPM = 0.05
"""A wheel that is asked to stand and is slower than this does."""
DRIVER_TIMEOUT_US = 300_000
TURN_M = 2 * pi * WHEEL_RADIUS_M
"""Way of one turn of a wheel."""


@dataclass
class MotorDriver:
    """Takes commands from the board that the relay connects; stands without one for 300 ms."""

    relay: Side = Side.BOARD_2
    stop_pins: dict[Side, bool] = field(default_factory=lambda: dict.fromkeys(Side, True))
    """Whether the stop pin of each board is at stop level, as before its first step."""
    _source: Side | None = None
    _command: tuple[float, float] = (0.0, 0.0)
    _since_us: int = 0

    def command(self, board: Side, left_rpm: float, right_rpm: float, time_us: int) -> None:
        """A board sends the speeds of both sides."""
        if board is self.relay:
            self._source, self._command, self._since_us = board, (left_rpm, right_rpm), time_us

    @property
    def stopped(self) -> bool:
        """Whether the connected board holds the motors by its stop pin."""
        return self.stop_pins[self.relay]

    def source(self, time_us: int) -> Driver:
        """Whose command is in force."""
        if self._source is None or time_us - self._since_us >= DRIVER_TIMEOUT_US:
            return Driver.NOBODY
        return Driver(self._source)

    def wanted(self, time_us: int) -> tuple[float, float]:
        """The speeds of the left and of the right wheels that the motors are driven to."""
        if self.stopped or self.source(time_us) is Driver.NOBODY:
            return 0.0, 0.0
        return self._command


@dataclass
class Rover:
    """The motion from step to step."""

    scenario: Scenario
    driver: MotorDriver = field(default_factory=MotorDriver)
    wheels: list[float] = field(default_factory=lambda: [0.0] * len(WHEELS))
    heading: float = 0.0
    yaw_rate: float = 0.0
    speed: float = 0.0
    travelled: float = 0.0

    def step(self, time_us: int) -> None:
        """The millisecond that ends now."""
        left, right = self.driver.wanted(time_us)
        for place, wanted in enumerate((left, right, left, right)):
            self.wheels[place] = self._wheel(place, wanted, time_us)
        grip = self.scenario.number("grip", time_us)
        self.yaw_rate = grip * wheel_yaw_rate(self.wheels)
        self.speed = sum(self.wheels) / len(WHEELS) / 60 * TURN_M
        self.heading = (self.heading + self.yaw_rate * STEP_US / 10**6) % 360
        self.travelled += self.speed * STEP_US / 10**6

    def _wheel(self, place: int, wanted: float, time_us: int) -> float:
        if self.scenario.at(f"wheel_{WHEELS[place]}", time_us) == "blocked":
            return 0.0
        speed = self.wheels[place]
        speed += (wanted - speed) * (STEP_US / MOTOR_US)
        return 0.0 if wanted == 0 and abs(speed) < STANDS_RPM else speed

    def sample(self, time_us: int) -> Sample:
        """What it does now."""
        left, right = self.driver.wanted(time_us)
        fl, fr, rl, rr = self.wheels
        return Sample(
            time_us,
            wheel_FL=fl,
            wheel_FR=fr,
            wheel_RL=rl,
            wheel_RR=rr,
            left_rpm=left,
            right_rpm=right,
            heading=self.heading,
            yaw_rate=self.yaw_rate,
            speed=self.speed,
            travelled=self.travelled,
            relay=self.driver.relay,
            driven_by=self.driver.source(time_us),
            stop_level=self.driver.stopped,
        )
