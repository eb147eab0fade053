"""What happens sooner or later, without a bound: a deviation ends, the stop is released, waiting returns."""

from properties.forms import leads_to, recoverable
from spec_model.board2.obstacles import obstacles_n
from spec_model.lang.expr import all_of
from spec_model.lang.time import ticks
from spec_model.signals.board2 import SONARS, B2Decision, prevDEG_B1

chart = obstacles_n()

# --- every deviation ends [seed §3.4.1 (1), Fig 25] ------------------------------------------------

PB2_09_left = leads_to(
    "PB2-09-left", "Moving toward sonar 1 ends.",
    trigger=B2Decision == 2, response=B2Decision != 2,
    covers=["B2-OBS-09"], on="obstacles_heading_free", readings=["E08"],
)  # fmt: skip

PB2_09_straight = leads_to(
    "PB2-09-straight", "Moving toward sonar 2 ends.",
    trigger=B2Decision == 3, response=B2Decision != 3, bound=25 * ticks,
    covers=["B2-OBS-08"], on="obstacles_n_straight", readings=["E05"],
)  # fmt: skip

PB2_09_right = leads_to(
    "PB2-09-right", "Moving toward sonar 3 ends.",
    trigger=B2Decision == 4, response=B2Decision != 4,
    covers=["B2-OBS-09"], on="obstacles_heading_free", readings=["E08"],
)  # fmt: skip

PB2_09c_ends_left = leads_to(
    "PB2-09c-ends-left", "If the rover turns as told, moving toward sonar 1 ends.",
    trigger=B2Decision == 2, response=B2Decision != 2,
    covers=["B2-OBS-09"], on="obstacles_turning_free", readings=("E06", "E08"),
)  # fmt: skip

PB2_09c_ends_right = leads_to(
    "PB2-09c-ends-right", "If the rover turns as told, moving toward sonar 3 ends.",
    trigger=B2Decision == 4, response=B2Decision != 4,
    covers=["B2-OBS-09"], on="obstacles_turning_free", readings=("E06", "E08"),
)  # fmt: skip

# --- waiting returns [seed §3.4.1, Fig 25] ---------------------------------------------------------

PB2_23_back = recoverable(
    "PB2-23-back", "From everywhere the chart can come back to Waiting.",
    to=chart.active("B2Decisions.Waiting"),
    by=all_of(prevDEG_B1, *(d > 300 for d in SONARS)), within=2 * ticks,
    covers=["B2-OBS-05"], on="obstacles_n_free",
)  # fmt: skip
