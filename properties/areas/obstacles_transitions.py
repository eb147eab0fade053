"""Every transition of the non-degraded obstacle chart can be taken [spec §3.4.1, Figs 24-27].

A transition is known by what it alone does: the states before and after it, or the flag that it sets.
"""

from rovercheck.properties.forms import Property, reachable
from rovercheck.spec_model.board2.obstacles import drawn_n as chart
from rovercheck.spec_model.lang.expr import Expr, all_of
from rovercheck.spec_model.lang.words import previous, rising
from rovercheck.spec_model.signals.board2 import (
    obj1Detected,
    obj2Detected,
    obj3Detected,
    prevDEG_B1,
)

again = chart.active("check_sonars_for_moving_again")
waiting, emergency = chart.active("B2Decisions.Waiting"), chart.active("InEmergency")
to_S1, to_S2, to_S3 = (chart.active(f"MoveToS{i}") for i in (1, 2, 3))
window_21, window_23, window_32 = (chart.active(f"timerSonar{ij}.Fall1Detected") for ij in (21, 23, 32))


def taken(id: str, transition: str, that: Expr, *covers: str, on: str = "obstacles_n") -> Property:
    """The transition is taken in some step of the chart as drawn."""
    return reachable(id, f"{transition} can be taken.", that=that, covers=covers, on=on)


def between(source: Expr, target: Expr) -> Expr:
    """One step leads from one state to another, and not because of prevDEG_B1."""
    return all_of(previous(source), target, ~prevDEG_B1)


def falls(detected: Expr) -> Expr:
    """The falling edge of a detection flag."""
    return previous(detected) & ~detected


def never_in(detected: Expr) -> Expr:
    """A detection flag is false throughout the step; it changes at most once in one."""
    return ~previous(detected) & ~detected


# --- distance_70 and distance_gt70 -----------------------------------------------------------------

PB2_23_stops = taken("PB2-23-stops", "The transition that stops", between(~again, again), "B2-OBS-11")
PB2_23_moves = taken("PB2-23-moves", "The transition that ends the stop", between(again, ~again), "B2-OBS-12")

PB2_23_rises_1 = taken(
    "PB2-23-rises-1", "The transition that detects at sonar 1", rising(obj1Detected), "B2-OBS-16"
)
PB2_23_rises_2 = taken(
    "PB2-23-rises-2", "The transition that detects at sonar 2", rising(obj2Detected), "B2-OBS-16"
)
PB2_23_rises_3 = taken(
    "PB2-23-rises-3", "The transition that detects at sonar 3", rising(obj3Detected), "B2-OBS-16"
)
PB2_23_falls_1 = taken("PB2-23-falls-1", "The transition that sends Fall1", falls(obj1Detected), "B2-OBS-17")
PB2_23_falls_2 = taken("PB2-23-falls-2", "The transition that sends Fall2", falls(obj2Detected), "B2-OBS-17")
PB2_23_falls_3 = taken("PB2-23-falls-3", "The transition that sends Fall3", falls(obj3Detected), "B2-OBS-17")

# --- the windows; the transitions that open them lead to the states of PB2-23-window-12 and so on --------

PB2_23_confirms_12 = taken(
    "PB2-23-confirms-12", "The transition of timerSonar12 that sends moveToS1",
    rising(to_S1), "B2-OBS-19", "B2-OBS-21",
)  # fmt: skip
PB2_23_confirms_21 = taken(
    "PB2-23-confirms-21", "The transition of timerSonar21 that sends moveToS2",
    rising(to_S2) & never_in(obj3Detected), "B2-OBS-19", "B2-OBS-21",
)  # fmt: skip
PB2_23_confirms_23 = taken(
    "PB2-23-confirms-23", "The transition of timerSonar23 that sends moveToS2",
    rising(to_S2) & never_in(obj1Detected), "B2-OBS-19", "B2-OBS-21",
)  # fmt: skip
PB2_23_confirms_32 = taken(
    "PB2-23-confirms-32", "The transition of timerSonar32 that sends moveToS3",
    rising(to_S3), "B2-OBS-19", "B2-OBS-21",
)  # fmt: skip


def expires(ij: str, window: Expr, confirming: Expr) -> Property:
    """The window ends although the second sonar detects nothing throughout the step."""
    return taken(
        f"PB2-23-expiry-{ij}", f"The transition of timerSonar{ij} for the end of its window",
        falls(window) & never_in(confirming), "B2-OBS-18", "B2-OBS-20", on=f"obstacles_n_{ij}",
    )  # fmt: skip


PB2_23_expiry_21 = expires("21", window_21, obj1Detected)
PB2_23_expiry_23 = expires("23", window_23, obj3Detected)
PB2_23_expiry_32 = expires("32", window_32, obj2Detected)

# --- B2Decisions -----------------------------------------------------------------------------------

PB2_23_W_E = taken("PB2-23-W-E", "Waiting -> InEmergency", between(waiting, emergency), "B2-OBS-06")
PB2_23_W_S1 = taken("PB2-23-W-S1", "Waiting -> MoveToS1", between(waiting, to_S1), "B2-OBS-06")
PB2_23_W_S2 = taken("PB2-23-W-S2", "Waiting -> MoveToS2", between(waiting, to_S2), "B2-OBS-06")
PB2_23_W_S3 = taken("PB2-23-W-S3", "Waiting -> MoveToS3", between(waiting, to_S3), "B2-OBS-06")
PB2_23_E_W = taken("PB2-23-E-W", "InEmergency -> Waiting", between(emergency, waiting), "B2-OBS-06")
PB2_23_S1_E = taken("PB2-23-S1-E", "MoveToS1 -> InEmergency", between(to_S1, emergency), "B2-OBS-06")
PB2_23_S2_E = taken("PB2-23-S2-E", "MoveToS2 -> InEmergency", between(to_S2, emergency), "B2-OBS-06")
PB2_23_S3_E = taken("PB2-23-S3-E", "MoveToS3 -> InEmergency", between(to_S3, emergency), "B2-OBS-06")
PB2_23_S1_W = taken("PB2-23-S1-W", "MoveToS1 -> Waiting", between(to_S1, waiting), "B2-OBS-09")
PB2_23_S2_W = taken(
    "PB2-23-S2-W", "MoveToS2 -> Waiting", between(to_S2, waiting), "B2-OBS-08", on="obstacles_n_sides",
)  # fmt: skip
PB2_23_S3_W = taken("PB2-23-S3-W", "MoveToS3 -> Waiting", between(to_S3, waiting), "B2-OBS-09")
