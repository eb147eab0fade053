"""The two fault masks of Board 2: one bit for each of its four sources [spec §2.2, §3.1].

The document has no table of these bits (E24); only the own sources of Board 2 have one (E23).
"""

from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Block
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.words import mask_of
from rovercheck.spec_model.signals.board2_supervisor import (
    b1_sup_status,
    critical_mask,
    degraded_mask,
    esp_status,
    imu_status,
    rx_status,
)

COMPONENTS: tuple[tuple[Var, str, str], ...] = (
    (esp_status, "CRITICAL", "DEGRADED"),
    (imu_status, "CRITICAL", "DEGRADED"),
    (rx_status, "RX_CRITICAL", "RX_DEGRADED"),
    (b1_sup_status, "SUP_CRITICAL", "SUP_DEGRADED"),
)
"""Bit 0 first: the status, its critical and its degraded level."""


fault_masks_2 = Block(
    "Fault_masks_2",
    [
        assign(critical_mask, mask_of([status == critical for status, critical, _ in COMPONENTS])),
        assign(degraded_mask, mask_of([status == degraded for status, _, degraded in COMPONENTS])),
    ],
    text="The critical and the degraded mask of Board 2 from the four statuses.",
)
