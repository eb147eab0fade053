"""What the critical masks of both boards ask of Board 2."""

from dataclasses import dataclass

JOYSTICK, IMU = 1 << 0, 1 << 1
"""Bits of Board 2 without which it cannot drive."""
B1_RECEPTION, B1_FINDS_B2_SUPERVISOR = 1 << 2, 1 << 7
"""Bits of Board 1 [spec Table 1] that hand the motors over, and endanger nothing by themselves."""


@dataclass(frozen=True, slots=True)
class Classification:
    """The faults of both boards by what Board 2 must do about them."""

    b2_emergency: bool = False
    b1_requests_switch: bool = False
    b1_emergency: bool = False

    @property
    def emergency(self) -> bool:
        """Whether Board 2 must not let the rover move."""
        return self.b1_emergency or self.b2_emergency


def classify(own_critical_mask: int, b1_critical_mask: int) -> Classification:
    """Judge the mask of this step and the last one received from Board 1."""
    switch = B1_RECEPTION | B1_FINDS_B2_SUPERVISOR
    return Classification(
        b2_emergency=bool(own_critical_mask & (JOYSTICK | IMU)),
        b1_requests_switch=bool(b1_critical_mask & switch),
        b1_emergency=bool(b1_critical_mask & ~switch),
    )
