"""Every state of the obstacle charts can be reached, and every window of 3 s can end either way."""

from rovercheck.properties.forms import Property, reachable
from rovercheck.spec_model.board2.obstacles import drawn_n as chart
from rovercheck.spec_model.board2.obstacles_degraded import drawn_d as degraded
from rovercheck.spec_model.lang.words import previous
from rovercheck.spec_model.signals.board2 import obj2Detected


def reached(id: str, state: str, *covers: str) -> Property:
    """The state is active at the end of some step of the chart as drawn."""
    return reachable(
        id, f"{state} can be reached.", that=chart.active(state), covers=covers, on="obstacles_n"
    )


PB2_23_Waiting = reached("PB2-23-Waiting", "B2Decisions.Waiting", "B2-OBS-05")
PB2_23_InEmergency = reached("PB2-23-InEmergency", "B2Decisions.InEmergency", "B2-OBS-06")
PB2_23_MoveToS1 = reached("PB2-23-MoveToS1", "B2Decisions.MoveToS1", "B2-OBS-06", "B2-OBS-13")
PB2_23_MoveToS2 = reached("PB2-23-MoveToS2", "B2Decisions.MoveToS2", "B2-OBS-06", "B2-OBS-13")
PB2_23_MoveToS3 = reached("PB2-23-MoveToS3", "B2Decisions.MoveToS3", "B2-OBS-06", "B2-OBS-13")
PB2_23_stopping = reached("PB2-23-stopping", "check_sonars_for_stopping", "B2-OBS-10")
PB2_23_again = reached("PB2-23-again", "check_sonars_for_moving_again", "B2-OBS-10")
PB2_23_window_12 = reached("PB2-23-window-12", "timerSonar12.Fall1Detected", "B2-OBS-10", "B2-OBS-13")
PB2_23_window_21 = reached("PB2-23-window-21", "timerSonar21.Fall1Detected", "B2-OBS-10", "B2-OBS-13")
PB2_23_window_23 = reached("PB2-23-window-23", "timerSonar23.Fall1Detected", "B2-OBS-10", "B2-OBS-13")
PB2_23_window_32 = reached("PB2-23-window-32", "timerSonar32.Fall1Detected", "B2-OBS-10", "B2-OBS-13")

PB2_23_degraded_stop = reachable(
    "PB2-23-degraded-stop", "The degraded chart can stop the rover.",
    that=degraded.active("check_sonars_for_moving_again"), covers=["B2-OBS-22"], on="obstacles_d",
)  # fmt: skip

window_12 = chart.active("timerSonar12.Fall1Detected")

PB2_23_expiry = reachable(
    "PB2-23-expiry", "A window of 3 s can end without a confirmation.",
    that=previous(window_12) & ~window_12 & ~previous(obj2Detected) & ~obj2Detected,
    covers=("B2-OBS-18", "B2-OBS-20"), on="obstacles_n_12", interpretations=["E14"],
)  # fmt: skip
