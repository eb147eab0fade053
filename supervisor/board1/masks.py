"""The fault masks of Board 1: one bit per component [spec §2.6, Fig 18, Tables 1 and 3]."""

from dataclasses import dataclass

from rovercheck.supervisor.board1.signals import Statuses
from rovercheck.supervisor.types import Level


@dataclass(frozen=True, slots=True)
class Masks:
    """Components that fail and components that work badly, 8 bits each; no bit is in both (S52)."""

    critical: int
    degraded: int


def fault_masks(statuses: Statuses) -> Masks:
    """Both masks; bit 0 is the temperature, bit 7 the supervisor of Board 2 [spec Table 1]."""
    components = (
        statuses.temp_status,
        statuses.batt_status,
        statuses.rx_status,
        *statuses.wheel_status,
        statuses.b2_sup_status,
    )
    return Masks(mask(components, Level.CRITICAL), mask(components, Level.DEGRADED))


def mask(components: tuple[Level, ...], level: Level) -> int:
    """The components at a level, the first one in bit 0."""
    return sum(1 << bit for bit, status in enumerate(components) if status is level)
