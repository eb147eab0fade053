"""The two fault masks of Board 2: one bit for each of its four sources [seed §2.2, §3.1].

The document has no table of these bits (E24); only the own sources of Board 2 have one (E23).  Under
SAME-AS-B1 they are those of Table 1: joystick and IMU have none, and bit 7, the supervisor of Board 1,
is beyond the four modelled.  Under REMOTE bit 3 also reflects the faults that Board 1 reports.
"""

from collections.abc import Sequence

from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Block
from rovercheck.spec_model.lang.expr import FALSE, Expr, Var, const, ite
from rovercheck.spec_model.readings import choose, under
from rovercheck.spec_model.signals.board2_supervisor import (
    b1_sup_status,
    crit_mask_b1,
    critical_mask,
    degr_mask_b1,
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


def _mask(bits: list[Expr]) -> Expr:
    total: Expr = const(0)
    for index, set_ in enumerate(bits):
        total = total + ite(set_, const(2**index), const(0))
    return total


def _bits(levels: Sequence[Expr], mask_of_board1: Var) -> list[Expr]:
    """The bits by the conditions that the four sources are at a level."""
    remote = under("E23", "REMOTE") & (mask_of_board1 != 0)
    joystick, imu, reception, supervisor = (*levels[:3], levels[3] | remote)
    as_on_board1 = [FALSE, FALSE, reception, remote]
    return [
        choose("E24", {"B2BITS": own, "SAME-AS-B1": table1})
        for own, table1 in zip((joystick, imu, reception, supervisor), as_on_board1, strict=True)
    ]


fault_masks_2 = Block(
    "Fault_masks_2",
    [
        assign(critical_mask, _mask(_bits([s == critical for s, critical, _ in COMPONENTS], crit_mask_b1))),
        assign(degraded_mask, _mask(_bits([s == degraded for s, _, degraded in COMPONENTS], degr_mask_b1))),
    ],
    text="The critical and the degraded mask of Board 2 from the four statuses.",
)
