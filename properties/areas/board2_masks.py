"""What must be true of the fault masks of Board 2 and of the classes of faults [spec §2.2, §3.1] (E24)."""

from rovercheck.properties.document.masks import BOARD_2
from rovercheck.properties.forms import always, reachable
from rovercheck.spec_model.lang.expr import all_of, any_of
from rovercheck.spec_model.lang.words import bit
from rovercheck.spec_model.signals.board2_supervisor import (
    b1_emergency,
    b1_requests_switch,
    b2_emergency,
    crit_mask_b1,
    critical_mask,
    degraded_mask,
    esp_status,
    imu_status,
)

ON = "masks_2"
COVERS = ["B1-MASK-01", "B2-FLT-02", "B2-COM-07"]

PB1_10d = always(
    "PB1-10d", "Board 2: bit i of the critical mask is set if and only if source i is critical.",
    that=all_of(*(bit(critical_mask, i) == (s == critical) for i, (s, critical, _) in enumerate(BOARD_2))),
    covers=COVERS, on=ON, from_tick=2, interpretations=["E24"],
)  # fmt: skip
PB1_10e = always(
    "PB1-10e", "Board 2: bit i of the degraded mask is set if and only if source i is degraded.",
    that=all_of(*(bit(degraded_mask, i) == (s == degraded) for i, (s, _, degraded) in enumerate(BOARD_2))),
    covers=COVERS, on=ON, from_tick=2, interpretations=["E24"],
)  # fmt: skip
PB1_10f = always(
    "PB1-10f", "Board 2: no bit is set in both masks.",
    that=all_of(*(~(bit(critical_mask, i) & bit(degraded_mask, i)) for i in range(len(BOARD_2)))),
    covers=COVERS, on=ON, from_tick=2, interpretations=["E24"],
)  # fmt: skip
PB2_14e = always(
    "PB2-14e", "Every critical bit of Board 1 either stops Board 2 or asks it to move the rover.",
    that=all_of(
        b1_requests_switch == (bit(crit_mask_b1, 2) | bit(crit_mask_b1, 7)),
        b1_emergency == any_of(*(bit(crit_mask_b1, i) for i in (0, 1, 3, 4, 5, 6))),
        (crit_mask_b1 != 0) == (b1_requests_switch | b1_emergency),
    ),
    covers=["B2-ACT-01", "B2-FLT-01"], on=ON, from_tick=2, interpretations=["E22", "E23"],
)  # fmt: skip
PB2_17r = always(
    "PB2-17r", "The own emergency of Board 2 is a critical joystick link or a critical IMU.",
    that=b2_emergency == ((esp_status == "CRITICAL") | (imu_status == "CRITICAL")),
    covers=["B2-FLT-01", "B2-REF-01"], on=ON, from_tick=2, interpretations=["E23"],
)  # fmt: skip

REACH_B2_MASKS_FULL = reachable(
    "REACH-B2-MASKS-FULL", "Every bit of the critical mask of Board 2 can be set at once.",
    that=critical_mask == 15, covers=["B2-FLT-02"], on=ON,
)  # fmt: skip
REACH_B2_MASKS_MIXED = reachable(
    "REACH-B2-MASKS-MIXED", "Board 2 can have critical and degraded sources at the same time.",
    that=(critical_mask != 0) & (degraded_mask != 0), covers=["B2-FLT-02"], on=ON,
)  # fmt: skip
REACH_B2_BOTH_CLASSES = reachable(
    "REACH-B2-BOTH-CLASSES", "Board 1 can ask for the switch and report an emergency at once.",
    that=b1_requests_switch & b1_emergency, covers=["B2-FLT-01"], on=ON,
)  # fmt: skip
