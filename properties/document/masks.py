"""The fault masks of both boards, bit 0 first: whose bit it is, and at which levels it is set."""

from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.signals import board1 as b1
from rovercheck.spec_model.signals import board2_supervisor as b2

WHEELS = ("FL", "FR", "RL", "RR")
"""In the order of bits 3 to 6 [spec Table 1]."""

Bit = tuple[Var, str, str]
"""A status, its level for the critical mask and its level for the degraded one."""

BOARD_1: tuple[Bit, ...] = (
    (b1.temp_status, "TEMP_HEALTH_CRITICAL", "TEMP_HEALTH_DEGRADED"),
    (b1.batt_status, "BATT_HEALTH_CRITICAL", "BATT_HEALTH_DEGRADED"),
    (b1.rx_status, "RX_CRITICAL", "RX_DEGRADED"),
    *((b1.wheel_status[wheel], "WHEEL_CRITICAL_MOTOR", "WHEEL_DEGRADED_ENCODER") for wheel in WHEELS),
    (b1.b2_sup_status, "SUP_CRITICAL", "SUP_DEGRADED"),
)
"""[spec Tables 1 and 3]; each row of Table 3 means the levels of its own component (S51)."""

BOARD_2: tuple[Bit, ...] = (
    (b2.esp_status, "CRITICAL", "DEGRADED"),
    (b2.imu_status, "CRITICAL", "DEGRADED"),
    (b2.rx_status, "RX_CRITICAL", "RX_DEGRADED"),
    (b2.b1_sup_status, "SUP_CRITICAL", "SUP_DEGRADED"),
)
"""Joystick link, IMU, reception, supervisor of Board 1 [design] (S54, E24)."""
