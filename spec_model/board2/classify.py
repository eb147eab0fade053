"""What the critical masks mean for Board 2: a fault that stops the rover, or a request to take the motors.

Bits of Board 1 (Table 1): 2 is its reception from Board 2, 7 its view of the Board 2 supervisor.
"""

from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Block
from rovercheck.spec_model.lang.expr import any_of
from rovercheck.spec_model.lang.words import bit
from rovercheck.spec_model.signals.board2_supervisor import (
    b1_emergency,
    b1_requests_switch,
    b2_emergency,
    crit_mask_b1,
    critical_mask,
)

SWITCH = (2, 7)
"""Bits of Board 1 that ask Board 2 to move the rover; every other critical bit stops it."""

process_masks = Block(
    "Process_masks",
    [
        assign(b2_emergency, bit(critical_mask, 0) | bit(critical_mask, 1)),
        assign(b1_requests_switch, any_of(*(bit(crit_mask_b1, i) for i in SWITCH))),
        assign(b1_emergency, any_of(*(bit(crit_mask_b1, i) for i in range(8) if i not in SWITCH))),
    ],
    text="Classes of the own critical faults and of those that Board 1 reports.",
)
