"""What Board 1 measures: temperature and charge, and the speeds of the wheels."""

from collections.abc import Sequence
from dataclasses import dataclass, field

from rovercheck.supervisor.bench.conditions import WHEELS
from rovercheck.supervisor.bench.scenario import Scenario

Four = tuple[float, float, float, float]
RESOLUTION_RPM = 0.5
"""Below this an encoder reads 0."""
VALID_COMMAND_RPM = 5.0
"""A command above this is expected to turn a wheel."""


@dataclass
class Health:
    """The snapshot of temperature and battery, each with the time of its last valid reading."""

    temperature_degc: float = 0.0
    battery_pct: float = 0.0
    temp_last_valid_ms: int = 0
    batt_last_valid_ms: int = 0

    def read(self, scenario: Scenario, time_us: int, now_ms: int) -> None:
        """One run of the task; a silent sensor leaves value and time as they were."""
        if scenario.at("temperature_sensor", time_us) == "ok":
            self.temperature_degc = scenario.number("temperature", time_us)
            self.temp_last_valid_ms = now_ms
        if scenario.at("battery_sensor", time_us) == "ok":
            self.battery_pct = scenario.number("battery", time_us)
            self.batt_last_valid_ms = now_ms


@dataclass
class Encoders:
    """The snapshot of the wheel speeds, and which wheel reads 0 rpm under a valid command (S32)."""

    wheel_speed_rpm: Four = (0.0, 0.0, 0.0, 0.0)
    has_no_feedback: tuple[bool, bool, bool, bool] = field(default=(False, False, False, False))

    def read(
        self, scenario: Scenario, time_us: int, wheels: Sequence[float], commanded: tuple[float, float]
    ) -> None:
        """One cycle; ``commanded`` are the speeds that Board 1 sent to both sides in the cycle before."""
        states = [scenario.at(f"encoder_{wheel}", time_us) for wheel in WHEELS]
        fl, fr, rl, rr = (
            self._reading(place, str(state), wheels[place]) for place, state in enumerate(states)
        )
        self.wheel_speed_rpm = fl, fr, rl, rr
        left, right = (abs(side) > VALID_COMMAND_RPM for side in commanded)
        self.has_no_feedback = left and fl == 0, right and fr == 0, left and rl == 0, right and rr == 0

    def _reading(self, place: int, state: str, speed: float) -> float:
        if state == "frozen":
            return self.wheel_speed_rpm[place]
        return 0.0 if state == "dead" or abs(speed) < RESOLUTION_RPM else speed
