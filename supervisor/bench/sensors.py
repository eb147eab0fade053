"""What Board 2 measures: the sonars, the IMU and the joystick, as their tasks acquire them."""

from collections.abc import Callable
from dataclasses import dataclass, field

from rovercheck.supervisor.bench.conditions import SIDES
from rovercheck.supervisor.bench.scenario import Scenario
from rovercheck.supervisor.board2.distances import Distances

SCAN_US = 20_000
"""Longest wait for the echoes of a scan."""
US_PER_CM = 58
"""Width of an echo pulse."""
NO_ECHO_CM = 301
NOISE_DPS = 0.3
"""A yaw rate up to this is taken for noise."""
PERIOD_S = 0.02
"""What the IMU task takes for the time between two reads."""
DEAD_ZONE = 0.1
"""A joystick axis up to this is centred."""


@dataclass
class Sonars:
    """Three HC-SR04, triggered together [spec §1.3.1]."""

    dist_cm: Distances = (0.0, 0.0, 0.0)
    last_valid_ms: int = 0

    def publish(self, dist_cm: Distances, now_ms: int) -> None:
        """The end of a scan."""
        self.dist_cm, self.last_valid_ms = dist_cm, now_ms


def scan(scenario: Scenario, time_us: int) -> tuple[Distances, int]:
    """What a scan that begins now finds, in whole cm, and the microseconds that it takes.

    It ends with the last of three echoes, or when there was time enough for all.
    """
    widths = [scenario.number(f"obstacle_{side}", time_us) * US_PER_CM for side in SIDES]
    heard = [width <= SCAN_US for width in widths]
    left, centre, right = (
        float(width // US_PER_CM) if echo else float(NO_ECHO_CM)
        for width, echo in zip(widths, heard, strict=True)
    )
    return (left, centre, right), int(max(widths)) if all(heard) else SCAN_US


@dataclass
class Imu:
    """Heading since power-up, by adding up the yaw rate."""

    yaw: float = 0.0
    gz_dps: float = 0.0
    last_valid_ms: int = 0

    def read(self, yaw_rate: float, now_ms: int) -> None:
        """A good read."""
        self.gz_dps, self.last_valid_ms = yaw_rate, now_ms
        if abs(yaw_rate) > NOISE_DPS:
            self.yaw = (self.yaw + yaw_rate * PERIOD_S) % 360


@dataclass
class Joystick:
    """The axes behind their dead zone, and the buttons."""

    x_norm: float = 0.0
    y_norm: float = 0.0
    btn1: bool = False
    btn2: bool = False
    last_valid_ms: int = 0

    def read(self, scenario: Scenario, time_us: int, now_ms: int) -> None:
        """A complete read."""
        self.x_norm = _axis(scenario.number("stick_x", time_us))
        self.y_norm = _axis(scenario.number("stick_y", time_us))
        self.btn1 = scenario.at("btn1", time_us) is True
        self.btn2 = scenario.at("btn2", time_us) is True
        self.last_valid_ms = now_ms


def _axis(value: float) -> float:
    return value if abs(value) >= DEAD_ZONE else 0.0


@dataclass
class Sensors:
    """All of them, each silent when a scenario says so."""

    scenario: Scenario
    sonars: Sonars = field(default_factory=Sonars)
    imu: Imu = field(default_factory=Imu)
    joystick: Joystick = field(default_factory=Joystick)

    def start_scan(self, time_us: int, publish_at: Callable[[int, Distances], None]) -> None:
        """Trigger the sonars; ``publish_at`` takes the time of the end and what was found."""
        if self.scenario.at("sonars", time_us) == "ok":
            dist_cm, takes_us = scan(self.scenario, time_us)
            publish_at(time_us + takes_us, dist_cm)

    def read_imu(self, time_us: int, now_ms: int, yaw_rate: float) -> None:
        """One run of the IMU task."""
        if self.scenario.at("imu", time_us) == "ok":
            self.imu.read(yaw_rate, now_ms)

    def read_joystick(self, time_us: int, now_ms: int) -> None:
        """One run of the joystick task."""
        if self.scenario.at("joystick", time_us) == "ok":
            self.joystick.read(self.scenario, time_us, now_ms)
