"""Board 2 on a bench: every source is fresh in every step until a test says otherwise."""

from dataclasses import dataclass, field, replace
from typing import Any

from rovercheck.supervisor.board2.board import Board2
from rovercheck.supervisor.board2.signals import Board2Inputs, Board2Outputs, FromBoard1
from rovercheck.supervisor.timing import CLOCK
from rovercheck.supervisor.types import STEP_MS

STAMPS = (
    "last_valid_b1_ms",
    "b1_data_last_valid_ms",
    "sonar_last_valid_ms",
    "imu_last_valid_ms",
    "ble_last_valid_ms",
)
FAR = (301.0, 301.0, 301.0)
B1_RECEPTION = 1 << 2
"""Bit of Board 1 that asks Board 2 to drive."""


@dataclass
class Bench:
    """Calls the board every 20 ms; the stamps named in ``stale`` stay where they are."""

    now_ms: int = 0
    stale: set[str] = field(default_factory=set)
    board: Board2 = field(default_factory=Board2)
    inputs: Board2Inputs = field(default_factory=lambda: Board2Inputs(dist_cm=FAR))

    def step(self, steps: int = 1, **changes: Any) -> Board2Outputs:
        """The outputs of the last of so many steps; changed inputs keep their new values."""
        self.inputs = replace(self.inputs, **changes)
        for _ in range(steps):
            self.now_ms = (self.now_ms + STEP_MS) % CLOCK
            fresh: dict[str, Any] = {name: self.now_ms for name in STAMPS if name not in self.stale}
            self.inputs = replace(self.inputs, now_ms=self.now_ms, **fresh)
            outputs = self.board.step(self.inputs)
        return outputs

    def masks(self, critical: int = 0, degraded: int = 0) -> FromBoard1:
        """The payload of Board 1 with other masks."""
        return replace(self.inputs.payload, critical_mask=critical, degraded_mask=degraded)

    def wheels(self, rpm: float) -> FromBoard1:
        """The payload of Board 1 with another speed of all wheels."""
        return replace(self.inputs.payload, wheel_speed_rpm=(rpm, rpm, rpm, rpm))

    def authorise(self) -> Board2Outputs:
        """The first authorised step: the second one of the board, Board 1 asking for it."""
        self.step()
        return self.step(payload=self.masks(critical=B1_RECEPTION))
