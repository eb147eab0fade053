"""Signals of the obstacle logic of Board 2: what the sonars measure, what the charts keep and decide."""

from rovercheck.spec_model.ambiguity import choose
from rovercheck.spec_model.lang.domain import chosen, integer
from rovercheck.spec_model.lang.expr import Expr, Var, any_of, flag, var
from rovercheck.spec_model.lang.words import named
from rovercheck.spec_model.signals.common import COMMAND, USER_X

# Both sides of every limit the charts compare with: 70, 100 and 300 cm; 301 is "no echo" (E13).
distance = chosen([0, 70, 71, 100, 101, 200, 299, 300, 301], "cm")

d1 = var("d1", distance, doc="distance on the left sonar S1 [spec §1.3.1]")
d2 = var("d2", distance, doc="distance on the centre sonar S2 [spec §1.3.1]")
d3 = var("d3", distance, doc="distance on the right sonar S3 [spec §1.3.1]")
SONARS = (d1, d2, d3)
sonar_fault = flag("sonar_fault", "a bit of the fault masks beyond the four modelled: no echo (E13 FAULT)")

decision = integer(0, 7)
"""0 execute the user command, 1 stop, 2 3 4 move toward sonar 1 2 3, 5 move degraded, 6 stop degraded."""

MEANING = (
    "CMD_NORMAL", "CMD_ESTOP", "CMD_GO_LEFT", "CMD_NORMAL", "CMD_GO_RIGHT", "CMD_NORMAL", "CMD_ESTOP",
)  # fmt: skip
"""The command that each decision stands for [spec Fig 12]."""


def number(decision: int) -> Expr:
    """How a chart writes a decision: as drawn, or as the number of its command (E04 ENUM8, up to 7)."""
    enum8 = COMMAND.raw(MEANING[decision])
    return choose("E04", {"INDEX5-MAPPED": decision, "INDEX5-RAW": decision, "ENUM8": enum8})


# --- chart of the non-degraded state [spec §3.4.1, Figs 24-27] ------------------------------------

B2Decision = var("B2Decision", decision, doc="output of the non-degraded chart, 0..4 [spec §3.4.1 (1)]")
stop = flag("stop", "a sonar measured 70 cm or less [spec Fig 26]")
isClose = tuple(flag(f"isClose{i}", f"S{i} measured 100..300 cm [spec Fig 27]") for i in (1, 2, 3))
objDetected = tuple(flag(f"obj{i}Detected", f"S{i} holds a detection [spec §3.4.1 i]") for i in (1, 2, 3))
obj1Detected, obj2Detected, obj3Detected = objDetected

# --- chart of the degraded state [spec §3.4.2, Fig 28] --------------------------------------------

B2DecDegraded = var("B2DecDegraded", decision, doc="output of the degraded chart, 5 or 6 [spec Fig 28]")

# --- selection and translation [spec Figs 12, 24, 28] ---------------------------------------------

DEG_B1 = flag("DEG_B1", "Board 1 is not healthy or Board 2 drives: the degraded chart decides (E09)")
prevDEG_B1 = flag("prevDEG_B1", "DEG_B1 of the step before, read by the non-degraded chart [spec Fig 25]")
B2Dec = var("B2Dec", decision, doc="decision of Board 2 about obstacles [spec Figs 24, 28]")
command = var("command", COMMAND, doc="the decision as a command for Board 1 [spec Fig 12]")
x_sent = var("x_sent", USER_X, 0, "the turning command that Board 2 transmits (E31 ZERO-TURN)")


# --- what selects, where the obstacle charts are checked without the rest of the board -------------

deg_mask_b1 = flag("deg_mask_b1", "the degraded mask last received from Board 1 is not zero")
crit_mask_b1 = flag("crit_mask_b1", "the critical mask last received from Board 1 is not zero")
autorized_prev = flag("autorized_prev", "Board 2 was authorised to move the rover in the step before")
own_deg_mask = flag("own_deg_mask", "the degraded mask of Board 2 was not zero in the step before")
own_crit_mask = flag("own_crit_mask", "the critical mask of Board 2 was not zero in the step before")


def within(limit: int) -> Expr:
    """Some sonar measures an obstacle at ``limit`` cm or less."""
    return named(f"nearest <= {limit}", any_of(*(d <= limit for d in SONARS)))


def in_range(d: Var) -> Expr:
    """The range in which a moving obstacle is looked for: above 100, up to 300 cm (E01, E03)."""
    return named(f"closeRange({d.name})", (d > 100) & (d <= 300))


def touching(d: Var) -> Expr:
    """So near that the rover must stop: 70 cm or less (E01, E02)."""
    return d <= 70
