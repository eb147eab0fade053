"""What the fault masks received from Board 2 mean for the rover: stop it or slow it down [spec Fig 19].

Some critical bits of Board 2 only slow the rover down (S55).  The bits (S54): 0 joystick link, 1 IMU,
2 reception from Board 1, 3 supervisor of Board 1.
"""

from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Block
from rovercheck.spec_model.lang.words import bit, named
from rovercheck.spec_model.signals.board1 import b2_critical, b2_degraded, crit_mask_b2, degr_mask_b2

stop_required = named("stop_required", bit(crit_mask_b2, 0) | bit(crit_mask_b2, 1))
degraded_required = named(
    "degraded_required", bit(crit_mask_b2, 2) | bit(crit_mask_b2, 3) | (degr_mask_b2 != 0)
)

process_b2_masks = Block(
    "Process_B2_masks",
    [assign(b2_critical, stop_required), assign(b2_degraded, degraded_required)],
    text="Classes of the faults that Board 2 reports.",
)
