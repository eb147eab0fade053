"""What must be true of the fault masks of Board 1 [spec §2.3, §2.6, Tables 1 and 3]."""

from rovercheck.properties.document.masks import BOARD_1, WHEELS
from rovercheck.properties.forms import always, reachable
from rovercheck.spec_model.lang.expr import all_of
from rovercheck.spec_model.lang.words import bit
from rovercheck.spec_model.signals.board1 import (
    b1_critical,
    b1_degraded,
    critical_mask,
    degraded_mask,
    wheel_status,
)

ON = "masks"

PB1_10a = always(
    "PB1-10a", "Bit i of the critical mask is set if and only if component i is critical.",
    that=all_of(*(bit(critical_mask, i) == (s == critical) for i, (s, critical, _) in enumerate(BOARD_1))),
    covers=["B1-MASK-01", "B1-MASK-02"], on=ON, from_tick=2, interpretations=["S51"],
)  # fmt: skip
PB1_10b = always(
    "PB1-10b", "Bit i of the degraded mask is set if and only if component i is degraded.",
    that=all_of(*(bit(degraded_mask, i) == (s == degraded) for i, (s, _, degraded) in enumerate(BOARD_1))),
    covers=["B1-MASK-01", "B1-MASK-03"], on=ON, from_tick=2, interpretations=["S51"],
)  # fmt: skip
PB1_10c = always(
    "PB1-10c", "No bit is set in both masks.",
    that=all_of(*(~(bit(critical_mask, i) & bit(degraded_mask, i)) for i in range(len(BOARD_1)))),
    covers=["B1-MASK-02", "B1-MASK-03"], on=ON, from_tick=2, interpretations=["S52"],
)  # fmt: skip
PB1_10g = always(
    "PB1-10g",
    "A bit of the critical mask is a critical cause of Board 1, one of the degraded mask a degraded one.",
    that=all_of(b1_critical == (critical_mask != 0), b1_degraded == (degraded_mask != 0)),
    covers=["B1-REF-07"], on=ON,
)  # fmt: skip
PB1_31a = always(
    "PB1-31a", "Bit i + 2 of one of the two masks is set if and only if wheel i is not OK.",
    that=all_of(*(
        (bit(critical_mask, i) | bit(degraded_mask, i)) == (wheel_status[wheel] != "WHEEL_OK")
        for i, wheel in enumerate(WHEELS, start=3)
    )),
    covers=["B1-WHL-05"], on=ON, from_tick=2, interpretations=["S33", "S51"],
)  # fmt: skip

REACH_MASKS_FULL = reachable(
    "REACH-MASKS-FULL", "Every bit of the critical mask can be set at once.",
    that=critical_mask == 255, covers=["B1-MASK-01"], on=ON,
)  # fmt: skip
REACH_MASKS_MIXED = reachable(
    "REACH-MASKS-MIXED", "Critical and degraded bits can be set at the same time.",
    that=(critical_mask != 0) & (degraded_mask != 0), covers=["B1-MASK-02", "B1-MASK-03"], on=ON,
)  # fmt: skip
