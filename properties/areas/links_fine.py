"""What must be true of the link statuses of Board 1 when updates come at any ms [spec Table 2].

The properties of ``links``, said again where an age and an interval are exact to the ms.
"""

from rovercheck.properties.forms import always, holds_after, reachable
from rovercheck.spec_model.board1.fine_systems import heartbeat, reception
from rovercheck.spec_model.lang.expr import Expr, Var, all_of, const, implies
from rovercheck.spec_model.lang.time import ms, ticks
from rovercheck.spec_model.lang.words import previous
from rovercheck.spec_model.signals.board1 import (
    b2_sup_status,
    heartbeat_slow,
    heartbeat_update,
    rx_slow,
    rx_status,
    rx_update,
)
from rovercheck.spec_model.signals.board1_fine import heartbeat_age_ms, heartbeat_lag, rx_age_ms, rx_lag

STEP = const(20, "ms")


def _interval(age: Var, lag: Var) -> Expr:
    """What an update in this step closes: from the latest stamp seen in the step before to its own."""
    return previous(age) + STEP - lag


rx_interval = _interval(rx_age_ms, rx_lag)
heartbeat_interval = _interval(heartbeat_age_ms, heartbeat_lag)

PB1_07a_ms = always(
    "PB1-07a-ms", "While the last valid frame is more than 120 ms old, to the ms, the reception is critical.",
    that=implies(rx_age_ms > 120, rx_status == "RX_CRITICAL"),
    covers=["B1-RX-03"], on="reception_ms", from_tick=2, interpretations=["S37", "S38", "S39"],
)  # fmt: skip
PB1_07b_ms = always(
    "PB1-07b-ms", "While the heartbeat is more than 120 ms old, to the ms, the supervisor is critical.",
    that=implies(heartbeat_age_ms > 120, b2_sup_status == "SUP_CRITICAL"),
    covers=["B1-SUP-03"], on="heartbeat_ms", from_tick=2, interpretations=["S37", "S38", "S39"],
)  # fmt: skip
PB1_08a_ms = always(
    "PB1-08a-ms",
    "To the ms, the reception is OK if and only if at most 120 ms old and its mean not above 40 ms.",
    that=(rx_status == "RX_OK") == ((rx_age_ms <= 120) & ~rx_slow),
    covers=["B1-RX-02", "B1-RX-03", "B1-RX-04"], on="reception_ms", from_tick=2,
    interpretations=["S34", "S38"],
)  # fmt: skip
PB1_08b_ms = always(
    "PB1-08b-ms",
    "To the ms, the supervisor is OK if and only if at most 120 ms old and its mean not above 40 ms.",
    that=(b2_sup_status == "SUP_OK") == ((heartbeat_age_ms <= 120) & ~heartbeat_slow),
    covers=["B1-SUP-02", "B1-SUP-03", "B1-SUP-04"], on="heartbeat_ms", from_tick=2,
    interpretations=["S34", "S38"],
)  # fmt: skip
PB1_08c_ms = holds_after(
    "PB1-08c-ms",
    "Frames more than 40 ms apart, never missing for more than 120 ms, make the reception degraded.",
    premise=implies(rx_update, rx_interval > 40) & (rx_age_ms <= 120), for_=77 * ticks,
    then=rx_status == "RX_DEGRADED",
    covers=["B1-RX-02"], on="reception_ms", from_tick=2, interpretations=["S34", "S35", "S36"],
)  # fmt: skip
PB1_08d_ms = holds_after(
    "PB1-08d-ms", "Frames at most 40 ms apart for the last 440 ms leave the reception OK.",
    premise=implies(rx_update, rx_interval <= 40) & (rx_age_ms <= 40), for_=440 * ms,
    then=rx_status == "RX_OK",
    covers=["B1-RX-02", "B1-RX-04"], on="reception_ms", from_tick=2, interpretations=["S36", "S37"],
)  # fmt: skip
PB1_08e_ms = holds_after(
    "PB1-08e-ms",
    "Heartbeats more than 40 ms apart, never missing for more than 120 ms, make the supervisor degraded.",
    premise=implies(heartbeat_update, heartbeat_interval > 40) & (heartbeat_age_ms <= 120), for_=77 * ticks,
    then=b2_sup_status == "SUP_DEGRADED",
    covers=["B1-SUP-02"], on="heartbeat_ms", from_tick=2, interpretations=["S34", "S35", "S36", "S40"],
)  # fmt: skip
PB1_08f_ms = holds_after(
    "PB1-08f-ms", "Heartbeats at most 40 ms apart for the last 440 ms leave the supervisor OK.",
    premise=implies(heartbeat_update, heartbeat_interval <= 40) & (heartbeat_age_ms <= 40), for_=440 * ms,
    then=b2_sup_status == "SUP_OK",
    covers=["B1-SUP-02", "B1-SUP-04"], on="heartbeat_ms", from_tick=2, interpretations=["S36", "S37"],
)  # fmt: skip
PB1_32a_ms = always(
    "PB1-32a-ms",
    "To the ms, the reception is critical exactly while older than 120 ms, else degraded if slow.",
    that=all_of(
        (rx_status == "RX_CRITICAL") == (rx_age_ms > 120),
        (rx_status == "RX_DEGRADED") == ((rx_age_ms <= 120) & rx_slow),
    ),
    covers=["B1-RX-05"], on="reception_ms", from_tick=2, interpretations=["S34", "S37", "S38", "S39"],
)  # fmt: skip
PB1_32b_ms = always(
    "PB1-32b-ms",
    "To the ms, the supervisor is critical exactly while older than 120 ms, else degraded if slow.",
    that=all_of(
        (b2_sup_status == "SUP_CRITICAL") == (heartbeat_age_ms > 120),
        (b2_sup_status == "SUP_DEGRADED") == ((heartbeat_age_ms <= 120) & heartbeat_slow),
    ),
    covers=["B1-RX-05"], on="heartbeat_ms", from_tick=2, interpretations=["S34", "S37", "S38", "S39", "S41"],
)  # fmt: skip

REACH_RX_DEG_MS = reachable(
    "REACH-RX-DEG-MS", "A mean above 40 ms of unlike intervals can make the reception degraded.",
    that=reception.active("Rx_DEG") & rx_update & (rx_interval <= 40),
    covers=["B1-RX-02"], on="reception_ms", interpretations=["S36"],
)  # fmt: skip
REACH_SUP_DEG_MS = reachable(
    "REACH-SUP-DEG-MS", "A mean above 40 ms of unlike intervals can make the supervisor degraded.",
    that=heartbeat.active("Sup_DEG") & heartbeat_update & (heartbeat_interval <= 40),
    covers=["B1-SUP-02"], on="heartbeat_ms", interpretations=["S36"],
)  # fmt: skip
