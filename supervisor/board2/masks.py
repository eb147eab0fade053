"""The fault masks of Board 2: one bit for each component [spec §2.6]."""

from dataclasses import dataclass

from rovercheck.supervisor.types import Level


@dataclass(frozen=True, slots=True)
class Statuses:
    """How well the four sources of Board 2 work, in the order of their bits."""

    esp_status: Level = Level.OK
    """Joystick link, bit 0."""
    imu_status: Level = Level.OK
    """Bit 1."""
    rx_status: Level = Level.OK
    """Reception from Board 1, bit 2."""
    b1_sup_status: Level = Level.OK
    """Supervisor of Board 1, bit 3."""


def mask(statuses: Statuses, level: Level) -> int:
    """The 8-bit mask of the components that are at this level."""
    components = (statuses.esp_status, statuses.imu_status, statuses.rx_status, statuses.b1_sup_status)
    return sum(1 << bit for bit, status in enumerate(components) if status is level)
