"""Construction of the two fault masks of Board 1: one bit per component [spec §2.6, Fig 18, Tables 1 and 3].

Table 3 prints the names of the temperature levels on almost every row; each row means the levels of
its own component (S51).  A component has one level, so no bit is in both masks (S52).
"""

from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Block
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.words import mask_of
from rovercheck.spec_model.signals.board1 import (
    b1_critical,
    b1_degraded,
    b2_sup_status,
    batt_status,
    critical_mask,
    degraded_mask,
    rx_status,
    temp_status,
    wheel_status,
)

COMPONENTS: tuple[tuple[Var, str, str], ...] = (
    (temp_status, "TEMP_HEALTH_CRITICAL", "TEMP_HEALTH_DEGRADED"),
    (batt_status, "BATT_HEALTH_CRITICAL", "BATT_HEALTH_DEGRADED"),
    (rx_status, "RX_CRITICAL", "RX_DEGRADED"),
    (wheel_status["FL"], "WHEEL_CRITICAL_MOTOR", "WHEEL_DEGRADED_ENCODER"),
    (wheel_status["FR"], "WHEEL_CRITICAL_MOTOR", "WHEEL_DEGRADED_ENCODER"),
    (wheel_status["RL"], "WHEEL_CRITICAL_MOTOR", "WHEEL_DEGRADED_ENCODER"),
    (wheel_status["RR"], "WHEEL_CRITICAL_MOTOR", "WHEEL_DEGRADED_ENCODER"),
    (b2_sup_status, "SUP_CRITICAL", "SUP_DEGRADED"),
)
"""Bit 0 first: the status, its critical and its degraded level."""


fault_masks = Block(
    "Fault_masks",
    [
        assign(critical_mask, mask_of([status == critical for status, critical, _ in COMPONENTS])),
        assign(degraded_mask, mask_of([status == degraded for status, _, degraded in COMPONENTS])),
    ],
    text="The critical and the degraded mask of Board 1 from the eight statuses.",
)

own_causes = Block(
    "Own_causes",
    [assign(b1_critical, critical_mask != 0), assign(b1_degraded, degraded_mask != 0)],
    text="Whether the masks of Board 1 hold any critical or degraded bit [spec Fig 21].",
)
