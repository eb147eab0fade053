"""What happens sooner or later, without a bound: a deviation ends, the stop is released, waiting returns."""

from rovercheck.properties.areas.motion import calm, resumed
from rovercheck.properties.forms import leads_to, recoverable, settles
from rovercheck.spec_model.board2.obstacles import drawn_n as chart
from rovercheck.spec_model.lang.expr import all_of
from rovercheck.spec_model.lang.time import ticks
from rovercheck.spec_model.signals.board1 import is_rotating180
from rovercheck.spec_model.signals.board2 import B2Decision, d1, d2, d3, prevDEG_B1

# --- the stop of Board 1 is released [spec §2.3]; steps are those in which Board 1 actuates ----------

RESUMES = ("B1-EST-01", "B1-ACT-01")

PB1_25 = settles(
    "PB1-25", "With no critical cause, CMD_NORMAL and wheels at rest for good, Board 1 resumes for good.",
    premise=calm, then=resumed,
    covers=RESUMES, on="references_executed", interpretations=["S62"],
)  # fmt: skip

PB1_25_turned = settles(
    "PB1-25-turned",
    "If every 180° rotation ends, with no critical cause, CMD_NORMAL and wheels at rest for good, Board 1 "
    "resumes for good.",
    premise=calm, then=resumed, fair=[~is_rotating180],
    covers=RESUMES, on="references_executed", interpretations=["S62"],
)  # fmt: skip

# --- every deviation ends [spec §3.4.1 (1), Fig 25] ------------------------------------------------

PB2_09_left = leads_to(
    "PB2-09-left", "Moving toward sonar 1 ends.",
    trigger=B2Decision == 2, response=B2Decision != 2,
    covers=["B2-OBS-09"], on="obstacles_heading", interpretations=["E08"],
)  # fmt: skip

PB2_09_straight = leads_to(
    "PB2-09-straight", "Moving toward sonar 2 ends.",
    trigger=B2Decision == 3, response=B2Decision != 3,
    covers=["B2-OBS-08"], on="obstacles_n_sides", interpretations=("E05", "E08"),
)  # fmt: skip

PB2_09_right = leads_to(
    "PB2-09-right", "Moving toward sonar 3 ends.",
    trigger=B2Decision == 4, response=B2Decision != 4,
    covers=["B2-OBS-09"], on="obstacles_heading", interpretations=["E08"],
)  # fmt: skip

PB2_09c_ends_left = leads_to(
    "PB2-09c-ends-left", "If the rover turns as told, moving toward sonar 1 ends.",
    trigger=B2Decision == 2, response=B2Decision != 2, bound=3 * ticks,
    covers=["B2-OBS-09"], on="obstacles_turning_free", interpretations=("E06", "E08"),
)  # fmt: skip

PB2_09c_ends_right = leads_to(
    "PB2-09c-ends-right", "If the rover turns as told, moving toward sonar 3 ends.",
    trigger=B2Decision == 4, response=B2Decision != 4,
    covers=["B2-OBS-09"], on="obstacles_turning", interpretations=("E06", "E08"),
)  # fmt: skip

# --- waiting returns [spec §3.4.1, Fig 25] ---------------------------------------------------------

PB2_23_back = recoverable(
    "PB2-23-back", "From everywhere the chart can come back to Waiting.",
    to=chart.active("B2Decisions.Waiting"),
    by=all_of(prevDEG_B1, *(d > 300 for d in (d1, d2, d3))), within=2 * ticks,
    covers=["B2-OBS-05"], on="obstacles_n_free",
)  # fmt: skip
