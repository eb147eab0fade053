"""Motor commands of Board 2, which it sends while it is authorised, and its stop pin."""

from dataclasses import dataclass
from math import isfinite

FULL_SCALE_RPM = 160.0
MAX_RPM = 80.0
MAX_CHANGE_RPM = 4.0
"""Largest change of a side from one command to the next."""
FULL_SCALE_V = 12.0
DRIVER_TIMEOUT_MS = 300


@dataclass(frozen=True)
class MotorCommand:
    """Speeds of the two sides in rpm; front and rear wheel of a side get the same voltage."""

    left_rpm: float = 0.0
    right_rpm: float = 0.0

    @property
    def volts(self) -> tuple[float, float, float, float]:
        """Voltages of the wheels FL, FR, RL and RR."""
        left = FULL_SCALE_V * self.left_rpm / FULL_SCALE_RPM
        right = FULL_SCALE_V * self.right_rpm / FULL_SCALE_RPM
        return left, right, left, right


@dataclass(frozen=True)
class Actuated:
    """What a step puts on the lines of Board 2."""

    stop_pin: bool
    """Whether it has its stop level."""
    driver_timeout_ms: int | None = None
    """The initialisation of the driver, if it is sent: it stops the motors so long after a last command."""
    motors: MotorCommand | None = None
    """The command that is sent, if one is."""


@dataclass
class Actuation:
    """Sends in authorised steps; the first one after power-up only initialises the driver.

    Without authorisation nothing is sent and the stop pin keeps its level.
    """

    _stop_pin: bool = True
    _autorized: bool = False
    _initialised: bool = False
    _last: MotorCommand = MotorCommand()

    def step(self, autorized: bool, v_ref: float, omega_ref: float, emergency_stop: bool) -> Actuated:
        """Execute one step; the references are parts of full scale, ``omega_ref`` positive to the left."""
        resumed = autorized and not self._autorized
        self._autorized = autorized
        if resumed:
            self._last = MotorCommand()
        if not autorized:
            return Actuated(self._stop_pin)
        if not self._initialised:
            self._initialised = True
            return Actuated(self._stop_pin, driver_timeout_ms=DRIVER_TIMEOUT_MS)
        self._stop_pin = emergency_stop
        self._last = MotorCommand(
            left_rpm=next_rpm(self._last.left_rpm, v_ref - omega_ref),
            right_rpm=next_rpm(self._last.right_rpm, v_ref + omega_ref),
        )
        return Actuated(self._stop_pin, motors=self._last)


def next_rpm(last_rpm: float, reference: float) -> float:
    """The speed of a side after ``last_rpm``; a reference that is infinite or no number asks for rest."""
    wanted = FULL_SCALE_RPM * reference if isfinite(reference) else 0.0
    limited = max(-MAX_RPM, min(MAX_RPM, wanted))
    return max(last_rpm - MAX_CHANGE_RPM, min(last_rpm + MAX_CHANGE_RPM, limited))
