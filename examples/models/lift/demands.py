"""What must be true of the lift."""

from door import door
from signals import blocked, gap, locked, motor, moving

from rovercheck import always, holds_for, implies, never, recoverable, ticks

LIFT_1 = never(
    "LIFT-1",
    "The cabin never moves with the door open.",
    that=moving & (gap > 0),
    covers=["SAFE-1"],
    on="lift",
)
LIFT_2 = always(
    "LIFT-2",
    "While something is in the light curtain the door does not close.",
    that=implies(blocked, motor != "CLOSE"),
    covers=["SAFE-2"],
    on="lift",
)
LIFT_3 = holds_for(
    "LIFT-3",
    "Once open, the door stays open for 3 s.",
    start=door.active("Open"),
    that=door.active("Open"),
    for_=149 * ticks,  # the tick in which it opens and 149 more: 3 s
    covers=["COMFORT-1"],
    on="lift",
)
LIFT_4 = recoverable(
    "LIFT-4",
    "Whatever happens, the door can be locked again.",
    to=locked,
    covers=["SAFE-3"],
    on="lift",
)
