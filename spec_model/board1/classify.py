"""What the fault masks received from Board 2 mean for the rover: stop it or slow it down [seed Fig 19].

Some critical bits of Board 2 only slow the rover down (S55).  The bits (S54): 0 joystick link, 1 IMU,
2 reception from Board 1, 3 supervisor of Board 1.  Under SAME-AS-B1 they are those of Table 1.
"""

from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Block
from rovercheck.spec_model.lang.words import bit, named
from rovercheck.spec_model.readings import choose
from rovercheck.spec_model.signals.board1 import b2_critical, b2_degraded, crit_mask_b2, degr_mask_b2

# Of the bits of Table 1 the link (2) slows down and the others stop; bits 4 to 7 are beyond the 4 modelled.
stopping = choose(
    "S54",
    {
        "B2BITS": bit(crit_mask_b2, 0) | bit(crit_mask_b2, 1),
        "SAME-AS-B1": bit(crit_mask_b2, 0) | bit(crit_mask_b2, 1) | bit(crit_mask_b2, 3),
    },
)
slowing = choose(
    "S54",
    {"B2BITS": bit(crit_mask_b2, 2) | bit(crit_mask_b2, 3), "SAME-AS-B1": bit(crit_mask_b2, 2)},
)

stop_required = named("stop_required", choose("S55", {"CLASSIFIED": stopping, "ANY-BIT": crit_mask_b2 != 0}))
degraded_required = named(
    "degraded_required",
    choose("S55", {"CLASSIFIED": slowing | (degr_mask_b2 != 0), "ANY-BIT": degr_mask_b2 != 0}),
)

process_b2_masks = Block(
    "Process_B2_masks",
    [assign(b2_critical, stop_required), assign(b2_degraded, degraded_required)],
    text="Classes of the faults that Board 2 reports.",
)
